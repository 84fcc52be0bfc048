//! Branches with states that grow without bound, and meshes that must follow them.

use crate::{of, trace};
use bvp::{Constant, Ends, Family, Problem, Real, Segment};
use continuation::{Direction, Kind, Options, Stop};

/// u'' + λ exp(u / (1 + ε u)) = 0, u(0) = u(1) = 0: an S for ε below 0.24, and Bratu's problem for
/// ε = 0.
struct Perturbed {
    epsilon: f64,
}

impl Problem for Perturbed {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 1.0)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn condition_count(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -p[0] * (y[0] / (y[0] * self.epsilon + 1.0)).exp();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
    }
}

/// λ of the limit points and the reason to stop, from u = 0 with λ within the bounds.
fn limits(epsilon: f64, bounds: [f64; 2], options: &bvp::Options) -> (Vec<f64>, Stop) {
    let problem = Perturbed { epsilon };
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![0.0],
    };
    let (mut family, start) = Family::new(&problem, 0, &[], &guess, options).unwrap();
    let options = Options::within(bounds[0], bounds[1]);
    let (points, stop) = trace(&mut family, &start, Direction::Increasing, &options);
    let limits = of(&points, Kind::LimitPoint);
    (limits.iter().map(|point| point.lambda()).collect(), stop)
}

#[test]
fn an_s_with_states_of_ten_thousands_has_two_limit_points_and_reaches_the_bound() {
    for i in 0..=27 {
        let epsilon = 0.08 + 0.04 * f64::from(i) / 27.0;
        let (limits, stop) = limits(epsilon, [0.0, 8.0], &bvp::Options::default());
        assert_eq!(limits.len(), 2, "ε = {epsilon}: {limits:?}, {stop}");
        assert!(matches!(stop, Stop::Bound { lambda: 8.0 }), "{stop}");
    }
}

#[test]
fn an_asymptote_at_a_bound_is_named() {
    for high in [4.0, 8.0, 40.0] {
        let (limits, stop) = limits(0.0, [0.0, high], &bvp::Options::default());
        assert!(matches!(stop, Stop::Asymptote { lambda: 0.0 }), "{stop}");
        assert_eq!(limits.len(), 1, "{limits:?}, {stop}");
        assert!((limits[0] - 3.513_830_719_125_161).abs() < 1e-5);
    }
}

#[test]
fn an_asymptote_within_the_bounds_ends_the_branch_with_a_reason() {
    for low in [-1.0, -4.0] {
        let (limits, stop) = limits(0.0, [low, 4.0], &bvp::Options::default());
        assert_eq!(limits.len(), 1, "{limits:?}, {stop}");
        let reason = matches!(stop, Stop::StepTooSmall { .. } | Stop::Inaccurate { .. });
        assert!(reason, "{stop}");
    }
}

#[test]
fn a_fine_tolerance_needs_no_finer_mesh_than_its_solutions() {
    // The points are corrected as far as the tolerance asks for.
    for tolerance in [1e-8, 1e-9, 1e-10, 1e-11] {
        let problem = Perturbed { epsilon: 0.0 };
        let guess = Constant {
            states: vec![vec![0.0; 2]],
            parameters: vec![0.1],
        };
        let options = bvp::Options {
            tolerance,
            ..bvp::Options::default()
        };
        let (mut family, start) = Family::new(&problem, 0, &[], &guess, &options).unwrap();
        let options = Options::within(0.05, 4.0);
        let (points, stop) = trace(&mut family, &start, Direction::Increasing, &options);
        let largest = points.iter().map(|point| point.z.len()).max().unwrap();
        println!("{tolerance:e}: {largest} unknowns");
        assert!(matches!(stop, Stop::Bound { lambda: 0.05 }), "{stop}");
        assert!(largest < 1200, "{tolerance:e}: {largest} unknowns");
    }
}
