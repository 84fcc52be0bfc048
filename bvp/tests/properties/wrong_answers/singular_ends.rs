//! Singular ends, where a condition may hold for all solutions of a family.

use bvp::{Constant, Error, Options, TwoPoint, solve};

const TOLERANCES: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// y' = k y/s has all c sᵏ, and y(0) = 0 holds for all of them. Of these runs 3 of 4 were accepted where k is no
/// integer.
#[test]
fn powers_that_vanish_at_an_end_are_free() {
    for k in [0.1, 0.3, 0.5, 1.0, 1.5, 2.0, 2.5, 7.3] {
        for guess in [0.0, 0.5, 2.0] {
            for tolerance in TOLERANCES {
                for (from, to) in [(0.0, 1.0), (0.0, 1e3), (3.0, 4.0), (1.0, 0.0)] {
                    let outcome = solve(
                        &TwoPoint::new(
                            [1, 0],
                            [from, to],
                            |s, y, _p, dy| dy[0] = k * y[0] / (s - from),
                            |start, _end, _p, r| r[0] = start[0],
                        ),
                        &Constant::new([guess]),
                        &Options::to(tolerance),
                    );
                    assert!(
                        outcome.is_err(),
                        "k = {k}, guess {guess}, [{from}, {to}], {tolerance:e}"
                    );
                }
            }
        }
    }
}

/// y₁' = y₁/(2 s) + y₂, y₂' = 0: y₁ = c √s + 2 d s, y₂ = d. Conditions with their numbers on y₁(0), y₂(0), y₁(1),
/// and their values.
fn with_root(conditions: [[f64; 4]; 2], tolerance: f64) -> Result<[f64; 2], Error> {
    let problem = TwoPoint::new(
        [2, 0],
        [0.0, 1.0],
        |s, y, _p, dy| dy.copy_from_slice(&[0.5 * y[0] / s + y[1], 0.0 * y[1]]),
        |start, end, _p, r| {
            for (r, [a, b, c, value]) in r.iter_mut().zip(conditions) {
                *r = a * start[0] + b * start[1] + c * end[0] - value;
            }
        },
    );
    let solution = solve(
        &problem,
        &Constant::new([1.0, 1.0]),
        &Options::to(tolerance),
    )?;
    Ok([solution.end(0)[0], solution.end(0)[1]])
}

#[test]
fn a_condition_counts_without_its_part_that_vanishes_at_an_end() {
    for tolerance in TOLERANCES {
        let at_both_ends = with_root([[3.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 4.0]], tolerance);
        let [y1, y2] = at_both_ends.unwrap();
        assert!((y1 - 4.0).abs() <= 10.0 * tolerance && (y2 - 1.0).abs() <= 10.0 * tolerance);
        for at_the_singular_end in [
            [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 1.0]],
            [[1.0, 1.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]],
            [[5.0, -1.0, 0.0, -1.0], [-2.0, 3.0, 0.0, 3.0]],
        ] {
            let error = with_root(at_the_singular_end, tolerance).unwrap_err();
            assert!(
                matches!(error, Error::SingularConditions { free: Some(_), .. }),
                "{error}"
            );
        }
    }
}

/// y' = k y/s + 1, y(1) = 2 has one solution, c sᵏ + s/(1 − k), c = 2 − 1/(1 − k).
#[test]
fn powers_that_a_regular_end_determines_are_found() {
    for k in [0.5, 1.5, 2.5] {
        for tolerance in [1e-3, 1e-6] {
            let problem = TwoPoint::new(
                [1, 0],
                [0.0, 1.0],
                |s, y, _p, dy| dy[0] = k * y[0] / s + 1.0,
                |_start, end, _p, r| r[0] = end[0] - 2.0,
            );
            let solution = solve(&problem, &Constant::new([1.0]), &Options::to(tolerance));
            let solution =
                solution.unwrap_or_else(|error| panic!("k = {k}, {tolerance:e}: {error}"));
            for i in 1..100 {
                let s = f64::from(i) / 100.0;
                let mut y = [0.0];
                solution.state(0, s, &mut y);
                let particular = 1.0 / (1.0 - k);
                let exact = (2.0 - particular) * s.powf(k) + particular * s;
                assert!((y[0] - exact).abs() <= 10.0 * tolerance * (1.0 + exact.abs()));
            }
        }
    }
}
