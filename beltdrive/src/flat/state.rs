//! The closed form as a steady state: profiles, powers, and the invariants it has to satisfy.

use super::closed_form::ClosedForm;
use super::{DRIVEN, DRIVER};
use crate::friction::epp;
use crate::friction::rim::contact::{Contact, Place};
use crate::friction::rim::profile::profile;
use crate::results::possible;
use crate::results::warning::large_strain;
use crate::{Check, Convergence, Drive, Entry, FrictionLaw, PulleyState, SteadyState};
use web_time::Instant;

/// The whole steady state.
pub(super) fn steady_state(drive: &Drive, solved: &ClosedForm, start: Instant) -> SteadyState {
    let belt = drive.belt;
    let axial = belt.axial_stiffness;
    let flow = belt.mass_per_length * solved.speed;
    let share = 1.0 - flow * solved.speed / axial;
    let tractive = |tension: f64| tension * share - flow * solved.speed;
    let [slack, tight] = solved.tension;
    let [driven, driver] = [DRIVEN, DRIVER].map(|pulley| pulley_state(drive, solved, pulley));
    let powers = [&driven, &driver].map(|pulley| pulley.torque * pulley.angular_speed);
    let unstretched = |span: f64, tension: f64| span / (1.0 + tension / axial);
    let on_pulleys = solved.contact.iter().map(|contact| {
        let stretch = |place: &Place| 1.0 + contact.arc.belt.tension(place.traction) / axial;
        contact.integral(|place| stretch(place).recip())
    });
    let span = solved.geometry.span;
    let against_rims = solved.contact.iter().map(|contact| contact.strain);
    let mut state = SteadyState {
        drive: drive.clone(),
        mass_flow: flow,
        belt_length: on_pulleys.sum::<f64>() + unstretched(span, slack) + unstretched(span, tight),
        slack_span: span,
        tight_span: span,
        slack_tension: slack,
        tight_tension: tight,
        slack_tractive_tension: tractive(slack),
        tight_tractive_tension: tractive(tight),
        // Both pulleys have the same friction force, so that the powers are as the speeds of the rims.
        efficiency: solved.rim_speed(DRIVEN) / solved.rim_speed(DRIVER),
        friction_loss: powers[DRIVER] - powers[DRIVEN],
        compression_power: 0.0,
        driver,
        driven,
        warnings: Vec::from_iter(large_strain(&drive.belt, drive.law, tight, against_rims)),
        checks: Vec::new(),
        convergence: Convergence {
            newton_iterations: solved.evaluations,
            ..Convergence::default()
        },
        restart: None,
    };
    state.checks = checks(solved, &state);
    state.checks.extend(possible::checks(&state));
    state.convergence.error_estimate = closing_error(solved);
    state.convergence.seconds = start.elapsed().as_secs_f64();
    state
}

/// How far the tractions at the ends of both pulleys are off, relative; at least the rounding of
/// doubles.
fn closing_error(solved: &ClosedForm) -> f64 {
    let off = |contact: &Contact| {
        let last = contact.zones.last().map(|zone| contact.end(zone).traction);
        last.map_or(0.0, |traction| (traction / contact.arc.exit() - 1.0).abs())
    };
    let [driven, driver] = &solved.contact;
    off(driven).max(off(driver)).max(4.0 * f64::EPSILON)
}

/// One pulley in SI units.
fn pulley_state(drive: &Drive, solved: &ClosedForm, pulley: usize) -> PulleyState {
    let contact = &solved.contact[pulley];
    let arc = contact.arc;
    let pair = drive.pair();
    let radius = [pair.driven_radius, pair.driver_radius][pulley];
    PulleyState {
        angular_speed: match pulley {
            DRIVER => pair.driver_speed,
            _ => solved.rim_speed(pulley) / radius,
        },
        torque: arc.change * radius,
        wrap_angle: solved.geometry.wrap[pulley],
        geometric_wrap_angle: solved.geometry.wrap[pulley],
        max_penetration: 0.0,
        inclination: [0.0; 2],
        zones: solved.zones_on(pulley),
        entry: Some(Entry {
            reference_tension: arc.belt.tension(contact.reference()),
            // No strain has no sign.
            strain: arc.sense * contact.strain + 0.0,
            smallest_stiffness: match drive.law {
                FrictionLaw::Epp { .. } => epp::smallest_stiffness(arc),
                _ => None,
            },
        }),
        least_slip: None,
        profile: profile(contact, drive.belt, radius, solved.speed),
    }
}

/// The invariants, from the friction law along the profile and not from the equations that were solved.
fn checks(solved: &ClosedForm, state: &SteadyState) -> Vec<Check> {
    let limit = possible::accuracy(state);
    let torque = |pulley: usize| {
        let contact = &solved.contact[pulley];
        let friction = contact.integral(|place| place.friction);
        (friction - contact.arc.change).abs() / contact.arc.entry().max(contact.arc.exit())
    };
    let driven = Check {
        name: "torque of the driven pulley from its friction",
        deviation: torque(DRIVEN),
        limit,
    };
    let driver = Check {
        name: "torque of the driver from its friction",
        deviation: torque(DRIVER),
        limit,
    };
    // Friction works against the slip velocity |V − R ω|.
    let dissipated = |pulley: usize| {
        let contact = &solved.contact[pulley];
        let rim = solved.rim_speed(pulley);
        let slip =
            |place: &Place| solved.speed * (1.0 + contact.arc.belt.strain(place.traction)) - rim;
        contact.integral(|place| place.friction * slip(place).abs())
    };
    let lost = dissipated(DRIVEN) + dissipated(DRIVER);
    let transmitted = solved.tension[1] * solved.speed;
    let power = Check {
        name: "friction loss from friction and slip",
        deviation: (lost - state.friction_loss).abs() / transmitted,
        limit,
    };
    vec![driven, driver, power]
}
