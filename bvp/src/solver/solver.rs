//! The driver: Newton on a mesh, the error of the solution, a better mesh, until everything holds.

use crate::accuracy::defect::defects;
use crate::accuracy::further_places::FurtherPlaces;
use crate::accuracy::isolation::{is_amplified, is_high, is_open, is_steady};
use crate::accuracy::mesh_selection::{
    GRADING, GRADING_BY_ERROR, UNRESOLVED, amplify_rough, next_mesh,
};
use crate::accuracy::rounding::{NO_DIGIT, UNIT_ROUNDOFF, exceeds};
use crate::discretisation::iterate::{Iterate, NonFinite};
use crate::discretisation::mesh::{Mesh, halved, intervals, thinned};
use crate::discretisation::tableau::Tableau;
use crate::kernels::dense::max_or_nan;
use crate::newton::collocation::Collocation;
use crate::newton::newton::{Failure, Newton};
use crate::problem::equations::Equations;
use crate::problem::guess::Guess;
use crate::problem::held::Held;
use crate::result::error::Error;
use crate::result::quality::{Direction, Quality, Samples};
use crate::result::restored::restore;
use crate::result::solution::Solution;
use crate::result::stats::Stats;
use crate::solver::failure::{check_mesh, ill_conditioned, numerical};
use crate::solver::homotopy::rough_solution;
use crate::solver::options::{Control, Options};
use crate::solver::statement::{check_guess, check_statement, first_mesh, in_units};
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
/// An amplified unit roundoff that is this share of the tolerance or less needs no closer look: the
/// amplification of random forcings is a lower bound, ten to a thousand times less than κ.
const HARMLESS: f64 = 0.1;
/// An interval whose local defect is at most this share of the tolerance need not resolve the solution, as
/// next to a jump of the right-hand side.
const HARMLESS_DEFECT: f64 = 0.1;
/// By as many meshes layers are found; what is not resolved on one more is rough.
const LAYERS_SHOWN: usize = 6;
/// Where rounding makes up this share of the tolerance, a mesh that is refused would be one against it:
/// defects are sums of as many rounding errors as there are stages, and what a mesh is made for is 0.3
/// tolerances.
const ROUNDING_SHARE: f64 = 0.1;
/// Measured rounding of less than this share of the tolerance is that of a matrix whose amplification is
/// one of slopes in thin layers alone.
const SHOWN_ROUNDING: f64 = 1e-3;
/// How often a mesh is halved because the solution on it does not seem to be isolated: where that is so by
/// a coarse mesh alone, a halved one shows it.
const DOUBTS: usize = 3;

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
        places: FurtherPlaces::new(),
        moved: false,
        refused: false,
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

/// What a second look at a solution within the tolerance says.
enum Confirmed {
    Yes,
    /// Newton's method went on from it.
    Moved,
    /// It is to be sought again on this mesh.
    On(Mesh),
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
    places: FurtherPlaces,
    /// The mesh of the last solution that was not resolved, and its relative defects.
    unresolved: Option<(Mesh, Vec<Vec<f64>>)>,
    /// The mesh of the last solution that missed the tolerance, and its local defects.
    before: Option<(Mesh, Vec<Vec<f64>>)>,
    /// Whether Newton's method has gone on from a solution on this mesh.
    moved: bool,
    /// Whether a solution was refused because it is not isolated.
    refused: bool,
}

impl Run<'_> {
    /// Solves from the guess on a first mesh, and on finer ones where Newton's method fails.
    fn solve(mut self, guess: &dyn Guess, mut first: Mesh) -> Result<Solution, Error> {
        for _ in 0..self.options.retries {
            match self.adapt(first.clone(), Start::Guess(guess)) {
                Err(error) if self.may_retry(&error) && self.may_halve(&first) => {
                    first = halved(&first);
                }
                outcome => return outcome,
            }
        }
        match self.adapt(first, Start::Guess(guess)) {
            Err(mut error) if self.may_retry(&error) && self.options.retries > 0 => {
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
            if let Err(error) = check_mesh(&mesh, self.stats.meshes, self.options, &solution) {
                return Err(self.out_of_reach(error, &solution));
            }
            let start = Start::Solution(&solution);
            solution = match self.on(mesh, start) {
                // Where an iterate is far off, its rounding means little.
                Err(error)
                    if (self.may_retry(&error)
                        || matches!(error, Error::IllConditioned { .. }))
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
        self.moved = false;
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
        let estimating = self.estimates();
        let relative = self.relevant_defects(solution);
        let defect = relative.iter().flatten().copied().fold(0.0, max_or_nan);
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
            let (mut defects, m) = (relative.clone(), self.stages());
            let before = self.unresolved.replace((solution.mesh.clone(), relative));
            if let Some(before) = before.filter(|_| self.stats.meshes > LAYERS_SHOWN) {
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
        self.estimate(solution)?;
        if solution
            .error_estimate()
            .is_some_and(|error| error <= tolerance)
        {
            match self.confirm(solution)? {
                Confirmed::Yes => return Ok(None),
                Confirmed::Moved => return self.judge(solution),
                Confirmed::On(mesh) => return Ok(Some(mesh)),
            }
        }
        let error = solution.error_estimate().unwrap_or(f64::INFINITY);
        if error.is_infinite() {
            return Ok(Some(halved(&solution.mesh)));
        }
        let order = self.collocation.tableau.scheme.dense_order();
        let defects = &solution.quality.defects;
        let mut local = defects.local.clone();
        let before = self.before.replace((solution.mesh.clone(), local.clone()));
        let rough = before
            .filter(|_| self.stats.meshes > LAYERS_SHOWN)
            .is_some_and(|before| amplify_rough(&mut local, &solution.mesh, &before, order, 2));
        self.missed = if rough { 1 } else { self.missed + 1 };
        let wanted = AIM.powi(self.missed) * tolerance * defects.largest_local() / error;
        let next = next_mesh(&solution.mesh, &local, wanted, order, grading);
        Ok(Some(next))
    }

    /// The relative defects of a solution; where the error is controlled without those of intervals so short
    /// that their local defects are harmless.
    fn relevant_defects(&self, solution: &Solution) -> Vec<Vec<f64>> {
        let mut relative = solution.quality.defects.relative.clone();
        if self.options.control == Control::Error {
            let harmless = HARMLESS_DEFECT * self.options.tolerance;
            let local = solution.quality.defects.local.iter().flatten();
            for (relative, local) in relative.iter_mut().flatten().zip(local) {
                if *local <= harmless {
                    *relative = relative.min(RESOLVED * UNRESOLVED);
                }
            }
        }
        relative
    }

    /// Estimates the error of a solution by the last linearisation.
    fn estimate(&mut self, solution: &mut Solution) -> Result<(), Error> {
        let (samples, local) = (&self.samples, &solution.quality.defects.local);
        let Self {
            newton,
            collocation,
            ..
        } = self;
        solution.quality.errors = newton.global_errors(collocation, &solution.x, samples, local);
        match self.collocation.is_suspect() {
            true => {
                let a = self.amplification(&solution.x);
                self.refuse_rounding(solution, a)
            }
            false => Ok(()),
        }
    }

    /// Linearises at a solution, and lets Newton's method go on from it where its correction is not small
    /// beside the tolerance, once on a mesh; returns whether it did. A smaller correction is in the estimate of
    /// the error.
    fn goes_on(&mut self, solution: &mut Solution) -> Result<bool, Error> {
        let correction = self.correction(&solution.x);
        let is_small = |&size: &f64| size <= AIM * self.options.tolerance;
        if correction.as_ref().is_ok_and(is_small) {
            return Ok(false);
        }
        if std::mem::replace(&mut self.moved, true) {
            return match correction {
                Ok(_) => Ok(false),
                Err(failure) => Err(self.failed(failure, solution.x.clone())),
            };
        }
        let mut x = solution.x.clone();
        *solution = match self.iterate(&mut x) {
            Ok(()) => self.assess(x)?,
            Err(failure) => return Err(self.failed(failure, x)),
        };
        Ok(true)
    }

    /// Takes a second look at a solution within the tolerance: what was found of it must hold at the
    /// solution itself, it must be isolated, and no layer may hide from the mesh.
    fn confirm(&mut self, solution: &mut Solution) -> Result<Confirmed, Error> {
        let harmless = HARMLESS * self.options.tolerance;
        let mut a = match self.newton.is_current() {
            true => self.amplification(&solution.x),
            false => f64::INFINITY,
        };
        // A long step leaves its rounding, too.
        if a * UNIT_ROUNDOFF * self.newton.moved > harmless {
            if self.goes_on(solution)? {
                return Ok(Confirmed::Moved);
            }
            a = self.amplification(&solution.x);
        }
        if a * UNIT_ROUNDOFF > harmless || self.collocation.is_suspect() {
            self.refuse_rounding(solution, a)?;
        }
        if is_open(a) && self.rounds(solution) {
            let direction = self.amplified(&solution.x);
            return self.doubt(direction, solution).map(Confirmed::On);
        }
        if is_amplified(a, self.options.tolerance)
            && let Some(direction) = self.direction(&solution.x, &solution.quality.defects.local, a)
        {
            return self.doubt(direction, solution).map(Confirmed::On);
        }
        if let Some(mesh) = self.look_further(solution) {
            return Ok(Confirmed::On(mesh));
        }
        let layers = match std::mem::replace(&mut self.probed, true) {
            true => None,
            false => self.collocation.with_possible_layers(),
        };
        if is_high(a) && self.may_halve(&solution.mesh) {
            let direction = self.amplified(&solution.x);
            let (_, _, on_halved) = self.amplification_on(halved(&solution.mesh), solution);
            if !is_steady(a, on_halved) {
                return self.doubt(direction, solution).map(Confirmed::On);
            }
        }
        if let Some(mesh) = layers
            && !self.is_kept(solution, &mesh)
        {
            return Ok(Confirmed::On(mesh));
        }
        Ok(Confirmed::Yes)
    }

    /// The error for a solution whose next mesh is refused: what keeps it from the tolerance may be rounding.
    fn out_of_reach(&mut self, error: Error, solution: &Solution) -> Error {
        if self.estimates() && self.collocation.mesh == solution.mesh {
            let rounding = self.collocation.rounding(&solution.x);
            if rounding.is_nan() || rounding >= ROUNDING_SHARE * self.options.tolerance {
                let mut best = solution.clone();
                best.stats = self.cost();
                return ill_conditioned(rounding, self.options.tolerance, best);
            }
        }
        error
    }

    /// The halved mesh on which a solution proves isolated that does not so on its own; an error if there is
    /// none.
    fn doubt(&mut self, direction: Direction, solution: &Solution) -> Result<Mesh, Error> {
        let mut mesh = solution.mesh.clone();
        let mut before = f64::INFINITY;
        for _ in 0..DOUBTS {
            if !self.may_halve(&mesh) {
                break;
            }
            mesh = halved(&mesh);
            let (x, local, a) = self.amplification_on(mesh.clone(), solution);
            if is_open(a) {
                break;
            }
            if !is_amplified(a, self.options.tolerance)
                || is_steady(before, a) && self.direction(&x, &local, a).is_none()
            {
                return Ok(mesh);
            }
            before = a;
        }
        self.refused = true;
        Err(self.undetermined(None, direction, solution.clone()))
    }

    /// A solution on another mesh, its local defects and the amplification of forcings there, infinite where
    /// nothing can be told of it; leaves the linearisation there.
    fn amplification_on(
        &mut self,
        mesh: Mesh,
        solution: &Solution,
    ) -> (Iterate, Vec<Vec<f64>>, f64) {
        self.set_mesh(mesh);
        let Self {
            newton,
            collocation,
            samples,
            stats,
            ..
        } = self;
        let (t, mesh) = (&collocation.tableau, &collocation.mesh);
        let x = transfer(mesh, t, solution);
        let local = match defects(self.equations, t, mesh, &x, samples, stats) {
            Ok(defects) => defects.local,
            Err(_) => return (x, vec![], f64::INFINITY),
        };
        let a = match newton.correction(collocation, &x, stats) {
            Ok(_) => newton.amplification(collocation, &x, self.options.tolerance),
            Err(_) => f64::INFINITY,
        };
        (x, local, a)
    }

    /// The mesh for what the right-hand side shows of a solution at further places.
    fn look_further(&mut self, solution: &Solution) -> Option<Mesh> {
        let found = (&solution.x, &solution.quality.defects);
        self.places.look(
            self.equations,
            &self.collocation.tableau,
            &solution.mesh,
            found,
            self.options.tolerance,
            &mut self.stats,
        )
    }

    /// The size of Newton's correction at a solution.
    fn correction(&mut self, x: &Iterate) -> Result<f64, Failure> {
        let Self {
            newton,
            collocation,
            stats,
            ..
        } = self;
        newton.correction(collocation, x, stats)
    }

    /// Whether rounding shows in a solution, or cannot since it vanishes.
    fn rounds(&mut self, solution: &Solution) -> bool {
        let rounding = self.collocation.rounding(&solution.x);
        rounding == 0.0 || rounding.is_nan() || rounding >= SHOWN_ROUNDING * self.options.tolerance
    }

    /// The amplification of forcings by the last linearisation.
    fn amplification(&mut self, x: &Iterate) -> f64 {
        let tolerance = self.options.tolerance;
        self.newton
            .amplification(&mut self.collocation, x, tolerance)
    }

    /// The direction of the last amplification.
    fn amplified(&self, x: &Iterate) -> Direction {
        self.newton
            .amplified(&self.collocation, x, self.options.tolerance)
    }

    /// The direction in which a solution with these local defects is not isolated, if so, after its
    /// amplification a.
    fn direction(&mut self, x: &Iterate, local: &[Vec<f64>], a: f64) -> Option<Direction> {
        let Self {
            newton,
            collocation,
            samples,
            stats,
            ..
        } = self;
        newton.global_errors(collocation, x, samples, local);
        newton.direction(collocation, x, samples, a, self.options.tolerance, stats)
    }

    /// Refuses a solution with the amplification a that may be nothing but rounding.
    fn refuse_rounding(&mut self, solution: &Solution, a: f64) -> Result<(), Error> {
        let rounding = self.collocation.rounding(&solution.x);
        if !exceeds(rounding, a, self.options.tolerance) {
            return Ok(());
        }
        let rounding = rounding.max(a * UNIT_ROUNDOFF);
        let direction = self.amplified(&solution.x);
        self.refused = true;
        Err(self.undetermined(Some(rounding), direction, solution.clone()))
    }

    /// The error for a solution that is one of a family, where no rounding is known, or nothing but rounding.
    fn undetermined(
        &self,
        rounding: Option<f64>,
        direction: Direction,
        mut best: Solution,
    ) -> Error {
        best.stats = self.cost();
        let Direction { felt, shift, free } = direction;
        if felt && (shift || rounding.is_none()) {
            return Error::SingularConditions {
                conditions: vec![],
                free,
                shift,
                best: Box::new(best),
            };
        }
        let rounding = rounding.unwrap_or(f64::INFINITY);
        ill_conditioned(rounding, self.options.tolerance, best)
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

    /// Whether another attempt may do better: not where a solution was found and refused.
    fn may_retry(&self, error: &Error) -> bool {
        error.is_of_newton() && !self.refused
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
            Failure::NoConvergence { correction, .. } if correction <= NO_DIGIT => {
                Some(self.collocation.rounding(&x)).filter(|&rounding| rounding >= correction)
            }
            _ => None,
        };
        if matches!(failure, Failure::NoConvergence { .. }) && is_open(self.amplification(&x)) {
            let direction = self.amplified(&x);
            let best = self.solution(x, Quality::unknown(&self.collocation.mesh));
            return self.undetermined(Some(f64::INFINITY), direction, best);
        }
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
        let units = self.collocation.condition_units();
        let scales = scales.iter().zip(units).map(|(s, unit)| s.max(unit));
        let allowed = scales.map(|s| self.options.tolerance * s);
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
            absolute: vec![],
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
