//! The driver: Newton on a mesh, the error of the solution, a better mesh, until everything holds.

use crate::accuracy::defect::defects;
use crate::accuracy::mesh_selection::{GRADING, GRADING_BY_ERROR, UNRESOLVED, next_mesh};
use crate::accuracy::rounding::exceeds;
use crate::discretisation::iterate::{Iterate, NonFinite};
use crate::discretisation::mesh::{Mesh, halved, intervals, thinned};
use crate::discretisation::tableau::Tableau;
use crate::newton::collocation::Collocation;
use crate::newton::newton::{Failure, Newton};
use crate::problem::equations::Equations;
use crate::problem::guess::Guess;
use crate::problem::held::Held;
use crate::result::error::Error;
use crate::result::quality::{Quality, Samples};
use crate::result::restored::restore;
use crate::result::solution::Solution;
use crate::result::stats::Stats;
use crate::solver::failure::{check_mesh, ill_conditioned, numerical, unresolved};
use crate::solver::homotopy::rough_solution;
use crate::solver::options::{Control, Options};
use crate::solver::statement::{check_guess, check_statement, first_mesh};
use crate::solver::transfer::transfer;
use std::sync::Arc;
use web_time::Instant;

/// Newton's method stops when its corrections are this fraction of the tolerance. What is left of them
/// is in the defect, and so in the estimate of the error, ...
const NEWTON_FRACTION: f64 = 0.03;
/// ... but without an estimate it is to be invisible beside the discretisation error.
const INVISIBLE_FRACTION: f64 = 0.01;
/// Where a mesh does not resolve the solution, the next one aims at this fraction of the largest
/// defect that does: where nothing is resolved a defect is about one however fine the mesh is.
const RESOLVED: f64 = 0.3;
/// A first mesh of equal intervals has the stated number divided by this: it tells nothing of the solution.
const THINNED: f64 = 3.4;
/// A mesh made for the error aims at this fraction of the tolerance, and after every one that missed it
/// at this fraction of the aim before.
const AIM: f64 = 0.3;
/// A solution whose correction on another mesh is at most this many tolerances is the same there.
const KEPT: f64 = 3.0;
/// Meshes tried before the tolerance is declared out of reach.
const MAX_MESHES: usize = 40;

/// Solves a boundary value problem from a guess.
///
/// On success the estimated global error and the residuals of the conditions are at most the
/// tolerance; see [`Options::tolerance`].
///
/// # Errors
/// Statement errors before any arithmetic; numerical failures with the best iterate. See
/// [`Error`].
pub fn solve(
    equations: &dyn Equations,
    guess: &dyn Guess,
    options: &Options,
) -> Result<Solution, Error> {
    solve_held(&Held::none(equations), guess, options)
}

/// The same with some parameters held.
pub(crate) fn solve_held(
    equations: &Held<'_>,
    guess: &dyn Guess,
    options: &Options,
) -> Result<Solution, Error> {
    let start = Instant::now();
    options.validate()?;
    check_statement(equations, 0)?;
    let mesh = first_mesh(equations, guess, options)?;
    let first = match options.control {
        Control::Error => thinned(&mesh, THINNED),
        Control::Both | Control::Defect => mesh,
    };
    let tableau = Tableau::of(options.scheme());
    let collocation = Collocation::new(equations.clone(), tableau, first.clone());
    let run = Run {
        equations,
        options,
        start,
        stats: Stats::default(),
        newton: Newton::new(&collocation),
        collocation,
        samples: vec![],
        missed: 0,
        probed: false,
    };
    restore(equations, run.solve(&equations.divided(guess), first))
}

/// What Newton's method starts at.
#[derive(Clone, Copy)]
enum Start<'a> {
    Guess(&'a dyn Guess),
    Solution(&'a Solution),
}

/// A condition whose residual is larger than allowed.
struct Violation {
    condition: usize,
    residual: f64,
    allowed: f64,
}

/// One call of [`solve`].
struct Run<'a> {
    equations: &'a Held<'a>,
    options: &'a Options,
    start: Instant,
    stats: Stats,
    /// The problem discretised on the last mesh.
    collocation: Collocation<'a>,
    newton: Newton,
    /// The defects of the last solution.
    samples: Samples,
    /// How many solutions were resolved, but not within the tolerance.
    missed: i32,
    /// Whether layers have been looked for that the mesh might not show.
    probed: bool,
}

impl Run<'_> {
    /// Solves from the guess on a first mesh, and on finer ones where Newton's method fails.
    fn solve(mut self, guess: &dyn Guess, mut first: Mesh) -> Result<Solution, Error> {
        for _ in 0..self.options.retries {
            match self.adapt(first.clone(), Start::Guess(guess)) {
                Err(error) if error.is_of_newton() && self.may_halve(&first) => {
                    first = halved(&first);
                }
                outcome => return outcome,
            }
        }
        match self.adapt(first, Start::Guess(guess)) {
            Err(mut error) if error.is_of_newton() && self.options.retries > 0 => {
                match rough_solution(self.equations, guess, self.options, &mut self.stats) {
                    None => {
                        if let Some(best) = error.best_mut() {
                            best.stats = self.cost();
                        }
                        Err(error)
                    }
                    Some(rough) => self.adapt(rough.mesh.clone(), Start::Solution(&rough)),
                }
            }
            outcome => outcome,
        }
    }

    /// Solves on one mesh after the other, each chosen from the solution on the last.
    fn adapt(&mut self, first: Mesh, start: Start<'_>) -> Result<Solution, Error> {
        self.missed = 0;
        let mut solution = self.on(first, start)?;
        while let Some(mesh) = self.judge(&mut solution)? {
            check_mesh(&mesh, self.options, &solution)?;
            if self.stats.meshes >= MAX_MESHES {
                return Err(unresolved(self.options, &solution));
            }
            let start = Start::Solution(&solution);
            solution = match self.on(mesh, start) {
                // Where an iterate is far off, its rounding means little.
                Err(error)
                    if (error.is_of_newton() || matches!(error, Error::IllConditioned { .. }))
                        && self.may_halve(&self.collocation.mesh) =>
                {
                    self.on(halved(&self.collocation.mesh), start)?
                }
                outcome => outcome?,
            };
        }
        solution.stats = self.cost();
        Ok(solution)
    }

    /// The solution on a mesh.
    fn on(&mut self, mesh: Mesh, start: Start<'_>) -> Result<Solution, Error> {
        self.stats.meshes += 1;
        self.set_mesh(mesh);
        let Self { collocation, .. } = self;
        let mut x = match start {
            Start::Guess(guess) => {
                let x = collocation.interpolate(guess);
                check_guess(&x, &collocation.mesh)?;
                x
            }
            Start::Solution(solution) => {
                transfer(&collocation.mesh, &collocation.tableau, solution)
            }
        };
        let mut outcome = self.iterate(&mut x);
        if outcome.is_err()
            && self.options.retries > 0
            && let Start::Guess(guess) = start
            && let Ok(picard) = self.collocation.picard(guess, &mut self.stats)
        {
            x = picard;
            outcome = self.iterate(&mut x);
        }
        match outcome {
            Ok(()) => self.assess(x),
            Err(failure) => Err(self.failed(failure, x)),
        }
    }

    /// Discretises the problem on a mesh.
    fn set_mesh(&mut self, mesh: Mesh) {
        self.collocation.set_mesh(mesh);
        self.newton.resize(&self.collocation);
    }

    /// Estimates the error of a solution where that is to be, and makes a better mesh: none if the
    /// solution is good enough, an error if rounding hides it.
    fn judge(&mut self, solution: &mut Solution) -> Result<Option<Mesh>, Error> {
        let tolerance = self.options.tolerance;
        let (defect, estimating) = (solution.defect(), self.estimates());
        let (allowed, wanted, grading) = match self.options.control {
            Control::Error => (UNRESOLVED, RESOLVED * UNRESOLVED, GRADING_BY_ERROR),
            Control::Both | Control::Defect => (tolerance, tolerance, GRADING),
        };
        if defect > allowed {
            if estimating
                && defect > UNRESOLVED
                && !self.probed
                && let Some(mesh) = self.collocation.with_possible_layers()
            {
                self.probed = true;
                return Ok(Some(mesh));
            }
            let (defects, m) = (&solution.quality.defects.relative, self.stages());
            return Ok(Some(next_mesh(&solution.mesh, defects, wanted, m, grading)));
        }
        if !estimating {
            return Ok(None);
        }
        let (samples, local) = (&self.samples, &solution.quality.defects.local);
        let Self {
            newton,
            collocation,
            ..
        } = self;
        solution.quality.errors = newton.global_errors(collocation, &solution.x, samples, local);
        let error = solution.error_estimate().unwrap_or(f64::INFINITY);
        self.refuse_rounding(solution)?;
        if error <= tolerance {
            if std::mem::replace(&mut self.probed, true) {
                return Ok(None);
            }
            let resolving = self.collocation.with_possible_layers();
            return Ok(resolving.filter(|mesh| !self.is_kept(solution, mesh)));
        }
        if error.is_infinite() {
            return Ok(Some(halved(&solution.mesh)));
        }
        self.missed += 1;
        let order = self.collocation.tableau.scheme.dense_order();
        let defects = &solution.quality.defects;
        let wanted = AIM.powi(self.missed) * tolerance * defects.largest_local() / error;
        let local = &defects.local;
        let next = next_mesh(&solution.mesh, local, wanted, order, grading);
        Ok(Some(next))
    }

    /// Refuses a solution that may be nothing but rounding.
    fn refuse_rounding(&mut self, solution: &Solution) -> Result<(), Error> {
        if self.collocation.is_suspect() {
            let rounding = self.collocation.rounding(&solution.x);
            let tolerance = self.options.tolerance;
            if exceeds(rounding, tolerance) {
                let mut best = solution.clone();
                best.stats = self.cost();
                return Err(ill_conditioned(rounding, tolerance, best));
            }
        }
        Ok(())
    }

    /// Whether a solution within the tolerance on its own mesh is so on another one, by its correction
    /// there.
    fn is_kept(&mut self, solution: &Solution, mesh: &Mesh) -> bool {
        self.set_mesh(mesh.clone());
        let Self {
            newton,
            collocation,
            ..
        } = self;
        let x = transfer(mesh, &collocation.tableau, solution);
        let correction = newton.correction(collocation, &x, &mut self.stats);
        correction.is_ok_and(|size| size <= KEPT * self.options.tolerance)
    }

    /// Whether the global error is to be known.
    fn estimates(&self) -> bool {
        self.options.control != Control::Defect
    }

    /// Stages m of the scheme.
    fn stages(&self) -> usize {
        self.collocation.tableau.stages
    }

    /// Whether a mesh may be halved within the limit.
    fn may_halve(&self, mesh: &Mesh) -> bool {
        2 * intervals(mesh) <= self.options.max_intervals
    }

    /// Newton's method.
    fn iterate(&mut self, x: &mut Iterate) -> Result<(), Failure> {
        let (wanted, steps) = (self.wanted(), self.options.max_newton_steps);
        self.newton
            .iterate(&mut self.collocation, x, wanted, steps, &mut self.stats)
    }

    /// How small corrections are to be, no less than what rounding permits.
    fn wanted(&self) -> f64 {
        let fraction = match self.estimates() {
            true => NEWTON_FRACTION,
            false => INVISIBLE_FRACTION,
        };
        (fraction * self.options.tolerance).max(100.0 * f64::EPSILON)
    }

    /// The error for a failure of Newton's method.
    fn failed(&mut self, failure: Failure, x: Iterate) -> Error {
        let rounding = match failure {
            // Corrections no larger than that are rounding.
            Failure::NoConvergence { correction, .. } => {
                Some(self.collocation.rounding(&x)).filter(|&rounding| rounding >= correction)
            }
            _ => None,
        };
        let best = self.solution(x, Quality::unknown(&self.collocation.mesh));
        match rounding {
            Some(rounding) => ill_conditioned(rounding, self.options.tolerance, best),
            None => numerical(failure, best, self.wanted()),
        }
    }

    /// The solution with its defects and conditions, from a converged iterate; an error where a value is
    /// not finite or a condition is violated.
    fn assess(&mut self, mut x: Iterate) -> Result<Solution, Error> {
        let mut outcome = self.violated(&x);
        if let Ok((_, Some(_))) = outcome {
            // The last step was trusted too far.
            self.newton.curvature = f64::INFINITY;
            if let Err(failure) = self.iterate(&mut x) {
                return Err(self.failed(failure, x));
            }
            outcome = self.violated(&x);
        }
        let assessed = outcome.and_then(|(conditions, violated)| {
            let Collocation { tableau, mesh, .. } = &self.collocation;
            let (samples, stats) = (&mut self.samples, &mut self.stats);
            let defects = defects(self.equations, tableau, mesh, &x, samples, stats)?;
            let quality = Quality {
                defects,
                conditions,
                errors: None,
            };
            Ok((quality, violated))
        });
        match assessed {
            Ok((quality, None)) => Ok(self.solution(x, quality)),
            Ok((quality, Some(violation))) => Err(Error::ConditionViolated {
                condition: violation.condition,
                residual: violation.residual,
                tolerance: violation.allowed,
                best: Box::new(self.solution(x, quality)),
            }),
            Err(what) => {
                let best = self.solution(x, Quality::unknown(&self.collocation.mesh));
                Err(numerical(Failure::NonFinite(what), best, 0.0))
            }
        }
    }

    /// The sizes of the residuals of all conditions, and the first one that is violated.
    fn violated(&mut self, x: &Iterate) -> Result<(Vec<f64>, Option<Violation>), NonFinite> {
        let mut conditions = vec![0.0; self.equations.condition_count()];
        self.collocation.conditions(x, &mut conditions)?;
        conditions.iter_mut().for_each(|r| *r = r.abs());
        let scales = self.collocation.condition_scales(x);
        let allowed = scales.iter().map(|s| self.options.tolerance * s.max(1.0));
        let all = conditions.iter().zip(allowed).enumerate();
        let mut violations = all.filter_map(|(condition, (&residual, allowed))| {
            (residual > allowed).then_some(Violation {
                condition,
                residual,
                allowed,
            })
        });
        let first = violations.next();
        Ok((conditions, first))
    }

    /// An iterate on the present mesh as a solution.
    fn solution(&self, x: Iterate, quality: Quality) -> Solution {
        let Collocation { tableau, mesh, .. } = &self.collocation;
        Solution {
            segments: self.equations.segments().to_vec(),
            tableau: Arc::clone(tableau),
            mesh: mesh.clone(),
            x,
            quality,
            stats: self.cost(),
        }
    }

    /// The cost so far.
    fn cost(&self) -> Stats {
        Stats {
            seconds: self.start.elapsed().as_secs_f64(),
            ..self.stats
        }
    }
}
