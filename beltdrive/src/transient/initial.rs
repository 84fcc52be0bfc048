//! From the statement to the equations, and the state at time 0.

use super::mesh::{LEAST_ARC_CELLS, LEAST_SPAN_CELLS, Mesh, Stretch, even};
use super::simulation::{Cells, Simulation, TransientError};
use super::state::Parts;
use super::statement::{self, refuse, refuse_key};
use super::string;
use super::system::{Resistance, System, Wheel};
use super::transverse::{Across, End, RunOut, SpanAcross, Transverse};
use crate::Drive;
use crate::drive::layout::Layout;
use crate::results::loop_state::LoopState;
use nalgebra::Vector2;

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

/// The pulleys of a drive with their axles.
pub(super) fn wheels(simulation: &Simulation) -> Vec<Wheel> {
    let pulleys = simulation.drive.pulleys.iter().zip(&simulation.axles);
    let wheels = pulleys.map(|(pulley, axle)| Wheel {
        radius: pulley.radius,
        friction_coefficient: pulley.friction_coefficient,
        axle: axle.clone(),
    });
    wheels.collect()
}

/// The equations of a drive that is laid out.
pub(crate) fn system(
    simulation: &Simulation,
    drive: &Drive,
    layout: &Layout,
) -> Result<System, TransientError> {
    let resistance = statement::resistance(simulation)?;
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
    Ok(System {
        mass: drive.belt.mass_per_length,
        axial_stiffness: drive.belt.axial_stiffness,
        axial_damping: simulation.axial_damping,
        resistance,
        across: simulation
            .transverse
            .as_ref()
            .map(|stated| across(stated, layout)),
        wheels: wheels(simulation),
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
            // Creep-rate friction follows from velocities.
            if let Resistance::Bristles { .. } = system.resistance {
                let bristle = parts.bristle.start + system.mesh.bristles[pulley].start + index;
                state[bristle] = value(&profile.displacement);
            }
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
        statement::of_running(&system.wheels[pulley].axle, known)?;
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
