//! The driver: Newton on a mesh, defects, a better mesh, until everything holds.

use crate::almost_block_diagonal::Singular;
use crate::collocation::{Collocation, Iterate, NonFinite};
use crate::error_control::{denser, next_mesh};
use crate::mesh::{Mesh, halved, intervals, uniform};
use crate::newton::{Failure, Newton};
use crate::scheme::Tableau;
use crate::solution::{GlobalErrors, Quality};
use crate::{Equations, Error, GlobalError, Guess, Options, Solution, Stats};
use std::sync::Arc;
use std::time::Instant;

/// Newton's method stops when its corrections are this fraction of the tolerance, so that what is
/// left of them is invisible beside the discretisation error.
const NEWTON_FRACTION: f64 = 0.01;
/// After a failure of Newton's method the mesh is halved and the guess taken again, at most so
/// often.
const RETRIES: usize = 2;
/// Meshes tried before the tolerance is declared out of reach.
const MAX_MESHES: usize = 40;

/// Solves a boundary value problem from a guess.
///
/// On success the relative defect of the solution, the residuals of the conditions and the
/// estimated global error are all below the tolerance.
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
    check_statement(equations)?;
    let mesh = match guess.mesh() {
        Some(mesh) => checked(mesh, equations)?,
        None => uniform(equations.segments(), options.initial_intervals),
    };
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
            let mut collocation = Collocation::new(self.equations, &tableau, mesh);
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
            let outcome = newton.iterate(
                &mut collocation,
                &mut x,
                newton_tolerance,
                self.options.max_newton_steps,
                &mut self.stats,
            );
            if let Err(failure) = outcome {
                let finer = halved(&collocation.mesh);
                if retries < RETRIES && intervals(&finer) <= limit {
                    retries += 1;
                    mesh = finer;
                    continue;
                }
                let best = self.solution(collocation.mesh, x, Quality::unknown());
                return Err(numerical(failure, best, newton_tolerance));
            }
            let (mut solution, conditions) = match self.assess(collocation, x) {
                Ok(assessed) => assessed,
                Err((what, best)) => {
                    return Err(numerical(Failure::NonFinite(what), best, tolerance));
                }
            };
            if let Some((condition, residual, tolerance)) = conditions {
                return Err(Error::ConditionViolated {
                    condition,
                    residual,
                    tolerance,
                    best: Box::new(solution),
                });
            }
            let defect = solution.defect();
            if defect > tolerance {
                let defects = &solution.quality.defects;
                let finer = next_mesh(&solution.mesh, defects, tolerance, tableau.stages);
                mesh_limit_or(&mut previous, solution, &finer, self.options, &self.stats)?;
                mesh = finer;
                continue;
            }
            if self.options.global_error == GlobalError::Skip {
                return Ok(self.finish(solution));
            }
            solution.quality.errors = self.global_errors(&solution);
            let error = solution.error_estimate().unwrap_or(f64::INFINITY);
            if error <= tolerance {
                return Ok(self.finish(solution));
            }
            let order = self.options.scheme.dense_order();
            let finer = denser(&solution.mesh, error, 0.3 * tolerance, order);
            mesh_limit_or(&mut previous, solution, &finer, self.options, &self.stats)?;
            mesh = finer;
        }
    }

    /// Defects and conditions of a converged iterate; a violated condition as (index, residual,
    /// largest residual allowed).
    #[expect(
        clippy::type_complexity,
        reason = "the two outcomes are taken apart at the only call"
    )]
    fn assess(
        &mut self,
        mut collocation: Collocation<'_>,
        x: Iterate,
    ) -> Result<(Solution, Option<(usize, f64, f64)>), (NonFinite, Solution)> {
        let mut residual = collocation.residual_buffer();
        let assessed = collocation
            .residual(&x, &mut residual, &mut self.stats)
            .and_then(|()| collocation.defects(&x, &mut self.stats));
        let defects = match assessed {
            Ok(defects) => defects,
            Err(what) => {
                let best = self.solution(collocation.mesh, x, Quality::unknown());
                return Err((what, best));
            }
        };
        let scales = collocation.condition_scales(&x);
        let violated = residual
            .conditions
            .iter()
            .zip(scales)
            .enumerate()
            .map(|(index, (r, scale))| (index, r.abs(), self.options.tolerance * scale.max(1.0)))
            .find(|&(_, residual, allowed)| residual > allowed);
        let largest = residual
            .conditions
            .iter()
            .fold(0.0, |m: f64, r| m.max(r.abs()));
        let quality = Quality {
            defects,
            conditions: largest,
            errors: None,
        };
        Ok((self.solution(collocation.mesh, x, quality), violated))
    }

    /// The estimated global error: one Newton correction on the halved mesh from the solution. An
    /// error ∝ h^q shrinks to 2^−q of it there, so the correction is (1 − 2^−q) of the error.
    fn global_errors(&mut self, solution: &Solution) -> Option<GlobalErrors> {
        let tableau = Arc::clone(&self.tableau);
        let mesh = halved(&solution.mesh);
        let mut collocation = Collocation::new(self.equations, &tableau, mesh);
        let x = collocation.interpolate(solution);
        let mut residual = collocation.residual_buffer();
        let mut correction = collocation.zeros();
        collocation
            .linearise(&x, &mut residual, &mut self.stats)
            .ok()?;
        collocation.correction(&residual, &mut correction);
        let order = i32::try_from(self.options.scheme.dense_order()).ok()?;
        let factor = 1.0 / (1.0 - 0.5f64.powi(order));
        let relative = |x: f64, d: f64| factor * (d / (1.0 + x.abs())).abs();
        let states = x
            .segments
            .iter()
            .zip(&correction.segments)
            .zip(&solution.segments)
            .map(|((x, d), segment)| {
                let mut largest = vec![0.0f64; segment.states];
                for (i, (&x, &d)) in x.nodes.iter().zip(&d.nodes).enumerate() {
                    let entry = &mut largest[i % segment.states];
                    *entry = entry.max(relative(x, d));
                }
                largest
            })
            .collect();
        let parameters = x.p.iter().zip(&correction.p);
        let errors = GlobalErrors {
            states,
            parameters: parameters.map(|(&x, &d)| relative(x, d)).collect(),
        };
        let finite = correction
            .segments
            .iter()
            .all(|s| s.nodes.iter().all(|d| d.is_finite()));
        finite.then_some(errors)
    }

    fn solution(&self, mesh: Mesh, x: Iterate, quality: Quality) -> Solution {
        Solution {
            segments: self.equations.segments().to_vec(),
            tableau: Arc::clone(&self.tableau),
            mesh,
            x,
            quality,
            stats: self.stats,
        }
    }

    /// Stamps the final cost on a solution.
    fn finish(&self, mut solution: Solution) -> Solution {
        solution.stats = self.stats;
        solution.stats.seconds = self.start.elapsed().as_secs_f64();
        solution
    }
}

impl Quality {
    fn unknown() -> Self {
        Self {
            defects: Vec::new(),
            conditions: f64::INFINITY,
            errors: None,
        }
    }
}

/// Keeps `solution` as the guess for the mesh `finer`, or refuses that mesh.
fn mesh_limit_or(
    previous: &mut Option<Solution>,
    solution: Solution,
    finer: &Mesh,
    options: &Options,
    stats: &Stats,
) -> Result<(), Error> {
    let needed = intervals(finer);
    if needed > options.max_intervals || stats.meshes >= MAX_MESHES {
        return Err(Error::MeshLimit {
            needed,
            limit: options.max_intervals,
            defect: solution.defect(),
            error: solution.error_estimate().unwrap_or(f64::INFINITY),
            tolerance: options.tolerance,
            best: Box::new(solution),
        });
    }
    *previous = Some(solution);
    Ok(())
}

/// The error for a failure of Newton's method.
fn numerical(failure: Failure, best: Solution, tolerance: f64) -> Error {
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

/// Checks that the problem is stated completely.
fn check_statement(equations: &dyn Equations) -> Result<(), Error> {
    let segments = equations.segments();
    if segments.is_empty() {
        return Err(Error::NoSegments);
    }
    for (index, segment) in segments.iter().enumerate() {
        if segment.states == 0 {
            return Err(Error::NoStates { segment: index });
        }
        let length = segment.to - segment.from;
        if !(length > 0.0 && length.is_finite()) {
            return Err(Error::Interval {
                segment: index,
                from: segment.from,
                to: segment.to,
            });
        }
    }
    let states = segments.iter().map(|segment| segment.states).sum();
    let parameters = equations.parameters();
    let unknowns = states + parameters;
    let conditions = equations.condition_count();
    if conditions != unknowns {
        return Err(Error::ConditionCount {
            conditions,
            unknowns,
            states,
            parameters,
        });
    }
    Ok(())
}

/// Checks the mesh that a guess brings.
fn checked(mesh: Mesh, equations: &dyn Equations) -> Result<Mesh, Error> {
    for (index, segment) in equations.segments().iter().enumerate() {
        let fits = mesh.get(index).is_some_and(|nodes| {
            nodes.len() >= 2
                && nodes.first() == Some(&segment.from)
                && nodes.last() == Some(&segment.to)
                && nodes.windows(2).all(|pair| pair[0] < pair[1])
        });
        if !fits || mesh.len() != equations.segments().len() {
            return Err(Error::GuessMesh {
                segment: index,
                from: segment.from,
                to: segment.to,
            });
        }
    }
    Ok(mesh)
}

/// Checks that a guess is finite.
fn check_guess(x: &Iterate, mesh: &Mesh) -> Result<(), Error> {
    for (index, (segment, nodes)) in x.segments.iter().zip(mesh).enumerate() {
        let values = segment.nodes.len();
        if let Some(i) = segment.nodes.iter().position(|y| !y.is_finite()) {
            return Err(Error::Guess {
                segment: index,
                s: nodes[i * nodes.len() / values],
            });
        }
        if segment.stages.iter().any(|slope| !slope.is_finite()) {
            return Err(Error::Guess {
                segment: index,
                s: nodes[0],
            });
        }
    }
    if x.p.iter().any(|p| !p.is_finite()) {
        return Err(Error::Guess {
            segment: mesh.len(),
            s: f64::NAN,
        });
    }
    Ok(())
}
