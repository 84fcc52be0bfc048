//! The belt along a pulley as points, and its zones as angles.

use super::contact::{Contact, Place};
use crate::{Belt, BeltKind, NormalForce, Profile, Zone};
use std::f64::consts::FRAC_PI_2;

/// Points of a profile: at least so many on a pulley, and in a panel of a zone.
const POINTS: usize = 240;
const PANEL_POINTS: usize = 4;

/// The belt along a pulley of a radius in m, in SI units; `speed` is that of the unstretched belt, m/s.
pub(crate) fn profile(contact: &Contact, belt: Belt, radius: f64, speed: f64) -> Profile {
    let flow = belt.mass_per_length * speed;
    let thesis = BeltKind::Flat {
        normal_force: NormalForce::Thesis,
    };
    let mut profile = Profile::default();
    let mut push = |place: &Place| {
        let tension = contact.arc.belt.tension(place.traction);
        let tractive = tension - flow * speed * (1.0 + tension / belt.axial_stiffness);
        let pressing = if belt.kind == thesis {
            tension
        } else {
            tractive
        };
        profile.angle.push(place.arc_length / radius);
        profile.arc_length.push(place.arc_length);
        profile.tension.push(tension);
        profile.tractive_tension.push(tractive);
        profile.inclination.push(0.0);
        profile.penetration.push(0.0);
        profile
            .displacement
            .push(contact.arc.sense * place.displacement);
        profile.sliding_angle.push(contact.arc.sense * FRAC_PI_2);
        profile.normal_force.push(pressing / radius);
        profile.friction_force.push(place.friction);
    };
    let panels: Vec<_> = contact
        .zones
        .iter()
        .map(|zone| contact.panels(zone))
        .collect();
    let count: usize = panels.iter().map(|panels| panels.len() - 1).sum();
    let points = POINTS.div_ceil(count.max(1)).max(PANEL_POINTS);
    for (zone, panels) in contact.zones.iter().zip(&panels) {
        push(&contact.at(zone, 0.0));
        for panel in panels.windows(2) {
            for point in 1..=points {
                let share = point as f64 / points as f64;
                push(&contact.at(zone, panel[0] + share * (panel[1] - panel[0])));
            }
        }
    }
    profile
}

/// The zones of a contact with a pulley of a radius in m, in the order in which the belt passes them.
pub(crate) fn zones(contact: &Contact, radius: f64) -> Vec<Zone> {
    let zones = contact.zones.iter();
    zones
        .map(|zone| Zone {
            kind: zone.friction.kind(),
            from: zone.start.arc_length / radius,
            to: zone.end / radius,
        })
        .collect()
}
