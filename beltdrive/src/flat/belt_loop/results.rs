//! Everything that follows from the speed and the tensions of a loop.

use super::numbers::Numbers;
use super::rest::{self, Rest};
use super::running::RunningBelt;
use super::solved::{Solved, entry_strain};
use crate::drive::layout::Layout;
use crate::friction::rim::contact::Contact;
use crate::friction::rim::profile::zones;
use crate::mechanics::span::DEFLECTION;
use crate::mechanics::tensioner::Held;
use crate::results::loop_state::{
    Contacts, FrictionParts, LoadLimit, LoopState, PulleyState, SpanState, TensionerState,
};
use crate::results::measured::{Measurable, OfPulley, OfSpan};
use crate::{Drive, SolveError, ZoneKind};

/// A solved loop.
pub(super) struct Found<'l> {
    pub(super) drive: &'l Drive,
    pub(super) numbers: &'l Numbers,
    pub(super) rest: Rest,
    pub(super) coordinate: f64,
    pub(super) layout: Layout,
    pub(super) belt: RunningBelt,
    pub(super) limit: Option<LoadLimit>,
}

impl Found<'_> {
    fn solved(&self) -> Solved<'_> {
        Solved {
            numbers: self.numbers,
            belt: &self.belt,
            wound: self.layout.wound(),
            rest_wound: self.rest.layout.wound(),
            rest_tension: self.rest.tension,
            unstretched: self.rest.unstretched,
        }
    }

    /// The tensioner in the running loop and at rest.
    fn held(&self) -> Option<[Held; 2]> {
        let carried = self.drive.tensioner()?;
        let held = |layout, coordinate, tension| {
            let length = self.rest.unstretched;
            Held::new(self.drive, carried, layout, coordinate, tension, length)
        };
        let running = self.belt.tractive[carried.0];
        let Rest {
            coordinate,
            tension,
            ..
        } = self.rest;
        Some([
            held(&self.layout, self.coordinate, running),
            held(&self.rest.layout, coordinate, tension),
        ])
    }

    /// Whether the tensioner stays where it is in the running loop.
    pub(super) fn stable(&self) -> Result<(), SolveError> {
        let held = self.drive.tensioner().zip(self.held());
        match held {
            Some((_, [running, _])) if running.stiffness > 0.0 => Ok(()),
            None => Ok(()),
            Some(((pulley, _), _)) => Err(SolveError::NoEquilibrium {
                pulley: self.drive.pulleys[pulley].name.clone(),
                which: "under load",
            }),
        }
    }

    fn span(&self, index: usize) -> SpanState {
        let OfSpan {
            tension,
            tractive_tension,
            frequency,
            rest_frequency,
        } = self.solved().of_span(index);
        let RunningBelt {
            speed,
            belt,
            tractions,
            ..
        } = &self.belt;
        let [span, at_rest] = [&self.layout, &self.rest.layout].map(|layout| layout.spans()[index]);
        let deflection = DEFLECTION * at_rest.length;
        let deflected = self.rest.layout.deflected(index, deflection);
        let force = deflected.map(|[length, across]| {
            rest::tension(
                length,
                self.rest.unstretched,
                self.drive.belt.axial_stiffness,
            ) * across
        });
        SpanState {
            length: span.length,
            direction: span.direction,
            tension,
            tractive_tension,
            speed: speed * (1.0 + belt.strain(tractions[index])),
            frequency,
            rest_length: at_rest.length,
            rest_frequency,
            deflection,
            deflection_force: force,
        }
    }

    fn pulley(&self, index: usize) -> PulleyState {
        let solved = self.solved();
        let OfPulley {
            angular_speed,
            speed_loss,
            wrap,
            slip_arc,
            hub_load,
            rest_hub_load,
            torque,
            power,
        } = solved.of_pulley(index);
        let RunningBelt {
            speed,
            belt,
            changes,
            contacts,
            ..
        } = &self.belt;
        let (stated, contact) = (&self.drive.pulleys[index], &contacts[index]);
        let load = self.belt.largest_load(stated, wrap);
        let capacity = stated.radius * contact.arc.low * load.exp_m1();
        PulleyState {
            name: stated.name.clone(),
            centre: self.layout.pulleys()[index].centre,
            angular_speed,
            torque,
            power,
            wrap,
            rest_wrap: self.rest.layout.wraps()[index],
            no_slip_arc: solved.arc(index, false),
            slip_arc,
            zones: zones(contact, stated.radius),
            entry_strain: Some(entry_strain(contact)),
            reference_tension: Some(belt.tension(contact.reference())),
            hub_load,
            rest_hub_load,
            speed_loss,
            friction_loss: solved.friction_loss(index),
            friction_parts: friction_parts(contact, speed / belt.stiffness),
            friction_utilisation: Some(if changes[index] == 0.0 {
                0.0
            } else {
                contact.arc.load() / load
            }),
            torque_capacity: Some(capacity),
            torque_margin: (torque != 0.0).then(|| capacity / torque.abs()),
            torque_margin_error: 0.0,
            groove: None,
        }
    }

    fn tensioner(&self) -> Option<TensionerState> {
        let (pulley, tensioner) = self.drive.tensioner()?;
        let [running, rest] = self.held()?;
        Some(TensionerState {
            pulley,
            coordinate: self.coordinate,
            rest_coordinate: self.rest.coordinate,
            load: tensioner.load_at(self.coordinate)[0],
            length_derivatives: running.length_derivatives,
            stiffness: running.stiffness,
            rest_stiffness: rest.stiffness,
            constant: running.constant,
            rest_constant: rest.constant,
        })
    }
}

/// What the friction loss of a contact consists of, W: c/D ∫ (P − `P_o`) dP over each zone, with c/D in m/s/N.
fn friction_parts(contact: &Contact, per_traction: f64) -> FrictionParts {
    let arc = contact.arc;
    let before_reference = arc.sense * contact.strain * arc.belt.stiffness;
    let starts = contact.zones.iter().map(|zone| zone.start.traction);
    let ends = starts.skip(1).chain([arc.exit()]);
    let mut parts = FrictionParts::default();
    for (zone, end) in contact.zones.iter().zip(ends) {
        let grown = zone.start.traction - arc.entry();
        let change = end - zone.start.traction;
        let lost = per_traction * change * (before_reference + grown + 0.5 * change);
        match zone.friction.kind() {
            ZoneKind::Elastic => parts.elastic += lost,
            ZoneKind::Slip | ZoneKind::Adhesion | ZoneKind::Creep => parts.sliding += lost,
        }
    }
    parts
}

/// The answer.
pub(super) fn state(found: Found<'_>) -> LoopState {
    let count = found.drive.pulleys.len();
    let solved = found.solved();
    let [power_in, power_out] = solved.power_in_and_out();
    let whole = solved.of_whole();
    LoopState {
        unstretched_speed: found.belt.speed,
        mass_flow: found.drive.belt.mass_per_length * found.belt.speed,
        length: found.layout.length(),
        unstretched_length: whole.unstretched_length,
        rest_tension: whole.rest_tension,
        power_in,
        power_out,
        power_loss: whole.power_loss,
        efficiency: whole.efficiency,
        spans: (0..count).map(|index| found.span(index)).collect(),
        pulleys: (0..count).map(|index| found.pulley(index)).collect(),
        tensioner: found.tensioner(),
        load_limit: found.limit,
        checks: vec![],
        convergence: None,
        rest_layout: found.rest.layout,
        layout: found.layout,
        contacts: Contacts::Flat {
            contacts: found.belt.contacts,
            belt: found.drive.belt,
        },
    }
}
