//! Errors that grow along the interval.

use super::Score;
use bvp::{Constant, Ends, Error, Options, Problem, Real, Segment, solve};

/// y' = λ (y − cos s) − sin s on \[0, L\], y(0) = 1, with the solution cos s: errors grow like e^(λ s).
struct Growth {
    lambda: f64,
    length: f64,
}

impl Problem for Growth {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(1, 0.0, self.length)]
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = (y[0] - s.cos()) * self.lambda - s.sin();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - 1.0;
    }
}

/// With the equation at exponents that leave less than a digit: what rounding makes of the start grows to
/// 1e14 at the end, beside which the solution is too small to be seen.
#[test]
fn rounding_beside_what_has_grown_is_seen() {
    let mut score = Score::default();
    for i in 0..60 {
        let exponent = 36.0 + 0.2 * f64::from(i);
        for lambda in [0.8, 1.7, 3.1] {
            let problem = Growth {
                lambda,
                length: exponent / lambda,
            };
            let guess = Constant {
                states: vec![vec![1.0]],
                parameters: vec![],
            };
            let outcome = solve(&problem, &guess, &Options::to(1e-3));
            score.count(&format!("{lambda} {exponent}"), 1e-3, outcome, f64::cos);
        }
    }
    assert_eq!(score.solved + score.refused, 180);
}

#[test]
fn amplified_rounding_is_seen() {
    let mut score = Score::default();
    for tolerance in [1e-3, 1e-6, 1e-9] {
        for lambda in [0.6, 7.1, 20.0, 30.0] {
            for exponent in [5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 60.0, 100.0] {
                let length = exponent / lambda;
                let problem = Growth { lambda, length };
                let guess = Constant {
                    states: vec![vec![0.0]],
                    parameters: vec![],
                };
                let outcome = solve(&problem, &guess, &Options::to(tolerance));
                if let Err(error) = &outcome {
                    // No finer mesh helps.
                    assert!(
                        matches!(
                            error,
                            Error::IllConditioned { .. } | Error::SingularConditions { .. }
                        ),
                        "{lambda} {exponent} {tolerance:e}: {error}"
                    );
                }
                let name = format!("{lambda} {exponent}");
                score.count(&name, tolerance, outcome, f64::cos);
            }
        }
    }
    assert!(score.solved >= 30, "{score:?}");
}

/// y' = λ (y − cos ωs) − ω sin ωs, y(0) = 1, with the solution cos ωs.
struct Wave;

impl Wave {
    const RATE: f64 = 16.367_329_863_713_785;
    const WAVE: f64 = 1.549_479_386_122_248_4;
    const LENGTH: f64 = 2.544_885_782_333_507_6;
}

impl Problem for Wave {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(1, 0.0, Self::LENGTH)]
    }

    fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        let (sin, cos) = (s * Self::WAVE).sin_cos();
        dy[0] = (y[0] - cos) * Self::RATE - sin * Self::WAVE;
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0] - 1.0;
    }
}

/// Growth by 1e18 on a mesh that is coarse at the start: an end of -1.5e8 in place of -0.7 was accepted.
#[test]
fn a_solution_that_has_grown_from_rounding_is_refused() {
    let outcome = solve(&Wave, &Constant::new([0.0]), &Options::to(1e-3));
    assert!(
        outcome.is_err(),
        "{:?}",
        outcome.map(|found| found.end(0)[0])
    );
}
