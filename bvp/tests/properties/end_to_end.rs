//! Published values of eigenvalue, periodic, multipoint and free-length problems.

use bvp::{Constant, Ends, Function, Options, Problem, Real, Scheme, Segment, solve};
use std::f64::consts::PI;

/// y'' + (λ − 2q cos 2x) y = 0 with q = 5, y'(0) = y'(π) = 0, y(0) = 1: the example `mat4bvp` of
/// Kierzenka & Shampine (2001).
pub(crate) struct Mathieu;

impl Mathieu {
    /// Four half waves and λ = 15.
    pub(crate) fn guess() -> Function<fn(usize, f64) -> [f64; 2]> {
        Function {
            state: |_, s| [(4.0 * s).cos(), -4.0 * (4.0 * s).sin()],
            parameters: vec![15.0],
        }
    }
}

impl Problem for Mathieu {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, PI)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, x: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -(p[0] - (x * 2.0).cos() * 10.0) * y[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[1];
        r[1] = at.end(0)[1];
        r[2] = at.start(0)[0] - 1.0;
    }
}

fn tight() -> Options {
    Options {
        tolerance: 1e-10,
        ..Options::default()
    }
}

#[test]
fn the_fourth_eigenvalue_of_mathieus_equation() {
    let solution = solve(&Mathieu, &Mathieu::guess(), &tight()).unwrap();
    let error = solution.parameters()[0] - 17.096_581_684_366_05;
    assert!(error.abs() < 1e-9, "{error:e}");
}

/// The nerve impulse of `FitzHugh` and Nagumo scaled to one unknown period p, as in R. Seydel,
/// *From Equilibrium to Chaos* (Elsevier 1988).
pub(crate) struct FitzHughNagumo;

impl FitzHughNagumo {
    /// A circle and the period 2π.
    pub(crate) fn guess() -> Function<fn(usize, f64) -> [f64; 2]> {
        Function {
            state: |_, s| [2.0 * (2.0 * PI * s).sin(), (2.0 * PI * s).cos()],
            parameters: vec![2.0 * PI],
        }
    }
}

impl Problem for FitzHughNagumo {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = p[0] * 3.0 * (y[0] + y[1] - y[0].powi(3) / 3.0 - 1.3);
        dy[1] = -p[0] * (y[0] - 0.7 + y[1] * 0.8) / 3.0;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (start, end) = (at.start(0), at.end(0));
        r[0] = start[0] - end[0];
        r[1] = start[1] - end[1];
        r[2] = -p[0] * (start[0] - 0.7 + start[1] * 0.8) / 3.0 - 1.0;
    }
}

#[test]
fn the_period_of_the_fitzhugh_nagumo_impulse() {
    let solution = solve(&FitzHughNagumo, &FitzHughNagumo::guess(), &tight()).unwrap();
    let error = solution.parameters()[0] - 10.710_808_513_425_889;
    assert!(error.abs() < 1e-8, "{error:e}");
}

/// y''' = 6 with y given at three points: two segments of different length.
struct Cubic;

impl Problem for Cubic {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(3, -1.0, 0.0), Segment::on(3, 0.0, 2.0)]
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = y[2];
        dy[2] = T::from_f64(6.0);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        // y = s³ − 2 s + 1
        r[0] = at.start(0)[0] - 2.0;
        r[1] = at.end(0)[0] - 1.0;
        r[2] = at.end(1)[0] - 5.0;
        for i in 0..3 {
            r[3 + i] = at.end(0)[i] - at.start(1)[i];
        }
    }
}

#[test]
fn a_polynomial_through_three_points_is_exact() {
    let guess = Constant {
        states: vec![vec![0.0; 3]; 2],
        parameters: vec![],
    };
    let solution = solve(&Cubic, &guess, &Options::default()).unwrap();
    let mut y = [0.0; 3];
    for (segment, s) in [(0, -0.7), (0, -0.2), (1, 0.3), (1, 1.9)] {
        solution.state(segment, s, &mut y);
        assert!((y[0] - (s * s * s - 2.0 * s + 1.0)).abs() < 1e-13);
        assert!((y[1] - (3.0 * s * s - 2.0)).abs() < 1e-12);
    }
}

/// The double integrator brought from rest at 0 to rest at 1 in least time with |force| ≤ 1: full
/// push, then full pull, on two segments of unknown duration.
pub(crate) struct MinimalTime;

impl Problem for MinimalTime {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2), Segment::new(2)]
    }

    fn parameters(&self) -> usize {
        2
    }

    fn rhs<T: Real>(&self, segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let force = if segment == 0 { 1.0 } else { -1.0 };
        dy[0] = p[segment] * y[1];
        dy[1] = p[segment] * force;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[1];
        r[2] = at.end(1)[0] - 1.0;
        r[3] = at.end(1)[1];
        r[4] = at.end(0)[0] - at.start(1)[0];
        r[5] = at.end(0)[1] - at.start(1)[1];
    }
}

#[test]
fn both_durations_of_the_time_optimal_double_integrator_are_one() {
    let guess = Constant {
        states: vec![vec![0.5, 0.5]; 2],
        parameters: vec![0.5, 2.0],
    };
    let solution = solve(&MinimalTime, &guess, &tight()).unwrap();
    for duration in solution.parameters() {
        assert!((duration - 1.0).abs() < 1e-12);
    }
}

/// (ε + s²) y'' + 4 s y' + 2 y = 0 with y = 1/(ε + s²), a spike on ends ten thousand times lower.
struct Spike;

const SPIKE: f64 = 1e-4;

impl Problem for Spike {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, -1.0, 1.0)]
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -(s * y[1] * 4.0 + y[0] * 2.0) / (s * s + SPIKE);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - 1.0 / (1.0 + SPIKE);
        r[1] = at.end(0)[0] - 1.0 / (1.0 + SPIKE);
    }
}

#[test]
fn corrections_that_are_only_rounding_do_not_stop_the_solver() {
    // So ill-conditioned that corrections stall far above the 1e-11 that Newton's method aims at.
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![],
    };
    let options = Options {
        tolerance: 1e-9,
        scheme: Some(Scheme::Gauss { stages: 6 }),
        ..Options::default()
    };
    let solution = solve(&Spike, &guess, &options).unwrap();
    let mut y = [0.0; 2];
    for i in -100..=100 {
        let s = 0.01 * f64::from(i);
        solution.state(0, s, &mut y);
        let exact = 1.0 / (SPIKE + s * s);
        assert!((y[0] - exact).abs() < 1e-9 * (1.0 + exact), "s = {s}");
    }
}
