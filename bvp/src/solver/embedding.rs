//! A hard problem approached through a parameter that makes it easy.

use crate::problem::equations::Equations;
use crate::problem::guess::Guess;
use crate::problem::held::Held;
use crate::problem::problem::Segment;
use crate::result::error::Error;
use crate::result::solution::Solution;
use crate::shares::TWO_DIGITS;
use crate::solver::options::Options;
use crate::solver::solver::solve_held;
use crate::solver::statement::check_statement;
use crate::solver::stepping::{Stalled, cost, follow, on_the_way};
use std::f64::consts::LN_10;

/// A given parameter of a problem, with a value for which the problem is easy and the one for which
/// its solution is wanted: a small coefficient of the highest derivative, a Reynolds number, a
/// load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Embedding {
    /// Index of the parameter in p.
    pub parameter: usize,
    /// Its value to start from, where the guess is good enough.
    pub from: f64,
    /// The value of the problem to be solved.
    pub to: f64,
}

/// Solves a problem with one condition fewer than unknown constants for a given value of one of its
/// parameters, through other values of it if need be.
///
/// ```text
/// dy/ds = f(s, y, p),   g(all ends, p) = 0        Σ nᵢ + k − 1 conditions
/// pᵢ = embedding.to                               i = embedding.parameter
/// ```
///
/// The value `to` is tried from the guess. Where that fails, the problem is solved at `from` and
/// followed to `to` in steps of the parameter (of its logarithm if the two values have one
/// sign and differ by more than a factor of ten), each solution and its mesh the guess of the next, as
/// if a user had done so by hand. Steps grow where Newton's method converges fast and are halved where it
/// fails. The solutions on the way are rough; where that leads astray, the way is gone again with
/// solutions whose defect is within the tolerance. The last solution meets all of the options, and
/// its [`Stats`](crate::Stats) are those of everything together. What the guess says of the
/// parameter is not used.
///
/// An interface of width ε, from which Newton's method does not converge unaided:
///
/// ```
/// use bvp::{Constant, Embedding, Ends, Options, Problem, Real, Segment, solve_embedded};
///
/// /// ε y'' = 1 − y'², y(−1) = y(1) = 1, with p = (ε).
/// struct Corner;
///
/// impl Problem for Corner {
///     fn segments(&self) -> Vec<Segment> {
///         vec![Segment::on(2, -1.0, 1.0)]
///     }
///
///     fn parameters(&self) -> usize {
///         1
///     }
///
///     fn condition_count(&self) -> usize {
///         2
///     }
///
///     fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
///         dy[0] = y[1];
///         dy[1] = (-y[1] * y[1] + 1.0) / p[0];
///     }
///
///     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
///         r[0] = at.start(0)[0] - 1.0;
///         r[1] = at.end(0)[0] - 1.0;
///     }
/// }
///
/// let guess = Constant { states: vec![vec![1.0, 0.0]], parameters: vec![1.0] };
/// let embedding = Embedding { parameter: 0, from: 1.0, to: 1e-5 };
/// let solution = solve_embedded(&Corner, &embedding, &guess, &Options::default())?;
///
/// // y = 1 + ε ln (cosh(s/ε) / cosh(1/ε)), rounded off by ε ln 2 at zero.
/// let mut y = [0.0; 2];
/// solution.state(0, 0.0, &mut y);
/// assert!((y[0] - 1e-5 * 2f64.ln()).abs() < 1e-9);
/// # Ok::<(), bvp::Error>(())
/// ```
///
/// # Errors
/// [`Error::Embedding`] if there is no such parameter or one of the values is not finite;
/// [`Error::Unreached`] if the way ends before `to`, with the value that was reached and the solution
/// there; the error of [`solve`](crate::solve) if the problem has no solution from the guess even at `from`.
pub fn solve_embedded(
    equations: &dyn Equations,
    embedding: &Embedding,
    guess: &dyn Guess,
    options: &Options,
) -> Result<Solution, Error> {
    let Embedding {
        parameter,
        from,
        to,
    } = *embedding;
    let problem = Held::none(equations);
    let parameters = problem.parameters();
    if parameter >= parameters || !from.is_finite() || !to.is_finite() {
        return Err(Error::Embedding {
            parameter,
            parameters,
            from,
            to,
        });
    }
    check_statement(&problem, 1)?;
    let solve_at = |value: f64, guess: &dyn Guess, options: &Options| {
        let mut p = vec![0.0; parameters];
        p[parameter] = value;
        let with_value = WithValue {
            guess,
            parameter,
            value,
        };
        let held = Held::new(equations, &[parameter], &p);
        solve_held(&held, &with_value, options)
    };

    let unaided = Options {
        retries: 0,
        ..options.clone()
    };
    let direct = solve_at(to, guess, &unaided);
    if direct.as_ref().err().and_then(Error::best).is_none() {
        return direct;
    }
    let mut stats = cost(&direct);
    let mut way = |defect: f64| {
        let rough = on_the_way(options, defect);
        let retried = Options {
            retries: options.retries,
            ..rough.clone()
        };
        let first = solve_at(from, guess, &retried)?;
        stats += first.stats;
        let rough_at =
            |theta: f64, guess: &dyn Guess| solve_at(embedding.value(theta), guess, &rough);
        let stalled = match follow(first, &mut stats, rough_at) {
            Ok(best) => {
                let wanted = solve_at(to, &best, options);
                stats += cost(&wanted);
                match wanted {
                    Ok(mut solution) => {
                        solution.stats = stats;
                        return Ok(solution);
                    }
                    Err(cause) => Stalled {
                        reached: 1.0,
                        best,
                        cause,
                    },
                }
            }
            Err(stalled) => *stalled,
        };
        let mut best = Box::new(stalled.best);
        best.stats = stats;
        Err(Error::Unreached {
            parameter,
            reached: embedding.value(stalled.reached),
            to,
            cause: Box::new(stalled.cause),
            best,
        })
    };
    match way(TWO_DIGITS) {
        Err(Error::Unreached { .. }) if options.tolerance < TWO_DIGITS => way(options.tolerance),
        result => result,
    }
}

impl Embedding {
    /// The value of the parameter at 0 ≤ θ ≤ 1 of the way.
    fn value(&self, theta: f64) -> f64 {
        let Self { from, to, .. } = *self;
        let distance = to.abs().ln() - from.abs().ln();
        let one_sign = from.is_sign_positive() == to.is_sign_positive();
        if theta >= 1.0 {
            to
        } else if one_sign && distance.is_finite() && distance.abs() > LN_10 {
            from * (theta * distance).exp()
        } else {
            from + theta * (to - from)
        }
    }
}

/// A guess with another value of one of its parameters.
struct WithValue<'a> {
    guess: &'a dyn Guess,
    parameter: usize,
    value: f64,
}

impl Guess for WithValue<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        self.guess.state(segment, s, y);
    }

    fn parameters(&self, p: &mut [f64]) {
        self.guess.parameters(p);
        p[self.parameter] = self.value;
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        self.guess.mesh()
    }

    fn state_values(&self, index: usize, segment: &Segment) -> Option<usize> {
        self.guess.state_values(index, segment)
    }

    fn parameter_values(&self) -> Option<usize> {
        self.guess.parameter_values()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_ratios_are_stepped_in_the_logarithm() {
        let halfway = |from, to| {
            let parameter = 0;
            Embedding {
                parameter,
                from,
                to,
            }
            .value(0.5)
        };
        assert!((halfway(1.0, 1e-4) - 1e-2).abs() < 1e-16);
        assert!((halfway(-1.0, -1e4) + 1e2).abs() < 1e-12);
        assert!((halfway(1e-300, 1e300) - 1.0).abs() < 1e-12);
        for (from, to) in [
            (0.0, 100.0),
            (-1.0, 99.0),
            (1.0, 5.0),
            (2.0, 2.0),
            (-3.0, 0.0),
        ] {
            assert_eq!(halfway(from, to), 0.5 * (from + to));
        }
    }
}
