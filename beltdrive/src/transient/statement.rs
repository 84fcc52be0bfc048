//! What is refused of a statement.

use super::axle::{Axle, Motion, Motor};
use super::mesh::{LEAST_ARC_CELLS, LEAST_SPAN_CELLS};
use super::schedule::Schedule;
use super::simulation::{Cells, Simulation, Start, TransientError, Until};
use super::system::Resistance;
use super::transverse::{RunOut, Transverse};
use crate::results::loop_state::PulleyState;
use crate::{BeltKind, FrictionLaw};

/// Most cells of a mesh: a second of motion then takes an hour.
const MOST_CELLS: usize = 10_000;

/// Most samples of a history: far more than a figure shows, some hundred megabytes.
const MOST_SAMPLES: f64 = 1e6;

/// A prescribed speed is that of the steady state from which it starts to this, relative: a number that is stated
/// with seven digits.
const SAME_SPEED: f64 = 1e-6;

/// The key of the damping of bristles.
const FRICTION_DAMPING: &str = "transient.friction_damping";

/// The key of a given speed.
const SPEED_KEY: &str = "transient.pulley.*.speed";

/// Refuses a part of the statement.
pub(crate) fn refuse<T>(subject: &str, problem: impl Into<String>) -> Result<T, TransientError> {
    Err(TransientError::Statement {
        subject: subject.to_owned(),
        problem: problem.into(),
        key: None,
    })
}

/// Refuses what a key of a drive file states.
pub(crate) fn refuse_key<T>(
    key: &'static str,
    subject: &str,
    problem: impl Into<String>,
) -> Result<T, TransientError> {
    Err(TransientError::Statement {
        subject: subject.to_owned(),
        problem: problem.into(),
        key: Some(key),
    })
}

/// What is wrong with a motion of the spans across.
fn of_transverse(stated: &Transverse, pulleys: usize) -> Option<&'static str> {
    if !(stated.damping >= 0.0 && stated.damping.is_finite()) {
        return Some("the damping must not be negative");
    }
    if !stated.gravity.iter().all(|part| part.is_finite()) {
        return Some("gravity must be finite");
    }
    if [stated.plucks.len(), stated.run_outs.len()] != [pulleys; 2] {
        return Some("there must be a pluck of every span and a run-out of every pulley, or none");
    }
    let mut plucks = stated.plucks.iter().flatten();
    if plucks.any(|pluck| !pluck.amplitude.is_finite() || pluck.mode == 0) {
        return Some("a pluck needs an amplitude and at least one half wave");
    }
    let mut run_outs = stated.run_outs.iter().flatten();
    let is_wrong = |run_out: &RunOut| {
        !(run_out.amplitude >= 0.0 && run_out.amplitude.is_finite()) || run_out.order == 0
    };
    (run_outs.any(is_wrong))
        .then_some("a run-out needs an amplitude that is not negative and at least one wave")
}

/// Refuses what is out of range, whatever the state at time 0.
pub(crate) fn check(simulation: &Simulation) -> Result<(), TransientError> {
    let drive = &simulation.drive;
    if let Some((pulley, _)) = drive.tensioner() {
        let name = &drive.pulleys[pulley].name;
        return refuse(name, "a drive with a tensioner cannot be simulated");
    }
    let damping = simulation.friction_damping;
    if !(damping >= 0.0 && damping.is_finite()) {
        return refuse_key(
            FRICTION_DAMPING,
            "damping of friction",
            "it must not be negative",
        );
    }
    of_law(simulation)?;
    if let (BeltKind::V(_), Some(_)) = (drive.belt.kind, &simulation.transverse) {
        return refuse_key(
            "transient.transverse",
            "motion of the spans across",
            "the spans of a V-belt stay straight in time",
        );
    }
    if simulation.axles.len() != drive.pulleys.len() {
        return refuse("axles", "there must be one for every pulley");
    }
    let damping = simulation.axial_damping;
    if !(damping >= 0.0 && damping.is_finite()) {
        return refuse_key(
            "transient.axial_damping",
            "axial damping",
            "it must not be negative",
        );
    }
    if let Some(stated) = &simulation.transverse
        && let Some(problem) = of_transverse(stated, drive.pulleys.len())
    {
        return refuse("motion of the spans across", problem);
    }
    let cells_are_in_range = match simulation.cells {
        Cells::Total(cells) => (1..=MOST_CELLS).contains(&cells),
        Cells::Each { arc, span } => {
            let all = arc.saturating_add(span).saturating_mul(drive.pulleys.len());
            arc >= LEAST_ARC_CELLS && span >= LEAST_SPAN_CELLS && all <= MOST_CELLS
        }
    };
    if !cells_are_in_range {
        return refuse_key(
            "transient.cells",
            "cells",
            format!(
                "there must be at least {LEAST_ARC_CELLS} on an arc, {LEAST_SPAN_CELLS} on a span and at most \
                 {MOST_CELLS} in all"
            ),
        );
    }
    let positive = |value: f64| value > 0.0 && value.is_finite();
    let end = simulation.until.latest();
    if !positive(end) {
        return refuse_key("transient.end", "end", "its time must be positive");
    }
    let interval = simulation.interval;
    if !positive(interval) {
        return refuse_key("transient.interval", "interval", "it must be positive");
    }
    if end / interval > MOST_SAMPLES {
        return refuse_key(
            "transient.interval",
            "interval",
            format!(
                "{:.0e} samples, one every {interval:e} s up to {end} s, are more than {MOST_SAMPLES:.0e}",
                end / interval
            ),
        );
    }
    if simulation.step.is_some_and(|step| !positive(step)) {
        return refuse_key("transient.time_step", "step", "it must be positive");
    }
    let mut instants = simulation.instants.iter();
    if !instants.all(|instant| (0.0..=end).contains(instant)) {
        return refuse("instants", "they must lie between 0 and the end of the run");
    }
    let axles = drive.pulleys.iter().zip(&simulation.axles);
    for (pulley, axle) in axles {
        if let Some(problem) = of_axle(axle) {
            return refuse(&pulley.name, problem);
        }
        if let Some(problem) = of_first_speed(axle, simulation.start) {
            return refuse_key(SPEED_KEY, &pulley.name, problem);
        }
        if let Some(problem) = of_pulsations(axle, simulation) {
            return refuse_key("transient.pulley.*.load_frequency", &pulley.name, problem);
        }
    }
    Ok(())
}

/// What is wrong with an axle.
fn of_axle(axle: &Axle) -> Option<String> {
    let inertia = axle.inertia;
    let over_speed = match &axle.motion {
        Motion::Torques {
            motor: Some(Motor::Characteristic(over_speed)),
            ..
        } => Some(over_speed),
        Motion::Torques { .. } | Motion::Speed(_) => None,
    };
    let mut given = axle.schedule().into_iter().flatten().chain(over_speed);
    if !given.all(Schedule::is_in_order) {
        return Some(
            "the points of what it is given must be finite and in ascending order".to_owned(),
        );
    }
    match &axle.motion {
        Motion::Speed(speed) => {
            if !(inertia >= 0.0 && inertia.is_finite()) {
                return Some("the moment of inertia must not be negative".to_owned());
            }
            let jump = speed.first_jump();
            jump.map(|time| format!("its speed must not jump, as it does at {time} s"))
        }
        Motion::Torques { load, .. } => {
            if !(inertia > 0.0 && inertia.is_finite()) {
                return Some(
                    "the moment of inertia of a pulley without a prescribed speed must be positive"
                        .to_owned(),
                );
            }
            if let Some(speed) = over_speed.and_then(Schedule::first_jump) {
                return Some(format!(
                    "the torque of its motor must not jump over the speed, as it does at {speed} rad/s"
                ));
            }
            (!(load.per_speed >= 0.0 && load.per_speed.is_finite()))
                .then(|| "the torque per speed of its load must not be negative".to_owned())
        }
    }
}

/// What is wrong with the speed at which an axle starts.
fn of_first_speed(axle: &Axle, start: Start) -> Option<String> {
    let Motion::Speed(speed) = &axle.motion else {
        return None;
    };
    let first = speed.at(0.0);
    (start == Start::Rest && first != 0.0).then(|| {
        format!("a drive at rest cannot start with a speed of {first} rad/s: let it rise from 0")
    })
}

/// What is wrong with the sines that are added to what an axle is given.
fn of_pulsations(axle: &Axle, simulation: &Simulation) -> Option<String> {
    if let Motion::Torques {
        motor: Some(Motor::Characteristic(over_speed)),
        ..
    } = &axle.motion
        && over_speed.pulsation().is_some()
    {
        return Some("the torque of its motor over the speed cannot pulsate over time".to_owned());
    }
    let given = axle.schedule().into_iter().flatten();
    given.filter_map(Schedule::pulsation).find_map(|pulsation| {
        let (amplitude, frequency) = (pulsation.amplitude, pulsation.angular_frequency);
        if !(amplitude >= 0.0 && amplitude.is_finite()) {
            Some("the amplitude of its pulsation must not be negative".to_owned())
        } else if !(frequency > 0.0 && frequency.is_finite()) {
            Some("the frequency of its pulsation must be positive".to_owned())
        } else {
            let is_steady_sought = matches!(simulation.until, Until::Steady { .. });
            is_steady_sought.then(|| {
                "it pulsates at all times, so that the drive is never steady: end the run at a time"
                    .to_owned()
            })
        }
    })
}

/// Refuses a friction law that belts of a kind do not have in time.
fn of_law(simulation: &Simulation) -> Result<(), TransientError> {
    match simulation.drive.belt.kind {
        BeltKind::Flat { .. } => resistance(simulation).map(|_| ()),
        BeltKind::V(_) => bristle_stiffness(simulation).map(|_| ()),
    }
}

/// The friction of a flat belt in time.
pub(super) fn resistance(simulation: &Simulation) -> Result<Resistance, TransientError> {
    let damping = simulation.friction_damping;
    match simulation.drive.law {
        FrictionLaw::Epp { stiffness } => Ok(Resistance::Bristles { stiffness, damping }),
        FrictionLaw::CreepRate { .. } if damping > 0.0 => refuse_key(
            FRICTION_DAMPING,
            "damping of friction",
            "creep-rate friction has no bristles that it could damp",
        ),
        FrictionLaw::CreepRate { velocity } => Ok(Resistance::Creep { velocity }),
        law => refuse_key(
            "friction.law",
            "friction",
            format!(
                "a flat belt in time needs elastic/perfectly-plastic friction (`epp`) or creep-rate friction \
                 (`creep-rate`), not `{}`",
                law.name()
            ),
        ),
    }
}

/// The stiffness κ of the bristles of a V-belt in time, 1/m.
pub(super) fn bristle_stiffness(simulation: &Simulation) -> Result<f64, TransientError> {
    match simulation.drive.law {
        FrictionLaw::Bristle { .. } if simulation.friction_damping > 0.0 => refuse_key(
            FRICTION_DAMPING,
            "damping of friction",
            "the bristles of V-belts have none",
        ),
        FrictionLaw::Bristle { stiffness } => Ok(stiffness),
        law => refuse_key(
            "friction.law",
            "friction",
            format!(
                "a V-belt in time needs vector bristles (`bristle`), not `{}`",
                law.name()
            ),
        ),
    }
}

/// Refuses a given speed that does not start with that of the steady state of its pulley.
pub(super) fn of_running(axle: &Axle, known: &PulleyState) -> Result<(), TransientError> {
    let Motion::Speed(given) = &axle.motion else {
        return Ok(());
    };
    let (first, speed) = (given.at(0.0), known.angular_speed);
    match (first / speed - 1.0).abs() > SAME_SPEED {
        true => refuse_key(
            SPEED_KEY,
            &known.name,
            format!("its speed starts with {first} rad/s, but the running drive has {speed} rad/s"),
        ),
        false => Ok(()),
    }
}
