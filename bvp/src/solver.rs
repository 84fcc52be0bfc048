//! The driver: Newton on a mesh, defects, a better mesh, until everything holds.

use crate::almost_block_diagonal::Singular;
use crate::collocation::Collocation;
use crate::defect::defects;
use crate::error_control::{denser, next_mesh};
use crate::global_error::global_errors;
use crate::held::Held;
use crate::iterate::{Iterate, NonFinite};
use crate::mesh::{Mesh, halved, intervals, is_representable};
use crate::newton::{Failure, Newton};
use crate::scheme::Tableau;
use crate::solution::Quality;
use crate::statement::{check_guess, check_statement, first_mesh};
use crate::{Control, Equations, Error, GlobalError, Guess, Options, Solution, Stats};
use std::sync::Arc;
use std::time::Instant;

/// Newton's method stops when its corrections are this fraction of the tolerance, so that what is
/// left of them is invisible beside the discretisation error.
const NEWTON_FRACTION: f64 = 0.01;
/// With a larger relative defect than this a mesh does not resolve the solution, and its error is not
/// worth an estimate.
const UNRESOLVED: f64 = 0.5;
/// Meshes tried before the tolerance is declared out of reach.
const MAX_MESHES: usize = 40;

/// Solves a boundary value problem from a guess.
///
/// On success the relative defect of the solution, the residuals of the conditions and the
/// estimated global error are all at most the tolerance; see [`Options::tolerance`].
///
/// # Errors
/// Statement errors before any arithmetic; numerical failures with the best iterate. See
/// [`Error`].
pub fn solve(
    equations: &dyn Equations,
    guess: &dyn Guess,
    options: &Options,
) -> Result<Solution, Error> {
    let start = Instant::now();
    options.validate()?;
    check_statement(equations, 0)?;
    let mesh = first_mesh(equations, guess, options)?;
    let run = Run {
        equations,
        options,
        tableau: Arc::new(Tableau::new(options.scheme)),
        start,
        stats: Stats::default(),
    };
    run.solve(guess, mesh)
}

/// One call of [`solve`].
struct Run<'a> {
    equations: &'a dyn Equations,
    options: &'a Options,
    tableau: Arc<Tableau>,
    start: Instant,
    stats: Stats,
}

impl Run<'_> {
    fn solve(mut self, guess: &dyn Guess, mut mesh: Mesh) -> Result<Solution, Error> {
        let (tolerance, limit) = (self.options.tolerance, self.options.max_intervals);
        let mut previous: Option<Solution> = None;
        let mut retries = 0;
        loop {
            let tableau = Arc::clone(&self.tableau);
            let mut collocation = Collocation::new(Held::none(self.equations), tableau, mesh);
            let from = previous
                .as_ref()
                .map_or(guess, |solution| solution as &dyn Guess);
            let mut x = collocation.interpolate(from);
            if previous.is_none() {
                check_guess(&x, &collocation.mesh)?;
            }
            self.stats.meshes += 1;
            let mut newton = Newton::new(&collocation);
            let newton_tolerance = (NEWTON_FRACTION * tolerance).max(100.0 * f64::EPSILON);
            let mut iterate =
                |x: &mut Iterate, collocation: &mut Collocation<'_>, stats: &mut Stats| {
                    let steps = self.options.max_newton_steps;
                    newton.iterate(collocation, x, newton_tolerance, steps, stats)
                };
            let mut outcome = iterate(&mut x, &mut collocation, &mut self.stats);
            if outcome.is_err()
                && self.options.retries > 0
                && previous.is_none()
                && let Ok(swept) = collocation.swept(guess, &mut self.stats)
            {
                x = swept;
                outcome = iterate(&mut x, &mut collocation, &mut self.stats);
            }
            if let Err(failure) = outcome {
                let finer = halved(&collocation.mesh);
                if retries < self.options.retries && intervals(&finer) <= limit {
                    retries += 1;
                    mesh = finer;
                    continue;
                }
                let quality = Quality::unknown(&collocation.mesh);
                let best = self.solution(collocation.mesh, x, quality);
                return Err(numerical(failure, best, newton_tolerance));
            }
            let mut solution = self.assess(collocation, x).map_err(|error| *error)?;
            let Some(finer) = self.better_mesh(&mut solution) else {
                return Ok(self.finish(solution));
            };
            let solution = self.finish(solution);
            check_mesh(&finer, self.options, &solution)?;
            if solution.stats.meshes >= MAX_MESHES {
                return Err(unresolved(self.options, &solution));
            }
            previous = Some(solution);
            mesh = finer;
        }
    }

    /// The mesh to go on with, unless the solution is within the tolerance.
    fn better_mesh(&mut self, solution: &mut Solution) -> Option<Mesh> {
        let (tolerance, m) = (self.options.tolerance, self.tableau.stages);
        let defect = solution.defect();
        let by_defect = |solution: &Solution, wanted: f64| {
            next_mesh(&solution.mesh, &solution.quality.defects, wanted, m)
        };
        let wanted = match self.options.control {
            _ if self.options.global_error == GlobalError::Skip => tolerance,
            Control::Defect => tolerance,
            Control::Error => UNRESOLVED,
        };
        if defect > wanted || defect.is_nan() {
            return Some(by_defect(solution, wanted));
        }
        if self.options.global_error == GlobalError::Skip {
            return None;
        }
        solution.quality.errors = global_errors(self.equations, solution, &mut self.stats);
        let error = solution.error_estimate().unwrap_or(f64::INFINITY);
        if error <= tolerance {
            return None;
        }
        let order = self.options.scheme.dense_order();
        Some(match self.options.control {
            Control::Defect => denser(&solution.mesh, error, tolerance, order),
            Control::Error => {
                // The defect is of order m, the error of this order: so much less of the one is as
                // much less of the other as is wanted.
                let less = (tolerance / error).powf(m as f64 / order as f64);
                by_defect(solution, defect * less)
            }
        })
    }

    /// The solution with its defects and conditions, from a converged iterate; an error where a
    /// value is not finite or a condition is violated.
    fn assess(
        &mut self,
        mut collocation: Collocation<'_>,
        x: Iterate,
    ) -> Result<Solution, Box<Error>> {
        let (equations, stats) = (self.equations, &mut self.stats);
        let mut residual = collocation.residual_buffer();
        let defects = collocation
            .residual(&x, &mut residual, stats)
            .and_then(|()| defects(equations, &self.tableau, &collocation.mesh, &x, stats));
        let scales = collocation.condition_scales(&x);
        let mesh = collocation.mesh;
        let defects = match defects {
            Ok(defects) => defects,
            Err(what) => {
                let quality = Quality::unknown(&mesh);
                let best = self.solution(mesh, x, quality);
                return Err(numerical(Failure::NonFinite(what), best, 0.0).into());
            }
        };
        let sizes = residual.conditions.iter().map(|r| r.abs());
        let quality = Quality {
            defects,
            conditions: sizes.clone().fold(0.0, f64::max),
            errors: None,
        };
        let solution = self.solution(mesh, x, quality);
        let allowed = scales.iter().map(|&s| self.options.tolerance * s.max(1.0));
        let violated = sizes
            .zip(allowed)
            .enumerate()
            .find(|(_, (residual, allowed))| residual > allowed);
        match violated {
            None => Ok(solution),
            Some((condition, (residual, tolerance))) => Err(Box::new(Error::ConditionViolated {
                condition,
                residual,
                tolerance,
                best: Box::new(solution),
            })),
        }
    }

    fn solution(&self, mesh: Mesh, x: Iterate, quality: Quality) -> Solution {
        self.finish(Solution {
            segments: self.equations.segments().to_vec(),
            tableau: Arc::clone(&self.tableau),
            mesh,
            x,
            quality,
            stats: self.stats,
        })
    }

    /// Stamps the cost so far on a solution.
    fn finish(&self, mut solution: Solution) -> Solution {
        solution.stats = self.stats;
        solution.stats.seconds = self.start.elapsed().as_secs_f64();
        solution
    }
}

/// Refuses a next mesh that is too large or cannot be represented.
pub(crate) fn check_mesh(finer: &Mesh, options: &Options, best: &Solution) -> Result<(), Error> {
    let (needed, limit) = (intervals(finer), options.max_intervals);
    if needed > limit {
        return Err(Error::MeshLimit {
            needed,
            limit,
            defect: best.defect(),
            error: best.error_estimate().unwrap_or(f64::INFINITY),
            tolerance: options.tolerance,
            best: Box::new(best.clone()),
        });
    }
    if is_representable(finer) {
        Ok(())
    } else {
        Err(unresolved(options, best))
    }
}

/// The error for a solution that no mesh seems to resolve.
fn unresolved(options: &Options, best: &Solution) -> Error {
    let (segment, s, length) = best.worst_interval();
    Error::Unresolved {
        segment,
        s,
        length,
        meshes: best.stats.meshes,
        defect: best.defect(),
        error: best.error_estimate().unwrap_or(f64::INFINITY),
        tolerance: options.tolerance,
        best: Box::new(best.clone()),
    }
}

/// The error for a failure of Newton's method.
pub(crate) fn numerical(failure: Failure, best: Solution, tolerance: f64) -> Error {
    let steps = best.stats.newton_steps;
    let best = Box::new(best);
    match failure {
        Failure::NonFinite(NonFinite::Rhs {
            segment,
            s,
            component,
        }) => Error::NonFiniteRhs {
            segment,
            s,
            component,
            best,
        },
        Failure::NonFinite(NonFinite::Condition { index }) => Error::NonFiniteCondition {
            condition: index,
            best,
        },
        Failure::Singular(Singular::Node { segment, node }) => Error::SingularNode {
            segment,
            node,
            best,
        },
        Failure::Singular(Singular::Ends) => Error::SingularConditions { best },
        Failure::NoConvergence { correction } => Error::NoConvergence {
            correction,
            steps,
            tolerance,
            best,
        },
    }
}
