//! The spans as strings that move along themselves and across.
//!
//! Displacement w and velocity u of the belt across stand at the faces of a span, second order, with the slope
//! s = ∂w/∂σ in the cells:
//!
//! ```text
//! stretch       λ = (1 + s²/2)/ρ                     λ̇ = ((1 − s²/2) ∂v/∂σ + s ∂u/∂σ)/ρ
//! displacement  ẇ = u − v s
//! across        m ρ (u̇ + v ∂u/∂σ) = ∂(T s)/∂σ − c_w u + m ρ g
//! along         m ρ (v̇ + v ∂v/∂σ) = ρ ∂(½ EA λ²)/∂σ − s ∂(EA (λ − 1) s)/∂σ + ∂(c_d λ̇ (1 − s²/2))/∂σ
//! ```
//!
//! These are the equations of the energy ½ m ρ (v² + u²) + ½ EA (λ − 1)² ρ per length: what one of the terms with s
//! gives, another one takes, on the mesh as well. At a tangent point w is given, and the belt bends without a shock
//! into the span: half a cell of it moves across with u = ẇ + v s, on the pulley u = 0. The reaction of the pulley on
//! what turns there acts across and, as the belt keeps its energy, along.

use super::rates::{Rates, pressure};
use super::state::AcrossParts;
use super::system::System;
use super::transverse::{Across, Pluck, SpanAcross};
use std::f64::consts::PI;
use std::ops::Range;

/// What the rates of the spans are computed from, for the cells of one span.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// Slope s.
    slope: Vec<f64>,
    /// T s without damping, and what damping adds, N.
    elastic: Vec<f64>,
    damped: Vec<f64>,
    /// Force of damping along, `c_d` λ̇ (1 − s²/2), N.
    along: Vec<f64>,
}

/// Powers, W.
#[derive(Clone, Copy, Debug, Default)]
struct Powers {
    gravity: f64,
    run_out: f64,
    damped: f64,
}

/// Where the faces of a span stand in the list of those of all spans: each has one more than cells.
fn faces(system: &System, span: usize) -> Range<usize> {
    let spans = &system.mesh.spans;
    let before: usize = spans[..span].iter().map(|cells| cells.len() + 1).sum();
    before..before + spans[span].len() + 1
}

/// What moves the spans, and where it stands in a state.
fn of(system: &System) -> Option<(&Across, &AcrossParts)> {
    system.across.as_ref().zip(system.parts.across.as_ref())
}

/// Displacements of the belt across at the faces of a span, m; none where the spans do not move across.
pub(super) fn displacements<'a>(system: &System, state: &'a [f64], span: usize) -> &'a [f64] {
    of(system).map_or(&[], |(_, parts)| {
        &state[parts.displacement.clone()][faces(system, span)]
    })
}

/// Slopes in the cells of a span with displacements at the faces.
fn slopes(displaced: &[f64], cell: f64) -> impl Iterator<Item = f64> {
    displaced
        .windows(2)
        .map(move |ends| (ends[1] - ends[0]) / cell)
}

/// The steepest slope of a span that moves across; 0 where none does.
pub(super) fn steepest(system: &System, state: &[f64]) -> f64 {
    let spans = system.mesh.spans.iter().enumerate();
    let slopes = spans.flat_map(|(index, span)| {
        let cell = system.mesh.lengths[span.start];
        slopes(displacements(system, state, index), cell)
    });
    slopes.map(f64::abs).fold(0.0, f64::max)
}

/// The fastest change of a displacement across among rates, m/s; 0 where the spans do not move so.
pub(super) fn fastest(system: &System, changes: &[f64]) -> f64 {
    let spans = 0..system.mesh.spans.len();
    let changes = spans.flat_map(|span| displacements(system, changes, span));
    changes.map(|change| change.abs()).fold(0.0, f64::max)
}

/// Kinetic energy of the spans that move across and what their slopes add to the strain energy, J.
pub(super) fn energy(system: &System, state: &[f64]) -> f64 {
    let Some((_, parts)) = of(system) else {
        return 0.0;
    };
    let density = &state[system.parts.density.clone()][1..];
    let spans = system.mesh.spans.iter().enumerate().map(|(index, span)| {
        let own = faces(system, index);
        let displaced = &state[parts.displacement.clone()][own.clone()];
        let velocity = &state[parts.velocity.clone()][own];
        let cell = system.mesh.lengths[span.start];
        let cells = density[span.clone()].iter().zip(slopes(displaced, cell));
        let cells = cells.enumerate().map(|(index, (&density, slope))| {
            let flat = density.recip();
            let stored =
                |stretch: f64| 0.5 * system.stiffness(stretch) * (stretch - 1.0) * (stretch - 1.0);
            let strained = stored(flat * (1.0 + 0.5 * slope * slope)) - stored(flat);
            let squares = velocity[index].powi(2) + velocity[index + 1].powi(2);
            cell * density * (strained + 0.25 * system.mass * squares)
        });
        cells.sum::<f64>()
    });
    spans.sum()
}

/// Displaces the spans of a state of a straight belt as they are plucked, from straight lines between their ends, without
/// motion across. A span keeps its unstretched length, and the same tension all along.
pub(super) fn pluck(system: &System, plucks: &[Option<Pluck>], state: &mut [f64]) {
    let Some((_, parts)) = of(system) else {
        return;
    };
    for (index, span) in system.mesh.spans.iter().enumerate() {
        let own = faces(system, index);
        let count = span.len();
        set_ends(system, state);
        let displaced = &mut state[parts.displacement.clone()][own.clone()];
        let [first, last] = [displaced[0], displaced[count]];
        for (face, to) in displaced.iter_mut().enumerate() {
            let share = face as f64 / count as f64;
            let wave = |pluck: Pluck| pluck.amplitude * (PI * pluck.mode as f64 * share).sin();
            *to = first + (last - first) * share + plucks[index].map_or(0.0, wave);
        }
        let cell = system.mesh.lengths[span.start];
        let longer = slopes(displaced, cell).map(|slope| 1.0 + 0.5 * slope * slope);
        let longer: Vec<_> = longer.collect();
        let mean = longer.iter().sum::<f64>() / count as f64;
        for (of_loop, longer) in span.clone().zip(longer) {
            state[system.parts.density.start + 1 + of_loop] *= longer / mean;
        }
        for face in 1..count {
            let displaced = &state[parts.displacement.clone()][own.clone()];
            let slope = (displaced[face + 1] - displaced[face - 1]) / (2.0 * cell);
            let along = state[system.parts.velocity.start + span.start + face];
            state[parts.velocity.start + own.start + face] = along * slope;
        }
    }
    system.parts.close(state);
    set_ends(system, state);
}

/// Sets displacement and velocity across at the ends of the spans.
pub(super) fn set_ends(system: &System, state: &mut [f64]) {
    let Some((across, parts)) = of(system) else {
        return;
    };
    for (index, span) in system.mesh.spans.iter().enumerate() {
        let own = faces(system, index);
        let cell = system.mesh.lengths[span.start];
        let last = own.len() - 1;
        let ends = [(0, 1, -1.0), (last, last - 1, 1.0)];
        for ((face, inner, sign), end) in ends.into_iter().zip(&across.spans[index].ends) {
            let angle = state[parts.angle.start + end.pulley];
            let speed = state[system.parts.speed.start + end.pulley];
            let [displaced, rising, _] = end.motion(angle, speed, 0.0);
            let inner = state[parts.displacement.start + own.start + inner];
            let along = state[system.parts.velocity.start + span.start + face];
            state[parts.displacement.start + own.start + face] = displaced;
            let slope = sign * (displaced - inner) / cell;
            state[parts.velocity.start + own.start + face] = rising + along * slope;
        }
    }
}

impl Rates<'_> {
    /// Sets the ends of the spans, and stretch, its rate and the force ½ EA λ² − ½ m v̂² in their cells, which faces take.
    pub(super) fn raise(&mut self, state: &mut [f64]) {
        let system = self.system;
        let Some((_, parts)) = of(system) else {
            return;
        };
        set_ends(system, state);
        let velocity = &state[system.parts.velocity.clone()];
        for (index, span) in system.mesh.spans.iter().enumerate() {
            let own = faces(system, index);
            let displaced = &state[parts.displacement.clone()][own.clone()];
            let across = &state[parts.velocity.clone()][own];
            let per_cell = self.per_cell[span.start];
            for (index, cell) in span.clone().enumerate() {
                let slope = (displaced[index + 1] - displaced[index]) * per_cell;
                let half = 0.5 * slope * slope;
                let flat = self.stretch[cell + 1];
                let along = (velocity[cell + 1] - velocity[cell]) * per_cell;
                let rising = (across[index + 1] - across[index]) * per_cell;
                let stretch = flat * (1.0 + half);
                self.stretch[cell + 1] = stretch;
                self.stretching[cell + 1] = flat * ((1.0 - half) * along + slope * rising);
                self.pressure[cell + 1] = pressure(
                    system.axial_stiffness,
                    system.mass,
                    [stretch, self.middle[cell]],
                );
            }
        }
        let cells = self.per_cell.len();
        for closed in [&mut self.stretch, &mut self.stretching, &mut self.pressure] {
            closed[0] = closed[cells];
        }
    }

    /// The rates of the spans across and what they add to those along, from the other rates.
    pub(super) fn across(&mut self, state: &[f64], rates: &mut [f64]) {
        let system = self.system;
        let Some((across, parts)) = of(system) else {
            return;
        };
        let mut room = std::mem::take(&mut self.room);
        let mut powers = Powers::default();
        for (index, span) in across.spans.iter().enumerate() {
            let cells = system.mesh.spans[index].clone();
            let own = faces(system, index);
            self.fill(
                &mut room,
                &cells,
                &state[parts.displacement.clone()][own.clone()],
            );
            let place = Place {
                cells,
                displacement: parts.displacement.start + own.start,
                velocity: parts.velocity.start + own.start,
            };
            self.damp_along(&room, &place, state, rates);
            let [gravity, damped] =
                self.inside(&room, &place, [across.damping, span.gravity], state, rates);
            powers.gravity += gravity;
            powers.damped += damped;
            powers.run_out += self.at_ends(&room, &place, span, state, rates);
        }
        self.room = room;
        let velocity = system.parts.velocity.clone();
        rates[velocity.end - 1] = rates[velocity.start];
        for (place, speed) in parts.angle.clone().zip(system.parts.speed.clone()) {
            rates[place] = state[speed];
        }
        rates[parts.gravity] = powers.gravity;
        rates[parts.run_out] = powers.run_out;
        rates[parts.damped] = powers.damped;
        rates[system.parts.turnover] += powers.gravity.abs() + powers.run_out.abs();
    }

    /// Slopes and forces in the cells of a span.
    fn fill(&self, room: &mut Room, cells: &Range<usize>, displaced: &[f64]) {
        let system = self.system;
        for list in [
            &mut room.slope,
            &mut room.elastic,
            &mut room.damped,
            &mut room.along,
        ] {
            list.clear();
        }
        let cell = system.mesh.lengths[cells.start];
        for (slope, of_loop) in slopes(displaced, cell).zip(cells.clone()) {
            let stretch = self.stretch[of_loop + 1];
            let damping = system.axial_damping * self.stretching[of_loop + 1];
            room.slope.push(slope);
            room.elastic.push(system.tension(stretch) * slope);
            room.damped.push(damping * slope);
            room.along.push(damping * (1.0 - 0.5 * slope * slope));
        }
    }

    /// Replaces the force of axial damping on a straight belt at the faces of a span by that on the belt as it is.
    fn damp_along(&self, room: &Room, place: &Place, state: &[f64], rates: &mut [f64]) {
        let system = self.system;
        if system.axial_damping == 0.0 {
            return;
        }
        let density = &state[system.parts.density.clone()];
        for face in place.cells.start..=place.cells.end {
            let cells = self.per_cell.len();
            let (behind, ahead) = (face, if face == cells { 1 } else { face + 1 });
            let force = |closed: usize| match closed.checked_sub(1 + place.cells.start) {
                Some(inside) if inside < place.cells.len() => room.along[inside],
                _ => system.axial_damping * self.stretching[closed],
            };
            let flat = density[behind].recip() + density[ahead].recip();
            let strained = self.stretch[behind] + self.stretch[ahead];
            let straight =
                system.axial_damping * (self.stretching[ahead] - self.stretching[behind]);
            let change = 0.5 * (flat * (force(ahead) - force(behind)) - strained * straight);
            let face = face % cells;
            rates[system.parts.velocity.start + face] += change * self.per_mass[face];
        }
    }

    /// The rates at the faces inside a span; powers of gravity and of damping, W.
    fn inside(
        &self,
        room: &Room,
        place: &Place,
        [damping, gravity]: [f64; 2],
        state: &[f64],
        rates: &mut [f64],
    ) -> [f64; 2] {
        let system = self.system;
        let density = &state[system.parts.density.clone()][1..];
        let cell = system.mesh.lengths[place.cells.start];
        let mut powers = [0.0; 2];
        for index in 1..place.cells.len() {
            let face = place.cells.start + index;
            let along = state[system.parts.velocity.start + face];
            let u = &state[place.velocity + index - 1..][..3];
            let slope = 0.5 * (room.slope[index - 1] + room.slope[index]);
            let elastic = room.elastic[index] - room.elastic[index - 1];
            let force = elastic + room.damped[index] - room.damped[index - 1];
            let mass = 0.5 * system.mass * cell * (density[face - 1] + density[face]);
            let flow = |face: usize| 0.25 * system.mass * (self.flux[face] + self.flux[face + 1]);
            let carried = flow(face) * (u[2] - u[1]) + flow(face - 1) * (u[1] - u[0]);
            let damped = damping * cell * u[1];
            rates[place.displacement + index] = u[1] - along * slope;
            rates[place.velocity + index] = (force - carried - damped) / mass + gravity;
            rates[system.parts.velocity.start + face] -= slope * elastic / mass;
            powers[0] += mass * gravity * u[1];
            powers[1] += damped * u[1];
        }
        powers
    }

    /// The rates at the ends of a span; power of what moves them, W.
    fn at_ends(
        &self,
        room: &Room,
        place: &Place,
        span: &SpanAcross,
        state: &[f64],
        rates: &mut [f64],
    ) -> f64 {
        let system = self.system;
        let (parts, mass) = (&system.parts, system.mass);
        let lengths = &system.mesh.lengths;
        let density = &state[parts.density.clone()];
        let (cell, last) = (lengths[place.cells.start], place.cells.len());
        let angle = parts.across.as_ref().map_or(0, |across| across.angle.start);
        let mut power = 0.0;
        // Sense in which the span lies from its end: ahead of the first one.
        for (end, sense) in span.ends.iter().zip([1.0, -1.0]) {
            let (index, inner, of_span) = match sense > 0.0 {
                true => (0, 1, 0),
                false => (last, last - 1, last - 1),
            };
            let speed = parts.speed.start + end.pulley;
            let [_, rising, quickening] =
                end.motion(state[angle + end.pulley], state[speed], rates[speed]);
            let closed = place.cells.start + index;
            let face = closed % lengths.len();
            let along = state[parts.velocity.start + face];
            let [u, next] = [index, inner].map(|index| state[place.velocity + index]);
            let slope = room.slope[of_span];
            let turning = sense * (rates[place.displacement + inner] - rising) / cell;
            let in_span = place.cells.start + of_span;
            // Half a cell moves across, and carries on what the flow through its middle and through the face brings.
            let half = 0.5 * mass * cell * density[in_span + 1];
            let [shares, around] = [self.shares[face], [density[face], density[face + 1]]];
            let behind = lengths[(face + lengths.len() - 1) % lengths.len()];
            let whole = 0.5 * mass * (around[0] * behind + around[1] * lengths[face]);
            let on_face = self.flux[face];
            let inside = 0.25 * mass * (self.flux[in_span] + self.flux[in_span + 1]);
            let carried = sense * (inside * (next - u) + mass * on_face * u);
            let known = half * (quickening + along * turning) + carried;
            let damped = sense * room.damped[of_span];
            let turned = 0.5 * mass * (shares[0] * around[0] + shares[1] * around[1]) * u * u;
            let straight = rates[parts.velocity.start + face];
            let held = whole * straight - slope * (known - damped) + sense * turned;
            let changed = held / (whole + half * slope * slope);
            rates[parts.velocity.start + face] = changed;
            let force = known + half * slope * changed;
            let pulled = sense * (room.elastic[of_span] + room.damped[of_span]);
            power += (force - pulled) * rising;
            rates[place.displacement + index] = rising;
            rates[place.velocity + index] = 0.0;
        }
        power
    }
}

/// Where a span stands.
struct Place {
    /// Its cells of the loop.
    cells: Range<usize>,
    /// Its displacements and velocities across in a state.
    displacement: usize,
    velocity: usize,
}
