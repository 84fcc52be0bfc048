//! The driver: Newton on a mesh, the solution on its halves, a better mesh, until everything holds.

use crate::collocation::Collocation;
use crate::defect::defects;
use crate::error_control::{UNRESOLVED, next_mesh};
use crate::failure::{check_mesh, ill_conditioned, numerical, unresolved};
use crate::global_error::global_errors;
use crate::held::Held;
use crate::homotopy::rough_solution;
use crate::iterate::Iterate;
use crate::mesh::{Mesh, halved, intervals, thinned};
use crate::newton::{Failure, Newton, norm};
use crate::restriction::restrict;
use crate::rounding::hides;
use crate::solution::Quality;
use crate::statement::{check_guess, check_statement, first_mesh};
use crate::tableau::Tableau;
use crate::{Equations, Error, GlobalError, Guess, Options, Solution, Stats};
use std::sync::Arc;
use std::time::Instant;

/// Newton's method stops when its corrections are this fraction of the tolerance, so that what is
/// left of them is invisible beside the discretisation error.
const NEWTON_FRACTION: f64 = 0.01;
/// Where a mesh does not resolve the solution, the next one aims at this fraction of the largest
/// defect that does: where nothing is resolved a defect is about one however fine the mesh is.
const RESOLVED: f64 = 0.3;
/// The first mesh that is to be halved has so many intervals less than the one stated.
const THINNED: f64 = 3.4;
/// A next mesh aims at this fraction of the tolerance.
const AIM: f64 = 0.5;
/// From this mesh on, halves are preferred to another distribution of the nodes, which has been tried.
const MESHES_DISTRIBUTED: usize = 3;
/// A solution whose correction on another mesh is so many tolerances or less is the same there.
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
    let start = Instant::now();
    options.validate()?;
    check_statement(equations, 0)?;
    let mesh = first_mesh(equations, guess, options)?;
    let run = Run {
        equations,
        options,
        tableau: Tableau::of(options.scheme()),
        start,
        stats: Stats::default(),
        curvature: f64::INFINITY,
        probed: false,
    };
    run.solve(guess, mesh)
}

/// What Newton's method starts at.
#[derive(Clone, Copy)]
enum Start<'a> {
    Guess(&'a dyn Guess),
    Solution(&'a Solution),
}

/// How to go on after a solution.
enum Next {
    /// The solution is within the tolerance.
    Done,
    /// On its mesh with every interval halved.
    Halved,
    /// On this mesh.
    Mesh(Mesh),
}

/// One call of [`solve`].
struct Run<'a> {
    equations: &'a dyn Equations,
    options: &'a Options,
    tableau: Arc<Tableau>,
    start: Instant,
    stats: Stats,
    /// What [`Newton::iterate`] has learnt on the last mesh.
    curvature: f64,
    /// Whether layers have been looked for that the mesh might not show.
    probed: bool,
}

impl<'a> Run<'a> {
    /// Solves from the guess on a first mesh, and on finer ones where Newton's method fails.
    fn solve(mut self, guess: &dyn Guess, mesh: Mesh) -> Result<Solution, Error> {
        let mut first = match self.options.global_error {
            GlobalError::HalvedMesh => thinned(&mesh, THINNED),
            GlobalError::BesideDefect | GlobalError::Skip => mesh,
        };
        for _ in 0..self.options.retries {
            match self.begin(guess, first.clone()) {
                Err(error) if error.is_of_newton() && self.may_halve(&first) => {
                    first = halved(&first);
                }
                outcome => return outcome,
            }
        }
        match self.begin(guess, first) {
            Err(mut error) if error.is_of_newton() && self.options.retries > 0 => {
                match rough_solution(self.equations, guess, self.options, &mut self.stats) {
                    None => {
                        if let Some(best) = error.best_mut() {
                            best.stats = self.cost();
                        }
                        Err(error)
                    }
                    Some(rough) => {
                        let coarse = self.on(rough.mesh.clone(), Start::Solution(&rough))?;
                        self.adapt(coarse)
                    }
                }
            }
            outcome => outcome,
        }
    }

    /// Solves from the guess on a first mesh.
    fn begin(&mut self, guess: &dyn Guess, first: Mesh) -> Result<Solution, Error> {
        let coarse = self.on(first, Start::Guess(guess))?;
        self.adapt(coarse)
    }

    /// Solves on one mesh after the other, each chosen from the solution on the last.
    fn adapt(&mut self, mut coarse: Solution) -> Result<Solution, Error> {
        loop {
            let (solution, next) = self.judge(coarse).map_err(|error| *error)?;
            let solution = self.finish(solution);
            coarse = match next {
                Next::Done => return Ok(solution),
                Next::Halved => solution,
                Next::Mesh(mesh) => {
                    check_mesh(&mesh, self.options, &solution)?;
                    if solution.stats.meshes >= MAX_MESHES {
                        return Err(unresolved(self.options, &solution));
                    }
                    let start = Start::Solution(&solution);
                    match self.on(mesh.clone(), start) {
                        Err(error) if error.is_of_newton() && self.may_halve(&mesh) => {
                            self.on(halved(&mesh), start)?
                        }
                        outcome => outcome?,
                    }
                }
            };
        }
    }

    /// The solution on a mesh.
    fn on(&mut self, mesh: Mesh, start: Start<'_>) -> Result<Solution, Error> {
        self.stats.meshes += 1;
        let mut collocation = self.collocation(mesh);
        let mut x = match start {
            Start::Guess(guess) => {
                let x = collocation.interpolate(guess);
                check_guess(&x, &collocation.mesh)?;
                x
            }
            Start::Solution(solution) => {
                Iterate::transfer(&collocation.mesh, &self.tableau, solution)
            }
        };
        // A solution that is to be halved need not be more accurate than its mesh.
        let fraction = if self.refines() { 1.0 } else { NEWTON_FRACTION };
        let mut outcome = self.newton(&mut collocation, &mut x, fraction);
        if outcome.is_err()
            && self.options.retries > 0
            && let Start::Guess(guess) = start
            && let Ok(swept) = collocation.swept(guess, &mut self.stats)
        {
            x = swept;
            outcome = self.newton(&mut collocation, &mut x, fraction);
        }
        match outcome {
            Ok(()) => self
                .assess(&mut collocation, x, fraction)
                .map_err(|error| *error),
            Err(failure) => Err(self.failed(failure, collocation, x, fraction)),
        }
    }

    /// The best solution known after one on a mesh, and how to go on.
    fn judge(&mut self, coarse: Solution) -> Result<(Solution, Next), Box<Error>> {
        let (tolerance, m) = (self.options.tolerance, self.tableau.stages);
        let defect = coarse.defect();
        let by_defect = |wanted: f64| {
            let defects = &coarse.quality.defects.relative;
            Next::Mesh(next_mesh(&coarse.mesh, defects, wanted, m))
        };
        let next = match self.options.global_error {
            GlobalError::HalvedMesh if defect <= UNRESOLVED => None,
            GlobalError::HalvedMesh => Some(by_defect(RESOLVED * UNRESOLVED)),
            GlobalError::BesideDefect if defect <= tolerance => None,
            GlobalError::Skip if defect <= tolerance => Some(Next::Done),
            GlobalError::BesideDefect | GlobalError::Skip => Some(by_defect(tolerance)),
        };
        if let Some(next) = next {
            return Ok((coarse, next));
        }
        let halves = halved(&coarse.mesh);
        check_mesh(&halves, self.options, &coarse)?;
        let mut collocation = self.collocation(halves);
        let Some(fine) = self.refined(&mut collocation, &coarse)? else {
            return Ok((coarse, Next::Mesh(collocation.mesh)));
        };
        let error = fine.error_estimate().unwrap_or(f64::INFINITY);
        if error <= tolerance {
            let resolving = match std::mem::replace(&mut self.probed, true) {
                false => collocation.with_possible_layers(),
                true => None,
            };
            let changed = resolving.filter(|mesh| !self.is_kept(&fine, mesh));
            return Ok((fine, changed.map_or(Next::Done, Next::Mesh)));
        }
        // Before the next mesh is halved its errors may be larger by this factor.
        let order = self.tableau.scheme.dense_order();
        let halves_gain = 1.0 / self.tableau.scheme.share_left();
        let local = &fine.quality.defects.local;
        let wanted = AIM * halves_gain * tolerance * fine.quality.defects.largest_local() / error;
        let next = next_mesh(&fine.mesh, local, wanted, order);
        let few = 2 * intervals(&fine.mesh) < 4 * intervals(&next);
        let tried = self.stats.meshes >= MESHES_DISTRIBUTED;
        if error < 0.5 * halves_gain * tolerance && (few || tried) {
            return Ok((fine, Next::Halved));
        }
        Ok((fine, Next::Mesh(next)))
    }

    /// The solution on the halved mesh of `collocation` with its estimated errors; `None` if there is
    /// none, an error if rounding hides it.
    fn refined(
        &mut self,
        collocation: &mut Collocation<'_>,
        coarse: &Solution,
    ) -> Result<Option<Solution>, Box<Error>> {
        let start = restrict(&self.tableau, &coarse.segments, &coarse.mesh, &coarse.x);
        let mut x = start.clone();
        if self.newton(collocation, &mut x, NEWTON_FRACTION).is_err() {
            return Ok(None);
        }
        let mut fine = self.assess(collocation, x, NEWTON_FRACTION)?;
        fine.quality.errors = global_errors(coarse, &start, &fine);
        if collocation.is_suspect() {
            let (rounding, tolerance) = (collocation.rounding(&fine.x), self.options.tolerance);
            if hides(rounding, tolerance) {
                let error = ill_conditioned(rounding, tolerance, self.finish(fine));
                return Err(Box::new(error));
            }
        }
        Ok(Some(fine))
    }

    /// Whether a solution within the tolerance on its own mesh is so on another one, by its correction
    /// there.
    fn is_kept(&mut self, solution: &Solution, mesh: &Mesh) -> bool {
        let mut collocation = self.collocation(mesh.clone());
        let x = Iterate::transfer(mesh, &self.tableau, solution);
        let (mut residual, mut correction) = (collocation.residual_buffer(), collocation.zeros());
        let linearised = collocation.linearise(&x, &mut residual, &mut self.stats);
        linearised.is_ok() && {
            collocation.node_correction(&residual, &mut correction);
            norm(&x, &[(1.0, &correction)]).largest <= KEPT * self.options.tolerance
        }
    }

    /// Whether the global error is to be known: the solution is then the one on a halved mesh.
    fn refines(&self) -> bool {
        self.options.global_error != GlobalError::Skip
    }

    /// Whether a mesh may be halved within the limit.
    fn may_halve(&self, mesh: &Mesh) -> bool {
        2 * intervals(mesh) <= self.options.max_intervals
    }

    /// The problem discretised on a mesh.
    fn collocation(&self, mesh: Mesh) -> Collocation<'a> {
        let tableau = Arc::clone(&self.tableau);
        Collocation::new(Held::none(self.equations), tableau, mesh)
    }

    /// Newton's method until corrections are this fraction of the tolerance.
    fn newton(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: &mut Iterate,
        fraction: f64,
    ) -> Result<(), Failure> {
        let (wanted, steps) = (self.wanted(fraction), self.options.max_newton_steps);
        let mut newton = Newton::new(collocation, self.curvature);
        let outcome = newton.iterate(collocation, x, wanted, steps, &mut self.stats);
        self.curvature = newton.curvature;
        outcome
    }

    /// A fraction of the tolerance, but no less than what rounding permits.
    fn wanted(&self, fraction: f64) -> f64 {
        (fraction * self.options.tolerance).max(100.0 * f64::EPSILON)
    }

    /// The error for a failure of Newton's method.
    fn failed(
        &self,
        failure: Failure,
        mut collocation: Collocation<'_>,
        x: Iterate,
        fraction: f64,
    ) -> Error {
        let rounding = match failure {
            // Corrections no larger than that are rounding.
            Failure::NoConvergence { correction, .. } => {
                Some(collocation.rounding(&x)).filter(|&rounding| rounding >= correction)
            }
            _ => None,
        };
        let quality = Quality::unknown(&collocation.mesh);
        let best = self.solution(collocation.mesh, x, quality);
        match rounding {
            Some(rounding) => ill_conditioned(rounding, self.options.tolerance, best),
            None => numerical(failure, best, self.wanted(fraction)),
        }
    }

    /// The solution with its defects and conditions, from an iterate converged to this fraction of
    /// the tolerance; an error where a value is not finite or, where it is less than one, a condition is
    /// violated.
    fn assess(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: Iterate,
        fraction: f64,
    ) -> Result<Solution, Box<Error>> {
        let mut conditions = vec![0.0; self.equations.condition_count()];
        let defects = collocation.conditions(&x, &mut conditions).and_then(|()| {
            let (equations, mesh) = (self.equations, &collocation.mesh);
            defects(equations, &self.tableau, mesh, &x, &mut self.stats)
        });
        let mesh = collocation.mesh.clone();
        let defects = match defects {
            Ok(defects) => defects,
            Err(what) => {
                let quality = Quality::unknown(&mesh);
                let best = self.solution(mesh, x, quality);
                return Err(numerical(Failure::NonFinite(what), best, 0.0).into());
            }
        };
        // What is allowed of every condition that is to hold.
        let mut allowed = vec![];
        if fraction < 1.0 {
            let scales = collocation.condition_scales(&x);
            allowed.extend(scales.iter().map(|s| self.options.tolerance * s.max(1.0)));
        }
        let sizes = conditions.iter().map(|r| r.abs());
        let quality = Quality {
            defects,
            conditions: sizes.clone().collect(),
            errors: None,
        };
        let solution = self.solution(mesh, x, quality);
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

    /// The cost so far.
    fn cost(&self) -> Stats {
        Stats {
            seconds: self.start.elapsed().as_secs_f64(),
            ..self.stats
        }
    }

    /// Stamps the cost so far on a solution.
    fn finish(&self, mut solution: Solution) -> Solution {
        solution.stats = self.cost();
        solution
    }
}
