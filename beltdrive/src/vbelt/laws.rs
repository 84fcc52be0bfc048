//! The way from a drive to its steady state: a start that always converges, then the friction law
//! that was asked for.
//!
//! ```text
//! frictionless guess ──▶ soft bristles ──▶ Coulomb, ε falling
//!                              │              └──▶ EPP blended in, zones, ε falling
//!                              └─────────▶ the bristles of the drive, κ rising
//! ```
//!
//! Bristle friction has no 0/0 and no kink, and Newton's method finds its solution from the
//! guess. Every arrow is one Newton solve where that converges; where it does not, the parameter
//! moves in steps that grow on success and shrink on failure. Solutions on the way are rough.

use super::carried::Carried;
use super::path::{Effort, Path, Solved, Stuck};
use super::zones::Split;
use super::{DRIVEN, DRIVER, DriveProblem, Scales};
use crate::FrictionLaw;
use std::f64::consts::LN_10;

/// Bristle stiffness of the start, κ R/μ: friction is fully developed after a thousandth of a
/// radius of sliding, so that its layers are no finer than those of seating.
pub(super) const START_STIFFNESS: f64 = 1000.0;
/// Normalisations ε of the slip direction with which Coulomb friction is entered, the first that
/// works: of the order of the largest slip.
pub(super) const FIRST_EPSILONS: [f64; 3] = [1e-3, 1e-2, 1e-1];
/// ε at which the profile is first resolved to the tolerance.
pub(super) const RESOLVED_EPSILON: f64 = 1e-7;
/// ε below which slip velocities drown in the rounding of the speeds they are differences of.
pub(super) const SMALLEST_EPSILON: f64 = 1e-12;
/// The effect of ε may be this share of the tolerance.
pub(super) const EPSILON_SHARE: f64 = 0.3;
/// First steps of a homotopy in ln ε or ln κ: a factor of 10, or of 3 where that failed.
pub(super) const GREAT_STEP: f64 = LN_10;
pub(super) const SMALL_STEP: f64 = 1.1;
/// Zones are found anew at most so often; if they still change, the check of the state says so.
const MAX_SPLITS: usize = 8;

impl Path<'_> {
    /// The steady state with the law of the drive at the scaled tight tension `tight`, from
    /// nothing.
    pub(super) fn at_load(&mut self, tight: f64) -> Result<Solved, Stuck> {
        let radius = self.drive.driver_radius.min(self.drive.driven_radius);
        let soft = START_STIFFNESS * self.drive.friction_coefficient / radius;
        let bristles =
            |path: &Self, stiffness| path.problem(FrictionLaw::Bristle { stiffness }, 0.0, tight);
        let FrictionLaw::Bristle { stiffness } = self.drive.law else {
            let start = self.cold(bristles(self, soft), Effort::Start)?;
            let coulomb = self.enter_coulomb(start, tight)?;
            if let FrictionLaw::Coulomb = self.drive.law {
                let sharp = self.lower_epsilon(coulomb, RESOLVED_EPSILON)?;
                return self.finish(sharp);
            }
            return self
                .epp_by_zones(&coulomb, tight)
                .or_else(|stuck| {
                    let other = self.epp_at_last(&coulomb, tight);
                    self.farther(stuck, other)
                })
                .or_else(|stuck| {
                    let other = self.epp_as_a_whole(&coulomb, tight);
                    self.farther(stuck, other)
                });
        };
        if let Ok(solved) = self.cold(bristles(self, stiffness), Effort::Final) {
            return Ok(solved);
        }
        let start = self.cold(bristles(self, soft), Effort::Start)?;
        let range = [soft.ln(), stiffness.ln()];
        let member = |problem: &DriveProblem, t: f64| problem.clone().with_bristles(t.exp());
        let stiffer = self.follow(start, range, GREAT_STEP, Effort::Rough, member)?;
        self.finish(stiffer)
    }

    /// The steady state as by [`Path::at_load`], but at the smallest ε that was reached where its effect is
    /// not below the tolerance: good enough to follow a branch from it.
    pub(super) fn start(&mut self, tight: f64) -> Result<Solved, Stuck> {
        match self.at_load(tight) {
            Err(Stuck {
                last: Some(last), ..
            }) if last.is_resolved(self.drive.law, self.tolerance) => Ok(*last),
            outcome => outcome,
        }
    }

    /// The steady state of the drive from that of a neighbouring drive with a law of the same kind,
    /// at the same ε and with the same zones.
    pub(super) fn neighbour(&mut self, solved: &Solved) -> Result<Solved, bvp::Error> {
        self.scales = Scales::with_force(self.drive, solved.problem.scales().units.force);
        let [driven, driver] = [DRIVEN, DRIVER].map(|pulley| solved.problem.regimes(pulley));
        let problem = DriveProblem::new(self.drive, self.scales, solved.problem.epsilon())
            .with_zones(driven, driver);
        self.attempt(problem, &Carried(solved), Effort::Final)
    }

    /// The outcome of another way, or the way that came farther: to a state that only lacks a smaller ε.
    fn farther(&self, stuck: Stuck, other: Result<Solved, Stuck>) -> Result<Solved, Stuck> {
        let resolved = |stuck: &Stuck| {
            let last = stuck.last.as_ref();
            last.is_some_and(|last| last.is_resolved(self.drive.law, self.tolerance))
        };
        match other {
            Err(other) if resolved(&stuck) && !resolved(&other) => Err(stuck),
            outcome => outcome,
        }
    }

    /// From bristles to Coulomb friction with a large ε.
    fn enter_coulomb(&mut self, start: Solved, tight: f64) -> Result<Solved, Stuck> {
        let [first, others @ ..] = FIRST_EPSILONS;
        let coulomb = |path: &Self, epsilon| path.problem(FrictionLaw::Coulomb, epsilon, tight);
        let mut outcome = self.attempt(coulomb(self, first), &Carried(&start), Effort::Rough);
        for epsilon in others {
            if outcome.is_err() {
                outcome = self.attempt(coulomb(self, epsilon), &Carried(&start), Effort::Rough);
            }
        }
        outcome.map_err(|cause| Stuck::after(start, cause))
    }

    /// EPP friction entered at a large ε, its zones made segments there.
    fn epp_by_zones(&mut self, coulomb: &Solved, tight: f64) -> Result<Solved, Stuck> {
        let blended = self.enter_epp(coulomb.clone(), tight)?;
        let split = self.split_zones(blended, Effort::Rough)?;
        let sharp = self.lower_epsilon(split, RESOLVED_EPSILON)?;
        self.finish(sharp)
    }

    /// Coulomb friction sharpened first, then EPP friction and its zones.
    fn epp_at_last(&mut self, coulomb: &Solved, tight: f64) -> Result<Solved, Stuck> {
        let sharp = self.lower_epsilon(coulomb.clone(), RESOLVED_EPSILON)?;
        let blended = self.enter_epp(sharp, tight)?;
        let split = self.split_zones(blended, Effort::Rough)?;
        self.finish(split)
    }

    /// EPP friction across its kinks, which costs mesh intervals but needs no zones.
    fn epp_as_a_whole(&mut self, coulomb: &Solved, tight: f64) -> Result<Solved, Stuck> {
        let blended = self.enter_epp(coulomb.clone(), tight)?;
        let sharp = self.lower_epsilon(blended, RESOLVED_EPSILON)?;
        self.finish(sharp)
    }

    /// From Coulomb to EPP friction at the same ε, by growing its share.
    fn enter_epp(&mut self, start: Solved, tight: f64) -> Result<Solved, Stuck> {
        let epp = self.problem(self.drive.law, start.problem.epsilon(), tight);
        // With no share of it the law only adds the displacement.
        let unblended = self
            .attempt(
                epp.clone().with_epp_weight(0.0),
                &Carried(&start),
                Effort::Rough,
            )
            .map_err(|cause| Stuck::after(start, cause))?;
        let member = |_: &DriveProblem, share| epp.clone().with_epp_weight(share);
        self.follow(unblended, [0.0, 1.0], 1.0, Effort::Rough, member)
    }

    /// Solves EPP friction with its zones as segments, until every zone is of the kind it was
    /// taken for.
    fn split_zones(&mut self, solved: Solved, effort: Effort) -> Result<Solved, Stuck> {
        let mut here = solved;
        for _ in 0..MAX_SPLITS {
            let Some(split) = Split::of(&here) else {
                break;
            };
            let outcome = self.attempt(split.problem(&here), &split.guess(&here), effort);
            here = match outcome {
                Ok(solved) => solved,
                Err(cause) => return Err(Stuck::after(here, cause)),
            };
        }
        Ok(here)
    }

    /// A solution with its zones found anew where they are segments.
    pub(super) fn keep_zones(&mut self, solved: Solved, effort: Effort) -> Result<Solved, Stuck> {
        if solved.problem.is_split() {
            self.split_zones(solved, effort)
        } else {
            Ok(solved)
        }
    }

    /// Solves to the tolerance, and lowers ε until its effect is below that.
    pub(super) fn finish(&mut self, rough: Solved) -> Result<Solved, Stuck> {
        if let FrictionLaw::Bristle { .. } = self.drive.law {
            return self.again(rough, Effort::Final);
        }
        let solved = self.again(rough, Effort::Final)?;
        let here = self.keep_zones(solved, Effort::Final)?;
        let mut here = self.slip_at_exits(here);
        loop {
            let epsilon = here.problem.epsilon();
            let range = [epsilon.ln(), (0.1 * epsilon).ln()];
            let finer = self.follow(here.clone(), range, GREAT_STEP, Effort::Full, with_epsilon)?;
            let constants = here.constants().into_iter().zip(finer.constants());
            let change = constants
                .map(|(a, b)| (a - b).abs() / (1.0 + b.abs()))
                .fold(0.0, f64::max);
            // The effect vanishes at least as fast as ε: ten ninths of the change were that of
            // the larger ε, one ninth is that of the smaller.
            self.epsilon_effect = change / 0.9;
            if self.epsilon_effect <= EPSILON_SHARE * self.tolerance {
                return self.with_estimate(here);
            }
            self.epsilon_effect = change / 9.0;
            if self.epsilon_effect <= EPSILON_SHARE * self.tolerance || epsilon <= SMALLEST_EPSILON
            {
                return self.with_estimate(finer);
            }
            here = finer;
        }
    }

    /// The solution with a slip zone at the exits that elastic friction reached, if there is one. Without it
    /// the normal force is negative at the exit, which the checks refuse.
    fn slip_at_exits(&mut self, here: Solved) -> Solved {
        if !here.problem.is_split() {
            return here;
        }
        let Some(split) = Split::with_exits(&here) else {
            return here;
        };
        let problem = split.problem(&here);
        let outcome = self.attempt(problem, &split.guess(&here), Effort::Final);
        match outcome {
            Ok(slipping) if Split::of(&slipping).is_none() => slipping,
            _ => here,
        }
    }

    /// A solution with an estimate of its global error.
    fn with_estimate(&mut self, solved: Solved) -> Result<Solved, Stuck> {
        match solved.solution.error_estimate() {
            Some(_) => Ok(solved),
            None => self.again(solved, Effort::Final),
        }
    }

    /// Lowers ε roughly in great steps, or carefully in small ones where the slip is too small for
    /// that.
    fn lower_epsilon(&mut self, start: Solved, epsilon: f64) -> Result<Solved, Stuck> {
        let from = start.problem.epsilon().ln();
        let fallback = start.clone();
        let range = [from, epsilon.ln()];
        self.follow(start, range, GREAT_STEP, Effort::Rough, with_epsilon)
            .or_else(|_| self.follow(fallback, range, SMALL_STEP, Effort::Careful, with_epsilon))
    }
}

/// The same problem with the slip normalised by ε = eᵗ.
pub(super) fn with_epsilon(problem: &DriveProblem, t: f64) -> DriveProblem {
    problem.clone().with_epsilon(t.exp())
}
