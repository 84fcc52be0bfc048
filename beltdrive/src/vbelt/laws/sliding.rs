//! Coulomb friction whose direction is a state.
//!
//! The direction follows the slip over a length ℓ with a lead, which needs few mesh intervals however short ℓ is. Where that is not
//! found at once it follows without a lead at first, which is what Newton's method likes.

use super::Asked;
use super::astray::Astray;
use super::obeyed::{Gains, obeys_friction, power_gained};
use crate::FrictionLaw;
use crate::vbelt::carried::Carried;
use crate::vbelt::path::{Effort, Path, Solved};
use crate::vbelt::zones::Cut;
use crate::vbelt::{BeltProblem, Law};

/// Lengths ℓ with which Coulomb friction is entered with a lead, as multiples of the length over which bristles develop friction, the
/// first that works. With 1 alone the states of 94 random drives take 34 factorisations (median) in place of 30, those of the drive
/// of Kim (2009) 45 to 55 Newton steps from 400 to 700 N in place of 36 to 45; a first one of 0.001 takes up to 282 below 150 N.
/// Below 120 N the second one works where the first does not: without it seven of these states take up to 114 steps in place of 86.
const FIRST_LED_LAGS: [f64; 2] = [0.02, 0.2];
/// The same without a lead: 1e-3 and 1e-2 of the smallest radius for the softest bristles. A belt that locks with stiff bristles only
/// slips with these.
const FIRST_LAGS: [f64; 2] = [1.0, 10.0];
/// Lengths ℓ/R at which a lead is tried behind a way without one, in this order. On the drive of Kim (2009) the first works from
/// 1.006 times the slack tension on.
const LED_LAGS: [f64; 3] = [1e-5, 1e-6, 1e-7];
/// ℓ/R at which the profile is first resolved to the tolerance: with 1e-7 the effect on the drive of Kim (2009) is 2e-7 to
/// 6e-7 from 105 to 5000 N, more than a tenth of the usual tolerance.
pub(super) const RESOLVED_LAG: f64 = 1e-8;
/// The same where the belt sticks somewhere: on that drive with elastic friction of 1.2e6 N/m² a rough solution with 1e-8
/// takes up to 100 Newton steps more, from one with 1e-7 that is resolved it does not.
pub(super) const RESOLVED_LAG_WITH_STICK: f64 = 1e-7;
/// Share of the power of friction that the belt may gain from a traction on the way that is not against its
/// slip. Where the traction turns the wrong way round it is 0.03 and more, elsewhere less than 1e-6.
pub(in crate::vbelt) const WRONG_WAY: f64 = 1e-4;
/// If the belt gains more than this share of that without a lead, it does not do so because of the lead, and a shorter ℓ
/// leads to the same state: on a loop of three pulleys three such ways took 150 to 170 Newton steps each, and the gain
/// stayed the same to 1 % along each of them.
pub(super) const SAME_WAY: f64 = 0.5;

impl Path<'_> {
    /// Coulomb friction by way of bristles, if it is found so and friction obeys its law.
    pub(super) fn coulomb<A: Asked>(
        &mut self,
        asked: &A,
        bristles: &Solved<A::Problem>,
    ) -> Option<Solved<A::Problem>> {
        let cut = Cut::of(bristles);
        let developed = developed_after(&bristles.problem);
        let entry = |lag, is_led| cut.apply(asked.problem(FrictionLaw::Coulomb, lag).led(is_led));
        for times in FIRST_LED_LAGS {
            if let Ok(led) = self.attempt(entry(times * developed, true), &cut, Effort::Rough)
                && let Ok((sharp, gains)) = self.shorten_led(led)
                && gains.share() <= WRONG_WAY
                && let Ok(found) = self.finish_obeying(sharp)
            {
                return Some(found);
            }
        }
        let entered = FIRST_LAGS.into_iter().find_map(|times| {
            let problem = entry(times * developed, false);
            self.attempt(problem, &cut, Effort::Rough).ok()
        });
        self.sharpen(entered?).ok()
    }

    /// ℓ shortened to its end, and the direction led as soon as that can be, if friction obeys its law then.
    pub(super) fn sharpen<P: BeltProblem>(
        &mut self,
        entered: Solved<P>,
    ) -> Result<Solved<P>, Astray> {
        let mut here = entered;
        let mut lags = LED_LAGS.into_iter();
        let mut failure = Astray::default();
        let sharp = loop {
            let Some(lag) = lags.next() else {
                return Err(failure);
            };
            let mut is_stuck = false;
            here = match self.smooth_less(here, lag, Effort::Rough) {
                Ok(shorter) => shorter,
                // A lead may help on from where it got stuck.
                Err(stuck) => {
                    is_stuck = true;
                    failure = stuck.astray;
                    *stuck.last.ok_or(failure)?
                }
            };
            match self.lead(&here) {
                Ok(sharp) => break sharp,
                Err(Unled::WrongWay(astray)) => return Err(astray),
                Err(Unled::Failed(astray)) => failure = astray,
            }
            if is_stuck {
                return Err(failure);
            }
        };
        self.finish_obeying(sharp)
    }

    /// A solution to the tolerance, if friction obeys its law then.
    pub(in crate::vbelt) fn finish_obeying<P: BeltProblem>(
        &mut self,
        sharp: Solved<P>,
    ) -> Result<Solved<P>, Astray> {
        let solved = self.finish(sharp).map_err(|stuck| stuck.astray)?;
        let gains = Gains::of(&solved);
        if gains.obey_friction(&solved, self.tolerance) {
            return Ok(solved);
        }
        let resting = self.come_to_rest(&solved);
        let resting = resting.and_then(|resting| self.finish(resting).ok());
        resting
            .filter(|resting| obeys_friction(resting, self.tolerance))
            .ok_or_else(|| gains.astray(&solved, self.tolerance))
    }

    /// A direction that is led, with a short ℓ, if the belt gains no power from friction then.
    fn lead<P: BeltProblem>(&mut self, following: &Solved<P>) -> Result<Solved<P>, Unled> {
        let led = following.problem.clone().led(true);
        let led = self
            .attempt(led.clone(), &Carried(following), Effort::Rough)
            .map_err(|cause| Unled::Failed(Astray::of(&led, &cause)))?;
        let (sharp, gains) = self.shorten_led(led).map_err(Unled::Failed)?;
        let gained = gains.share();
        if gained <= WRONG_WAY {
            return Ok(sharp);
        }
        let astray = gains.astray(&sharp, self.tolerance);
        Err(match power_gained(following) > SAME_WAY * gained {
            true => Unled::WrongWay(astray),
            false => Unled::Failed(astray),
        })
    }

    /// ℓ of a direction that is led shortened to its end, and what the belt gains from friction then.
    fn shorten_led<P: BeltProblem>(
        &mut self,
        led: Solved<P>,
    ) -> Result<(Solved<P>, Gains), Astray> {
        let resolved = match led.problem.sticks() {
            true => RESOLVED_LAG_WITH_STICK,
            false => RESOLVED_LAG,
        };
        let last = match led.problem.sticks() {
            true => Effort::Rough,
            false => self.resolving(&led.problem.clone().with_smoothing(resolved)),
        };
        let sharp = self
            .smooth_less_to(led, resolved, [Effort::Rough, last])
            .map_err(|stuck| stuck.astray)?;
        let gains = Gains::of(&sharp);
        Ok((sharp, gains))
    }
}

/// The length μ/κ over which bristles develop friction on a pulley, over its radius, where that is largest.
fn developed_after<P: BeltProblem>(bristles: &P) -> f64 {
    let grooves = (0..bristles.pulleys()).filter_map(|pulley| bristles.in_groove(pulley));
    let lengths = grooves.map(|groove| match groove.law {
        Law::Bristle { stiffness, .. } => groove.friction_coefficient / stiffness,
        Law::Normalised { .. } | Law::Sliding { .. } | Law::Vector { .. } => {
            panic!("bristles were expected")
        }
    });
    lengths.fold(0.0, f64::max)
}

/// Why a direction is not led.
enum Unled {
    /// It is not found, or gains power that it did not gain without the lead.
    Failed(Astray),
    /// It pulled with the slip before.
    WrongWay(Astray),
}
