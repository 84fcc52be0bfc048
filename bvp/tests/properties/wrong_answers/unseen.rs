//! What neither the defect nor the residual of a solution shows.

use bvp::{Constant, Error, Options, Real, Solution, TwoPoint, solve};

/// The largest error of a state relative to 1 + |y| at 401 places.
fn error(solution: &Solution, state: usize, exact: impl Fn(f64) -> f64) -> f64 {
    let mesh = solution.mesh(0);
    let (from, to) = (mesh[0], mesh[mesh.len() - 1]);
    let mut y = vec![0.0; solution.segments()[0].states];
    (0..=400).fold(0.0, |largest: f64, i| {
        let x = (from + (to - from) * f64::from(i) / 400.0).clamp(from, to);
        solution.state(0, x, &mut y);
        let known = exact(x);
        largest.max((y[state] - known).abs() / (1.0 + known.abs()))
    })
}

/// y' = y (1 − y) from a seed far below the tolerance: where y is that small no mesh is too coarse for its
/// defect, and the growth beyond it depends on all of it. From two of these guesses, of 120 runs 5 were false.
#[test]
fn growth_from_below_the_tolerance_is_resolved() {
    let mut solved = 0;
    for (i, tolerance) in (0..120).zip([1e-2, 1e-3, 1e-6].into_iter().cycle()) {
        let seed = 10f64.powf(-4.0 - 0.06 * f64::from(i));
        let length = (0.7 + 0.05 * f64::from(i % 19)) * -seed.ln();
        let problem = TwoPoint::new(
            [1, 0],
            [0.0, length],
            |_s, y, _p, dy| dy[0] = y[0] * (1.0 - y[0]),
            |start, _end, _p, r| r[0] = start[0] - seed,
        );
        for guess in [0.0, 0.5] {
            if let Ok(solution) = solve(&problem, &Constant::new([guess]), &Options::to(tolerance))
            {
                let exact = |x: f64| {
                    let odds = seed / (1.0 - seed) * x.exp();
                    odds / (1.0 + odds)
                };
                let error = error(&solution, 0, exact);
                assert!(
                    error <= 10.0 * tolerance,
                    "seed {seed:e}, {tolerance:e}: {error:e}"
                );
                solved += 1;
            }
        }
    }
    assert!(solved > 200, "{solved} of 240 solved");
}

/// y' = y from 1e-12 to beyond 1: the elimination rounds the seed beside what has become of it, so that after
/// one step of this linear problem up to 1e-5 was wrong everywhere. Steps that shrink the error are taken until
/// it is small, and where they no longer do the solution is refused.
#[test]
fn rounding_beside_what_a_seed_has_become_is_seen() {
    let mut solved = 0;
    for (i, tolerance) in (0..60).zip([1e-6, 1e-9, 1e-9].into_iter().cycle()) {
        let seed = 10f64.powf(-11.0 - 0.05 * f64::from(i));
        let length = 24.0 + 0.25 * f64::from(i);
        let problem = TwoPoint::new(
            [1, 0],
            [0.0, length],
            |_s, y, _p, dy| dy[0] = y[0],
            |start, _end, _p, r| r[0] = start[0] - seed,
        );
        for guess in [0.0, 0.5, 3.0] {
            match solve(&problem, &Constant::new([guess]), &Options::to(tolerance)) {
                Ok(solution) => {
                    let error = error(&solution, 0, |x| seed * x.exp());
                    assert!(
                        error <= tolerance,
                        "{seed:e} over {length}, {tolerance:e}: {error:e}"
                    );
                    solved += 1;
                }
                Err(
                    Error::IllConditioned { .. }
                    | Error::SingularConditions { .. }
                    | Error::MeshLimit { .. },
                ) => {}
                Err(other) => panic!("{seed:e} over {length}, {tolerance:e}: {other}"),
            }
        }
    }
    assert!(solved > 120, "{solved} of 180 solved");
}

/// An epidemic, s' = −2 s i and i' = 2 s i − i, from an infected share of 1e-13 to 1e-7: without infected there
/// is a solution, too, and Newton's method, led there by the guess, left the share at what a mesh of three
/// intervals makes of it. Where the epidemic has passed, s solves s = exp(2 (s − 1)), 0.2031878699799799.
#[test]
fn an_epidemic_from_a_small_seed_is_not_missed() {
    let mut solved = 0;
    for i in 0..90 {
        let seed = 10f64.powf(-13.0 + f64::from(i) / 15.0);
        let length = 40.0 - seed.ln();
        let problem = TwoPoint::new(
            [2, 0],
            [0.0, length],
            |_s, y, _p, dy| {
                let infections = 2.0 * y[0] * y[1];
                dy.copy_from_slice(&[-infections, infections - y[1]]);
            },
            |start, _end, _p, r| r.copy_from_slice(&[start[0] - 1.0, start[1] - seed]),
        );
        for (tolerance, guess) in [(1e-2, 1.0), (1e-3, 0.5), (1e-6, 1.0)] {
            if let Ok(solution) = solve(
                &problem,
                &Constant::new([1.0, guess]),
                &Options::to(tolerance),
            ) {
                let left = solution.end(0)[0];
                assert!(
                    (left - 0.203_187_869_979_979_9).abs() <= 10.0 * tolerance,
                    "seed {seed:e}, {tolerance:e}: {left}"
                );
                solved += 1;
            }
        }
    }
    assert!(solved > 50, "{solved} of 270 solved");
}

/// exp(−y²) = 0 has no solution, but a first step from a small y leads to where it does not show.
#[test]
fn a_residual_that_vanishes_far_away_is_no_solution() {
    for guess in [0.05, 0.1, 0.15, -0.1, 0.2] {
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let problem = TwoPoint::new(
                [2, 0],
                [0.0, 1.0],
                |_s, y, _p, dy| dy.copy_from_slice(&[y[1], 0.0 * y[0]]),
                |start, end, _p, r| r.copy_from_slice(&[(-end[0] * end[0]).exp(), start[1]]),
            );
            let outcome = solve(
                &problem,
                &Constant::new([guess, 0.0]),
                &Options::to(tolerance),
            );
            assert!(outcome.is_err(), "guess {guess}, {tolerance:e}");
        }
    }
}

/// A right-hand side that is no number on a hundredth of the interval, where no collocation point lies, is not
/// passed over where it is met: of 64 further places none meets it with a probability of one half.
#[test]
fn a_right_hand_side_that_is_no_number_in_between_is_refused() {
    let runs = 200;
    let mut accepted = 0;
    for i in 0..runs {
        let place = 0.02 + 0.96 * f64::from(i) / f64::from(runs);
        let problem = TwoPoint::new(
            [1, 0],
            [0.0, 1.0],
            |s, y, _p, dy| {
                dy[0] = if (s - place).abs() < 0.005 {
                    y[0] * f64::NAN
                } else {
                    -y[0]
                }
            },
            |start, _end, _p, r| r[0] = start[0] - 1.0,
        );
        match solve(&problem, &Constant::new([1.0]), &Options::default()) {
            Ok(_) => accepted += 1,
            Err(error) => assert!(matches!(error, Error::NonFiniteRhs { .. }), "{error}"),
        }
    }
    assert!(accepted < runs / 2, "{accepted} of {runs} accepted");
}

/// A solution may touch the end of the domain: y' = −2 √y ends at zero, on either side of which its
/// polynomials are by less than the tolerance.
#[test]
fn a_solution_that_touches_the_end_of_the_domain_is_accepted() {
    let problem = TwoPoint::new(
        [1, 0],
        [0.0, 1.0],
        |_s, y, _p, dy| dy[0] = -2.0 * y[0].sqrt(),
        |start, _end, _p, r| r[0] = start[0] - 1.0,
    );
    let solution = solve(&problem, &Constant::new([1.0]), &Options::to(1e-3)).expect("a solution");
    assert!(error(&solution, 0, |x| (1.0 - x) * (1.0 - x)) <= 1e-2);
}
