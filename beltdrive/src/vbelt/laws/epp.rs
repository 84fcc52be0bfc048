//! EPP friction whose direction is a state.
//!
//! Bristles with the limit of EPP friction show where the belt sticks and where it turns. The sliding between
//! these places is entered across the kinks at which elastic friction reaches its limit, as stiff bristles would
//! make it: with ℓ = μ/κ their direction has the same equation. Then the kinks become ends of zones too.

use super::START_STIFFNESS;
use crate::vbelt::DriveProblem;
use crate::vbelt::carried::Carried;
use crate::vbelt::path::{Effort, Path, Solved, Stuck};
use crate::vbelt::zones::{Cut, Loose};

/// How many times as stiff as those of the start the bristles are that show the zones, in the order in which
/// they are tried. Of 45 searches on 40 random drives the first found 43 and the second one more.
const STIFFER: [f64; 2] = [10.0, 1.0];

/// Where the belt is taken to break loose on the driven pulley and on the driver, in the order in which they are
/// tried.
const LOOSE: [[Loose; 2]; 5] = [
    [Loose::Early; 2],
    [Loose::Late; 2],
    [Loose::Never, Loose::Early],
    [Loose::Early, Loose::Never],
    [Loose::Never; 2],
];

impl Path<'_> {
    /// EPP friction by way of bristles, if it is found so and friction obeys its law.
    pub(super) fn epp(&mut self, start: &Solved, tight: f64) -> Option<Solved> {
        let soft = self.elastic_bristles(start, tight).ok()?;
        for stiffer in STIFFER {
            let range = [self.soft(), stiffer * self.soft()];
            let Ok(bristles) = self.with_bristles(soft.clone(), range) else {
                continue;
            };
            let lag = 1.0 / (stiffer * START_STIFFNESS);
            let mut tried: Vec<Cut<'_>> = Vec::new();
            for loose in LOOSE {
                let cut = Cut::of_bristles(&bristles, loose);
                if tried.iter().any(|other| cut.is_like(other)) {
                    continue;
                }
                let found = self.epp_from(&cut, lag, tight);
                if found.is_some() {
                    return found;
                }
                tried.push(cut);
            }
        }
        None
    }

    /// From bristles to those with the limit of EPP friction.
    fn elastic_bristles(&mut self, start: &Solved, tight: f64) -> Result<Solved, Stuck> {
        let epp = self.problem(self.drive.law, 0.0, tight);
        let epp = epp.with_bristles(self.soft());
        // Without its share EPP friction only adds the displacement.
        let unblended = epp.clone().with_epp_weight(0.0);
        let unblended = self
            .attempt(unblended, &Carried(start), Effort::Rough)
            .map_err(|cause| Stuck::after(start.clone(), cause))?;
        let member = |_: &DriveProblem, share| epp.clone().with_epp_weight(share);
        self.follow(unblended, [0.0, 1.0], 1.0, Effort::Rough, member)
    }

    /// From the zones that bristles show to a state.
    fn epp_from(&mut self, cut: &Cut<'_>, lag: f64, tight: f64) -> Option<Solved> {
        let problem = self.problem(self.drive.law, lag, tight).without_lead();
        let entered = self.attempt(cut.apply(problem), cut, Effort::Rough).ok()?;
        let split = self.split_zones(entered, Effort::Rough).ok()?;
        self.sharpen(split)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FrictionLaw;
    use crate::vbelt::groove::{ANGLE, INCLINATION, PENETRATION, TENSION};
    use crate::vbelt::scaling::tests::kim;
    use crate::vbelt::{DRIVER, Regime};

    #[test]
    fn a_belt_that_sticks_is_that_of_a_normalised_direction() {
        // Soft friction: the belt on the driver sticks behind its elastic zone.
        let drive = kim(FrictionLaw::Epp { stiffness: 1e6 }, 0.25);
        let mut path = Path::new(&drive, 1e-6).with_direction();
        let tight = path.target();
        let bristles = path.problem(
            FrictionLaw::Bristle {
                stiffness: path.soft(),
            },
            0.0,
            tight,
        );
        let start = path.cold(bristles, Effort::Start).unwrap();
        let exact = path.epp(&start, tight).unwrap();
        let steps = path.stats.newton_steps;
        assert!(steps <= 95, "{steps}");

        let [_, driver] = exact.problem.regimes();
        let [Regime::Elastic, Regime::Stick, Regime::Slip, Regime::Slip] = driver else {
            panic!("{driver:?}");
        };
        let stick = exact.problem.zones(DRIVER).start + 1;
        let [from, to] = [exact.solution.start(stick), exact.solution.end(stick)];
        assert!(from[INCLINATION].abs() < 1e-12 && to[ANGLE] - from[ANGLE] > 1.0);
        for state in [TENSION, PENETRATION] {
            assert!((to[state] - from[state]).abs() < 1e-12);
        }

        // The other formulation knows no place where the belt sticks: friction below its limit needs a slip
        // there that is a share of ε.
        let other = path.normalised(start, tight).unwrap();
        for (one, other) in exact.constants().into_iter().zip(other.constants()) {
            assert!((one / other - 1.0).abs() < 5e-7, "{one} {other}");
        }
    }
}
