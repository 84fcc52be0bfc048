//! The rates of a state: mass, momentum, bristles and pulleys, with the depth in the grooves in balance.
//!
//! In a cell of length h of the pitch line, with a of unstretched belt per length in it and λ = g/a, ρ = a/g:
//!
//! ```text
//! mass       h ȧ = −Δ(ρ̂ v)
//! momentum   m â h̄ v̇ = ρ̂ Δ(½ EA λ²) + Δ(c_d λ v_σ/g) − ½ Σ h f − ½ m (Ψ Δv + Ψ Δv) − ½ m v Σ ρ ġ h
//! friction   f = g (t cos θ − n sin θ)                 Ψ: mean of ρ̂ v at both faces of a cell
//! ```
//!
//! Its sums are such that energy is kept but for the steps of time: the terms with Ψ move kinetic energy from face to
//! face, that with ġ does the work of the part m ρ v² of F = T − m ρ v² in the radial balance.

use super::super::axles::Axles;
use super::super::bristle::slopes;
use super::radial::{Balance, Measure, Pull, Shape};
use super::sinking::{Contact, Drawn, Sinking, size};
use super::system::System;

/// The belt in a groove at the middle of a cell.
#[derive(Clone, Copy, Default)]
pub(super) struct Seated {
    /// Shape of the cell.
    pub(super) shape: Shape,
    /// Load k x per length, N/m; 0 where x < 0.
    load: f64,
    /// Sine and cosine of the inclination θ to the local circle, positive outward.
    pub(super) direction: [f64; 2],
    /// Slip `e_t` along the pulley, m/s.
    pub(super) slip: f64,
    /// Pressure p of each face per length, N/m.
    pub(super) pressure: f64,
}

/// The rates of the states of a system; what they are computed from stays until the next ones.
pub(crate) struct Rates<'s> {
    pub(crate) system: &'s System,
    /// Of the cells of each arc.
    measures: Vec<Measure>,
    /// 1/h of all cells, 1/m.
    per_cell: Vec<f64>,
    /// Shares of the cells behind and before a face in the density there.
    shares: Vec<[f64; 2]>,
    /// Time of the last rates, s.
    time: f64,
    /// Depth x at the faces of each arc, m.
    pub(super) depths: Vec<Vec<f64>>,
    balances: Vec<Balance>,
    /// Rate of the depth.
    pub(super) sinking: Vec<Sinking>,
    /// The cells of all arcs.
    pub(super) seated: Vec<Seated>,
    drawn: Vec<Drawn>,
    /// Pressure 2 p of both faces and outward load n in them, per k x.
    pressing: Vec<[f64; 2]>,
    /// Of all cells: 1/a, g, its rate in 1/s, stretch, velocity in the middle in m/s, force f h on the belt against its
    /// motion in N.
    per_amount: Vec<f64>,
    pub(super) lengths: Vec<f64>,
    pub(super) lengthening: Vec<f64>,
    pub(super) stretch: Vec<f64>,
    pub(super) middle: Vec<f64>,
    force: Vec<f64>,
    /// Of the cells, after that of the last one: ρ, a h in m, ½ EA λ² in N, force of damping in N, `force` with ½ m Ψ Δv
    /// of both faces in N.
    density: Vec<f64>,
    belt: Vec<f64>,
    elastic: Vec<f64>,
    viscous: Vec<f64>,
    held: Vec<f64>,
    /// Of the faces, the first one once more at the end: v and ρ̂ v in m/s.
    velocity: Vec<f64>,
    flux: Vec<f64>,
    /// Of the faces: deceleration ½ v/(â h̄) per ρ ġ h, 1/s.
    slowing: Vec<f64>,
    /// Torques on the pulleys.
    pub(super) axles: Axles,
}

/// A rate of the depth is found to this share of the largest velocity of the belt; the ledger feels no more than that.
const SINKING: f64 = 1e-10;

impl<'s> Rates<'s> {
    /// The rates of a system, with the belt on the pitch circles up to the first state.
    pub(crate) fn new(system: &'s System) -> Self {
        let mesh = &system.mesh;
        let cells = mesh.cells();
        let pulleys = system.wheels.len();
        let faces = || mesh.arcs.iter().map(|arc| arc.len() + 1);
        let room = || vec![0.0; cells];
        let closed = || vec![0.0; cells + 1];
        let measures = mesh.arcs.iter().zip(&system.wheels);
        Self {
            measures: measures
                .map(|(arc, wheel)| Measure::new(wheel.radius, mesh.lengths[arc.start]))
                .collect(),
            per_cell: mesh.lengths.iter().map(|length| length.recip()).collect(),
            shares: mesh.shares(),
            time: 0.0,
            depths: faces().map(|faces| vec![0.0; faces]).collect(),
            balances: faces().map(Balance::new).collect(),
            sinking: faces().map(Sinking::new).collect(),
            seated: vec![Seated::default(); mesh.bristle_cells()],
            drawn: vec![Drawn::default(); mesh.bristle_cells()],
            pressing: vec![[0.0; 2]; mesh.bristle_cells()],
            per_amount: room(),
            lengths: vec![1.0; cells],
            lengthening: room(),
            stretch: room(),
            middle: room(),
            force: room(),
            density: closed(),
            belt: closed(),
            elastic: closed(),
            viscous: closed(),
            held: closed(),
            velocity: closed(),
            flux: closed(),
            slowing: room(),
            axles: Axles::new(pulleys),
            system,
        }
    }

    /// Depth and shape of the belt whose tension in N is given in every cell of an arc, at rest or running with a
    /// velocity in m/s in every cell; whether there is one.
    pub(super) fn seat(
        &mut self,
        pulley: usize,
        state: &[f64],
        tension: impl Fn(usize) -> f64,
        velocity: impl Fn(usize) -> f64,
    ) -> bool {
        let system = self.system;
        let arc = system.mesh.arcs[pulley].clone();
        let up = &state[system.parts.up.clone()][system.mesh.bristles[pulley].clone()];
        let (measure, depths) = (&self.measures[pulley], &mut self.depths[pulley]);
        let settled = self.balances[pulley].settle(depths, measure, |cell, depth, _| {
            let (tension, speed) = (tension(cell), velocity(cell));
            let density = (1.0 + tension / system.axial_stiffness).recip();
            let tractive = tension - system.mass * density * speed * speed;
            let [_, outward] = system.pressing(up[cell]);
            Pull::new([tractive, 0.0], system.radial_stiffness * outward, depth)
        });
        for (ends, length) in depths.windows(2).zip(&mut self.lengths[arc]) {
            *length = measure.shape([ends[0], ends[1]]).length;
        }
        settled
    }

    /// The rates of a state at a time in s, which is set right.
    pub(super) fn evaluate(&mut self, time: f64, state: &mut [f64], rates: &mut [f64]) {
        let System { wheels, parts, .. } = self.system;
        let axles = &mut self.axles;
        axles.prescribe(wheels, time, &mut state[parts.speed.clone()]);
        self.belt(state);
        self.settle(time, state);
        self.cells(state, rates);
        self.faces(rates);
        self.sink(state, rates);
        self.slip(state, rates);
        let places = (&parts.speed, &parts.work, parts.turnover);
        self.axles.turn((wheels, time), places, state, rates);
    }

    /// What stands in a state whatever the depths are.
    fn belt(&mut self, state: &[f64]) {
        let System { parts, .. } = self.system;
        let velocity = &state[parts.velocity.clone()];
        let cells = velocity.len();
        self.velocity[..cells].copy_from_slice(velocity);
        self.velocity[cells] = velocity[0];
        for (middle, ends) in self.middle.iter_mut().zip(self.velocity.windows(2)) {
            *middle = 0.5 * (ends[0] + ends[1]);
        }
        let amounts = &state[parts.amount.clone()];
        for (per_amount, amount) in self.per_amount.iter_mut().zip(amounts) {
            *per_amount = amount.recip();
        }
        let up = &state[parts.up.clone()];
        for (pressing, up) in self.pressing.iter_mut().zip(up) {
            *pressing = self.system.pressing(*up);
        }
    }

    /// The depth in all grooves at a time in s, from the last one and its rate.
    fn settle(&mut self, time: f64, state: &[f64]) {
        let System {
            mass,
            axial_stiffness,
            radial_stiffness,
            ref parts,
            ref mesh,
            ..
        } = *self.system;
        let passed = time - self.time;
        self.time = time;
        for (pulley, arc) in mesh.arcs.iter().enumerate() {
            let cells = arc.len();
            let pressing = &self.pressing[mesh.bristles[pulley].clone()][..cells];
            let amounts = &state[parts.amount.clone()][arc.clone()][..cells];
            let per_amount = &self.per_amount[arc.clone()][..cells];
            let velocity = &self.velocity[arc.start..=arc.end][..=cells];
            let depths = &mut self.depths[pulley];
            self.sinking[pulley].go_on(passed, depths);
            let of_cell = |cell: usize, depth: f64, shape: &Shape| {
                // F = T − m ρ v² and its derivative with g.
                let squares = squares([velocity[cell], velocity[cell + 1]]);
                let centrifugal = mass * squares * amounts[cell] * shape.per_length;
                let tractive = [
                    axial_stiffness * (shape.length * per_amount[cell] - 1.0) - centrifugal,
                    axial_stiffness * per_amount[cell] + centrifugal * shape.per_length,
                ];
                let [_, outward] = pressing[cell];
                Pull::new(tractive, radial_stiffness * outward, depth)
            };
            if !self.balances[pulley].settle(depths, &self.measures[pulley], of_cell) {
                depths.fill(f64::NAN);
            }
        }
    }

    /// What stands in the cells, and the rates of bristles that do not slip.
    fn cells(&mut self, state: &[f64], rates: &mut [f64]) {
        let System {
            axial_stiffness,
            radial_stiffness,
            ref parts,
            ref mesh,
            ..
        } = *self.system;
        let amounts = &state[parts.amount.clone()];
        let speeds = &state[parts.speed.clone()];
        for (pulley, arc) in mesh.arcs.iter().enumerate() {
            let measure = self.measures[pulley];
            let own = mesh.bristles[pulley].clone();
            let middle = &self.middle[arc.clone()];
            let is_forward = middle[0] + middle[arc.len() - 1] >= 0.0;
            let [along, up] =
                [&parts.along, &parts.up].map(|part| &state[part.clone()][own.clone()]);
            for (part, list) in [(&parts.along, along), (&parts.up, up)] {
                let carried = &mut rates[part.clone()][own.clone()];
                slopes(carried, list, is_forward, measure.cell);
            }
            let cells = arc.len();
            let (depths, middle) = (&self.depths[pulley][..=cells], &middle[..cells]);
            let (along, pressing) = (&along[..cells], &self.pressing[own.clone()][..cells]);
            let (seated, amounts) = (
                &mut self.seated[own][..cells],
                &amounts[arc.clone()][..cells],
            );
            let lengths = &mut self.lengths[arc.clone()][..cells];
            let densities = &mut self.density[1..][arc.clone()][..cells];
            let forces = &mut self.force[arc.clone()][..cells];
            let mut torque = 0.0;
            for cell in 0..cells {
                let ends = [depths[cell], depths[cell + 1]];
                let shape = measure.shape(ends);
                let direction = [-shape.slope, shape.radius].map(|part| part * shape.per_length);
                let rim = measure.radius * shape.radius;
                let load = radial_stiffness * (0.5 * (ends[0] + ends[1])).max(0.0);
                let [faces, outward] = pressing[cell].map(|pressing| load * pressing);
                let against = faces * along[cell];
                seated[cell] = Seated {
                    shape,
                    load,
                    direction,
                    slip: middle[cell] * direction[1] - speeds[pulley] * rim,
                    pressure: 0.5 * faces,
                };
                lengths[cell] = shape.length;
                densities[cell] = amounts[cell] * shape.per_length;
                let length = shape.length * measure.cell;
                forces[cell] = length * (against * direction[1] - outward * direction[0]);
                torque += length * against * rim;
            }
            self.axles.torque[pulley] = torque;
            let own = mesh.bristles[pulley].clone();
            for part in [&parts.along, &parts.up] {
                let carried = rates[part.clone()][own.clone()].iter_mut();
                let cells = self.seated[own.clone()].iter().zip(middle);
                for (rate, (seated, v)) in carried.zip(cells) {
                    *rate *= -v * seated.shape.per_length;
                }
            }
        }
        for span in &mesh.spans {
            self.density[1..][span.clone()].copy_from_slice(&amounts[span.clone()]);
        }
        let cells = mesh.cells();
        let (lengths, amounts) = (&self.lengths[..cells], &amounts[..cells]);
        let (stretches, per_amount) = (&mut self.stretch[..cells], &self.per_amount[..cells]);
        let (belt, elastic) = (&mut self.belt[1..=cells], &mut self.elastic[1..=cells]);
        let pitch = &mesh.lengths[..cells];
        for cell in 0..cells {
            let stretch = lengths[cell] * per_amount[cell];
            stretches[cell] = stretch;
            belt[cell] = amounts[cell] * pitch[cell];
            elastic[cell] = 0.5 * axial_stiffness * stretch * stretch;
        }
        for closed in [&mut self.density, &mut self.belt, &mut self.elastic] {
            closed[0] = closed[cells];
        }
    }

    /// The rates of the mass, and those of the velocity without the part of ġ.
    fn faces(&mut self, rates: &mut [f64]) {
        let System {
            mass,
            axial_damping,
            ref parts,
            ref mesh,
            ..
        } = *self.system;
        let cells = mesh.cells();
        let per_cell = &self.per_cell[..cells];
        let velocity = &self.velocity[..=cells];
        let (density, elastic) = (&self.density[..=cells], &self.elastic[..=cells]);
        let (belt, shares) = (&self.belt[..=cells], &self.shares[..cells]);
        let mean = |face: usize| {
            let [behind, before] = shares[face];
            behind * density[face] + before * density[face + 1]
        };
        let flux = &mut self.flux[..=cells];
        for face in 0..cells {
            flux[face] = velocity[face] * mean(face);
        }
        flux[cells] = flux[0];
        let (per_amount, force) = (&self.per_amount[..cells], &self.force[..cells]);
        let (viscous, held) = (&mut self.viscous[..=cells], &mut self.held[..=cells]);
        let amounts = &mut rates[parts.amount.clone()][..cells];
        let mut damped = 0.0;
        for cell in 0..cells {
            let drop = velocity[cell + 1] - velocity[cell];
            // λ/g = 1/a.
            let damping = axial_damping * per_amount[cell] * drop * per_cell[cell];
            damped += damping * drop;
            viscous[cell + 1] = damping;
            held[cell + 1] = force[cell] + 0.5 * mass * (flux[cell] + flux[cell + 1]) * drop;
            amounts[cell] = (flux[cell] - flux[cell + 1]) * per_cell[cell];
        }
        (viscous[0], held[0]) = (viscous[cells], held[cells]);
        rates[parts.damped] = damped;
        let slowing = &mut self.slowing[..cells];
        let accelerations = &mut rates[parts.velocity.clone()][..cells];
        let per_mass = mass.recip();
        for face in 0..cells {
            let force = mean(face) * (elastic[face + 1] - elastic[face])
                + (viscous[face + 1] - viscous[face])
                - 0.5 * (held[face] + held[face + 1]);
            // 1/(2 â h̄).
            let per_belt = (belt[face] + belt[face + 1]).recip();
            accelerations[face] = 2.0 * force * per_belt * per_mass;
            slowing[face] = velocity[face] * per_belt;
        }
    }

    /// The rates of the depths.
    fn sink(&mut self, state: &[f64], rates: &[f64]) {
        let System {
            mass,
            axial_stiffness,
            bristle_stiffness,
            groove: [_, cosine],
            ref wheels,
            ref parts,
            ref mesh,
            ..
        } = *self.system;
        let fastest = self.velocity.iter().map(|v| v.abs()).fold(0.0, f64::max);
        let contact = Contact {
            stiffness: bristle_stiffness,
            per_cosine: cosine.recip(),
            moved: 2.0 * mass * fastest * fastest / axial_stiffness,
            error: SINKING * fastest,
        };
        for (pulley, arc) in mesh.arcs.iter().enumerate() {
            let cells = arc.len();
            let cell = self.measures[pulley].cell;
            let own = mesh.bristles[pulley].clone();
            let per_friction = wheels[pulley].friction_coefficient.recip();
            let seated = &self.seated[own.clone()][..cells];
            let pressing = &self.pressing[own.clone()][..cells];
            let up = &state[parts.up.clone()][own.clone()][..cells];
            let carried = &rates[parts.up.clone()][own.clone()][..cells];
            let per_amount = &self.per_amount[arc.clone()][..cells];
            let changes = &rates[parts.amount.clone()][arc.clone()][..cells];
            let faces = arc.start..=arc.end;
            let velocity = &self.velocity[faces.clone()][..=cells];
            let slowing = &self.slowing[faces.clone()][..=cells];
            let accelerations = &rates[parts.velocity.clone()][faces][..=cells];
            let (stretch, density) = (&self.stretch[arc.clone()], &self.density[1..][arc.clone()]);
            let (stretch, density) = (&stretch[..cells], &density[..cells]);
            let middle = &self.middle[arc.clone()][..cells];
            let drawn = &mut self.drawn[own.clone()][..cells];
            for index in 0..cells {
                let Seated {
                    shape,
                    load,
                    direction,
                    slip,
                    ..
                } = seated[index];
                let inertia = mass * density[index];
                let ends = [velocity[index], velocity[index + 1]];
                let by_amount = -per_amount[index]
                    * (axial_stiffness * stretch[index] + inertia * squares(ends));
                let change = ends[0] * accelerations[index] + ends[1] * accelerations[index + 1];
                drawn[index] = Drawn {
                    by: shape.by,
                    belt: density[index] * cell,
                    drawing: cell * (by_amount * changes[index] - inertia * change),
                    inertia: inertia * cell,
                    pressed: -0.5 * cell * shape.length * load * pressing[index][0].powi(2),
                    carried: carried[index],
                    slip: [slip, middle[index] * direction[0] * contact.per_cosine],
                    bent: up[index] * per_friction,
                };
            }
            let matrix = &self.balances[pulley].matrix;
            self.sinking[pulley].find(matrix, drawn, [velocity, slowing], &contact);
        }
    }

    /// What the sinking does to the rates of velocity and bristles; powers of friction and compression.
    fn slip(&mut self, state: &[f64], rates: &mut [f64]) {
        let System {
            bristle_stiffness,
            groove: [sine, cosine],
            ref wheels,
            ref parts,
            ref mesh,
            ..
        } = *self.system;
        let [mut friction, mut compression] = [0.0; 2];
        for (pulley, arc) in mesh.arcs.iter().enumerate() {
            let cell = self.measures[pulley].cell;
            let per_friction = wheels[pulley].friction_coefficient.recip();
            let first = mesh.bristles[pulley].start;
            for (index, ends) in self.sinking[pulley].rate.windows(2).enumerate() {
                let (place, of_loop) = (first + index, arc.start + index);
                let seated = &self.seated[place];
                let [behind, before] = seated.shape.by;
                self.lengthening[of_loop] = behind * ends[0] + before * ends[1];
                let outward =
                    self.middle[of_loop] * seated.direction[0] - 0.5 * (ends[0] + ends[1]);
                let slip = [seated.slip, outward / cosine];
                let size = size(slip) * per_friction;
                let bristles = [parts.along.start, parts.up.start].map(|part| part + place);
                let length = cell * seated.shape.length;
                for (bristle, slip) in bristles.into_iter().zip(slip) {
                    rates[bristle] += bristle_stiffness * (slip - size * state[bristle]);
                    friction += 2.0 * length * seated.pressure * state[bristle] * slip;
                }
                compression -= length * seated.load * sine * slip[1];
            }
            // ρ ġ h of the cell behind a face.
            let mut behind = 0.0;
            for face in arc.clone() {
                let before = self.density[face + 1] * self.lengthening[face] * cell;
                rates[parts.velocity.start + face] -= self.slowing[face] * (behind + before);
                behind = before;
            }
            rates[parts.velocity.start + arc.end] -= self.slowing[arc.end] * behind;
        }
        rates[parts.friction] = friction;
        rates[parts.compression] = compression;
    }
}

/// Mean of the squares of the velocity at the faces of a cell, m²/s².
fn squares([behind, before]: [f64; 2]) -> f64 {
    0.5 * (behind * behind + before * before)
}
