//! Made-up but plausible branches, for the tests of reports and figures.

use super::v_belt;
use crate::input::Key;
use crate::{
    Branch, BranchEnd, BranchEvent, EventKind, LimitCurve, LimitCurvePoint, LimitReason,
    PulleyErrors, Role, StateErrors, StateSummary, TraceConvergence, TracePoint,
};

/// Tight tension at the limit point, N, and where on the branch of arclength 1 it lies.
const LARGEST: f64 = 8221.013;
const FOLD: f64 = 0.8;

/// A branch from 700 N over a limit point, where the driver's exit overhangs.
pub(crate) fn folded() -> Branch {
    let drive = v_belt::loaded().drive;
    let points: Vec<_> = (0..=60).map(|step| point(f64::from(step) / 60.0)).collect();
    let events = [
        (EventKind::Start, 0.0),
        (EventKind::Overhang(Role::Driver), 0.72),
        (EventKind::LimitPoint, FOLD),
        (EventKind::End, 1.0),
    ];
    Branch {
        key: Key::load(&drive),
        drive,
        points,
        events: events.map(|(kind, at)| event(kind, at)).to_vec(),
        end: BranchEnd::Target,
        convergence: TraceConvergence {
            tolerance: 1e-6,
            slip_normalisation: 1e-7,
            continuation_steps: 64,
            newton_iterations: 312,
            rhs_evaluations: 90_112,
            factorisations: 181,
            seconds: 0.42,
        },
    }
}

/// Its limit over the coefficient of friction, of two kinds.
pub(crate) fn curve() -> LimitCurve {
    let branch = folded();
    let second = Key::all(&branch.drive)
        .find(|key| key.path() == "friction.coefficient")
        .expect("a key of every drive");
    let points = (0..=20).map(|step| {
        let second = 0.2 + 0.02 * f64::from(step);
        LimitCurvePoint {
            second,
            value: 100.0 * (11.0 * second).exp().min(4000.0 * second.powi(4)),
            value_error: Some(0.01),
            reason: if second < 0.35 {
                LimitReason::DriverSlips
            } else {
                LimitReason::Overhang
            },
            state: point(second).state,
        }
    });
    LimitCurve {
        key: branch.key,
        second,
        drive: branch.drive,
        points: points.collect(),
        cusps: Vec::new(),
        end: BranchEnd::Target,
        convergence: branch.convergence,
    }
}

fn event(kind: EventKind, arclength: f64) -> BranchEvent {
    let errors = PulleyErrors {
        angular_speed: 2e-4,
        torque: 3e-3,
        wrap_angle: 1e-5,
        max_penetration: 1e-8,
        inclination: [1e-6, 2e-5],
    };
    BranchEvent {
        kind,
        point: point(arclength),
        value_error: Some(0.004),
        errors: Some(StateErrors {
            efficiency: 1e-6,
            driver: errors,
            driven: errors,
        }),
    }
}

/// The state at an arclength from 0 to 1.
fn point(arclength: f64) -> TracePoint {
    let value = LARGEST - (LARGEST - 700.0) * (1.0 - arclength / FOLD).powi(2);
    let mut state = StateSummary::from(&v_belt::loaded());
    let lost = 0.02 + 0.6 * arclength.powi(4);
    state.speed_loss = lost;
    state.efficiency = 1.0 - lost - 0.02;
    state.tight_tractive_tension = value;
    state.tight_tension = value + 71.0;
    state.driven.angular_speed = (1.0 - lost) * state.driver.angular_speed;
    state.error_estimate = None;
    for (pulley, share) in [(&mut state.driver, 0.7), (&mut state.driven, 1.8)] {
        pulley.torque = 0.25 * (value - 100.0);
        pulley.wrap_angle += share * arclength.powi(2);
        pulley.inclination[1] += 2.143 * arclength * share / 0.7;
        pulley.max_penetration *= value / 700.0;
    }
    state.driven.inclination[1] = 0.3;
    TracePoint {
        value,
        arclength,
        state,
    }
}
