//! Coulomb and scalar EPP friction of a drive whose belt locks on both pulleys, from its integrals.
//!
//! The direction of friction is led from the start, with an ℓ that need hardly be shortened.

use super::sliding::RESOLVED_LAG;
use super::{Asked, AtLoad};
use crate::FrictionLaw;
use crate::vbelt::carried::Carried;
use crate::vbelt::locked::Locked;
use crate::vbelt::path::{Effort, Path, Solved};
use crate::vbelt::zones::Cut;
use crate::vbelt::{BeltProblem, DriveProblem, Regime};

/// ℓ/R over the slip at which the belt breaks away, so that friction follows the slip through the turn behind that. Of 300 random
/// drives at no load and just above, the slowest takes 1.3 s with this and 3.3 s with a third of it, and with 0.1 the state of one is
/// not found.
const LAG_SHARE: f64 = 3e-3;
/// The longest ℓ/R with Coulomb friction, whose effect is below the tolerance without load: with that at which friction is first
/// resolved elsewhere the drive of Kim (2009) is solved twice there and takes 38 ms in place of 24.
const LONGEST_LAG: f64 = 1e-9;
/// The shortest ℓ/R: with a tenth of it six of eight random drives at light loads take 4 to 20 times as long.
const SHORTEST_LAG: f64 = 1e-10;
/// Stiffnesses of elastic friction, over that of a drive, whose states may lead to its own, most of them in one step: the arc of a
/// belt that friction held is not followed to its end with each. Of 12 random drives without load or with 1.0001 times the slack
/// tension that are not found otherwise four are found so.
const BESIDE: [f64; 5] = [1.01, 0.99, 1.1, 0.9, 1.5];
/// The largest load over the slack tension at which they are tried: beyond the limit of a drive they would only take time, 0.1 to
/// 0.7 s of a refusal.
const LIGHT: f64 = 1.01;
/// First step in the logarithm of the stiffness on the way back.
const STIFFNESS_STEP: f64 = 0.1;

impl Path<'_> {
    /// The steady state of a drive with Coulomb or scalar EPP friction whose belt locks on both pulleys and hardly slides
    /// along them, if it is found and friction obeys its law.
    pub(super) fn locked(&mut self, asked: &AtLoad<'_>) -> Option<Solved> {
        let is_elastic = match asked.law() {
            FrictionLaw::Coulomb => false,
            FrictionLaw::Epp { .. } => true,
            _ => return None,
        };
        let sharp = self.put_together(asked, asked.law());
        let found = sharp.and_then(|sharp| self.finish_obeying(sharp).ok());
        if found.is_some() || !is_elastic {
            return found;
        }
        let sharp = self.by_coulomb(asked)?;
        self.finish_obeying(sharp).ok()
    }

    /// A state with scalar EPP friction of a stiffness at a light load from one with another stiffness, if it is found and friction
    /// obeys its law.
    pub(super) fn locked_beside(&mut self, asked: &AtLoad<'_>, stiffness: f64) -> Option<Solved> {
        if asked.tight > LIGHT * self.slack() {
            return None;
        }
        let law = |stiffness| FrictionLaw::Epp { stiffness };
        let member = |problem: &DriveProblem, t: f64| {
            let beside = asked.problem(law(t.exp()), problem.smoothing());
            beside.with_zones(&problem.regimes())
        };
        BESIDE.into_iter().find_map(|times| {
            let beside = self.put_together(asked, law(times * stiffness))?;
            let range = [(times * stiffness).ln(), stiffness.ln()];
            let way = self.follow(beside, range, STIFFNESS_STEP, Effort::Rough, member);
            self.finish_obeying(way.ok()?).ok()
        })
    }

    /// The state with a law from its integrals, roughly.
    fn put_together(&mut self, asked: &AtLoad<'_>, law: FrictionLaw) -> Option<Solved> {
        let (problem, guess) = integrals(asked, law)?;
        self.solved_from_integrals(problem, &guess)
    }

    /// The state of a problem from its integrals, roughly.
    pub(super) fn solved_from_integrals(
        &mut self,
        problem: DriveProblem,
        guess: &Locked,
    ) -> Option<Solved> {
        // The turn of a belt that hardly slips needs a fine mesh at first, and patience.
        let sharp = self.attempt(problem, guess, Effort::Start);
        self.keep_zones(sharp.ok()?, Effort::Rough).ok()
    }

    /// EPP friction from Coulomb friction, roughly: with the displacement of the belt that state shows its zones.
    fn by_coulomb(&mut self, asked: &AtLoad<'_>) -> Option<Solved> {
        let coulomb = self.put_together(asked, FrictionLaw::Coulomb)?;
        let zones: Vec<Vec<_>> = coulomb.problem.regimes();
        let blended = zones.iter().map(|zones| vec![Regime::Either; zones.len()]);
        let epp = asked.problem(asked.law(), coulomb.problem.smoothing());
        // Without its share EPP friction only adds the displacement.
        let unblended = epp.clone().with_zones(&blended.collect::<Vec<_>>());
        let unblended = unblended.with_epp_weight(0.0);
        let shown = self.attempt(unblended, &Carried(&coulomb), Effort::Rough);
        let shown = shown.ok()?;
        let cut = Cut::of(&shown);
        let sharp = self.attempt(cut.apply(epp), &cut, Effort::Rough).ok()?;
        self.keep_zones(sharp, Effort::Rough).ok()
    }
}

/// The problem of a belt that locks with a law, and its integrals, if they meet.
pub(super) fn integrals(asked: &AtLoad<'_>, law: FrictionLaw) -> Option<(DriveProblem, Locked)> {
    // Elastic friction that holds the belt on that drive takes 112 Newton steps with so short an ℓ, in place of 20.
    let longest = match law {
        FrictionLaw::Coulomb => LONGEST_LAG,
        _ => RESOLVED_LAG,
    };
    let problem = asked.problem(law, longest);
    let guess = Locked::of(&problem)?;
    let problem = problem.with_zones(&guess.zones());
    let lag = (LAG_SHARE * guess.slip()).clamp(SHORTEST_LAG, longest);
    Some((problem.with_smoothing(lag), guess))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vbelt::scaling::tests::{kim, tractive, v_belt};
    use crate::{Drive, TwoPulleys};

    #[test]
    fn a_state_whose_arcs_are_lost_is_found_from_another_stiffness() {
        let law = FrictionLaw::Epp {
            stiffness: 39_995_165.793_381_99,
        };
        let slack = 87.517_361_855_727_84;
        let drive = Drive::from(TwoPulleys {
            belt: v_belt([
                0.227_930_482_041_539_82,
                40_391.272_993_298_98,
                1_002_511.578_783_240_9,
                18.149_197_705_592_858_f64.to_radians(),
            ]),
            friction_coefficient: 0.589_630_040_562_572_1,
            driver_radius: 0.161_744_359_669_158_04,
            driver_speed: 35.834_439_622_279_76,
            driven_radius: 0.065_207_092_425_893_97,
            centre_distance: 0.630_326_197_871_491_8,
            load: tractive(slack, slack),
            ..kim(law, 0.25)
        });
        let mut path = Path::new(&drive, 1e-6);
        assert!(path.at_locked_load().is_none());
        let steps = path.stats.newton_steps;
        let tight = path.target();
        let solved = path.at_load(tight).unwrap();
        assert!(solved.problem.sticks(), "{:?}", solved.problem.regimes());
        let steps = path.stats.newton_steps - steps;
        assert!(steps <= 650, "{steps}");
    }
}
