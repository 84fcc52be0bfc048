//! What can be measured on a solved loop, in any scalar.

use super::numbers::Numbers;
use super::running::RunningBelt;
use crate::drive::layout::Wound;
use crate::friction::rim::contact::Contact;
use crate::friction::rim::zone::Friction;
use crate::mechanics::span::{first_frequency, rest_frequency};
use crate::results::measured::{Measurable, OfPulley, OfSpan, OfWhole};
use bvp::Real;

/// What the numbers that can be measured follow from.
pub(super) struct Solved<'l, S = f64> {
    pub(super) numbers: &'l Numbers<S>,
    pub(super) belt: &'l RunningBelt<S>,
    pub(super) wound: &'l Wound<S>,
    /// The belt at rest on its pulleys.
    pub(super) rest_wound: &'l Wound<S>,
    /// Its tension, N.
    pub(super) rest_tension: S,
    /// Its length without tension, m.
    pub(super) unstretched: S,
}

impl<S: Real> Solved<'_, S> {
    /// Traction of the belt at which it would run as fast as the rim of a pulley, N.
    fn reference(&self, pulley: usize) -> S {
        self.belt.contacts[pulley].reference()
    }

    /// Angle on a pulley where the belt slips, or where it does not, rad.
    pub(super) fn arc(&self, pulley: usize, slips: bool) -> S {
        let zones = self.belt.contacts[pulley].zones.iter();
        let zones = zones.filter(|zone| matches!(zone.friction, Friction::Slip) == slips);
        let length: S = zones.map(|zone| zone.end - zone.start.arc_length).sum();
        // An empty sum is −0.
        length / self.numbers.rims[pulley].radius + 0.0
    }

    /// Power lost in friction on a pulley, W.
    pub(super) fn friction_loss(&self, pulley: usize) -> S {
        let RunningBelt {
            speed,
            belt,
            changes,
            contacts,
            ..
        } = self.belt;
        let contact = &contacts[pulley];
        let before_reference = belt.stiffness * entry_strain(contact);
        // c/D [(P_out² − P_in²)/2 − P_o (P_out − P_in)]
        *speed / belt.stiffness * changes[pulley] * (before_reference + changes[pulley] * 0.5)
    }

    /// Power M ω of each pulley, W.
    fn powers(&self) -> impl Iterator<Item = S> {
        (0..self.numbers.rims.len()).map(|pulley| self.torque(pulley) * self.angular_speed(pulley))
    }

    /// Powers into and out of the belt, W.
    pub(super) fn power_in_and_out(&self) -> [S; 2] {
        self.powers().fold([S::ZERO; 2], |[input, output], power| {
            [input + (-power).max(S::ZERO), output + power.max(S::ZERO)]
        })
    }

    /// Torque of a pulley, N·m.
    fn torque(&self, pulley: usize) -> S {
        self.belt.changes[pulley] * self.numbers.rims[pulley].radius
    }

    /// Angular speed of a pulley, rad/s.
    pub(super) fn angular_speed(&self, pulley: usize) -> S {
        let RunningBelt { speed, belt, .. } = self.belt;
        match pulley == self.numbers.driver {
            true => self.numbers.driver_speed,
            false => {
                let strain = belt.strain(self.reference(pulley));
                *speed * (strain + 1.0) / self.numbers.rims[pulley].radius
            }
        }
    }
}

/// Strain u′(0) of the belt against the rim where it enters a pulley.
pub(super) fn entry_strain<S: Real>(contact: &Contact<S>) -> S {
    contact.strain * contact.arc.sense + 0.0
}

/// Force on the hub of a pulley with tractive tensions of the spans behind and before it, N.
fn hub_load<S: Real>(wound: &Wound<S>, pulley: usize, [behind, before]: [S; 2]) -> [S; 2] {
    let [entering, leaving] = wound.spans_of(pulley).map(|span| span.tangent);
    std::array::from_fn(|part| before * leaving[part] - behind * entering[part])
}

impl<S: Real> Measurable<S> for Solved<'_, S> {
    fn of_pulley(&self, index: usize) -> OfPulley<S> {
        let RunningBelt { belt, tractive, .. } = self.belt;
        let driver = self.reference(self.numbers.driver);
        let (torque, angular_speed) = (self.torque(index), self.angular_speed(index));
        let count = tractive.len();
        let ends = [tractive[(index + count - 1) % count], tractive[index]];
        OfPulley {
            angular_speed,
            speed_loss: (driver - self.reference(index)) / (belt.offset() + driver),
            wrap: self.wound.wraps[index],
            slip_arc: self.arc(index, true),
            hub_load: hub_load(self.wound, index, ends),
            rest_hub_load: hub_load(self.rest_wound, index, [self.rest_tension; 2]),
            torque,
            power: torque * angular_speed,
        }
    }

    fn of_span(&self, index: usize) -> OfSpan<S> {
        let Numbers {
            mass_per_length,
            axial_stiffness,
            ..
        } = *self.numbers;
        let RunningBelt {
            speed,
            belt,
            tractions,
            tractive,
            ..
        } = self.belt;
        let [length, rest_length] =
            [self.wound, self.rest_wound].map(|wound| wound.spans[index].length);
        let tension = belt.tension(tractions[index]);
        let moving = *speed * (belt.strain(tractions[index]) + 1.0);
        let flow = mass_per_length * *speed;
        OfSpan {
            tension,
            tractive_tension: tractive[index],
            frequency: first_frequency(length, tractive[index], tension, moving, flow),
            rest_frequency: rest_frequency(
                rest_length,
                self.rest_tension,
                mass_per_length,
                axial_stiffness,
            ),
        }
    }

    fn of_whole(&self) -> OfWhole<S> {
        let [power_in, power_out] = self.power_in_and_out();
        let pulleys = 0..self.numbers.rims.len();
        OfWhole {
            rest_tension: self.rest_tension,
            power_loss: pulleys.map(|pulley| self.friction_loss(pulley)).sum(),
            efficiency: (power_in > 0.0).then(|| power_out / power_in),
            unstretched_length: self.unstretched,
        }
    }
}
