//! The closed form as a steady state: profiles, powers, and the invariants it has to satisfy.

use super::closed_form::ClosedForm;
use super::{DRIVEN, DRIVER};
use crate::friction::epp;
use crate::friction::rim::contact::Contact;
use crate::friction::rim::profile::profile;
use crate::results::possible;
use crate::results::state_summary::speed_loss;
use crate::results::warning::large_strain;
use crate::{
    Check, Convergence, Drive, Entry, FrictionLaw, PulleyState, PulleySummary, StateSummary,
    SteadyState,
};
use web_time::Instant;

/// The whole steady state.
pub(super) fn steady_state(drive: &Drive, solved: &ClosedForm, start: Instant) -> SteadyState {
    let integrals = Integrals::of_both(drive, solved);
    let found = scalars(drive, solved, &integrals);
    let tight = found.tight_tension;
    let against_rims = solved.contact.iter().map(|contact| contact.strain);
    let checks = checks(solved, &integrals, &found).to_vec();
    let pulley = |index, summary| pulley_state(drive, solved, index, summary);
    let mut state = SteadyState {
        drive: drive.clone(),
        mass_flow: found.mass_flow,
        belt_length: found.belt_length,
        slack_span: found.slack_span,
        tight_span: found.tight_span,
        slack_tension: found.slack_tension,
        tight_tension: tight,
        slack_tractive_tension: found.slack_tractive_tension,
        tight_tractive_tension: found.tight_tractive_tension,
        efficiency: found.efficiency,
        friction_loss: found.friction_loss,
        compression_power: found.compression_power,
        driver: pulley(DRIVER, found.driver),
        driven: pulley(DRIVEN, found.driven),
        warnings: Vec::from_iter(large_strain(&drive.belt, drive.law, tight, against_rims)),
        checks,
        convergence: Convergence {
            newton_iterations: solved.evaluations,
            ..Convergence::default()
        },
        restart: None,
    };
    state.checks.extend(possible::checks(&state));
    state.convergence.error_estimate = closing_error(solved);
    state.convergence.seconds = start.elapsed().as_secs_f64();
    state
}

/// The scalars of the steady state, a quarter of the work; `None` if the friction along the pulleys does not agree with
/// them.
pub(super) fn summary(drive: &Drive, solved: &ClosedForm) -> Option<StateSummary> {
    let integrals = Integrals::of_both(drive, solved);
    let found = scalars(drive, solved, &integrals);
    let checks = checks(solved, &integrals, &found);
    checks.iter().all(Check::holds).then_some(found)
}

/// The scalars of the steady state.
fn scalars(drive: &Drive, solved: &ClosedForm, integrals: &[Integrals; 2]) -> StateSummary {
    let axial = drive.belt.axial_stiffness;
    let flow = drive.belt.mass_per_length * solved.speed;
    let share = 1.0 - flow * solved.speed / axial;
    let tractive = |tension: f64| tension * share - flow * solved.speed;
    let [slack, tight] = solved.tension;
    let [driven, driver] = [DRIVEN, DRIVER].map(|pulley| pulley_summary(drive, solved, pulley));
    let unstretched = |span: f64, tension: f64| span / (1.0 + tension / axial);
    let on_pulleys = integrals.iter().map(|integrals| integrals.unstretched);
    let span = solved.geometry.span;
    let pair = drive.pair();
    let at_pitch = |pulley: &PulleySummary, radius: f64| pulley.angular_speed * radius;
    let rims = [
        at_pitch(&driven, pair.driven_radius),
        at_pitch(&driver, pair.driver_radius),
    ];
    StateSummary {
        mass_flow: flow,
        belt_length: on_pulleys.sum::<f64>() + unstretched(span, slack) + unstretched(span, tight),
        slack_span: span,
        tight_span: span,
        slack_tension: slack,
        tight_tension: tight,
        slack_tractive_tension: tractive(slack),
        tight_tractive_tension: tractive(tight),
        speed_loss: speed_loss(rims),
        // Both pulleys have the same friction force, so that the powers are as the speeds of the rims.
        efficiency: solved.rim_speed(DRIVEN) / solved.rim_speed(DRIVER),
        friction_loss: driver.power() - driven.power(),
        compression_power: 0.0,
        driver,
        driven,
        error_estimate: Some(closing_error(solved)),
    }
}

/// What is integrated along the contact with a pulley.
struct Integrals {
    /// Length of the unstretched belt on it, m.
    unstretched: f64,
    /// Friction, N.
    friction: f64,
    /// Power that friction takes, W.
    dissipated: f64,
}

impl Integrals {
    fn of_both(drive: &Drive, solved: &ClosedForm) -> [Self; 2] {
        let axial = drive.belt.axial_stiffness;
        [DRIVEN, DRIVER].map(|pulley| Self::of(solved, pulley, axial))
    }

    fn of(solved: &ClosedForm, pulley: usize, axial: f64) -> Self {
        let contact = &solved.contact[pulley];
        let belt = &contact.arc.belt;
        let rim = solved.rim_speed(pulley);
        let [unstretched, friction, dissipated] = contact.integrals(|place| {
            let stretch = 1.0 + belt.tension(place.traction) / axial;
            // Friction works against the slip velocity |V − R ω|.
            let slip = solved.speed * (1.0 + belt.strain(place.traction)) - rim;
            let friction = place.friction;
            [stretch.recip(), friction, friction * slip.abs()]
        });
        Self {
            unstretched,
            friction,
            dissipated,
        }
    }
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

/// The scalars of one pulley in SI units.
fn pulley_summary(drive: &Drive, solved: &ClosedForm, pulley: usize) -> PulleySummary {
    let contact = &solved.contact[pulley];
    let arc = contact.arc;
    let pair = drive.pair();
    let radius = [pair.driven_radius, pair.driver_radius][pulley];
    PulleySummary {
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
    }
}

/// One pulley with the belt along it.
fn pulley_state(
    drive: &Drive,
    solved: &ClosedForm,
    pulley: usize,
    found: PulleySummary,
) -> PulleyState {
    let pair = drive.pair();
    let radius = [pair.driven_radius, pair.driver_radius][pulley];
    PulleyState {
        angular_speed: found.angular_speed,
        torque: found.torque,
        wrap_angle: found.wrap_angle,
        geometric_wrap_angle: found.geometric_wrap_angle,
        max_penetration: found.max_penetration,
        inclination: found.inclination,
        zones: found.zones,
        entry: found.entry,
        least_slip: found.least_slip,
        profile: profile(&solved.contact[pulley], drive.belt, radius, solved.speed),
    }
}

/// The invariants, from the friction law along the profile and not from the equations that were solved.
fn checks(solved: &ClosedForm, integrals: &[Integrals; 2], found: &StateSummary) -> [Check; 3] {
    let limit = possible::OF_CLOSED_FORM;
    let torque = |pulley: usize| {
        let arc = &solved.contact[pulley].arc;
        (integrals[pulley].friction - arc.change).abs() / arc.entry().max(arc.exit())
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
    let lost = integrals[DRIVEN].dissipated + integrals[DRIVER].dissipated;
    let transmitted = solved.tension[1] * solved.speed;
    let power = Check {
        name: "friction loss from friction and slip",
        deviation: (lost - found.friction_loss).abs() / transmitted,
        limit,
    };
    [driven, driver, power]
}
