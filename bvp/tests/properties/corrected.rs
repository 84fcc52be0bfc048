//! Solutions with their estimated errors added.

use crate::exact::{Exact, chirp, limit_cycle, swing, three_point, wavenumber};
use crate::order::{COUNTS, errors, on_uniform_mesh, slope};
use bvp::{Control, Ends, Error, Options, Problem, Real, Scheme, Segment, Solution, solve};
use std::f64::consts::PI;

/// Problems with visible errors at the nodes for this order.
fn problems(order: usize) -> [Exact; 5] {
    let w = order as f64;
    [
        wavenumber(w / 2.0),
        chirp(2.0 * w - 3.0),
        limit_cycle(w - 1.0),
        three_point((w - 1.0) * PI),
        swing(w - 1.0),
    ]
}

#[test]
fn nodes_gain_two_orders() {
    let schemes = (2..=5).map(|stages| Scheme::Gauss { stages });
    let lobatto = [3, 4].map(|stages| Scheme::LobattoIIIA { stages });
    for scheme in schemes.chain(lobatto) {
        let theory = (scheme.order() + 2) as f64;
        for problem in problems(scheme.order()) {
            let measured = COUNTS.iter().filter_map(|&n| {
                let solution = on_uniform_mesh(&problem, scheme, n)?;
                let corrected = solution.corrected(&*problem.equations).unwrap();
                let [nodes, _] = errors(&problem, &corrected);
                Some((n, nodes))
            });
            let order = slope(&measured.collect::<Vec<_>>());
            println!("{scheme:?} {}: {order:.2}", problem.name);
            assert!(
                (order - theory).abs() < 0.3,
                "{scheme:?} {}: {order}",
                problem.name
            );
        }
    }
}

/// y'' = −k² y in units of y with y(0) = 0, y'(0) = k and y(1) = sin k in these units, k a parameter; one point is
/// joined.
struct Waves {
    unit: f64,
}

const K: f64 = 9.0;

impl Problem for Waves {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(2).joined(&[0.3])]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -p[0] * p[0] * y[0];
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.start(0)[1] - K * self.unit;
        r[2] = at.joined(0, 0)[0] - (0.3 * K).sin() * self.unit;
    }
}

impl bvp::Guess for Waves {
    fn state(&self, _: usize, s: f64, y: &mut [f64]) {
        y[0] = (K * s).sin() * self.unit;
        y[1] = K * (K * s).cos() * self.unit;
    }

    fn parameters(&self, p: &mut [f64]) {
        p[0] = K;
    }
}

/// The largest error of k and of y at the nodes, in units of y.
fn error(solution: &Solution, unit: f64) -> f64 {
    let mesh = solution.mesh(0).iter().enumerate();
    let of_nodes = mesh.map(|(i, s)| (solution.node(0, i)[0] / unit - (K * s).sin()).abs());
    of_nodes.fold((solution.parameters()[0] - K).abs(), f64::max)
}

#[test]
fn joined_points_and_units_change_nothing() {
    let mut errors = Vec::new();
    for unit in [1.0, 1e-9, 1e9] {
        let problem = Waves { unit };
        let options = Options {
            absolute: vec![unit, unit, 1.0],
            control: Control::Defect,
            initial_intervals: 3,
            ..Options::to(1e-3)
        };
        let solution = solve(&problem, &problem, &options).unwrap();
        let corrected = solution.corrected(&problem).unwrap();
        assert!(solution.error_estimate().is_none());
        assert!(corrected.error_estimate().unwrap() > error(&solution, unit));
        assert_eq!(solution.mesh(0), corrected.mesh(0));
        errors.push([error(&solution, unit), error(&corrected, unit)]);
    }
    for [before, after] in &errors {
        assert!(after < &(0.1 * before), "{errors:?}");
        assert!((before / errors[0][0] - 1.0).abs() < 1e-3, "{errors:?}");
    }
}

/// The error of a number that is a small difference is that of the number, not that of what it is made of.
#[test]
fn errors_of_numbers_are_differences_of_them() {
    let problem = Waves { unit: 1.0 };
    for tolerance in [1e-3, 1e-6] {
        let solution = solve(&problem, &problem, &Options::to(tolerance)).unwrap();
        let corrected = solution.corrected(&problem).unwrap();
        // The phase at the end, and what k and the slope there differ from each other by.
        let numbers: [fn(&Solution) -> f64; 2] = [
            |solution| solution.end(0)[0].atan2(solution.end(0)[1] / K),
            |solution| solution.end(0)[1] / K.cos() - solution.parameters()[0],
        ];
        for (number, exact) in numbers.into_iter().zip([K.sin().atan2(K.cos()), 0.0]) {
            let error = number(&solution) - exact;
            let estimated = number(&solution) - number(&corrected);
            assert!(
                (estimated / error - 1.0).abs() < 0.1,
                "{estimated:e} for {error:e}"
            );
        }
    }
}

#[test]
fn a_solution_of_other_equations_is_not_corrected() {
    let problem = Waves { unit: 1.0 };
    let solution = solve(&problem, &problem, &Options::default()).unwrap();
    let other = three_point(1.0);
    let error = solution.corrected(&*other.equations).unwrap_err();
    println!("{error:?}");
    assert!(matches!(
        error,
        Error::GuessStates { .. } | Error::GuessMesh { .. }
    ));
}

/// y' = −rate y², y(0) = 1.
struct Decay {
    rate: f64,
}

impl Problem for Decay {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::new(1)]
    }

    fn rhs<T: Real>(&self, _: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = -(y[0] * y[0] * self.rate);
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - 1.0;
    }
}

#[test]
fn the_effect_of_a_coefficient_is_found_to_first_order() {
    let one = bvp::Constant {
        states: vec![vec![1.0]],
        parameters: vec![],
    };
    let solution = solve(&Decay { rate: 2.0 }, &one, &Options::to(1e-9)).unwrap();
    let errors = [1e-1, 1e-2].map(|change: f64| {
        let corrected = solution.corrected(&Decay { rate: 2.0 + change }).unwrap();
        assert_eq!(corrected.stats().factorisations, 1);
        // δ' = −2 (2 + change) y δ − change y² with y = 1/(1 + 2 s), by variation of constants.
        let q = 2.0 + change;
        let delta = -change * (3_f64.powf(q - 1.0) - 1.0) / (2.0 * (q - 1.0)) / 3_f64.powf(q);
        assert!((corrected.end(0)[0] - (1.0 / 3.0 + delta)).abs() < 1e-9);
        corrected.end(0)[0] - 1.0 / (3.0 + change)
    });
    assert!(
        (0.9..1.1).contains(&(errors[0] / errors[1] / 100.0)),
        "{errors:?}"
    );
}
