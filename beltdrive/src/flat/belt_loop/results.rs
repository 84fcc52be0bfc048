//! Everything that follows from the speed and the tensions of a loop.

use super::rest::Rest;
use super::running::RunningBelt;
use crate::drive::layout::Layout;
use crate::friction::rim::contact::Contact;
use crate::friction::rim::profile::zones;
use crate::friction::rim::zone::Friction;
use crate::mechanics::span::{DEFLECTION, first_frequency, rest_frequency};
use crate::mechanics::tensioner::Held;
use crate::results::loop_state::{
    Contacts, FrictionParts, LoadLimit, LoopState, PulleyState, SpanState, TensionerState,
};
use crate::{Drive, Duty, SolveError, ZoneKind};

/// A solved loop.
pub(super) struct Found<'l> {
    pub(super) drive: &'l Drive,
    pub(super) rest: Rest,
    pub(super) coordinate: f64,
    pub(super) layout: Layout,
    pub(super) belt: RunningBelt,
    pub(super) limit: Option<LoadLimit>,
}

impl Found<'_> {
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
        let RunningBelt {
            speed,
            belt,
            tractions,
            tractive,
            ..
        } = &self.belt;
        let stated = self.drive.belt;
        let [span, rest] = [&self.layout, &self.rest.layout].map(|layout| layout.spans()[index]);
        let tension = belt.tension(tractions[index]);
        let moving = speed * (1.0 + belt.strain(tractions[index]));
        let flow = stated.mass_per_length * speed;
        let deflection = DEFLECTION * rest.length;
        let deflected = self.rest.layout.deflected(index, deflection);
        let force = deflected.map(|[length, across]| {
            let unstretched = self.rest.unstretched;
            stated.axial_stiffness * ((length - unstretched) / unstretched) * across
        });
        SpanState {
            length: span.length,
            direction: span.direction,
            tension,
            tractive_tension: tractive[index],
            speed: moving,
            frequency: first_frequency(span.length, tractive[index], tension, moving, flow),
            rest_length: rest.length,
            rest_frequency: rest_frequency(rest.length, self.rest.tension, &stated),
            deflection,
            deflection_force: force,
        }
    }

    fn pulley(&self, index: usize, driver: usize) -> PulleyState {
        let RunningBelt {
            speed,
            belt,
            tractive,
            changes,
            contacts,
            ..
        } = &self.belt;
        let (stated, contact) = (&self.drive.pulleys[index], &contacts[index]);
        let radius = stated.radius;
        let torque = changes[index] * radius;
        let reference = contact.reference();
        let driving = belt.offset() + contacts[driver].reference();
        let angular_speed = match stated.duty {
            Duty::Driver(angular_speed) => angular_speed,
            Duty::Torque(_) | Duty::Power(_) | Duty::Driven => {
                speed * (1.0 + belt.strain(reference)) / radius
            }
        };
        let arc_of = |slips: bool| {
            let zones = contact.zones.iter();
            let zones = zones.filter(|zone| matches!(zone.friction, Friction::Slip) == slips);
            // An empty sum is −0.
            zones
                .map(|zone| zone.end - zone.start.arc_length)
                .sum::<f64>()
                / radius
                + 0.0
        };
        let load = self.belt.largest_load(stated, self.layout.wraps()[index]);
        let capacity = radius * contact.arc.low * load.exp_m1();
        let hub_load = |layout: &Layout, tensions: [f64; 2]| {
            let [entering, leaving] = layout.spans_of(index).map(|span| span.tangent());
            let [behind, before] = tensions;
            <[f64; 2]>::from(before * leaving - behind * entering)
        };
        let count = tractive.len();
        let ends = [tractive[(index + count - 1) % count], tractive[index]];
        let entry_strain = contact.arc.sense * contact.strain + 0.0;
        let before_reference = belt.stiffness * entry_strain;
        PulleyState {
            name: stated.name.clone(),
            centre: self.layout.pulleys()[index].centre,
            angular_speed,
            torque,
            power: torque * angular_speed,
            wrap: self.layout.wraps()[index],
            rest_wrap: self.rest.layout.wraps()[index],
            no_slip_arc: arc_of(false),
            slip_arc: arc_of(true),
            zones: zones(contact, radius),
            entry_strain: Some(entry_strain),
            reference_tension: Some(belt.tension(reference)),
            hub_load: hub_load(&self.layout, ends),
            rest_hub_load: hub_load(&self.rest.layout, [self.rest.tension; 2]),
            speed_loss: (contacts[driver].reference() - reference) / driving,
            // c/D [(P_out² − P_in²)/2 − P_o (P_out − P_in)]
            friction_loss: speed / belt.stiffness
                * changes[index]
                * (before_reference + 0.5 * changes[index]),
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
    let driver = found.drive.driver();
    let count = found.drive.pulleys.len();
    let pulleys: Vec<_> = (0..count)
        .map(|index| found.pulley(index, driver))
        .collect();
    let powers = pulleys.iter().map(|pulley| pulley.power);
    let [power_in, power_out] = powers.fold([0.0, 0.0], |[input, output], power| {
        [input + (-power).max(0.0), output + power.max(0.0)]
    });
    LoopState {
        unstretched_speed: found.belt.speed,
        mass_flow: found.drive.belt.mass_per_length * found.belt.speed,
        length: found.layout.length(),
        unstretched_length: found.rest.unstretched,
        rest_tension: found.rest.tension,
        power_in,
        power_out,
        power_loss: pulleys.iter().map(|pulley| pulley.friction_loss).sum(),
        efficiency: (power_in > 0.0).then(|| power_out / power_in),
        spans: (0..count).map(|index| found.span(index)).collect(),
        pulleys,
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
