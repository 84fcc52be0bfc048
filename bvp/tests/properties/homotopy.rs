//! Guesses from which Newton's method does not converge by any mesh.

use crate::exact::bratu;
use crate::failures::{growth, states};
use bvp::{
    Constant, Ends, Equations, Error, FiniteDifferences, Function, Guess, Options, Problem, Real,
    Segment, Shape, Solution, TwoPoint, solve,
};
use std::sync::atomic::{AtomicUsize, Ordering};

fn unaided(equations: &dyn Equations, guess: &dyn Guess) -> Result<Solution, Error> {
    let options = Options {
        retries: 0,
        ..Options::default()
    };
    solve(equations, guess, &options)
}

/// Bratu's problem on two segments that meet at ½, its λ unknown, its middle value given.
struct Joined;

/// The middle value for λ = 1 on the lower branch.
const MIDDLE: f64 = 0.140_539_214_400_472;

impl Problem for Joined {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 0.5), Segment::on(2, 0.5, 1.0)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -p[0] * y[0].exp();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        let (before, after) = (at.end(0), at.start(1));
        r[0] = at.start(0)[0];
        r[1] = before[0] - after[0];
        r[2] = before[1] - after[1];
        r[3] = after[0] - MIDDLE;
        r[4] = at.end(1)[0];
    }
}

#[test]
fn a_guess_far_above_every_solution() {
    let problem = bratu(1.5);
    let guess = states(&[30.0, 0.0]);
    let error = unaided(&*problem.equations, &guess).unwrap_err();
    assert!(matches!(error, Error::NoConvergence { .. }), "{error}");
    let solution = solve(&*problem.equations, &guess, &Options::default()).unwrap();
    assert!(solution.error_estimate().unwrap() <= 1e-6);
    let (mut y, mut exact) = ([0.0; 2], [0.0; 2]);
    for i in 0..=20 {
        let s = f64::from(i) / 20.0;
        solution.state(0, s, &mut y);
        problem.state(0, s, &mut exact);
        assert!((y[0] - exact[0]).abs() < 1e-6 && (y[1] - exact[1]).abs() < 1e-6);
    }
}

#[test]
fn several_segments_and_a_parameter() {
    // So far away the path of Newton's method depends on rounding: it reaches the solution from some of these
    // guesses without help.
    let mut unaided_failures = 0;
    for y in [30.0, 40.0, 50.0, 200.0, 300.0, 500.0] {
        for p in [20.0, 50.0, 100.0] {
            let guess = Constant {
                states: vec![vec![y, 0.0]; 2],
                parameters: vec![p],
            };
            if let Err(error) = unaided(&Joined, &guess) {
                assert!(matches!(error, Error::NoConvergence { .. }), "{error}");
                unaided_failures += 1;
            }
            let solution = solve(&Joined, &guess, &Options::default()).unwrap();
            assert!((solution.parameters()[0] - 1.0).abs() < 1e-6);
            assert!((solution.end(0)[1]).abs() < 1e-6);
        }
    }
    assert!(unaided_failures >= 6, "{unaided_failures} of 18");
}

#[test]
fn a_guess_where_the_right_hand_side_is_not_finite() {
    // y' = 1/y, y(0) + y(1) = 1 + √3, guessed zero: y = √(1 + 2 s).
    let mut problem = growth();
    problem.rhs = |_, _, y, _, dy| dy[0] = 1.0 / y[0];
    problem.conditions = |at, _, r| r[0] = at.start(0)[0] + at.end(0)[0] - 1.0 - 3f64.sqrt();
    let error = unaided(&problem, &states(&[0.0])).unwrap_err();
    assert!(matches!(error, Error::NonFiniteRhs { .. }), "{error}");
    let solution = solve(&problem, &states(&[0.0]), &Options::default()).unwrap();
    assert!((solution.end(0)[0] - 3f64.sqrt()).abs() < 1e-6);
}

/// Evaluations counted by the right-hand side itself.
#[test]
fn the_cost_of_a_failure_counts_every_evaluation() {
    let count = AtomicUsize::new(0);
    let bratu = FiniteDifferences {
        segments: vec![Segment::new(2)],
        parameters: 0,
        condition_count: 2,
        rhs: |_: usize, _: f64, y: &[f64], _: &[f64], dy: &mut [f64]| {
            dy[0] = y[1];
            dy[1] = -4.0 * y[0].exp();
        },
        conditions: |at: Ends<'_, f64>, _: &[f64], r: &mut [f64]| {
            r[0] = at.start(0)[0];
            r[1] = at.end(0)[0];
        },
    };
    let counted = Counted {
        equations: &bratu,
        count: &count,
    };
    let error = solve(&counted, &states(&[0.0; 2]), &Options::default()).unwrap_err();
    let stats = error.best().unwrap().stats();
    assert_eq!(stats.rhs_evaluations, count.load(Ordering::Relaxed));
}

/// Equations that count the evaluations of their right-hand side.
struct Counted<'a> {
    equations: &'a dyn Equations,
    count: &'a AtomicUsize,
}

impl Equations for Counted<'_> {
    fn shape(&self) -> Shape {
        self.equations.shape()
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        self.count.fetch_add(1, Ordering::Relaxed);
        self.equations.evaluate_rhs(segment, s, y, p, dy);
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.count.fetch_add(1, Ordering::Relaxed);
        self.equations.rhs_jacobian(segment, s, y, p, dy, jacobian);
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        self.equations.evaluate_conditions(at, p, r);
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.equations.conditions_jacobian(at, p, r, jacobian);
    }
}

/// Lagerstrom and Cole's equation ε y'' = y (1 − y'), y(0) = −7/6, y(1) = 3/2: y = x − 7/6 up to a shock at
/// x = 1/3 + O(ε), and x + 1/2 behind it.
fn lagerstrom_cole(epsilon: f64) -> impl Equations {
    TwoPoint::new(
        [2, 0],
        [0.0, 1.0],
        move |_, y, _, dy| dy.copy_from_slice(&[y[1], y[0] * (1.0 - y[1]) / epsilon]),
        |start, end, _, r| r.copy_from_slice(&[start[0] + 7.0 / 6.0, end[0] - 1.5]),
    )
}

/// From the straight line between the ends one mesh after the other misses the shock.
#[test]
fn a_shock_that_no_mesh_resolves_from_the_guess() {
    let line = Function {
        state: |_: usize, x: f64| [8.0 / 3.0 * x - 7.0 / 6.0, 8.0 / 3.0],
        parameters: vec![],
    };
    for epsilon in [1e-3, 1e-4] {
        let problem = lagerstrom_cole(epsilon);
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let options = Options::to(tolerance);
            let unaided = Options {
                retries: 0,
                ..options.clone()
            };
            assert!(solve(&problem, &line, &unaided).is_err());
            let solution = solve(&problem, &line, &options).unwrap();
            let mut y = [0.0; 2];
            for (x, outer) in [(0.1, 0.1 - 7.0 / 6.0), (0.3, 0.3 - 7.0 / 6.0)]
                .into_iter()
                .chain([(0.36, 0.86), (0.7, 1.2)])
            {
                solution.state(0, x, &mut y);
                assert!(
                    (y[0] - outer).abs() <= 2.0 * tolerance,
                    "{epsilon}: y({x}) = {}",
                    y[0]
                );
            }
            for (x, sign) in [
                (1.0 / 3.0 - 5.0 * epsilon, -1.0),
                (1.0 / 3.0 + 5.0 * epsilon, 1.0),
            ] {
                solution.state(0, x, &mut y);
                assert!(sign * y[0] > 0.5, "{epsilon}: y({x}) = {}", y[0]);
            }
        }
    }
}
