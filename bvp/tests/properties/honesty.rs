//! Success means what it says: the true error is within the tolerance and within the estimate.

use crate::exact::{Exact, bratu, chirp, exponential, limit_cycle, swing, three_point, wavenumber};
use bvp::{
    Constant, Control, Ends, Guess, Options, Problem, Real, Scheme, Segment, Solution, solve,
};
use proptest::prelude::*;
use std::f64::consts::PI;

/// The true counterpart of [`Solution::error_estimate`], at 40 places per interval.
pub(crate) fn true_error(problem: &Exact, solution: &Solution) -> f64 {
    let relative = |exact: f64, found: f64| (exact - found).abs() / (1.0 + exact.abs());
    let parameters = problem.parameters.iter().zip(solution.parameters());
    let mut largest = parameters.fold(0.0f64, |m, (a, b)| m.max(relative(*a, *b)));
    for (segment, shape) in solution.segments().iter().enumerate() {
        let (mut exact, mut found) = (vec![0.0; shape.states], vec![0.0; shape.states]);
        for pair in solution.mesh(segment).windows(2) {
            for place in 0..=40 {
                let s = pair[0] + (pair[1] - pair[0]) * f64::from(place) / 40.0;
                problem.state(segment, s, &mut exact);
                solution.state(segment, s, &mut found);
                for (a, b) in exact.iter().zip(&found) {
                    largest = largest.max(relative(*a, *b));
                }
            }
        }
    }
    largest
}

/// What the estimate is of the true error. Measured: 0.77 to 5.93 of it, in the median 1.50; it is meant to
/// be too large by a factor of 1.5.
const NEAR: std::ops::Range<f64> = 0.7..6.0;

#[test]
fn the_true_error_is_within_the_tolerance_and_near_the_estimate() {
    let problems = [
        exponential(1.0),
        exponential(50.0),
        bratu(1.5),
        bratu(11.0),
        wavenumber(3.0),
        chirp(20.0),
        limit_cycle(2.0),
        three_point(5.0 * PI),
        swing(1.0),
    ];
    let mut schemes: Vec<_> = (3..=7).map(|stages| Scheme::Gauss { stages }).collect();
    schemes.extend([3, 4].map(|stages| Scheme::LobattoIIIA { stages }));
    for scheme in schemes {
        for tolerance in [1e-3, 1e-5, 1e-7] {
            for problem in &problems {
                let options = Options {
                    tolerance,
                    scheme: Some(scheme),
                    ..Options::default()
                };
                let solution = solve(&*problem.equations, problem, &options)
                    .unwrap_or_else(|error| panic!("{} {scheme:?}: {error}", problem.name));
                let error = true_error(problem, &solution);
                let estimate = solution.error_estimate().unwrap();
                let case = format!("{} {scheme:?} {tolerance:e}", problem.name);
                assert!(error <= tolerance, "{case}: error {error:e}");
                // Below that both are rounding.
                if error > 1e-13 {
                    let share = estimate / error;
                    assert!(NEAR.contains(&share), "{case}: {estimate:e} of {error:e}");
                }
            }
        }
    }
}

/// Two nonlinear states with random coefficients, a parameter, and conditions that couple all.
struct Arbitrary<'a> {
    a: &'a [f64],
}

impl Problem for Arbitrary<'_> {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, -1.0, 2.0)]
    }

    fn parameters(&self) -> usize {
        1
    }

    fn rhs<T: Real>(&self, _: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let a = self.a;
        dy[0] = y[1] * a[0] + y[0].sin() * a[1] + s * a[2] - y[0].powi(3) * a[3];
        dy[1] =
            y[0] * a[4] + p[0] * (s * a[5]).cos() + y[0] * y[1] * a[6] + (y[1] + 3.0).sqrt() * 0.3;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let (start, end) = (at.start(0), at.end(0));
        for (r, a) in r.iter_mut().zip(self.a[7..].chunks(6)) {
            *r = start[0] * a[0] + start[1] * a[1] + end[0] * a[2] + end[1] * a[3];
            *r += p[0] * a[4] + a[5];
        }
    }
}

/// The defect relative to 1 + |f|, root mean square over an interval, by the midpoint rule at 100 places
/// that lie denser at the ends.
fn mean_defect(problem: &Arbitrary<'_>, solution: &Solution, interval: &[f64]) -> f64 {
    let (mut y, mut slope, mut f) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    let mut square = 0.0;
    for place in 0..100 {
        let t = (f64::from(place) + 0.5) / 100.0;
        let s = interval[0] + (interval[1] - interval[0]) * t * t * (3.0 - 2.0 * t);
        solution.state(0, s, &mut y);
        solution.derivative(0, s, &mut slope);
        problem.rhs(0, s, &y, solution.parameters(), &mut f);
        let defects = slope
            .iter()
            .zip(f)
            .map(|(slope, f)| (slope - f).abs() / (1.0 + f.abs()));
        square += defects.fold(0.0, f64::max).powi(2) * 6.0 * t * (1.0 - t) / 100.0;
    }
    square.sqrt()
}

/// The largest mean, in tolerances, of a solution that is accepted with one of 1 seen at m + 1 places of an
/// interval. A defect with a peak between them is larger than it is seen: of 72 000 random problems 0.04 %
/// have a mean above 1.1, the worst of 130 000 has 1.45. The largest value on an interval has no such bound
/// (10.5 times the tolerance where y₁ nearly touches the end of the square root's domain); none is promised.
const SEEN: f64 = 2.0;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn whatever_is_returned_is_finite_and_a_success_by_the_defect_is_a_solution(
        a in prop::collection::vec(-1.0..1.0f64, 25),
    ) {
        let problem = Arbitrary { a: &a };
        let guess = Constant {
            states: vec![vec![0.0; 2]],
            parameters: vec![0.0],
        };
        let options = Options {
            max_intervals: 2_000,
            control: Control::Defect,
            ..Options::default()
        };
        let outcome = solve(&problem, &guess, &options);
        let solution = match &outcome {
            Ok(solution) => solution,
            Err(error) => error.best().expect("the statement is complete"),
        };
        let mut ends = [solution.start(0), solution.end(0)].concat();
        prop_assert!(ends.iter().chain(solution.parameters()).all(|y| y.is_finite()));
        if outcome.is_err() {
            return Ok(());
        }
        let p = solution.parameters();
        let mut r = [f64::NAN; 3];
        problem.conditions(Ends::new(&problem.segments(), &ends), p, &mut r);
        ends.extend(p);
        let scale = 20.0 * (1.0 + ends.iter().map(|y| y.abs()).sum::<f64>());
        prop_assert!(r.iter().all(|r| r.abs() <= scale * options.tolerance), "{r:?}");
        for interval in solution.mesh(0).windows(2) {
            let defect = mean_defect(&problem, solution, interval);
            prop_assert!(defect <= SEEN * options.tolerance, "{defect:e} on {interval:?}");
        }
    }

    #[test]
    fn a_success_by_the_error_is_near_an_exact_solution(a in prop::collection::vec(-1.0..1.0f64, 25)) {
        let problem = Arbitrary { a: &a };
        let guess = Constant {
            states: vec![vec![0.0; 2]],
            parameters: vec![0.0],
        };
        let options = Options {
            max_intervals: 2_000,
            ..Options::default()
        };
        let Ok(solution) = solve(&problem, &guess, &options) else {
            return Ok(());
        };
        prop_assert!(solution.error_estimate().is_some_and(|error| error <= options.tolerance));
        // From the solution itself, so that no other one is found.
        let Ok(exact) = solve(&problem, &solution, &Options::to(1e-10)) else {
            return Ok(());
        };
        let near = |y: f64, exact: f64| (y - exact).abs() <= 3.0 * options.tolerance * (1.0 + exact.abs());
        prop_assert!(near(solution.parameters()[0], exact.parameters()[0]));
        let (mut y, mut z) = ([0.0; 2], [0.0; 2]);
        for i in 0..=1000 {
            let s = -1.0 + 3e-3 * f64::from(i);
            solution.state(0, s, &mut y);
            exact.state(0, s, &mut z);
            prop_assert!(near(y[0], z[0]) && near(y[1], z[1]), "{y:?} and {z:?} at {s}");
        }
    }
}
