//! The way from a drive to its steady state: a start that always converges, then the friction law
//! that was asked for.
//!
//! ```text
//! frictionless guess ──▶ soft bristles ──▶ Coulomb, ℓ falling
//!                              │    └────▶ EPP without its share, blended in, zones, ε falling
//!                              └─────────▶ the bristles of the drive, κ rising
//! ```
//!
//! Bristle friction has no 0/0 and no kink, and Newton's method finds its solution from the
//! guess. Every arrow is one Newton solve where that converges; where it does not, the parameter
//! moves in steps that grow on success and shrink on failure. Solutions on the way are rough.
//!
//! Coulomb friction follows the slip over a length ℓ without a lead at first, which is what Newton's method
//! likes, and with a lead from there on, which needs few mesh intervals however short ℓ is.

use super::carried::Carried;
use super::path::{Effort, Path, Solved, Stuck};
use super::state::power_gained;
use super::zones::Cut;
use super::{DriveProblem, Scales};
use crate::FrictionLaw;
use std::f64::consts::LN_10;

/// Bristle stiffness of the start, κ R/μ: friction is fully developed after a thousandth of a
/// radius of sliding, so that its layers are no finer than those of seating.
pub(super) const START_STIFFNESS: f64 = 1000.0;
/// Lengths ℓ/R with which Coulomb friction is entered, the first that works.
const FIRST_LAGS: [f64; 2] = [1e-3, 1e-2];
/// Lengths ℓ/R at which a lead is tried, in this order. On the drive of Kim (2009) the first works from
/// 1.006 times the slack tension on.
const LED_LAGS: [f64; 3] = [1e-5, 1e-6, 1e-7];
/// Share of the power of friction that the belt may gain from a traction on the way that is not against its
/// slip. Where the traction turns the wrong way round it is 0.03 and more, elsewhere less than 1e-6.
const WRONG_WAY: f64 = 1e-4;
/// Normalisations ε of the slip direction with which EPP friction is entered, the first that
/// works: of the order of the largest slip.
pub(super) const FIRST_EPSILONS: [f64; 3] = [1e-3, 1e-2, 1e-1];
/// ℓ/R or ε at which the profile is first resolved to the tolerance.
pub(super) const RESOLVED: f64 = 1e-7;
/// ε below which slip velocities drown in the rounding of the speeds they are differences of; no effect of ℓ
/// was seen to need one as short.
pub(super) const SMALLEST: f64 = 1e-12;
/// The effect of ℓ may be this share of the tolerance.
const LAG_SHARE: f64 = 0.1;
/// The effect of ε may be this share of the tolerance.
pub(super) const EFFECT_SHARE: f64 = 0.3;
/// First steps of a homotopy in ln ℓ, ln ε or ln κ: a factor of 10, or of 3 where that failed.
pub(super) const GREAT_STEP: f64 = LN_10;
pub(super) const SMALL_STEP: f64 = 1.1;
/// Zones are found anew at most so often; if they still change, the check of the state says so.
const MAX_CUTS: usize = 8;

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
            if let FrictionLaw::Coulomb = self.drive.law {
                if self.has_direction
                    && let Ok(solved) = self.coulomb(&start, tight)
                    && power_gained(&solved) <= WRONG_WAY
                {
                    return Ok(solved);
                }
                return self.normalised(start, tight);
            }
            // EPP friction without its share is Coulomb friction and adds only the displacement.
            let unblended = self.enter_normalised(start, |path, epsilon| {
                let epp = path.problem(path.drive.law, epsilon, tight);
                epp.with_epp_weight(0.0)
            })?;
            return self
                .epp_by_zones(&unblended, tight)
                .or_else(|stuck| {
                    let other = self.epp_at_last(&unblended, tight);
                    self.farther(stuck, other)
                })
                .or_else(|stuck| {
                    let other = self.epp_as_a_whole(&unblended, tight);
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

    /// The steady state as by [`Path::at_load`], but with the shortest ℓ or smallest ε that was reached where its
    /// effect is not below the tolerance: good enough to follow a branch from it.
    pub(super) fn start(&mut self, tight: f64) -> Result<Solved, Stuck> {
        match self.at_load(tight) {
            Err(Stuck {
                last: Some(last), ..
            }) if last.is_resolved(self.drive.law, self.tolerance) => Ok(*last),
            outcome => outcome,
        }
    }

    /// The steady state of the drive from that of a neighbouring drive with a law of the same kind,
    /// at the same ℓ or ε and with the same zones.
    pub(super) fn neighbour(&mut self, solved: &Solved) -> Result<Solved, bvp::Error> {
        self.scales = Scales::with_force(self.drive, solved.problem.scales().units.force);
        let problem = DriveProblem::new(self.drive, self.scales, solved.problem.smoothing())
            .with_direction(solved.problem.has_direction())
            .with_zones(solved.problem.regimes());
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

    /// Coulomb friction whose direction is a state; where the belt gains power from it, only roughly.
    fn coulomb(&mut self, start: &Solved, tight: f64) -> Result<Solved, Stuck> {
        let following = self.enter_coulomb(start.clone(), tight)?;
        let sharp = self.sharpen(following)?;
        match power_gained(&sharp) <= WRONG_WAY {
            true => self.finish(sharp),
            false => Ok(sharp),
        }
    }

    /// Coulomb friction with a normalised direction, for loads so near to none (within 0.6 % on the drive of
    /// Kim 2009) that the slip of the turn changes its sense.
    fn normalised(&mut self, start: Solved, tight: f64) -> Result<Solved, Stuck> {
        let entered = self.enter_normalised(start, |path, epsilon| {
            let problem = path.problem(FrictionLaw::Coulomb, epsilon, tight);
            problem.with_direction(false)
        })?;
        let sharp = self.lower_epsilon(entered, RESOLVED)?;
        self.finish(sharp)
    }

    /// From bristles to Coulomb friction with a long ℓ, cut at the turns.
    fn enter_coulomb(&mut self, start: Solved, tight: f64) -> Result<Solved, Stuck> {
        let [first, others @ ..] = FIRST_LAGS;
        let cut = Cut::of(&start);
        let mut enter = |lag| {
            let problem = self.problem(FrictionLaw::Coulomb, lag, tight);
            self.attempt(cut.apply(problem.without_lead()), &cut, Effort::Rough)
        };
        let mut outcome = enter(first);
        for lag in others {
            outcome = outcome.or_else(|_| enter(lag));
        }
        outcome.map_err(|cause| Stuck::after(start.clone(), cause))
    }

    /// ℓ shortened, and the direction led as soon as that can be.
    fn sharpen(&mut self, following: Solved) -> Result<Solved, Stuck> {
        let mut following = following;
        for lag in LED_LAGS {
            following = self.smooth_less(following, lag, Effort::Rough)?;
            let led = following.problem.clone().with_lead();
            let Ok(led) = self.attempt(led, &Carried(&following), Effort::Rough) else {
                continue;
            };
            match self.smooth_less(led, RESOLVED, Effort::Rough) {
                Ok(sharp) if power_gained(&sharp) <= WRONG_WAY => return Ok(sharp),
                _ => {}
            }
        }
        Ok(following)
    }

    /// From bristles to friction with a normalised direction at the first large ε that works.
    fn enter_normalised(
        &mut self,
        start: Solved,
        problem: impl Fn(&Self, f64) -> DriveProblem,
    ) -> Result<Solved, Stuck> {
        let [first, others @ ..] = FIRST_EPSILONS;
        let mut outcome = self.attempt(problem(self, first), &Carried(&start), Effort::Rough);
        for epsilon in others {
            if outcome.is_err() {
                outcome = self.attempt(problem(self, epsilon), &Carried(&start), Effort::Rough);
            }
        }
        outcome.map_err(|cause| Stuck::after(start, cause))
    }

    /// EPP friction entered at a large ε, its zones made segments there.
    fn epp_by_zones(&mut self, unblended: &Solved, tight: f64) -> Result<Solved, Stuck> {
        let blended = self.blend(unblended.clone(), tight)?;
        let split = self.split_zones(blended, Effort::Rough)?;
        let sharp = self.lower_epsilon(split, RESOLVED)?;
        self.finish(sharp)
    }

    /// Coulomb friction sharpened first, then EPP friction and its zones.
    fn epp_at_last(&mut self, unblended: &Solved, tight: f64) -> Result<Solved, Stuck> {
        let sharp = self.lower_epsilon(unblended.clone(), RESOLVED)?;
        let blended = self.blend(sharp, tight)?;
        let split = self.split_zones(blended, Effort::Rough)?;
        self.finish(split)
    }

    /// EPP friction across its kinks, which costs mesh intervals but needs no zones.
    fn epp_as_a_whole(&mut self, unblended: &Solved, tight: f64) -> Result<Solved, Stuck> {
        let blended = self.blend(unblended.clone(), tight)?;
        let sharp = self.lower_epsilon(blended, RESOLVED)?;
        self.finish(sharp)
    }

    /// EPP friction at the same ε, by growing its share.
    fn blend(&mut self, unblended: Solved, tight: f64) -> Result<Solved, Stuck> {
        let epp = self.problem(self.drive.law, unblended.problem.smoothing(), tight);
        let member = |_: &DriveProblem, share| epp.clone().with_epp_weight(share);
        self.follow(unblended, [0.0, 1.0], 1.0, Effort::Rough, member)
    }

    /// A solution with its zones found anew, until every zone is of the kind it was taken for.
    fn split_zones(&mut self, solved: Solved, effort: Effort) -> Result<Solved, Stuck> {
        let mut here = solved;
        for _ in 0..MAX_CUTS {
            let cut = Cut::of(&here);
            if cut.is_kept() {
                break;
            }
            let problem = cut.apply(here.problem.clone());
            here = match self.attempt(problem, &cut, effort) {
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

    /// Solves to the tolerance, and smooths less until the effect of that is below that.
    pub(super) fn finish(&mut self, rough: Solved) -> Result<Solved, Stuck> {
        if let FrictionLaw::Bristle { .. } = self.drive.law {
            return self.again(rough, Effort::Final);
        }
        let solved = self.again(rough, Effort::Full)?;
        let here = self.keep_zones(solved, Effort::Final)?;
        let mut here = self.slip_at_exits(here);
        let share = match here.problem.has_direction() {
            true => LAG_SHARE,
            false => EFFECT_SHARE,
        };
        loop {
            let smoothing = here.problem.smoothing();
            let finer = self.smooth_less(here.clone(), 0.1 * smoothing, Effort::Full)?;
            let constants = here.constants().into_iter().zip(finer.constants());
            let change = constants
                .map(|(a, b)| (a - b).abs() / (1.0 + b.abs()))
                .fold(0.0, f64::max);
            // The effect vanishes at least as fast as ℓ or ε: ten ninths of the change were that of
            // the larger, one ninth is that of the smaller.
            self.smoothing_effect = change / 0.9;
            if self.smoothing_effect <= share * self.tolerance {
                return self.with_estimate(here);
            }
            self.smoothing_effect = change / 9.0;
            if self.smoothing_effect <= share * self.tolerance || smoothing <= SMALLEST {
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
        let cut = Cut::with_exits(&here);
        if cut.is_kept() {
            return here;
        }
        let problem = cut.apply(here.problem.clone());
        match self.attempt(problem, &cut, Effort::Final) {
            Ok(slipping) if Cut::of(&slipping).is_kept() => slipping,
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
        let range = [start.problem.smoothing().ln(), epsilon.ln()];
        let fallback = start.clone();
        self.smooth_less(start, epsilon, Effort::Rough)
            .or_else(|_| self.follow(fallback, range, SMALL_STEP, Effort::Careful, with_smoothing))
    }

    /// Shortens ℓ or lowers ε; bristles stay as they are.
    pub(super) fn smooth_less(
        &mut self,
        start: Solved,
        smoothing: f64,
        effort: Effort,
    ) -> Result<Solved, Stuck> {
        let from = start.problem.smoothing();
        if from == 0.0 || from == smoothing {
            return Ok(start);
        }
        let range = [from.ln(), smoothing.ln()];
        self.follow(start, range, GREAT_STEP, effort, with_smoothing)
    }
}

/// The same problem with ℓ/R or ε of eᵗ.
fn with_smoothing(problem: &DriveProblem, t: f64) -> DriveProblem {
    problem.clone().with_smoothing(t.exp())
}
