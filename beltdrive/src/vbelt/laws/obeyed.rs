//! Whether friction in a solution obeys its law.

use super::astray::Astray;
use crate::vbelt::on_pulley::{Integrals, OnPulley};
use crate::vbelt::path::Solved;
use crate::vbelt::{BeltProblem, Law, Regime, limit_excess};

/// What the checks of a state allow, in multiples of the tolerance: integrals of the continuous solution are as
/// accurate as its defect.
pub(in crate::vbelt) const ALLOWED: f64 = 10.0;

/// What is allowed of the share of [`power_gained`], in multiples of the tolerance. Near a load at which a zone
/// appears, a state without that zone may pass for one with a little of its friction the wrong way round, and its error is
/// larger than that share: 1.3e-6 of the driven speed at a share of 2.1e-8, 1.2e-5 at 6.8e-7, 3.5e-5 at 3.4e-6. States with all
/// of their zones have shares below 1e-14.
pub(in crate::vbelt) const GAINED: f64 = 0.01;

/// The contacts in grooves, with their pulleys.
fn grooves<P: BeltProblem>(solved: &Solved<P>) -> impl Iterator<Item = (usize, OnPulley<'_>)> {
    let pulleys = 0..solved.problem.pulleys();
    pulleys.filter_map(|pulley| Some((pulley, solved.in_groove(pulley)?)))
}

/// Whether friction is against the slip, and elastic or at its limit where it is taken to be.
pub(in crate::vbelt) fn obeys_friction<P: BeltProblem>(solved: &Solved<P>, tolerance: f64) -> bool {
    Gains::of(solved).obey_friction(solved, tolerance)
}

/// Power that the belt gains where the traction pulls with its slip, as a share of that which it spends
/// elsewhere. A traction that has turned the wrong way round meets all equations but the sense of friction.
pub(in crate::vbelt) fn power_gained<P: BeltProblem>(solved: &Solved<P>) -> f64 {
    Gains::of(solved).share()
}

/// The power of friction in every groove.
pub(super) struct Gains(Vec<Integrals>);

impl Gains {
    pub(super) fn of<P: BeltProblem>(solved: &Solved<P>) -> Self {
        Self(grooves(solved).map(|(_, on)| on.integrate()).collect())
    }

    /// As [`power_gained`].
    pub(super) fn share(&self) -> f64 {
        let (mut gained, mut friction) = (0.0, 0.0);
        for sum in &self.0 {
            gained += sum.gained;
            friction += sum.friction;
        }
        gained / (friction + gained)
    }

    /// As [`obeys_friction`], of the same solution.
    pub(super) fn obey_friction<P: BeltProblem>(&self, solved: &Solved<P>, tolerance: f64) -> bool {
        let limit = ALLOWED * tolerance;
        let is_right = !solved.problem.has_zones() || wrong_friction(solved) <= limit;
        is_right && self.share() <= GAINED * tolerance
    }

    /// The pulley of the same solution on which friction obeys its law least: where the belt gains the largest share of
    /// the power of friction, or if it gains none where friction is not of the kind that it is taken for.
    pub(super) fn astray<P: BeltProblem>(&self, solved: &Solved<P>, tolerance: f64) -> Astray {
        let gains = self.share() > GAINED * tolerance;
        let wrong = grooves(solved).zip(&self.0).map(|((pulley, on), sum)| {
            let wrong = match gains {
                true => sum.gained / (sum.friction + sum.gained),
                false => wrong_on(&on)[0],
            };
            (pulley, wrong)
        });
        let most = wrong.max_by(|(_, one), (_, other)| one.total_cmp(other));
        Astray {
            pulley: most.map(|(pulley, _)| pulley),
        }
    }
}

/// By how much friction is above its limit in elastic zones, below it in slip zones, or more than holds a belt that
/// sticks, or the pressure below zero, as a share of the largest pressure.
pub(in crate::vbelt) fn wrong_friction<P: BeltProblem>(solved: &Solved<P>) -> f64 {
    let [wrong, highest] = grooves(solved)
        .map(|(_, on)| wrong_on(&on))
        .fold([0.0f64; 2], |[wrong, highest], here| {
            [wrong.max(here[0]), highest.max(here[1])]
        });
    wrong / highest
}

/// By how much friction on a pulley is wrong in that sense, and the largest pressure.
fn wrong_on(on: &OnPulley<'_>) -> [f64; 2] {
    let (mut highest, mut wrong) = (0.0f64, 0.0f64);
    // Traction that vector EPP friction would lose where its plastic rate is negative.
    let mut lost = 0.0;
    on.for_each_point(|stretch, _, weight, y| {
        let pressure = on.contact(stretch.regime, y).pressure;
        highest = highest.max(pressure);
        wrong = wrong.max(-pressure);
        let excess = limit_excess(on.groove, stretch.regime, y, on.rim_speed, on.flow);
        wrong = wrong.max(match stretch.regime {
            Regime::Elastic | Regime::Reversed => excess,
            Regime::Slip => match on.groove.law {
                Law::Vector { stiffness, .. } => {
                    let strain = on.groove.strand.compliance;
                    lost += weight * stiffness * strain * (-excess).max(0.0);
                    lost
                }
                _ => -excess,
            },
            Regime::Stick => {
                let limit = on.contact(Regime::Either, y).friction();
                on.contact(Regime::Stick, y).friction() - limit
            }
            Regime::Either => 0.0,
        });
    });
    [wrong, highest]
}
