//! Made-up but plausible states of a flat belt on unequal pulleys, for the tests of reports and
//! figures.

use super::branch as v_branch;
use crate::{
    Belt, BeltKind, Branch, BranchEnd, BranchEvent, Check, Convergence, Drive, Entry, EventKind,
    FrictionLaw, LimitCurve, LimitReason, Load, NormalForce, Profile, PulleyState, Role,
    SpanTension, StateSummary, SteadyState, TraceConvergence, TracePoint, TwoPulleys, Zone,
    ZoneKind, input::Key,
};
use std::f64::consts::{FRAC_PI_2, PI};

const DRIVER_RADIUS: f64 = 0.1;
const DRIVEN_RADIUS: f64 = 0.15;
const CENTRE_DISTANCE: f64 = 0.6;
const SPEED: f64 = 250.0;
const COEFFICIENT: f64 = 0.6;
const STIFFNESS: f64 = 5e7;
const AXIAL_STIFFNESS: f64 = 2e5;
const MASS: f64 = 0.12;
const POINTS: usize = 201;

/// Tractive tension of the slack span and a usual and the largest one of the tight span, N.
const SLACK: f64 = 100.0;
const TIGHT: f64 = 420.0;
const LARGEST: f64 = 560.0;

/// Elastic/perfectly-plastic friction: an elastic and a slip zone on both pulleys.
pub(crate) fn epp() -> SteadyState {
    let stiffness = STIFFNESS;
    state(FrictionLaw::Epp { stiffness }, TIGHT)
}

/// Coulomb friction: an adhesion and a slip zone on both pulleys.
pub(crate) fn coulomb() -> SteadyState {
    state(FrictionLaw::Coulomb, TIGHT)
}

/// Creep-rate friction: a creep and a slip zone on both pulleys.
pub(crate) fn creep() -> SteadyState {
    state(FrictionLaw::CreepRate { velocity: 0.05 }, TIGHT)
}

/// A branch over the tight tension from no slip to gross slip on the driver.
pub(crate) fn branch() -> Branch {
    let drive = epp().drive;
    let appears = EventKind::ZoneAppears {
        pulley: Role::Driven,
        kind: ZoneKind::Slip,
    };
    let events = [
        (EventKind::Start, 0.0),
        (appears, 0.02),
        (EventKind::GrossSlip(Role::Driver), 1.0),
    ];
    Branch {
        key: Key::load(&drive),
        drive,
        points: (0..=40).map(|step| point(f64::from(step) / 40.0)).collect(),
        events: events
            .into_iter()
            .map(|(kind, at)| BranchEvent {
                kind,
                point: point(at),
                value_error: Some(1e-9),
                errors: None,
            })
            .collect(),
        end: BranchEnd::GrossSlip(Role::Driver),
        convergence: TraceConvergence {
            tolerance: 1e-6,
            continuation_steps: 41,
            seconds: 0.002,
            ..TraceConvergence::default()
        },
    }
}

/// Its limit over the coefficient of friction.
pub(crate) fn curve() -> LimitCurve {
    let mut curve = v_branch::curve();
    for (share, limit) in (0..).zip(&mut curve.points) {
        limit.reason = LimitReason::Capstan(match limit.reason {
            LimitReason::DriverSlips => Role::Driver,
            _ => Role::Driven,
        });
        limit.state = point(f64::from(share) / 40.0).state;
    }
    let drive = epp().drive;
    LimitCurve { drive, ..curve }
}

/// The state at an arclength from 0 to 1.
fn point(arclength: f64) -> TracePoint {
    let value = SLACK + (LARGEST - SLACK) * arclength;
    let stiffness = STIFFNESS;
    TracePoint {
        value,
        arclength,
        state: StateSummary::from(&state(FrictionLaw::Epp { stiffness }, value)),
    }
}

/// A state at a tractive tension of the tight span, N.
fn state(law: FrictionLaw, tight: f64) -> SteadyState {
    let rim = SPEED * DRIVER_RADIUS;
    let inertia = MASS * rim * rim;
    let loss = 0.8 * (tight - SLACK) / AXIAL_STIFFNESS;
    let lag = ((DRIVEN_RADIUS - DRIVER_RADIUS) / CENTRE_DISTANCE).asin();
    let span = CENTRE_DISTANCE * lag.cos();
    let driver = Contact {
        law,
        radius: DRIVER_RADIUS,
        wrap: PI - 2.0 * lag,
        sign: -1.0,
        ends: [tight, SLACK],
        inertia,
    };
    let driven = Contact {
        radius: DRIVEN_RADIUS,
        wrap: PI + 2.0 * lag,
        sign: 1.0,
        ends: [SLACK, tight],
        ..driver
    };
    let power = (tight - SLACK) * rim;
    let check = |name, deviation| Check {
        name,
        deviation,
        limit: 1e-9,
    };
    SteadyState {
        drive: Drive {
            title: Some("Flat belt, \"made up\" <&>".to_owned()),
            ..drive(law, tight).into()
        },
        mass_flow: MASS * rim,
        belt_length: 2.0 * span + driver.wrap * driver.radius + driven.wrap * driven.radius,
        slack_span: span,
        tight_span: span,
        slack_tension: SLACK + inertia,
        tight_tension: tight + inertia,
        slack_tractive_tension: SLACK,
        tight_tractive_tension: tight,
        efficiency: 1.0 - loss,
        friction_loss: loss * power,
        compression_power: 0.0,
        driver: driver.pulley(SPEED),
        driven: driven.pulley((1.0 - loss) * rim / DRIVEN_RADIUS),
        warnings: Vec::new(),
        checks: vec![
            check("power balance", 2.4e-15),
            check("torque of the driven pulley from its friction", 3.1e-11),
        ],
        convergence: Convergence {
            error_estimate: 1.2e-14,
            newton_iterations: 11,
            seconds: 2.3e-5,
            ..Convergence::default()
        },
        restart: None,
    }
}

fn drive(law: FrictionLaw, tight: f64) -> TwoPulleys {
    TwoPulleys {
        belt: Belt {
            ribs: 1,
            mass_per_length: MASS,
            axial_stiffness: AXIAL_STIFFNESS,
            kind: BeltKind::Flat {
                normal_force: NormalForce::Inertia,
            },
        },
        friction_coefficient: COEFFICIENT,
        law,
        driver_radius: DRIVER_RADIUS,
        driver_speed: SPEED,
        driven_radius: DRIVEN_RADIUS,
        centre_distance: CENTRE_DISTANCE,
        load: Load {
            slack: SpanTension::Tractive(SLACK),
            tight: SpanTension::Tractive(tight),
        },
    }
}

/// The belt on a pulley: a zone with little friction, then slip.
#[derive(Clone, Copy)]
struct Contact {
    law: FrictionLaw,
    radius: f64,
    wrap: f64,
    /// 1 where the tension rises, −1 where it falls.
    sign: f64,
    /// Tractive tensions at entry and exit, N.
    ends: [f64; 2],
    inertia: f64,
}

impl Contact {
    /// The first zone and how fast its friction grows towards the slip zone, per radian.
    fn first_zone(&self) -> (ZoneKind, f64) {
        match self.law {
            FrictionLaw::Coulomb => (ZoneKind::Adhesion, f64::INFINITY),
            FrictionLaw::CreepRate { .. } => (ZoneKind::Creep, 4.0),
            _ => (ZoneKind::Elastic, 20.0),
        }
    }

    fn pulley(&self, angular_speed: f64) -> PulleyState {
        let (kind, rate) = self.first_zone();
        let [entry, exit] = self.ends;
        let share = self.sign * COEFFICIENT / rate;
        // The tension where slip begins, and the arc that carries the rest.
        let middle = entry / (1.0 - share);
        let slip = self.sign * (exit / middle).ln() / COEFFICIENT;
        let from = (self.wrap - slip).clamp(0.0, self.wrap);
        let zone = |kind, from, to| Zone { kind, from, to };
        let zones = [zone(kind, 0.0, from), zone(ZoneKind::Slip, from, self.wrap)];
        PulleyState {
            angular_speed,
            torque: self.sign * (exit - entry) * self.radius,
            wrap_angle: self.wrap,
            geometric_wrap_angle: self.wrap,
            max_penetration: 0.0,
            inclination: [0.0; 2],
            zones: zones
                .into_iter()
                .filter(|zone| zone.from < zone.to)
                .collect(),
            least_slip: None,
            entry: Some(Entry {
                reference_tension: entry + self.inertia - self.sign * 0.05,
                strain: self.sign * 0.05 / AXIAL_STIFFNESS,
                smallest_stiffness: (kind == ZoneKind::Elastic).then_some(7.654_321e5),
            }),
            profile: self.profile(middle, from, rate),
        }
    }

    fn profile(&self, middle: f64, from: f64, rate: f64) -> Profile {
        let mut profile = Profile::default();
        let share = self.sign * COEFFICIENT / rate;
        for point in 0..POINTS {
            let angle = self.wrap * point as f64 / (POINTS - 1) as f64;
            // How much of its largest value friction has.
            let (tension, rise) = if angle < from {
                let rise = (-rate * (from - angle)).exp();
                (middle * (1.0 - share * (1.0 - rise)), rise)
            } else {
                let grown = (self.sign * COEFFICIENT * (angle - from)).exp();
                (middle * grown, 1.0)
            };
            let force = COEFFICIENT * tension / self.radius;
            let slid = self.radius * (tension - middle) / (COEFFICIENT * AXIAL_STIFFNESS);
            let slid = if angle < from { 0.0 } else { slid };
            profile.angle.push(angle);
            profile.arc_length.push(self.radius * angle);
            profile.tension.push(tension + self.inertia);
            profile.tractive_tension.push(tension);
            profile.inclination.push(0.0);
            profile.penetration.push(0.0);
            let held = self.sign * rise * force / STIFFNESS;
            profile.displacement.push(held + slid);
            profile.sliding_angle.push(self.sign * FRAC_PI_2);
            profile.normal_force.push(force / COEFFICIENT);
            profile.friction_force.push(rise * force);
        }
        profile
    }
}
