//! Made-up but plausible states with exact plane geometry, for the tests of reports and figures.

use crate::{
    Belt, BeltKind, Check, Convergence, Drive, FrictionLaw, Load, Profile, PulleyState, Role,
    SpanTension, SteadyState, TwoPulleys, VBelt, Warning, Zone, ZoneKind,
};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const RADIUS: f64 = 0.25;
const CENTRE_DISTANCE: f64 = 1.393;
const POINTS: usize = 201;

/// A drive that transmits power.
pub(crate) fn loaded() -> SteadyState {
    state([100.0, 700.0], 0.0)
}

/// A standing drive without a load or friction zones.
pub(crate) fn idle() -> SteadyState {
    let mut state = state([100.0, 100.0], 0.0);
    for pulley in [&mut state.driver, &mut state.driven] {
        pulley.angular_speed = 0.0;
        pulley.zones.clear();
        pulley.profile.tension.fill(state.slack_tension);
        pulley
            .profile
            .tractive_tension
            .fill(state.slack_tractive_tension);
    }
    state
}

/// A drive whose belt leaves the driver at more than 90°.
pub(crate) fn overhanging() -> SteadyState {
    let mut state = state([100.0, 7000.0], 1.9);
    let inclination = state.driver.inclination[1];
    state.warnings.push(Warning::Overhang {
        pulley: Role::Driver,
        inclination,
    });
    state
}

/// A standing drive without a profile.
pub(crate) fn blank() -> SteadyState {
    let mut state = idle();
    for pulley in [&mut state.driver, &mut state.driven] {
        pulley.profile = Profile::default();
        pulley.max_penetration = 0.0;
    }
    state
}

/// Tractive tensions of the slack and the tight span, N, and what the inclination at the exit of
/// the driver has in excess of a plausible one, rad.
fn state([slack, tight]: [f64; 2], overhang: f64) -> SteadyState {
    let drive = drive(slack, tight);
    let rate = (stiffness(&drive) * RADIUS * RADIUS / tight).sqrt();
    let slope = |tension: f64| tension * rate / (stiffness(&drive) * RADIUS * RADIUS);
    let driven_ends = [-slope(slack), slope(tight)];
    let driver_ends = [-slope(tight), slope(slack) + overhang];

    // Each span seen along its belt, and the polar angle of the line of centres in that view.
    let (tight_span, tight_view) = span(driven_ends[1], driver_ends[0]);
    let (slack_span, slack_view) = span(driver_ends[1], driven_ends[0]);
    let turning = PI + tight_view - slack_view;
    let driver_wrap = turning + driver_ends[1] - driver_ends[0];
    let driven_wrap = TAU - turning + driven_ends[1] - driven_ends[0];

    let speed = drive.driver_speed;
    let inertia = 71.0;
    let torque = (tight - slack) * RADIUS;
    let pulley = |angular_speed, wrap_angle, inclination, profile: Profile, zones| PulleyState {
        angular_speed,
        torque,
        wrap_angle,
        geometric_wrap_angle: PI,
        max_penetration: profile.penetration.iter().copied().fold(0.0, f64::max),
        inclination,
        zones,
        entry: None,
        least_slip: None,
        profile,
    };
    let profile = |wrap, from, to, excess| profile(&drive, wrap, [from, to], rate, excess);
    let zone = |kind, from, to| Zone { kind, from, to };
    let driver = pulley(
        speed,
        driver_wrap,
        driver_ends,
        profile(driver_wrap, tight, slack, overhang),
        vec![zone(ZoneKind::Slip, 0.0, driver_wrap)],
    );
    let driven = pulley(
        0.98 * speed,
        driven_wrap,
        driven_ends,
        profile(driven_wrap, slack, tight, 0.0),
        vec![
            zone(ZoneKind::Elastic, 0.0, 1.7),
            zone(ZoneKind::Slip, 1.7, driven_wrap - 0.25),
            zone(ZoneKind::Elastic, driven_wrap - 0.25, driven_wrap),
        ],
    );
    SteadyState {
        mass_flow: 2.768,
        belt_length: 4.361,
        slack_span,
        tight_span,
        slack_tension: slack + inertia,
        tight_tension: tight + inertia,
        slack_tractive_tension: slack,
        tight_tractive_tension: tight,
        efficiency: 0.962_380,
        friction_loss: 0.037_620 * torque * speed,
        compression_power: 0.0,
        driver,
        driven,
        warnings: Vec::new(),
        checks: vec![
            Check {
                name: "closure of the belt",
                deviation: 3.2e-12,
                limit: 1e-6,
            },
            Check {
                name: "power balance",
                deviation: 2.4e-9,
                limit: 1e-6,
            },
        ],
        convergence: Convergence {
            tolerance: 1e-8,
            defect: 6.1e-9,
            error_estimate: 3.4e-9,
            mesh_intervals: [48, 56],
            newton_iterations: 27,
            rhs_evaluations: 11_232,
            factorisations: 27,
            continuation_steps: 3,
            slip_normalisation: 1e-8,
            slip_normalisation_effect: 2.0e-7,
            seconds: 0.0123,
        },
        restart: None,
        drive: Drive {
            title: Some("Equal pulleys, \"made up\" <&>".to_owned()),
            ..drive.into()
        },
    }
}

fn drive(slack: f64, tight: f64) -> TwoPulleys {
    TwoPulleys {
        belt: Belt {
            ribs: 1,
            mass_per_length: 0.108,
            axial_stiffness: 120e3,
            kind: BeltKind::V(VBelt {
                radial_stiffness: 900e3,
                half_angle: PI / 10.0,
                height: None,
            }),
        },
        friction_coefficient: 0.4,
        law: FrictionLaw::Epp { stiffness: 8.1e6 },
        driver_radius: RADIUS,
        driver_speed: 1000.0 * PI / 30.0,
        driven_radius: RADIUS,
        centre_distance: CENTRE_DISTANCE,
        load: Load {
            slack: SpanTension::Tractive(slack),
            tight: SpanTension::Tractive(tight),
        },
    }
}

/// Radial stiffness of the belt in its groove, N/m².
fn stiffness(drive: &TwoPulleys) -> f64 {
    let belt = drive.belt.v();
    belt.radial_stiffness * belt.half_angle.tan()
}

/// Length of a span between the belt's inclination at an exit and at the next entry, and the
/// polar angle of the line of centres measured from the direction of the span.
fn span(exit: f64, entry: f64) -> (f64, f64) {
    let across = RADIUS * (entry.cos() - exit.cos());
    let along = (CENTRE_DISTANCE * CENTRE_DISTANCE - across * across).sqrt();
    (
        along - RADIUS * (exit.sin() - entry.sin()),
        across.atan2(along),
    )
}

/// Tractive tension from one end value to the other, penetration with boundary layers of a rate.
fn profile(
    drive: &TwoPulleys,
    wrap: f64,
    [from, to]: [f64; 2],
    rate: f64,
    overhang: f64,
) -> Profile {
    let mut profile = Profile::default();
    let stiffness = stiffness(drive) * RADIUS;
    for point in 0..POINTS {
        let angle = wrap * point as f64 / (POINTS - 1) as f64;
        let [entry, exit] = [(-rate * angle).exp(), (-rate * (wrap - angle)).exp()];
        let tension = from * (to / from).powf(angle / wrap);
        let penetration = tension / stiffness * (1.0 - entry) * (1.0 - exit);
        let slope = tension / stiffness * rate * (entry - exit);
        profile.angle.push(angle);
        profile.arc_length.push(RADIUS * angle);
        profile.tension.push(tension + 71.0);
        profile.tractive_tension.push(tension);
        profile.penetration.push(penetration);
        profile
            .inclination
            .push(overhang * exit.powi(3) - slope / RADIUS);
        profile.displacement.push(1e-3 * RADIUS * angle);
        profile
            .sliding_angle
            .push((from - to).signum() * FRAC_PI_2 * (1.0 + entry - exit));
        profile
            .normal_force
            .push(0.5 * drive.belt.v().radial_stiffness * penetration);
        profile
            .friction_force
            .push(0.2 * drive.belt.v().radial_stiffness * penetration);
    }
    profile
}
