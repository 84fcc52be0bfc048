//! Steps along a path of problems, from one whose solution is known to the one that is wanted.
//!
//! The problems are numbered by θ from 0 to 1. A step takes the secant through the last two solutions
//! as its guess, on the mesh of the last one; it is doubled after one that Newton's method found easy
//! and halved after a failure. Deuflhard (2004), section 5.1, with success or failure in the place of an
//! estimate of the convergence radius; carrying the mesh along is that of J. R. Cash, G. Moore & R. W.
//! Wright, "An automatic continuation strategy for the solution of singularly perturbed nonlinear
//! boundary value problems", ACM Trans. Math. Softw. 27 (2001) 245-266.

use crate::problem::guess::Guess;
use crate::result::error::Error;
use crate::result::solution::Solution;
use crate::result::stats::Stats;
use crate::solver::options::{Control, Options};

/// Length of the first step in θ. With 1 problems without a solution took 7 % more factorisations.
const FIRST_STEP: f64 = 0.25;
/// Below this length in θ a step is not tried again after a failure.
const SMALLEST_STEP: f64 = 1e-4;
/// The next step is longer after at most this many Newton steps per mesh of a solution, on average. Without
/// this and the next limit 150 random shocks took 47 % more factorisations.
const EASY: usize = 7;
/// Largest number of Newton steps on one mesh: with more, half the step is the cheaper way.
const NEWTON_STEPS: usize = 30;

/// The end of a path before its goal.
pub(crate) struct Stalled {
    /// The largest θ with a solution.
    pub(crate) reached: f64,
    /// The solution there.
    pub(crate) best: Solution,
    /// The failure of the smallest step beyond.
    pub(crate) cause: Error,
}

/// The caller's options for solutions on the way, with this relative defect: no estimate of their
/// error, and no attempts but from the guess given.
pub(crate) fn on_the_way(options: &Options, defect: f64) -> Options {
    Options {
        tolerance: options.tolerance.max(defect),
        max_newton_steps: options.max_newton_steps.min(NEWTON_STEPS),
        retries: 0,
        control: Control::Defect,
        ..options.clone()
    }
}

/// The solution at θ = 1 from the one at θ = 0, where `solve_at` solves the problem θ from a guess.
/// All cost is added to `stats`.
pub(crate) fn follow(
    first: Solution,
    stats: &mut Stats,
    solve_at: impl Fn(f64, &dyn Guess) -> Result<Solution, Error>,
) -> Result<Solution, Box<Stalled>> {
    let (mut reached, mut step) = (0.0, FIRST_STEP);
    let (mut last, mut before) = (first, None);
    loop {
        let next = next_point(reached, step);
        let taken = next - reached;
        let attempt = match &before {
            None => solve_at(next, &last),
            Some((solution, distance)) => {
                let secant = Secant {
                    last: &last,
                    before: solution,
                    factor: taken / distance,
                };
                solve_at(next, &secant)
            }
        };
        *stats += cost(&attempt);
        match attempt {
            Ok(solution) if next >= 1.0 => return Ok(solution),
            Ok(solution) => {
                let Stats {
                    newton_steps,
                    meshes,
                    ..
                } = solution.stats;
                let easy = newton_steps <= EASY * meshes;
                step = if easy { 2.0 * taken } else { taken };
                reached = next;
                before = Some((std::mem::replace(&mut last, solution), taken));
            }
            Err(cause) => {
                step = 0.5 * taken;
                if step < SMALLEST_STEP {
                    return Err(Box::new(Stalled {
                        reached,
                        best: last,
                        cause,
                    }));
                }
            }
        }
    }
}

/// What an attempt has cost; nothing where it failed before any arithmetic.
pub(crate) fn cost(attempt: &Result<Solution, Error>) -> Stats {
    let solution = attempt.as_ref().map_or_else(Error::best, Some);
    solution.map_or_else(Stats::default, |solution| solution.stats)
}

/// The θ of the next step, so that no short one is left for the end.
fn next_point(reached: f64, step: f64) -> f64 {
    let rest = 1.0 - reached;
    if step >= rest {
        1.0
    } else {
        reached + step.min(0.5 * rest)
    }
}

/// The straight line through two solutions, beyond the last: last + factor (last − before).
struct Secant<'a> {
    last: &'a Solution,
    before: &'a Solution,
    factor: f64,
}

impl Secant<'_> {
    /// Replaces the values of the last solution by those beyond it.
    fn extrapolate(&self, values: &mut [f64], before: &[f64]) {
        for (value, before) in values.iter_mut().zip(before) {
            *value += self.factor * (*value - before);
        }
    }
}

impl Guess for Secant<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let mut before = vec![0.0; y.len()];
        self.before.state(segment, s, &mut before);
        self.last.state(segment, s, y);
        self.extrapolate(y, &before);
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(self.last.parameters());
        self.extrapolate(p, self.before.parameters());
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        Guess::mesh(self.last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_end_at_one_and_leave_no_short_one() {
        assert_eq!(next_point(0.0, 0.25), 0.25);
        assert_eq!(next_point(0.5, 0.375), 0.75);
        assert_eq!(next_point(0.75, 0.25), 1.0);
        assert_eq!(next_point(0.1, 5.0), 1.0);
    }
}
