//! From the statement to the equations, and the state at time 0.

use super::axle::{Axle, Motion, Motor};
use super::mesh::{LEAST_ARC_CELLS, LEAST_SPAN_CELLS, Mesh, Stretch, even};
use super::schedule::Schedule;
use super::simulation::{Cells, Simulation, Start, TransientError, Until};
use super::state::Parts;
use super::string;
use super::system::{System, Wheel};
use super::transverse::{Across, End, RunOut, SpanAcross, Transverse};
use crate::drive::layout::Layout;
use crate::results::loop_state::LoopState;
use crate::{BeltKind, Drive, FrictionLaw, Pulley};
use nalgebra::Vector2;

/// Most cells of a mesh: a second of motion then takes an hour.
const MOST_CELLS: usize = 10_000;

/// Most samples of a history: far more than a figure shows, some hundred megabytes.
const MOST_SAMPLES: f64 = 1e6;

/// A prescribed speed is that of the steady state from which it starts to this, relative: a number that is stated
/// with seven digits.
pub(super) const SAME_SPEED: f64 = 1e-6;

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
fn refuse_key<T>(
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

/// Half as many cells on every arc and span, as far as there may be so few.
pub(crate) fn halved(arc: usize, span: usize) -> Cells {
    Cells::Each {
        arc: arc.div_ceil(2).max(LEAST_ARC_CELLS),
        span: span.div_ceil(2).max(LEAST_SPAN_CELLS),
    }
}

/// The stretches of a loop with lengths of arc and span of each pulley in m.
pub(super) fn stretches(cells: Cells, parts: &[[f64; 2]]) -> Vec<Stretch> {
    match cells {
        Cells::Total(cells) => even(parts, cells),
        Cells::Each { arc, span } => {
            let cells = |&[arc_length, span_length]: &[f64; 2]| Stretch {
                arc: arc_length,
                arc_cells: arc,
                span: span_length,
                span_cells: span,
            };
            parts.iter().map(cells).collect()
        }
    }
}

/// The equations of a drive that is laid out.
pub(crate) fn system(
    simulation: &Simulation,
    drive: &Drive,
    layout: &Layout,
) -> Result<System, TransientError> {
    let FrictionLaw::Epp { stiffness } = drive.law else {
        return refuse_key(
            "friction.law",
            "friction",
            format!(
                "a simulation needs elastic/perfectly-plastic friction (`epp`), not `{}`",
                drive.law.name()
            ),
        );
    };
    let wraps = layout.pulleys().iter().zip(layout.wraps());
    let arcs = wraps.map(|(pulley, wrap)| pulley.radius * wrap);
    let parts: Vec<_> = { arcs.zip(layout.spans()) }
        .map(|(arc, span)| [arc, span.length])
        .collect();
    let without = |part: usize| parts.iter().position(|lengths| lengths[part] <= 0.0);
    if let Some(pulley) = without(0) {
        return refuse(
            &drive.pulleys[pulley].name,
            "the belt does not wrap round it",
        );
    }
    if let Some(pulley) = without(1) {
        return refuse(
            &drive.pulleys[pulley].name,
            "the span behind it has no length",
        );
    }
    let stretches = stretches(simulation.cells, &parts);
    let mesh = Mesh::new(&stretches);
    let wheels = drive.pulleys.iter().zip(&simulation.axles);
    let wheel = |(pulley, axle): (&Pulley, &Axle)| Wheel {
        radius: pulley.radius,
        friction_coefficient: pulley.friction_coefficient,
        axle: axle.clone(),
    };
    Ok(System {
        mass: drive.belt.mass_per_length,
        axial_stiffness: drive.belt.axial_stiffness,
        axial_damping: simulation.axial_damping,
        friction_stiffness: stiffness,
        across: simulation
            .transverse
            .as_ref()
            .map(|stated| across(stated, layout)),
        wheels: wheels.map(wheel).collect(),
        parts: match simulation.transverse {
            Some(_) => Parts::across(&mesh),
            None => Parts::new(&mesh),
        },
        mesh,
    })
}

/// What moves the spans of a drive that is laid out across.
fn across(stated: &Transverse, layout: &Layout) -> Across {
    let count = layout.spans().len();
    let sense = layout.sense();
    let end = |pulley: usize, ahead: f64| {
        let round = stated.run_outs[pulley].unwrap_or(RunOut {
            amplitude: 0.0,
            order: 1,
        });
        End {
            pulley,
            // A pulley round which the belt turns the other way lies outside the loop.
            amplitude: round.amplitude * layout.pulleys()[pulley].turns(sense) * sense.sign(),
            order: round.order as f64,
            ahead,
        }
    };
    let spans = layout.spans().iter().enumerate().map(|(span, laid)| {
        let next = (span + 1) % count;
        let inward = sense.sign() * laid.normal();
        SpanAcross {
            gravity: -inward.dot(&Vector2::from(stated.gravity)),
            ends: [end(span, 0.0), end(next, layout.wraps()[next])],
        }
    });
    Across {
        damping: stated.damping,
        spans: spans.collect(),
    }
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
    if let BeltKind::V(_) = drive.belt.kind {
        return refuse_key(
            "belt.type",
            "belt",
            "only drives with flat belts can be simulated",
        );
    }
    if let Some((pulley, _)) = drive.tensioner() {
        let name = &drive.pulleys[pulley].name;
        return refuse(name, "a drive with a tensioner cannot be simulated");
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
    let (Until::Time(end) | Until::Steady { latest: end }) = simulation.until;
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

/// The belt at rest with a tension in N.
pub(crate) fn at_rest(system: &System, tension: f64) -> Vec<f64> {
    let stretch = 1.0 + tension / system.axial_stiffness;
    system.parts.uniform(stretch.recip(), 0.0)
}

/// The steady state of the solver on the mesh, with the unstretched length that it has.
pub(crate) fn running(system: &System, found: &LoopState) -> Result<Vec<f64>, TransientError> {
    let parts = &system.parts;
    let mut state = parts.uniform(1.0, 0.0);
    let density = |tension: f64| (1.0 + tension / system.axial_stiffness).recip();
    let densities = &mut state[parts.density.clone()][1..];
    for (span, known) in system.mesh.spans.iter().zip(&found.spans) {
        densities[span.clone()].fill(density(known.tension));
    }
    for (pulley, arc) in system.mesh.arcs.iter().enumerate() {
        let profile = found.profile(pulley);
        let cell = system.mesh.lengths[arc.start];
        for (index, of_loop) in arc.clone().enumerate() {
            let at = (index as f64 + 0.5) * cell;
            let value = |list: &[f64]| interpolated(&profile.arc_length, list, at);
            state[parts.density.start + 1 + of_loop] = density(value(&profile.tension));
            let bristle = parts.bristle.start + system.mesh.bristles[pulley].start + index;
            state[bristle] = value(&profile.displacement);
        }
    }
    // As long as the belt of the steady state.
    let share = found.unstretched_length / system.unstretched_length(&state);
    for density in &mut state[parts.density.clone()] {
        *density *= share;
    }
    parts.close(&mut state);
    let lengths = &system.mesh.lengths;
    for face in 0..lengths.len() {
        let behind = lengths[(face + lengths.len() - 1) % lengths.len()];
        let [before, after] = [0, 1].map(|cell| state[parts.density.start + face + cell]);
        let density = (before * lengths[face] + after * behind) / (behind + lengths[face]);
        state[parts.velocity.start + face] = found.unstretched_speed / density;
    }
    parts.close(&mut state);
    for (pulley, known) in found.pulleys.iter().enumerate() {
        if let Motion::Speed(given) = &system.wheels[pulley].axle.motion {
            let (first, speed) = (given.at(0.0), known.angular_speed);
            if (first / speed - 1.0).abs() > SAME_SPEED {
                return refuse_key(
                    SPEED_KEY,
                    &known.name,
                    format!(
                        "its speed starts with {first} rad/s, but the running drive has {speed} rad/s"
                    ),
                );
            }
        }
        state[parts.speed.start + pulley] = known.angular_speed;
    }
    Ok(state)
}

/// Displaces the spans of a state of a drive as they are plucked.
pub(crate) fn pluck(
    system: &System,
    drive: &Drive,
    stated: &Transverse,
    state: &mut [f64],
) -> Result<(), TransientError> {
    let plucked = drive.pulleys.iter().zip(&stated.plucks);
    for ((pulley, pluck), span) in plucked.zip(&system.mesh.spans) {
        // On fewer cells the half waves are others.
        let most = span.len() / 2;
        if let Some(pluck) = pluck.filter(|pluck| pluck.mode > most) {
            let problem = format!(
                "{} half waves of a pluck need two cells each, and the span behind it has {}",
                pluck.mode,
                span.len()
            );
            return refuse_key("transient.pulley.*.pluck_mode", &pulley.name, problem);
        }
    }
    string::pluck(system, &stated.plucks, state);
    Ok(())
}

/// The value of a list at a place between others that rise.
pub(super) fn interpolated(places: &[f64], values: &[f64], at: f64) -> f64 {
    let next = places
        .partition_point(|&place| place < at)
        .clamp(1, places.len() - 1);
    let [from, to] = [places[next - 1], places[next]];
    let [first, last] = [values[next - 1], values[next]];
    match to > from {
        true => first + (at - from) / (to - from) * (last - first),
        false => last,
    }
}
