//! From the steady state of a drive with a V-belt to its equations in time, and the state at time 0.

use super::super::history::Entry;
use super::super::initial::{interpolated, stretches, wheels};
use super::super::mesh::Mesh;
use super::super::simulation::{Simulation, TransientError};
use super::super::statement::{self, refuse};
use super::rates::Rates;
use super::state::Parts;
use super::system::System;
use crate::results::loop_state::LoopState;
use crate::{Profile, VBelt};

/// The equations of a drive whose belt keeps the places of contact of a steady state.
pub(crate) fn system(
    simulation: &Simulation,
    belt: &VBelt,
    found: &LoopState,
) -> Result<System, TransientError> {
    let drive = &simulation.drive;
    let stiffness = statement::bristle_stiffness(simulation)?;
    let pulleys = drive.pulleys.iter().zip(&found.pulleys);
    let mut parts = vec![];
    for (index, (pulley, known)) in pulleys.enumerate() {
        if known.groove.is_none() {
            let problem =
                "a V-belt in time must run in the groove of every pulley, not on its back";
            return refuse(&pulley.name, problem);
        }
        let angles = found.profile(index).angle;
        if angles.windows(2).any(|pair| pair[1] < pair[0]) {
            let problem =
                "the belt overhangs there in the steady state, for which there is no model in time";
            return refuse(&pulley.name, problem);
        }
        parts.push([pulley.radius * known.wrap, found.spans[index].length]);
    }
    let mesh = Mesh::new(&stretches(simulation.cells, &parts));
    let (sine, cosine) = belt.half_angle.sin_cos();
    Ok(System {
        mass: drive.belt.mass_per_length,
        axial_stiffness: drive.belt.axial_stiffness,
        axial_damping: simulation.axial_damping,
        bristle_stiffness: stiffness,
        radial_stiffness: belt.radial_stiffness,
        groove: [sine, cosine],
        wheels: wheels(simulation),
        parts: Parts::new(&mesh),
        mesh,
    })
}

/// The pulleys into whose grooves the belt sinks within less than a cell in a steady state.
///
/// Near its ends the balance of the depth is F x″ = k tan β x, so that it sinks over √(F/(k tan β)). With cells of 1.6 times
/// that length tensions are off by 6 %, with 0.8 times by 0.3 %.
pub(crate) fn coarse(system: &System, found: &LoopState) -> Vec<usize> {
    let (spans, mesh) = (&found.spans, &system.mesh);
    let count = spans.len();
    let [sine, cosine] = system.groove;
    let sinks_within_a_cell = |pulley: &usize| {
        let ends = [(pulley + count - 1) % count, *pulley].map(|span| spans[span].tractive_tension);
        let sinking = (ends[0].min(ends[1]) * cosine / (system.radial_stiffness * sine)).sqrt();
        mesh.lengths[mesh.arcs[*pulley].start] > sinking
    };
    (0..count).filter(sinks_within_a_cell).collect()
}

/// Where the belt meets the grooves in a steady state.
pub(crate) fn entries(found: &LoopState) -> Vec<Entry> {
    let count = found.pulleys.len();
    let sense = found.layout.sense();
    let pulleys = found.pulleys.iter().enumerate();
    let entries = pulleys.map(|(index, pulley)| {
        let turns = found.layout.pulleys()[index].turns(sense);
        let inclination = { pulley.groove.as_ref() }.map_or(0.0, |groove| groove.inclination[0]);
        let entering = &found.spans[(index + count - 1) % count];
        Entry {
            // An outward inclination turns the belt against the sense in which it goes round.
            direction: entering.direction + turns * inclination,
            turns,
        }
    });
    entries.collect()
}

/// Whether every groove was found to hold the belt.
fn seated(is_seated: bool) -> Result<(), TransientError> {
    match is_seated {
        true => Ok(()),
        false => Err(TransientError::Impossible {
            time: 0.0,
            problem: "the belt has no depth in a groove that balances its tension",
            history: None,
        }),
    }
}

/// Most corrections of the tension of the belt at rest; its length is nearly linear in it.
const MOST_CORRECTIONS: usize = 20;

/// The belt at rest with the unstretched length of the steady state, and one tension everywhere.
pub(crate) fn at_rest(
    rates: &mut Rates<'_>,
    found: &LoopState,
) -> Result<Vec<f64>, TransientError> {
    let system = rates.system;
    let mut state = vec![0.0; system.parts.len()];
    let mut tension = found.rest_tension;
    let [sine, cosine] = system.groove;
    // By what a higher tension shortens it, m/N: its stretch, and its depth but for the ends.
    let sinking = { system.wheels.iter().zip(&found.pulleys) }.map(|(wheel, known)| {
        known.wrap * cosine / (system.radial_stiffness * wheel.radius * sine)
    });
    let shortening = found.unstretched_length / system.axial_stiffness + sinking.sum::<f64>();
    for (depths, wheel) in rates.depths.iter_mut().zip(&system.wheels) {
        // Without friction, but for the ends.
        let depth = tension * cosine / (system.radial_stiffness * wheel.radius * sine);
        let last = depths.len() - 1;
        depths[1..last].fill(depth);
    }
    for _ in 0..MOST_CORRECTIONS {
        for pulley in 0..system.wheels.len() {
            seated(rates.seat(pulley, &state, |_| tension, |_| 0.0))?;
        }
        let stretch = 1.0 + tension / system.axial_stiffness;
        let lengths = rates.lengths.iter();
        for (amount, length) in state[system.parts.amount.clone()].iter_mut().zip(lengths) {
            *amount = length / stretch;
        }
        let off = system.unstretched_length(&state) / found.unstretched_length - 1.0;
        if off.abs() < 1e-14 {
            break;
        }
        tension += off * found.unstretched_length / shortening;
    }
    if tension <= 0.0 || tension.is_nan() {
        return refuse(
            "belt",
            "it is slack at rest, with the unstretched length of its steady state",
        );
    }
    Ok(state)
}

/// The steady state on the mesh, with the unstretched length that it has.
pub(crate) fn running(
    rates: &mut Rates<'_>,
    found: &LoopState,
) -> Result<Vec<f64>, TransientError> {
    let system = rates.system;
    let (parts, mesh) = (&system.parts, &system.mesh);
    let mut state = vec![0.0; parts.len()];
    let stretch = |tension: f64| 1.0 + tension / system.axial_stiffness;
    let mut stretches = vec![1.0; mesh.cells()];
    for (span, known) in mesh.spans.iter().zip(&found.spans) {
        stretches[span.clone()].fill(stretch(known.tension));
    }
    for (pulley, arc) in mesh.arcs.iter().enumerate() {
        let (profile, known) = (found.profile(pulley), &found.pulleys[pulley]);
        let radius = system.wheels[pulley].radius;
        let own = mesh.bristles[pulley].clone();
        let at = |index: usize| (index as f64 + 0.5) * mesh.lengths[arc.start] / radius;
        let bent = bristles(system, pulley, &profile, found);
        for index in 0..arc.len() {
            for (part, list) in [&parts.along, &parts.up].into_iter().zip(&bent) {
                let place = part.start + own.start + index;
                state[place] = interpolated(&profile.angle, list, at(index));
            }
            let tension = interpolated(&profile.angle, &profile.tension, at(index));
            stretches[arc.start + index] = stretch(tension);
        }
        let tension = |index: usize| system.tension(stretches[arc.start + index]);
        let speed = |index: usize| found.unstretched_speed * stretches[arc.start + index];
        for (depth, face) in rates.depths[pulley].iter_mut().zip(0_u32..) {
            let angle = f64::from(face) * mesh.lengths[arc.start] / radius;
            *depth = interpolated(&profile.angle, &profile.penetration, angle);
        }
        let last = rates.depths[pulley].len() - 1;
        rates.depths[pulley][0] = 0.0;
        rates.depths[pulley][last] = 0.0;
        seated(rates.seat(pulley, &state, tension, speed))?;
        statement::of_running(&system.wheels[pulley].axle, known)?;
        state[parts.speed.start + pulley] = known.angular_speed;
    }
    let amounts = &mut state[parts.amount.clone()];
    for ((amount, length), stretch) in amounts.iter_mut().zip(&rates.lengths).zip(&stretches) {
        *amount = length / stretch;
    }
    // As long as the belt of the steady state.
    let share = found.unstretched_length / system.unstretched_length(&state);
    for amount in &mut state[parts.amount.clone()] {
        *amount *= share;
    }
    let (lengths, cells) = (&mesh.lengths, mesh.cells());
    for face in 0..cells {
        let behind = (face + cells - 1) % cells;
        let density = |cell: usize| state[parts.amount.start + cell] / rates.lengths[cell];
        let mean = (density(behind) * lengths[face] + density(face) * lengths[behind])
            / (lengths[behind] + lengths[face]);
        state[parts.velocity.start + face] = found.unstretched_speed / mean;
    }
    Ok(state)
}

/// The deflections of the bristles along a contact, of which a steady state tells the sizes only: both are
/// integrated over its slip, exactly for one that is constant between two points.
fn bristles(system: &System, pulley: usize, profile: &Profile, found: &LoopState) -> [Vec<f64>; 2] {
    let wheel = &system.wheels[pulley];
    let omega = found.pulleys[pulley].angular_speed;
    let slip = |point: usize| {
        let speed =
            found.unstretched_speed * (1.0 + profile.tension[point] / system.axial_stiffness);
        let (sine, cosine) = profile.inclination[point].sin_cos();
        let rim = omega * (wheel.radius - profile.penetration[point]);
        [cosine - rim / speed, sine / system.groove[1]]
    };
    let mut bent = [vec![0.0], vec![0.0]];
    for point in 1..profile.angle.len() {
        let [before, after] = [slip(point - 1), slip(point)];
        let mean = [0, 1].map(|axis| 0.5 * (before[axis] + after[axis]));
        let norm = mean[0].hypot(mean[1]);
        let length = profile.arc_length[point] - profile.arc_length[point - 1];
        let left = (-system.bristle_stiffness * norm * length / wheel.friction_coefficient).exp();
        for (list, slip) in bent.iter_mut().zip(mean) {
            let full = match norm > 0.0 {
                true => wheel.friction_coefficient * slip / norm,
                false => 0.0,
            };
            let last = list[point - 1];
            list.push(full + (last - full) * left);
        }
    }
    bent
}
