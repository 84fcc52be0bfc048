//! The driver: Newton on a mesh, the error of the solution, a better mesh, until everything holds.

use crate::accuracy::mesh_selection::{
    GRADING, GRADING_BY_ERROR, UNRESOLVED, amplify_rough, next_mesh, relevant,
};
use crate::discretisation::mesh::{Mesh, halved, thinned};
use crate::kernels::dense::max_or_nan;
use crate::problem::equations::Equations;
use crate::problem::guess::Guess;
use crate::problem::held::Held;
use crate::result::error::Error;
use crate::result::restored::restore;
use crate::result::solution::Solution;
use crate::shares::{AIM, UNNOTICED};
use crate::solver::acceptance::{Acceptance, Confirmed};
use crate::solver::discretised::Discretised;
use crate::solver::failure::check_mesh;
use crate::solver::homotopy::rough_solution;
use crate::solver::options::{Control, Options};
use crate::solver::statement::{check_guess, check_statement, first_mesh, in_units};
use crate::solver::transfer::transfer;
use web_time::Instant;

/// A first mesh of equal intervals has the stated number divided by this: it tells nothing of the solution.
const THINNED: f64 = 3.4;
/// By as many meshes layers are found; what is not resolved on one more is rough.
const LAYERS_SHOWN: usize = 6;

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
    let equations = &in_units(equations, options)?;
    let mesh = first_mesh(equations, guess, options)?;
    let first = match options.control {
        Control::Error => thinned(&mesh, THINNED),
        Control::Both | Control::Defect => mesh,
    };
    let run = Run {
        problem: Discretised::new(equations, options, start),
        acceptance: Acceptance::new(),
        meshes: 0,
        missed: 0,
        unresolved: None,
        before: None,
    };
    restore(equations, run.solve(&equations.divided(guess), first))
}

/// What Newton's method starts at.
#[derive(Clone, Copy)]
enum Start<'a> {
    Guess(&'a dyn Guess),
    Solution(&'a Solution),
}

/// One call of [`solve`].
struct Run<'a> {
    /// The problem on the last mesh.
    problem: Discretised<'a>,
    acceptance: Acceptance,
    /// How many meshes this attempt has seen.
    meshes: usize,
    /// How many solutions were resolved, but not within the tolerance.
    missed: i32,
    /// The mesh of the last solution that was not resolved, and its relative defects.
    unresolved: Option<Seen>,
    /// The mesh of the last solution that missed the tolerance, and its local defects.
    before: Option<Seen>,
}

/// A mesh with the defects of its solution.
type Seen = (Mesh, Vec<Vec<f64>>);

impl Run<'_> {
    /// Solves from the guess on a first mesh, and on finer ones where Newton's method fails; at last from
    /// where a homotopy leads.
    fn solve(mut self, guess: &dyn Guess, mut first: Mesh) -> Result<Solution, Error> {
        for _ in 0..self.problem.options.retries {
            match self.adapt(first.clone(), Start::Guess(guess)) {
                Err(error) if self.may_retry(&error) && self.problem.may_halve(&first) => {
                    first = halved(&first);
                }
                outcome => return self.rescue(guess, outcome),
            }
        }
        let outcome = self.adapt(first, Start::Guess(guess));
        self.rescue(guess, outcome)
    }

    /// Another attempt from where a homotopy leads, where one may do better than the outcome so far, whose
    /// error stands if this one fails, too.
    fn rescue(
        &mut self,
        guess: &dyn Guess,
        outcome: Result<Solution, Error>,
    ) -> Result<Solution, Error> {
        let mut error = match outcome {
            Err(error) if self.may_follow(&error) => error,
            outcome => return outcome,
        };
        let Discretised {
            equations,
            options,
            stats,
            ..
        } = &mut self.problem;
        let rough = rough_solution(equations, guess, options, stats, solve);
        let rescued = rough.map(|rough| self.adapt(rough.mesh.clone(), Start::Solution(&rough)));
        match rescued {
            Some(Ok(solution)) => Ok(solution),
            _ => {
                if let Some(best) = error.best_mut() {
                    best.stats = self.problem.cost();
                }
                Err(error)
            }
        }
    }

    /// Solves on one mesh after the other, each chosen from the solution on the last.
    fn adapt(&mut self, first: Mesh, start: Start<'_>) -> Result<Solution, Error> {
        (self.meshes, self.missed) = (0, 0);
        let mut solution = self.on(first, start)?;
        while let Some(mesh) = self.judge(&mut solution)? {
            if let Err(error) = check_mesh(&mesh, self.meshes, self.problem.options, &solution) {
                return Err(self.out_of_reach(error, &solution));
            }
            let start = Start::Solution(&solution);
            solution = match self.on(mesh, start) {
                // Where an iterate is far off, its rounding means little.
                Err(error)
                    if (self.may_retry(&error)
                        || matches!(error, Error::IllConditioned { .. }))
                        && self.problem.may_halve(&self.problem.collocation.mesh) =>
                {
                    self.on(halved(&self.problem.collocation.mesh), start)?
                }
                outcome => outcome?,
            };
        }
        solution.stats = self.problem.cost();
        Ok(solution)
    }

    /// The solution on a mesh.
    fn on(&mut self, mesh: Mesh, start: Start<'_>) -> Result<Solution, Error> {
        self.problem.stats.meshes += 1;
        self.meshes += 1;
        self.acceptance.moved = false;
        self.problem.set_mesh(mesh);
        let Discretised { collocation, .. } = &self.problem;
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
        let mut outcome = self.problem.iterate(&mut x);
        if outcome.is_err()
            && self.problem.options.retries > 0
            && let Start::Guess(guess) = start
            && let Ok(picard) = self
                .problem
                .collocation
                .picard(guess, &mut self.problem.stats)
        {
            x = picard;
            outcome = self.problem.iterate(&mut x);
        }
        match outcome {
            Ok(()) => self.problem.assess(x),
            Err(failure) => Err(self.problem.failed(failure, x)),
        }
    }

    /// Estimates the error of a solution where that is to be, and makes a better mesh: none if the
    /// solution is good enough, an error if rounding hides it.
    fn judge(&mut self, solution: &mut Solution) -> Result<Option<Mesh>, Error> {
        let tolerance = self.problem.options.tolerance;
        let estimating = self.problem.estimates();
        let control = self.problem.options.control;
        let beside = (control == Control::Error).then_some(tolerance);
        let shown = relevant(&solution.quality.defects, beside);
        let defect = shown.flatten().fold(0.0, max_or_nan);
        // Where nothing is resolved a defect is about one however fine the mesh is.
        let (allowed, wanted, grading) = match control {
            Control::Error => (UNRESOLVED, AIM * UNRESOLVED, GRADING_BY_ERROR),
            Control::Both | Control::Defect => (tolerance, tolerance, GRADING),
        };
        if defect > allowed {
            if estimating
                && defect > UNRESOLVED
                && !self.acceptance.layers_sought
                && let Some(mesh) = self.problem.collocation.with_possible_layers()
            {
                self.acceptance.layers_sought = true;
                return Ok(Some(mesh));
            }
            let shown = relevant(&solution.quality.defects, beside);
            let mut defects: Vec<Vec<f64>> = shown.map(Iterator::collect).collect();
            let m = self.problem.stages();
            if let Some(before) = last(&mut self.unresolved, self.meshes, &solution.mesh, &defects)
            {
                amplify_rough(&mut defects, &solution.mesh, &before, m, 1);
            }
            return Ok(Some(next_mesh(
                &solution.mesh,
                &defects,
                wanted,
                m,
                grading,
            )));
        }
        if !estimating {
            return Ok(None);
        }
        let is_first = self.missed == 0;
        self.acceptance
            .estimate(&mut self.problem, solution, is_first)?;
        if solution
            .error_estimate()
            .is_some_and(|error| error <= tolerance)
        {
            match self.acceptance.confirm(&mut self.problem, solution)? {
                Confirmed::Yes => return Ok(None),
                Confirmed::Moved => return self.judge(solution),
                Confirmed::On(mesh) => return Ok(Some(mesh)),
            }
        }
        let error = solution.error_estimate().unwrap_or(f64::INFINITY);
        if error.is_infinite() {
            return Ok(Some(halved(&solution.mesh)));
        }
        let order = self.problem.collocation.tableau.scheme.dense_order();
        let defects = &solution.quality.defects;
        let mut local = defects.local.clone();
        let before = last(&mut self.before, self.meshes, &solution.mesh, &local);
        let rough = before
            .is_some_and(|before| amplify_rough(&mut local, &solution.mesh, &before, order, 2));
        self.missed = if rough { 1 } else { self.missed + 1 };
        let wanted = AIM.powi(self.missed) * tolerance * defects.largest_local() / error;
        let next = next_mesh(&solution.mesh, &local, wanted, order, grading);
        Ok(Some(next))
    }

    /// The error for a solution whose next mesh is refused: what keeps it from the tolerance may be rounding.
    /// A mesh refused where rounding shows would be one against it: defects are sums of as many rounding
    /// errors as there are stages, and a mesh is made for less than the tolerance.
    fn out_of_reach(&mut self, error: Error, solution: &Solution) -> Error {
        if self.problem.estimates() && self.problem.collocation.mesh == solution.mesh {
            let rounding = self.problem.collocation.rounding(&solution.x);
            if rounding.is_nan() || rounding >= UNNOTICED * self.problem.options.tolerance {
                return self.problem.ill_conditioned(rounding, solution.clone());
            }
        }
        error
    }

    /// Whether Newton's method may do better on a finer mesh: not where a solution was found and refused.
    fn may_retry(&self, error: &Error) -> bool {
        error.is_of_newton() && !self.acceptance.refused
    }

    /// Whether it may do better from where a homotopy leads: also where what it found is nothing but
    /// rounding, or no mesh resolves it.
    fn may_follow(&self, error: &Error) -> bool {
        let elsewhere = matches!(
            error,
            Error::IllConditioned { .. } | Error::Unresolved { .. }
        );
        let may = error.is_of_newton() || elsewhere;
        may && self.problem.options.retries > 0 && !self.acceptance.refused
    }
}

/// Keeps the defects on one of so many meshes; returns those kept before, where layers have been found. A mesh may
/// be halved before the next one is judged.
fn last(kept: &mut Option<Seen>, meshes: usize, mesh: &Mesh, defects: &[Vec<f64>]) -> Option<Seen> {
    if meshes + 2 <= LAYERS_SHOWN {
        return None;
    }
    let before = kept.replace((mesh.clone(), defects.to_vec()));
    before.filter(|_| meshes > LAYERS_SHOWN)
}
