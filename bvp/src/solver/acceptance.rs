//! Whether a solution is good enough: what was found of it must hold at the solution itself.

use crate::accuracy::amplification::{is_amplified, is_high, is_open, is_steady, vanishes};
use crate::accuracy::further_places::FurtherPlaces;
use crate::accuracy::rounding::{UNIT_ROUNDOFF, exceeds};
use crate::discretisation::mesh::{Mesh, halved, intervals};
use crate::result::error::Error;
use crate::result::quality::Direction;
use crate::result::solution::Solution;
use crate::shares::{AIM, INVISIBLE, ONE_SAMPLE, TWO_DIGITS, UNNOTICED};
use crate::solver::discretised::{Discretised, OnMesh};

/// How often a mesh is halved because the solution on it does not seem to be isolated: where that is so by
/// a coarse mesh alone, a halved one shows it.
const DOUBTS: usize = 3;

/// Corrections that shrink to no more than this share are not rounding. What is left of one then is at most three
/// times as large as it; with 0.5, of 540 runs of y′ = y from seeds of 1e-11 to 1e-14 14 more were refused.
const SHRINKS: f64 = 0.75;

/// What a second look at a solution within the tolerance says.
pub(crate) enum Confirmed {
    Yes,
    /// Newton's method went on from it.
    Moved,
    /// It is to be sought again on this mesh.
    On(Mesh),
}

/// What has been asked of the solutions of one problem.
pub(crate) struct Acceptance {
    places: FurtherPlaces,
    /// Whether layers have been looked for that the mesh might not show.
    pub(crate) layers_sought: bool,
    /// Whether Newton's method has gone on from a solution on this mesh.
    pub(crate) moved: bool,
    /// Whether a solution was refused because it is not isolated.
    pub(crate) refused: bool,
    /// How often a solution was sought again on a halved mesh because its error may be what makes it seem not
    /// to be isolated.
    repeated: usize,
}

impl Acceptance {
    pub(crate) fn new() -> Self {
        Self {
            places: FurtherPlaces::new(),
            layers_sought: false,
            moved: false,
            refused: false,
            repeated: 0,
        }
    }

    /// Estimates the error of a solution by the last linearisation. One beyond the tolerance is refused where it may
    /// be nothing but rounding: no mesh changes that. The others are confirmed or refused by a second look. The first solution
    /// that is reached from a neighbour misses the tolerance by its mesh.
    pub(crate) fn estimate(
        &mut self,
        problem: &mut Discretised<'_>,
        solution: &mut Solution,
        is_first: bool,
    ) -> Result<(), Error> {
        let (samples, local) = (&problem.samples, &solution.quality.defects.local);
        let Discretised {
            newton,
            collocation,
            ..
        } = problem;
        solution.quality.errors = newton.global_errors(collocation, &solution.x, samples, local);
        let within = |error: f64| error <= problem.options.tolerance;
        let by_mesh = is_first && problem.options.from_neighbour;
        if solution.error_estimate().is_some_and(within)
            || by_mesh
            || !problem.collocation.is_suspect()
        {
            return Ok(());
        }
        let a = problem.amplification(&solution.x);
        self.refuse_rounding(problem, solution, a)
    }

    /// Takes a second look at a solution within the tolerance: what was found of it must hold at the
    /// solution itself, it must be isolated, and no layer may hide from the mesh. For one that is reached from a neighbour all of
    /// that is known but its own rounding.
    pub(crate) fn confirm(
        &mut self,
        problem: &mut Discretised<'_>,
        solution: &mut Solution,
    ) -> Result<Confirmed, Error> {
        // The amplification of random forcings is a lower bound, ten to a thousand times less than κ.
        let harmless = UNNOTICED * problem.options.tolerance;
        let is_known = problem.options.from_neighbour;
        let mut a = match is_known || problem.is_current(&solution.x) {
            true => problem.amplification(&solution.x),
            false => f64::INFINITY,
        };
        // A long step leaves its rounding, too; and a direction is looked at closely at the solution only.
        let moved = problem.newton.moved;
        if a * UNIT_ROUNDOFF * moved > harmless || !is_known && moved > 0.0 && is_amplified(a) {
            if self.goes_on(problem, solution)? {
                return Ok(Confirmed::Moved);
            }
            a = problem.amplification(&solution.x);
        }
        let largest = problem.collocation.largest_in_all(&solution.x);
        let in_all = a * largest;
        let grown = problem.growth(&solution.x);
        // The elimination rounds beside the largest change of a step what the states make of a small one, as the
        // 1e-12 from which y′ = y grows to 1e3. On every interval that is a forcing as those of the growth, which
        // are a tolerance in all.
        let count = intervals(&solution.mesh) as f64;
        let rounding = grown * largest * UNIT_ROUNDOFF * moved * count;
        if ONE_SAMPLE * rounding > harmless * problem.options.tolerance
            && self.settles(problem, solution)?
        {
            return Ok(Confirmed::Moved);
        }
        if is_high(in_all) || is_high(grown) || problem.collocation.is_suspect() {
            // Beside its largest value, which need not be where the solution rounds, an amplification that leaves no
            // two digits counts: with less than that flat belts were refused at 1e-12 whose error is smaller.
            let counted = if in_all * UNIT_ROUNDOFF > TWO_DIGITS {
                in_all
            } else {
                a
            };
            self.refuse_rounding(problem, solution, counted)?;
        }
        if is_open(a) && problem.rounds(solution) {
            let direction = problem.amplified(&solution.x);
            let (mesh, _) = self.doubt(problem, direction, a, solution)?;
            return Ok(Confirmed::On(mesh));
        }
        let direction = match !is_known && is_amplified(a) {
            true => problem.direction(&solution.x, a),
            false => None,
        };
        problem
            .refuse_free(solution)
            .inspect_err(|_| self.refused = true)?;
        if let Some(mesh) = self.look_further(problem, solution) {
            return Ok(Confirmed::On(mesh));
        }
        if is_known {
            return Ok(Confirmed::Yes);
        }
        let layers = match std::mem::replace(&mut self.layers_sought, true) {
            true => None,
            false => problem.collocation.with_possible_layers(),
        };
        let mut isolated = None;
        if let Some(direction) = direction {
            let (mesh, seen) = self.doubt(problem, direction, a, solution)?;
            if seen.is_none() {
                return Ok(Confirmed::On(mesh));
            }
            isolated = seen;
        }
        let tolerance = problem.options.tolerance;
        let unsure = is_high(a) || vanishes(&solution.x, tolerance);
        let struggled = problem.struggled(&solution.mesh);
        if (unsure || struggled || is_amplified(grown)) && problem.may_halve(&solution.mesh) {
            let finer = halved(&solution.mesh);
            let on_finer = match isolated {
                // What has been seen on the halved mesh is steady.
                Some(seen) => seen,
                None => {
                    let direction = problem.amplified(&solution.x);
                    let seen = problem.on_mesh(finer.clone(), solution);
                    let opens = is_amplified(seen.amplification);
                    if (unsure || struggled && opens) && !is_steady(a, seen.amplification) {
                        let (mesh, _) = self.doubt(problem, direction, a, solution)?;
                        return Ok(Confirmed::On(mesh));
                    }
                    seen
                }
            };
            if is_amplified(grown)
                && (on_finer.correction > tolerance
                    || !is_steady(grown, problem.growth(&on_finer.x)))
            {
                return Ok(Confirmed::On(finer));
            }
        }
        if let Some(mesh) = layers
            && !problem.is_kept(solution, &mesh)
        {
            return Ok(Confirmed::On(mesh));
        }
        Ok(Confirmed::Yes)
    }

    /// Linearises at a solution, and lets Newton's method go on from it where its correction is not small
    /// beside the tolerance, once on a mesh; returns whether it did. A smaller correction is in the estimate
    /// of the error.
    fn goes_on(
        &mut self,
        problem: &mut Discretised<'_>,
        solution: &mut Solution,
    ) -> Result<bool, Error> {
        let correction = problem.correction(&solution.x);
        let is_small = |&size: &f64| size <= AIM * problem.options.tolerance;
        if correction.as_ref().is_ok_and(is_small) {
            return Ok(false);
        }
        if std::mem::replace(&mut self.moved, true) {
            return match correction {
                Ok(_) => Ok(false),
                Err(failure) => Err(problem.failed(failure, solution.x.clone())),
            };
        }
        let mut x = solution.x.clone();
        *solution = match problem.iterate(&mut x) {
            Ok(()) => problem.assess(x)?,
            Err(failure) => return Err(problem.failed(failure, x)),
        };
        Ok(true)
    }

    /// Lets Newton's method go on from a solution until its corrections do not show beside the tolerance, or are
    /// rounding; returns whether it did.
    fn settles(
        &mut self,
        problem: &mut Discretised<'_>,
        solution: &mut Solution,
    ) -> Result<bool, Error> {
        let tolerance = problem.options.tolerance;
        let (mut x, mut before) = (solution.x.clone(), f64::INFINITY);
        loop {
            let size = match problem.correction(&x) {
                Ok(size) => size,
                Err(failure) => return Err(problem.failed(failure, x)),
            };
            let shrinks = size <= SHRINKS * before;
            if !shrinks && size > AIM * tolerance {
                self.refused = true;
                return Err(problem.ill_conditioned(size, solution.clone()));
            }
            if !shrinks || size <= INVISIBLE * tolerance {
                break;
            }
            if let Err(failure) = problem.iterate(&mut x) {
                return Err(problem.failed(failure, x));
            }
            before = size;
        }
        let moved = before < f64::INFINITY;
        if moved {
            *solution = problem.assess(x)?;
        }
        Ok(moved)
    }

    /// The mesh for what the right-hand side shows of a solution at further places.
    fn look_further(&mut self, problem: &mut Discretised<'_>, solution: &Solution) -> Option<Mesh> {
        let found = (&solution.x, &solution.quality.defects);
        self.places.look(
            problem.equations,
            &problem.collocation.tableau,
            &solution.mesh,
            found,
            problem.options.tolerance,
            &mut problem.stats,
        )
    }

    /// The halved mesh on which a solution with the amplification `on_own` proves isolated that does not so on
    /// its own, or on which it is to be sought again; an error if there is none. With what was seen on the mesh of
    /// halved intervals if it proves isolated there, is as much amplified as on its own, and is within the tolerance of the
    /// solution there: then it need not be sought again.
    fn doubt(
        &mut self,
        problem: &mut Discretised<'_>,
        direction: Direction,
        on_own: f64,
        solution: &Solution,
    ) -> Result<(Mesh, Option<OnMesh>), Error> {
        let mut mesh = solution.mesh.clone();
        if !is_high(on_own) && !problem.may_halve(&mesh) {
            // Nothing but the limit of intervals keeps it from a second look.
            return Ok((halved(&mesh), None));
        }
        let mut before = f64::INFINITY;
        for doubts in 0..DOUBTS {
            if !problem.may_halve(&mesh) {
                break;
            }
            mesh = halved(&mesh);
            let seen = problem.on_mesh(mesh.clone(), solution);
            let a = seen.amplification;
            if is_open(a) {
                break;
            }
            if !is_amplified(a) || is_steady(before, a) && problem.direction(&seen.x, a).is_none() {
                let stays = doubts == 0
                    && is_steady(on_own, a)
                    && seen.correction <= problem.options.tolerance;
                return Ok((mesh, stays.then_some(seen)));
            }
            // The amplification is that of the exact problem, as far as meshes tell. The right-hand side may
            // change within the error of the solution more than it does along the direction, as in a layer
            // thinner than that: a solution on the finer mesh has a smaller one.
            if is_steady(on_own, a) && self.repeated < DOUBTS {
                self.repeated += 1;
                return Ok((mesh, None));
            }
            before = a;
        }
        self.refused = true;
        Err(problem.undetermined(None, direction, solution.clone()))
    }

    /// Refuses a solution with the amplification a that may be nothing but rounding.
    fn refuse_rounding(
        &mut self,
        problem: &mut Discretised<'_>,
        solution: &Solution,
        a: f64,
    ) -> Result<(), Error> {
        let rounding = problem.collocation.rounding(&solution.x);
        if !exceeds(rounding, a, problem.options.tolerance) {
            return Ok(());
        }
        let rounding = rounding.max(a * UNIT_ROUNDOFF);
        let direction = problem.amplified(&solution.x);
        self.refused = true;
        Err(problem.undetermined(Some(rounding), direction, solution.clone()))
    }
}
