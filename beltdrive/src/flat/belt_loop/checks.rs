//! The invariants of a state, from the friction law along the contacts and from the geometry, and not from the
//! equations that were solved.

use crate::drive::layout::Layout;
use crate::friction::rim::contact::Contact;
use crate::friction::rim::quadrature::integrals;
use crate::friction::rim::zone::{ContactZone, Friction};
use crate::mechanics::tensioner::resolution;
use crate::results::loop_state::{Contacts, LoopState};
use crate::{Check, Drive, Pulley, SolveError};
use nalgebra::Vector2;
use std::cell::Cell;
use std::f64::consts::TAU;

/// How far an invariant may be off, relative: quadrature has about eleven digits.
const ALLOWED: f64 = 1e-9;

/// Growth of the traction by slip on a panel of the quadrature, in logarithms: its error is then below
/// 1e-13.
const SLIP_PANEL: f64 = 1.5;

/// Integrals along a contact.
#[derive(Clone, Copy, Default)]
struct Along {
    /// Friction force, N; positive where it holds the belt back.
    friction: f64,
    /// Power lost in friction over the speed c, N.
    dissipated: f64,
    /// Unstretched length, m.
    unstretched: f64,
    /// Largest friction over its limit, less 1.
    excess: f64,
}

/// A state with its checks, if it passes them.
pub(super) fn checked(drive: &Drive, mut state: LoopState) -> Result<LoopState, SolveError> {
    if let Contacts::Flat { contacts, .. } = &state.contacts {
        state.checks = checks(drive, &state, contacts);
    }
    match state.checks.iter().find(|check| !check.holds()) {
        Some(violated) => Err(SolveError::Violated(violated.clone())),
        None => Ok(state),
    }
}

fn checks(drive: &Drive, state: &LoopState, contacts: &[Contact]) -> Vec<Check> {
    let scale = contacts
        .iter()
        .map(|contact| contact.arc.entry())
        .fold(0.0, f64::max);
    let count = state.pulleys.len();
    let [mut torque, mut power, mut transmitted, mut excess] = [0.0_f64; 4];
    let mut unstretched = 0.0;
    let (mut hubs, mut polygon) = ([[0.0; 2]; 2], [0.0; 2]);
    let mut turned = 0.0;
    for (index, contact) in contacts.iter().enumerate() {
        let (stated, pulley) = (&drive.pulleys[index], &state.pulleys[index]);
        let rim = pulley.angular_speed * stated.radius / state.unstretched_speed;
        let along = along(contact, stated, rim);
        torque = torque.max((along.friction - pulley.torque / stated.radius).abs());
        power += along.dissipated + pulley.power / state.unstretched_speed;
        transmitted = transmitted.max((pulley.power / state.unstretched_speed).abs());
        excess = excess.max(along.excess);
        unstretched += along.unstretched;
        for (sum, load) in hubs.iter_mut().zip([pulley.hub_load, pulley.rest_hub_load]) {
            *sum = [sum[0] + load[0], sum[1] + load[1]];
        }
        let sense = state.layout.pulleys()[index].turns(drive.sense);
        turned += sense * drive.sense.sign() * pulley.wrap;

        let span = &state.spans[index];
        unstretched += span.length / (1.0 + span.tension / drive.belt.axial_stiffness);
        let start = state.layout.spans()[index].start;
        let arrived = state.layout.spans()[(index + count - 1) % count].end;
        let along = [span.direction.cos(), span.direction.sin()];
        for part in 0..2 {
            polygon[part] += span.length * along[part] + start[part] - arrived[part];
        }
    }
    let turned = turned / TAU - f64::from(drive.turning_number);
    let forces = state.spans.iter();
    let forces = forces.flat_map(|span| [span.tension, span.tractive_tension]);
    let slackest = forces.fold(state.rest_tension, f64::min);
    let length = [
        polygon[0],
        polygon[1],
        unstretched - state.unstretched_length,
    ];
    let hub = |[x, y]: [f64; 2]| f64::hypot(x, y);
    let check = |name, deviation| Check {
        name,
        deviation,
        limit: ALLOWED,
    };
    vec![
        check("torques of the pulleys from their friction", torque / scale),
        // A pulley that almost stalls the belt has far more power than the belt.
        check("power of the loop", power.abs() / scale.max(transmitted)),
        check(
            "hub forces in equilibrium",
            (hub(hubs[0]) / scale).max(hub(hubs[1]) / state.rest_tension),
        ),
        check(
            "closing of the loop and length of the unstretched belt",
            length.map(f64::abs).into_iter().fold(0.0, f64::max) / state.length,
        ),
        check("turning of the belt", turned.abs()),
        moment(drive, state),
        Check {
            name: "tensions above 0",
            deviation: (-slackest / scale).max(0.0),
            limit: 0.0,
        },
        check("friction within its limit", excess),
    ]
}

/// By how far the load of the tensioner and the hub load of its idler are out of equilibrium, running and at
/// rest, of the two what is nearer to its limit; 0 without a tensioner.
fn moment(drive: &Drive, state: &LoopState) -> Check {
    let check = |deviation, rounding| Check {
        name: "moment of the tensioner",
        deviation,
        limit: ALLOWED + rounding,
    };
    let Some(((index, tensioner), found)) = drive.tensioner().zip(state.tensioner.as_ref()) else {
        return check(0.0, 0.0);
    };
    let (pulley, count) = (&state.pulleys[index], state.pulleys.len());
    let off = |coordinate: f64, layout: &Layout, hub_load: [f64; 2], tensions: [f64; 2]| {
        let [_, velocity, _] = tensioner.guide.centre(coordinate).map(Vector2::from);
        let [load, _] = tensioner.load_at(coordinate);
        let hub_load = Vector2::from(hub_load);
        let scale = load.abs() + hub_load.norm() * velocity.norm();
        // A span turns by no more than the idler is moved across it over its length.
        let resolution = resolution(layout, &tensioner.guide);
        let spans = layout.spans_of(index).into_iter().zip(tensions);
        let turned = spans.map(|(span, tension)| {
            tension * span.normal().dot(&velocity).abs() * resolution / span.length
        });
        let deviation = (load + hub_load.dot(&velocity)).abs() / scale;
        check(deviation, turned.sum::<f64>() / scale)
    };
    let tensions =
        [(index + count - 1) % count, index].map(|span| state.spans[span].tractive_tension);
    let running = off(found.coordinate, &state.layout, pulley.hub_load, tensions);
    let rest = off(
        found.rest_coordinate,
        &state.rest_layout,
        pulley.rest_hub_load,
        [state.rest_tension; 2],
    );
    match running.deviation / running.limit >= rest.deviation / rest.limit {
        true => running,
        false => rest,
    }
}

/// Integrals along a contact with a pulley whose rim has `rim` times the speed of the unstretched belt.
fn along(contact: &Contact, pulley: &Pulley, rim: f64) -> Along {
    let (arc, belt) = (contact.arc, contact.arc.belt);
    let limit = belt.slip_rate(pulley.friction_coefficient, pulley.radius);
    let excess = Cell::new(0.0);
    // Friction per length, the power it takes over c, and unstretched length.
    let densities = |traction: f64, friction: f64| {
        excess.set(f64::max(excess.get(), friction / (limit * traction) - 1.0));
        let stretch = 1.0 + belt.strain(traction);
        let friction = arc.sense * friction;
        [friction, friction * (stretch - rim), stretch.recip()]
    };
    let mut sums = [0.0; 3];
    for zone in &contact.zones {
        let found = match zone.friction {
            Friction::Adhesion => {
                let length = zone.end - zone.start.arc_length;
                densities(zone.start.traction, 0.0).map(|density| length * density)
            }
            Friction::Slip => slipping(contact, zone, |traction| {
                densities(traction, arc.slip_rate * traction)
            }),
            Friction::Developing(_) => {
                contact.all_over(zone, &|place| densities(place.traction, place.friction))
            }
        };
        for (sum, part) in sums.iter_mut().zip(found) {
            *sum += part;
        }
    }
    let [friction, dissipated, unstretched] = sums;
    Along {
        friction,
        dissipated,
        unstretched,
        excess: excess.get(),
    }
}

/// Integrals of functions of the traction along a zone of slip.
fn slipping<const N: usize>(
    contact: &Contact,
    zone: &ContactZone,
    densities: impl Fn(f64) -> [f64; N],
) -> [f64; N] {
    let length = zone.end - zone.start.arc_length;
    let rate = contact.arc.sense * contact.arc.slip_rate;
    let panels = (rate * length / SLIP_PANEL).abs().ceil().max(1.0);
    let at = |y: f64| densities(zone.start.traction * (rate * y).exp());
    let mut sums = [0.0; N];
    let mut panel = 0.0;
    while panel < panels {
        let ends = [panel, panel + 1.0].map(|end| end / panels * length);
        for (sum, part) in sums.iter_mut().zip(integrals(ends, at)) {
            *sum += part;
        }
        panel += 1.0;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::examples;
    use crate::input;

    #[test]
    fn every_check_notices_what_it_is_for() {
        let text = examples::find("serpentine").unwrap().text;
        let mut drive = input::parse("serpentine.toml", text, &[]).unwrap();
        let state = crate::belt_loop::solve(&drive).unwrap();
        let noticed = |drive: &Drive, change: fn(&mut LoopState)| {
            let mut state = state.clone();
            change(&mut state);
            match checked(drive, state) {
                Ok(_) => "nothing",
                Err(SolveError::Violated(check)) => check.name,
                Err(error) => panic!("{error}"),
            }
        };
        assert_eq!(noticed(&drive, |_| ()), "nothing");
        /// What is changed, and the check that notices.
        type Change = (fn(&mut LoopState), &'static str);
        let changes: [Change; 7] = [
            (|state| state.pulleys[0].torque *= 1.0 + 1e-6, "torques of"),
            (|state| state.pulleys[0].power *= 1.0 + 1e-6, "power of"),
            (|state| state.pulleys[1].hub_load[0] += 1e-2, "hub forces"),
            (|state| state.spans[0].length *= 1.0 + 1e-6, "closing of"),
            (|state| state.pulleys[0].wrap += 1e-6, "turning of"),
            (
                |state| state.tensioner.as_mut().unwrap().coordinate += 1e-4,
                "moment of",
            ),
            (
                |state| state.spans[0].tractive_tension = -1.0,
                "tensions above",
            ),
        ];
        for (change, name) in changes {
            let found = noticed(&drive, change);
            assert!(found.starts_with(name), "{name}: {found}");
        }
        for pulley in &mut drive.pulleys {
            pulley.friction_coefficient *= 1.0 - 1e-6;
        }
        assert_eq!(noticed(&drive, |_| ()), "friction within its limit");
    }
}
