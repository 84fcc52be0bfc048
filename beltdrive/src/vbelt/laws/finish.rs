//! The end of the way: zones of the right kind, the tolerance, and a smoothing without effect.

use super::GREAT_STEP;
use super::obeyed::{GAINED, power_gained};
use super::sliding::{SAME_WAY, WRONG_WAY};
use crate::vbelt::carried::Carried;
use crate::vbelt::path::{Effort, Path, Solved, Stuck};
use crate::vbelt::zones::Cut;
use crate::vbelt::{BeltProblem, Law};

/// ε at which the profile is first resolved to the tolerance.
pub(super) const RESOLVED: f64 = 1e-7;
/// δ of vector EPP friction without zones over p/`k_f`: its effect on the drive of Kim (2009) at 700 N is less than 1e-8, and
/// 5e-7 with 0.01. Without it 1 of 800 random drives takes minutes. On the way, with 0.1, it hides zones.
const ROUNDING: f64 = 1e-3;
/// ε below which slip velocities drown in the rounding of the speeds they are differences of.
const SMALLEST: f64 = 1e-12;
/// The same of ℓ/R, whose effect is 4e-14 with this on the drive of Kim (2009) at 700 N.
const SHORTEST: f64 = 1e-14;
/// Rounding of the slip where the belt locks: over ℓ it is the least defect of the direction there. On the drive of Kim (2009)
/// at 200 and 400 N that was 2e-8 with ℓ/R of 1e-9.
const ROUNDED_SLIP: f64 = 2e-17;
/// Such a defect is left aside where it is more than this share of the tolerance: with 0.5 that drive is not solved to 1e-8 at
/// 105 N with scalar EPP friction, with this in 0.4 s.
const LEFT_ASIDE: f64 = 0.1;
/// The effect of ℓ may be this share of the tolerance.
const LAG_SHARE: f64 = 0.1;
/// The effect of ε may be this share of the tolerance, and that of an ℓ/R below `SHORT`.
const EFFECT_SHARE: f64 = 0.3;
/// A shorter ℓ/R than this makes meshes follow the rounding of the slip. Near the largest load the effect is a hundred times
/// as large as elsewhere: of one loop at 0.995 of it, shortening from 1e-12, with 0.18 of the tolerance, took 40 s in vain.
const SHORT: f64 = 1e-10;
/// The effect of ℓ is told from its change by a length this much shorter, ...
const SHORTER: f64 = 0.1;
/// ... and that of ε by one this much smaller: every step towards a smaller ε takes ten Newton steps and more, and on
/// the drive of Kim (2009) without load that from 1e-8 to 1e-9 took two thirds of the time.
const SMALLER: f64 = 0.25;
/// Zones are found anew at most so often; if they still change, the check of the state says so.
const MAX_CUTS: usize = 8;

impl Path<'_> {
    /// A solution with its zones found anew, until every zone is of the kind it was taken for. Rough solutions
    /// keep zones that could not be changed: those of a shorter ℓ may be found again.
    pub(super) fn split_zones<P: BeltProblem>(
        &mut self,
        solved: Solved<P>,
        effort: Effort,
    ) -> Result<Solved<P>, Stuck<P>> {
        let mut here = solved;
        for _ in 0..MAX_CUTS {
            let cut = Cut::of(&here);
            if cut.is_kept() {
                break;
            }
            let problem = cut.apply(here.problem.clone());
            here = match self.attempt(problem.clone(), &cut, effort) {
                Ok(solved) => solved,
                Err(_) if effort.is_rough() || cut.is_nearly_kept() => break,
                Err(cause) => return Err(Stuck::before(&problem, here, cause)),
            };
        }
        Ok(here)
    }

    /// A solution with its zones found anew where they are segments.
    pub(in crate::vbelt) fn keep_zones<P: BeltProblem>(
        &mut self,
        solved: Solved<P>,
        effort: Effort,
    ) -> Result<Solved<P>, Stuck<P>> {
        if solved.problem.has_junctions() {
            self.split_zones(solved, effort)
        } else {
            Ok(solved)
        }
    }

    /// Solves to the tolerance with an estimate of the error, and smooths less until the effect of that is below
    /// the tolerance.
    pub(in crate::vbelt) fn finish<P: BeltProblem>(
        &mut self,
        rough: Solved<P>,
    ) -> Result<Solved<P>, Stuck<P>> {
        let rough = self.rounded(rough)?;
        let solved = self.resolve(rough)?;
        self.with_estimate(solved)
    }

    /// A state of vector EPP friction without zones with the usual δ.
    fn rounded<P: BeltProblem>(&mut self, rough: Solved<P>) -> Result<Solved<P>, Stuck<P>> {
        let problem = rough.problem.clone();
        let problem = problem.with_laws(|law, _| law.with_rounding(ROUNDING));
        if problem.is_split() || problem.law() == rough.problem.law() {
            return Ok(rough);
        }
        let outcome = self.attempt(problem, &Carried(&rough), Effort::Full);
        outcome.map_err(|cause| Stuck::after(rough, cause))
    }

    /// Solves to the tolerance, and smooths less until the effect of that is below the tolerance.
    pub(super) fn resolve<P: BeltProblem>(
        &mut self,
        rough: Solved<P>,
    ) -> Result<Solved<P>, Stuck<P>> {
        if rough.problem.smoothing() == 0.0 {
            self.smoothing_effect = 0.0;
            let solved = self.again(rough, Effort::Final)?;
            return self.keep_zones(solved, Effort::Final);
        }
        let effort = self.resolving(&rough.problem);
        let solved = match self.is_solved_with(&rough, effort) {
            true => rough,
            false => self.again(rough, effort)?,
        };
        let here = self.keep_zones(solved, Effort::Final)?;
        let here = self.zones_at_ends(here);
        match here.problem.law() {
            Law::Sliding { .. } => self.shorten_lag(here),
            // Places where zones end are printed, and move by more than the constants.
            Law::Vector { .. } => self.lower_effect(here, SHORTER, 0.0),
            _ => self.lower_effect(here, SMALLER, EFFECT_SHARE),
        }
    }

    /// How a problem is first solved to the tolerance.
    pub(super) fn resolving<P: BeltProblem>(&self, problem: &P) -> Effort {
        match problem.law() {
            Law::Sliding { lag, .. } if ROUNDED_SLIP / lag > LEFT_ASIDE * self.tolerance => {
                Effort::Close
            }
            // Where the belt sticks ℓ is longer at first, and an estimate would be one of a solution on the way, as with ε
            // and τ.
            Law::Sliding { .. } if !problem.sticks() => Effort::Final,
            _ => Effort::Full,
        }
    }

    /// Smooths less by a factor until the effect of ε or τ, told from the change by that, is below the tolerance. A solution
    /// is taken before that change if its effect is below the share `coarse` of the tolerance.
    fn lower_effect<P: BeltProblem>(
        &mut self,
        solved: Solved<P>,
        factor: f64,
        coarse: f64,
    ) -> Result<Solved<P>, Stuck<P>> {
        let mut here = solved;
        loop {
            let smoothing = here.problem.smoothing();
            let finer = self.smooth_less(here.clone(), factor * smoothing, Effort::Full)?;
            // The effect vanishes at least as fast as ε or τ: what is left of it behind the change is at most this.
            let largest = here.change_to(&finer.constants()) / (1.0 - factor);
            self.smoothing_effect = largest;
            if self.smoothing_effect <= coarse * self.tolerance {
                return Ok(here);
            }
            self.smoothing_effect = factor * largest;
            if self.smoothing_effect <= EFFECT_SHARE * self.tolerance || smoothing <= SMALLEST {
                return Ok(finer);
            }
            here = finer;
        }
    }

    /// Shortens ℓ until its effect is below the tolerance. That is told to first order, which on the drive of Kim (2009) is
    /// right to 1 % from 105 to 5000 N and takes a fifth of the time of a solution with a shorter one.
    ///
    /// A traction that lags behind a slip that turns within a length of about ℓ pulls with it for a while, with a shorter ℓ
    /// for less; one that has turned the wrong way round gains as much power with every ℓ.
    ///
    /// Rounding of the slip changes the direction in proportion to 1/ℓ. Where that is more than the tolerance at the ℓ whose effect
    /// is small beside that, the shortest ℓ that is found is taken if its effect is not more than the tolerance.
    fn shorten_lag<P: BeltProblem>(&mut self, solved: Solved<P>) -> Result<Solved<P>, Stuck<P>> {
        let (mut here, mut gained_before) = (solved, f64::INFINITY);
        let mut failure = None;
        loop {
            let lag = here.problem.smoothing();
            let shorter = here.problem.clone().with_smoothing(SHORTER * lag);
            let corrected = match self.corrected(&here, &shorter) {
                Ok(corrected) => shorter.constants(&corrected),
                Err(cause) => return Err(Stuck::after(here, cause)),
            };
            self.smoothing_effect = here.change_to(&corrected) / (1.0 - SHORTER);
            let share = if lag < SHORT { EFFECT_SHARE } else { LAG_SHARE };
            let gained = power_gained(&here);
            let lags_behind = gained > GAINED * self.tolerance
                && gained <= WRONG_WAY.min(SAME_WAY * gained_before);
            let has_effect = self.smoothing_effect > share * self.tolerance;
            if !(has_effect || lags_behind) || lag <= SHORTEST {
                return Ok(here);
            }
            if let Some(cause) = failure {
                return match self.smoothing_effect <= self.tolerance {
                    true => Ok(here),
                    false => Err(Stuck::after(here, cause)),
                };
            }
            gained_before = gained;
            let effort = match has_effect {
                true => Effort::Close,
                false => Effort::Lagging,
            };
            here = match self.smooth_less(here, SHORTER * lag, effort) {
                Ok(shorter) => shorter,
                Err(Stuck {
                    last: Some(last),
                    cause,
                    ..
                }) => {
                    failure = Some(cause);
                    *last
                }
                Err(stuck) => return Err(stuck),
            };
        }
    }

    /// The solution with the zones at the ends of contacts that lie between samples, if there are any. Without them the normal
    /// force is negative at an exit, or friction behind an entry above its elastic part, which the checks refuse.
    fn zones_at_ends<P: BeltProblem>(&mut self, here: Solved<P>) -> Solved<P> {
        if !here.problem.is_split() {
            return here;
        }
        let cut = Cut::with_ends(&here);
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
    pub(super) fn with_estimate<P: BeltProblem>(
        &mut self,
        solved: Solved<P>,
    ) -> Result<Solved<P>, Stuck<P>> {
        match solved.solution.error_estimate() {
            Some(_) => Ok(solved),
            None => self.again(solved, Effort::Final),
        }
    }

    /// Shortens ℓ or lowers ε; bristles stay as they are.
    pub(in crate::vbelt) fn smooth_less<P: BeltProblem>(
        &mut self,
        start: Solved<P>,
        smoothing: f64,
        effort: Effort,
    ) -> Result<Solved<P>, Stuck<P>> {
        self.smooth_less_to(start, smoothing, [effort; 2])
    }

    /// The same with one effort on the way and another one for the last step, if the end is found with that.
    pub(super) fn smooth_less_to<P: BeltProblem>(
        &mut self,
        start: Solved<P>,
        smoothing: f64,
        efforts: [Effort; 2],
    ) -> Result<Solved<P>, Stuck<P>> {
        let from = start.problem.smoothing();
        if from == 0.0 || from == smoothing {
            return Ok(start);
        }
        let range = [from.ln(), smoothing.ln()];
        self.follow_to(start, range, GREAT_STEP, efforts, with_smoothing)
    }
}

/// The same problem with ℓ/R or ε of eᵗ.
pub(super) fn with_smoothing<P: BeltProblem>(problem: &P, t: f64) -> P {
    problem.clone().with_smoothing(t.exp())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vbelt::scaling::tests::{kim, tractive, v_belt};
    use crate::{Drive, FrictionLaw, TwoPulleys};

    #[test]
    fn the_shortest_length_that_rounding_allows_is_taken() {
        // Rounding hides the direction with an ℓ/R of 1e-10.
        let law = FrictionLaw::Epp {
            stiffness: 1_004_147.0,
        };
        let drive = Drive::from(TwoPulleys {
            belt: v_belt([0.128_013_5, 134_825.72, 1.337_009e7, 0.219_441_74]),
            friction_coefficient: 0.395_502_7,
            driver_radius: 0.326_170_9,
            driver_speed: 27.385_488,
            driven_radius: 0.337_381_2,
            centre_distance: 0.869_771_8,
            load: tractive(119.248_2, 340.974_3),
            ..kim(law, 0.25)
        });
        let [coarse, fine] = [1e-7, 1e-8].map(|tolerance| {
            let mut path = Path::new(&drive, tolerance);
            let solved = path.at_load(path.target()).unwrap();
            let effect = path.smoothing_effect;
            assert!(effect <= tolerance, "{effect}");
            let steps = path.stats.newton_steps;
            // 115 of them for the same state from a smaller load.
            assert!(steps <= 340, "{steps}");
            solved
        });
        assert!(fine.problem.smoothing() < coarse.problem.smoothing());
        let change = fine.change_to(&coarse.constants());
        assert!(change < 1e-8, "{change}");
    }
}
