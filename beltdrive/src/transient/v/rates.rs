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
use super::super::bristle::weights;
use super::super::dynamics::Dynamics;
use super::super::explicit::{larger, with_waves};
use super::super::ledger::Ledger;
use super::super::mesh::Mesh;
use super::super::simulation::StepBound;
use super::super::slip::{slipping, slips};
use super::super::system::Wheel;
use super::radial::{Balance, Pull, Shape, Tridiagonal};
use super::system::System;
use crate::vbelt::SLIPPING_BRISTLES;
use std::convert::Infallible;
use std::ops::Range;

/// The belt in a groove at the middle of a cell.
#[derive(Clone, Copy, Default)]
pub(super) struct Seated {
    /// Shape of the cell.
    pub(super) shape: Shape,
    /// Mean depth, m.
    depth: f64,
    /// Sine and cosine of the inclination θ to the local circle, positive outward.
    direction: [f64; 2],
    /// Slip `e_t` along the pulley, m/s.
    slip: f64,
    /// Pressure p of each face per length, N/m.
    pressure: f64,
    /// Rates of both bristles without those of the slip that the sinking makes, 1/s.
    carried: [f64; 2],
}

/// The rates of the states of a system; what they are computed from stays until the next ones.
pub(crate) struct Rates<'s> {
    pub(crate) system: &'s System,
    /// Depth x at the faces of each arc, m.
    pub(super) depths: Vec<Vec<f64>>,
    /// Rate of the depth, m/s.
    sinking: Vec<Vec<f64>>,
    balances: Vec<Balance>,
    matrix: Tridiagonal,
    side: Vec<f64>,
    /// The cells of all arcs.
    pub(super) seated: Vec<Seated>,
    /// Of all cells: g, its rate in 1/s, stretch, velocity in the middle in m/s, force f h on the belt against its
    /// motion in N.
    pub(super) lengths: Vec<f64>,
    lengthening: Vec<f64>,
    stretch: Vec<f64>,
    pub(super) middle: Vec<f64>,
    force: Vec<f64>,
    /// Of all faces: ρ̂ v in m/s, â h̄ in m, acceleration without that of ġ in m/s².
    flux: Vec<f64>,
    amount: Vec<f64>,
    acceleration: Vec<f64>,
    /// Torques on the pulleys.
    axles: Axles,
}

/// A rate of the depth is found to this share of the largest velocity of the belt; the ledger feels no more than that.
const SINKING: f64 = 1e-10;

/// Most corrections of the rates of the depth; they take two or three.
const MOST_CORRECTIONS: usize = 30;

/// Velocity that keeps the derivative of the slip |e| finite where the belt does not slip, m/s.
const GUARD: f64 = 1e-20;

impl<'s> Rates<'s> {
    /// The rates of a system, with the belt on the pitch circles up to the first state.
    pub(crate) fn new(system: &'s System) -> Self {
        let cells = system.mesh.cells();
        let pulleys = system.wheels.len();
        let faces = || -> Vec<Vec<f64>> {
            let arcs = system.mesh.arcs.iter();
            arcs.map(|arc| vec![0.0; arc.len() + 1]).collect()
        };
        let room = || vec![0.0; cells];
        Self {
            depths: faces(),
            sinking: faces(),
            balances: vec![Balance::default(); pulleys],
            matrix: Tridiagonal::default(),
            side: vec![],
            seated: vec![Seated::default(); system.mesh.bristle_cells()],
            lengths: vec![1.0; cells],
            lengthening: room(),
            stretch: room(),
            middle: room(),
            force: room(),
            flux: room(),
            amount: room(),
            acceleration: room(),
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
        let measure = [system.wheels[pulley].radius, system.mesh.lengths[arc.start]];
        let depths = &mut self.depths[pulley];
        let settled = self.balances[pulley].settle(depths, measure, |cell, depth, _| {
            let (tension, speed) = (tension(cell), velocity(cell));
            let density = (1.0 + tension / system.axial_stiffness).recip();
            let tractive = tension - system.mass * density * speed * speed;
            pull(system, [tractive, 0.0], depth, up[cell])
        });
        for (index, of_loop) in arc.enumerate() {
            let ends = [self.depths[pulley][index], self.depths[pulley][index + 1]];
            self.lengths[of_loop] = Shape::new(ends, measure[0], measure[1]).length;
        }
        settled
    }

    /// The depth in all grooves.
    fn settle(&mut self, state: &[f64]) {
        let system = self.system;
        let parts = &system.parts;
        let (amounts, velocity) = (&state[parts.amount.clone()], &state[parts.velocity.clone()]);
        for (pulley, arc) in system.mesh.arcs.iter().enumerate() {
            let up = &state[parts.up.clone()][system.mesh.bristles[pulley].clone()];
            let measure = [system.wheels[pulley].radius, system.mesh.lengths[arc.start]];
            let of_cell = |cell: usize, depth: f64, shape: &Shape| {
                let of_loop = arc.start + cell;
                let (amount, length) = (amounts[of_loop], shape.length);
                let tractive = tractive(system, amount, length, squares(velocity, of_loop));
                pull(system, [tractive.0, tractive.1], depth, up[cell])
            };
            let settled = self.balances[pulley].settle(&mut self.depths[pulley], measure, of_cell);
            if !settled {
                self.depths[pulley].fill(f64::NAN);
            }
            self.balances[pulley].assemble(&self.depths[pulley], measure, of_cell);
        }
    }

    /// What stands in the cells.
    fn cells(&mut self, state: &[f64]) {
        let system = self.system;
        let parts = &system.parts;
        let (amounts, velocity) = (&state[parts.amount.clone()], &state[parts.velocity.clone()]);
        let cells = amounts.len();
        for cell in 0..cells {
            self.middle[cell] = 0.5 * (velocity[cell] + velocity[(cell + 1) % cells]);
        }
        let speeds = &state[parts.speed.clone()];
        let [sine, cosine] = system.groove;
        for (pulley, arc) in system.mesh.arcs.iter().enumerate() {
            let radius = system.wheels[pulley].radius;
            let cell = system.mesh.lengths[arc.start];
            let own = system.mesh.bristles[pulley].clone();
            let [along, up] =
                [&parts.along, &parts.up].map(|part| &state[part.clone()][own.clone()]);
            let forward = self.middle[arc.start] + self.middle[arc.end - 1] >= 0.0;
            let depths = &self.depths[pulley];
            let mut torque = 0.0;
            for (index, of_loop) in arc.clone().enumerate() {
                let ends = [depths[index], depths[index + 1]];
                let shape = Shape::new(ends, radius, cell);
                let depth = 0.5 * (ends[0] + ends[1]);
                let direction = [-shape.slope / shape.length, shape.radius / shape.length];
                let v = self.middle[of_loop];
                let rim = radius * shape.radius;
                let pressure =
                    0.5 * system.radial_stiffness * depth.max(0.0) / (cosine + up[index] * sine);
                let outward = 2.0 * pressure * (sine - up[index] * cosine);
                let against = 2.0 * pressure * along[index];
                let slope = |list: &[f64]| slope(list, index, forward) / (6.0 * cell);
                let carried = [along, up].map(|list| -(v / shape.length) * slope(list));
                self.seated[own.start + index] = Seated {
                    shape,
                    depth,
                    direction,
                    slip: v * direction[1] - speeds[pulley] * rim,
                    pressure,
                    carried,
                };
                let length = shape.length * cell;
                self.lengths[of_loop] = shape.length;
                self.force[of_loop] = length * (against * direction[1] - outward * direction[0]);
                torque += length * against * rim;
            }
            self.axles.torque[pulley] = torque;
        }
        for ((stretch, length), amount) in self.stretch.iter_mut().zip(&self.lengths).zip(amounts) {
            *stretch = length / amount;
        }
    }

    /// The rates of the mass, and accelerations without the part of ġ.
    fn faces(&mut self, state: &[f64], rates: &mut [f64]) {
        let System {
            mass,
            axial_stiffness,
            axial_damping,
            ref parts,
            ref mesh,
            ..
        } = *self.system;
        let (amounts, velocity) = (&state[parts.amount.clone()], &state[parts.velocity.clone()]);
        let lengths = &mesh.lengths;
        let cells = lengths.len();
        let density = |cell: usize| self.stretch[cell].recip();
        let mean = |face: usize, behind: usize| {
            let [back, front] = [lengths[behind], lengths[face]];
            (density(behind) * front + density(face) * back) / (back + front)
        };
        for face in 0..cells {
            let behind = (face + cells - 1) % cells;
            self.flux[face] = velocity[face] * mean(face, behind);
            self.amount[face] =
                0.5 * (amounts[behind] * lengths[behind] + amounts[face] * lengths[face]);
        }
        let through = |cell: usize| 0.5 * (self.flux[cell] + self.flux[(cell + 1) % cells]);
        let drop = |cell: usize| velocity[(cell + 1) % cells] - velocity[cell];
        let damping = |cell: usize| {
            axial_damping * self.stretch[cell] * drop(cell) / (lengths[cell] * self.lengths[cell])
        };
        let mut damped = 0.0;
        for face in 0..cells {
            let behind = (face + cells - 1) % cells;
            let squares = [behind, face].map(|cell| self.stretch[cell].powi(2));
            let elastic = mean(face, behind) * 0.5 * axial_stiffness * (squares[1] - squares[0]);
            let moved = 0.5 * mass * (through(face) * drop(face) + through(behind) * drop(behind));
            let held = 0.5 * (self.force[face] + self.force[behind]);
            let viscous = damping(face);
            damped += viscous * drop(face);
            let force = elastic + viscous - damping(behind) - moved - held;
            self.acceleration[face] = force / (mass * self.amount[face]);
            rates[parts.amount.start + face] =
                (self.flux[face] - self.flux[(face + 1) % cells]) / lengths[face];
        }
        rates[parts.damped] = damped;
    }

    /// The rates of depth, bristles and velocity, which depend on each other; powers of friction and compression.
    fn sink(&mut self, state: &[f64], rates: &mut [f64]) {
        let system = self.system;
        let (parts, mesh) = (&system.parts, &system.mesh);
        let (amounts, velocity) = (&state[parts.amount.clone()], &state[parts.velocity.clone()]);
        let cells = amounts.len();
        let fastest = velocity.iter().map(|v| v.abs()).fold(0.0, f64::max);
        let [_, cosine] = system.groove;
        let stiffness = system.bristle_stiffness;
        for correction in 0.. {
            self.accelerate(state, rates);
            let mut largest: f64 = 0.0;
            for (pulley, arc) in mesh.arcs.iter().enumerate() {
                let cell = mesh.lengths[arc.start];
                let own = mesh.bristles[pulley].clone();
                let friction_coefficient = system.wheels[pulley].friction_coefficient;
                self.matrix.clone_from(&self.balances[pulley].matrix);
                let inner = arc.len() - 1;
                self.side.clear();
                self.side.resize(inner, 0.0);
                for (row, values) in self.balances[pulley].matrix.rows.iter().enumerate() {
                    for (value, column) in values.iter().zip([row, row + 1, row + 2]) {
                        self.side[row] += value * self.sinking[pulley][column];
                    }
                }
                for (index, of_loop) in arc.clone().enumerate() {
                    let seated = self.seated[own.start + index];
                    let shape = seated.shape;
                    let sinking =
                        0.5 * (self.sinking[pulley][index] + self.sinking[pulley][index + 1]);
                    let place = own.start + index;
                    let bristles =
                        [parts.along.start, parts.up.start].map(|part| state[part + place]);
                    let outward = self.middle[of_loop] * seated.direction[0] - sinking;
                    let slip = [seated.slip, outward / cosine];
                    let norm = (slip[0] * slip[0] + slip[1] * slip[1] + GUARD * GUARD).sqrt();
                    let bends = [0, 1].map(|axis| {
                        let saturation = norm * bristles[axis] / friction_coefficient;
                        seated.carried[axis] + stiffness * (slip[axis] - saturation)
                    });
                    rates[parts.along.start + place] = bends[0];
                    rates[parts.up.start + place] = bends[1];
                    // The tractive tension changes with the mass in the cell and with its velocity.
                    let (amount, length) = (amounts[of_loop], shape.length);
                    let next = (of_loop + 1) % cells;
                    let squares = squares(velocity, of_loop);
                    let change = velocity[of_loop] * rates[parts.velocity.start + of_loop]
                        + velocity[next] * rates[parts.velocity.start + next];
                    let by_amount = -(system.axial_stiffness * length / amount
                        + system.mass * squares * amount / length)
                        / amount;
                    let tractive = by_amount * rates[parts.amount.start + of_loop]
                        - system.mass * amount / length * change;
                    let pressed = system.radial_stiffness * seated.depth.max(0.0);
                    let [_, by_up] = system.outward(bristles[1]);
                    let per_bend = 0.5 * cell * length * pressed * by_up;
                    for (side, face) in [index, index + 1].into_iter().enumerate() {
                        if let Some(row) = face.checked_sub(1).filter(|&row| row < inner) {
                            self.side[row] +=
                                cell * tractive * shape.by[side] + per_bend * bends[1];
                        }
                    }
                    // What the rate of the bristles changes with the sinking of the middle.
                    let bend = -stiffness / cosine
                        * (1.0 - slip[1] * bristles[1] / (norm * friction_coefficient));
                    let entry = 0.5 * per_bend * bend;
                    self.matrix.add(index, [[entry; 2]; 2]);
                }
                self.matrix.solve(&mut self.side);
                for (rate, change) in self.sinking[pulley][1..].iter_mut().zip(&self.side) {
                    *rate -= change;
                    largest = largest.max(change.abs());
                }
            }
            if largest <= SINKING * fastest || correction == MOST_CORRECTIONS || largest.is_nan() {
                break;
            }
        }
        let [mut friction, mut compression] = [0.0; 2];
        let [sine, _] = system.groove;
        for (pulley, arc) in mesh.arcs.iter().enumerate() {
            let cell = mesh.lengths[arc.start];
            let own = mesh.bristles[pulley].clone();
            for index in 0..arc.len() {
                let place = own.start + index;
                let seated = &self.seated[place];
                let up = self.sliding(pulley, index);
                let slip = [seated.slip, up];
                let bristles = [parts.along.start, parts.up.start].map(|part| state[part + place]);
                let length = cell * seated.shape.length;
                friction += 2.0
                    * length
                    * seated.pressure
                    * (bristles[0] * slip[0] + bristles[1] * slip[1]);
                let pressed = system.radial_stiffness * seated.depth.max(0.0);
                compression -= length * pressed * sine * up;
            }
        }
        rates[parts.friction] = friction;
        rates[parts.compression] = compression;
    }

    /// Deflection of the bristles in a cell of all arcs.
    fn bent(&self, state: &[f64], place: usize) -> f64 {
        let parts = &self.system.parts;
        state[parts.along.start + place].hypot(state[parts.up.start + place])
    }

    /// Deflection from which on the bristles of a pulley count as slipping.
    fn limit(&self, pulley: usize) -> f64 {
        SLIPPING_BRISTLES * self.system.wheels[pulley].friction_coefficient
    }

    /// Slip `e_w` of the belt up the groove faces in a cell of an arc, m/s.
    fn sliding(&self, pulley: usize, index: usize) -> f64 {
        let mesh = &self.system.mesh;
        let sinking = 0.5 * (self.sinking[pulley][index] + self.sinking[pulley][index + 1]);
        let direction = self.seated[mesh.bristles[pulley].start + index].direction;
        let v = self.middle[mesh.arcs[pulley].start + index];
        (v * direction[0] - sinking) / self.system.groove[1]
    }

    /// Rates of the lengths of the cells, and accelerations with what they do.
    fn accelerate(&mut self, state: &[f64], rates: &mut [f64]) {
        let system = self.system;
        let (parts, mesh) = (&system.parts, &system.mesh);
        let (amounts, velocity) = (&state[parts.amount.clone()], &state[parts.velocity.clone()]);
        for (pulley, arc) in mesh.arcs.iter().enumerate() {
            for (index, of_loop) in arc.clone().enumerate() {
                let [behind, before] = self.seated[mesh.bristles[pulley].start + index].shape.by;
                let sinking = &self.sinking[pulley];
                self.lengthening[of_loop] = behind * sinking[index] + before * sinking[index + 1];
            }
        }
        let cells = amounts.len();
        for face in 0..cells {
            let around = [(face + cells - 1) % cells, face];
            let lengthening: f64 = around
                .iter()
                .map(|&cell| self.lengthening[cell] * mesh.lengths[cell] / self.stretch[cell])
                .sum();
            rates[parts.velocity.start + face] =
                self.acceleration[face] - 0.5 * velocity[face] * lengthening / self.amount[face];
        }
    }
}

/// Mean of the squares of the velocity at the faces of a cell, m²/s².
pub(super) fn squares(velocity: &[f64], cell: usize) -> f64 {
    let next = velocity[(cell + 1) % velocity.len()];
    0.5 * (velocity[cell] * velocity[cell] + next * next)
}

/// F = T − m ρ v² of a cell with an amount of belt and a length, and its derivative with the length, N.
fn tractive(system: &System, amount: f64, length: f64, squares: f64) -> (f64, f64) {
    let (stretch, centrifugal) = (length / amount, system.mass * squares * amount / length);
    (
        system.tension(stretch) - centrifugal,
        system.axial_stiffness / amount + centrifugal / length,
    )
}

fn pull(system: &System, tractive: [f64; 2], depth: f64, up: f64) -> Pull {
    let [share, _] = system.outward(up);
    let stiffness = match depth > 0.0 {
        true => system.radial_stiffness * share,
        false => 0.0,
    };
    Pull {
        tractive,
        outward: [stiffness * depth, stiffness],
    }
}

/// Six times the difference of what the belt carries along an arc in a cell, from where it enters.
fn slope(list: &[f64], cell: usize, forward: bool) -> f64 {
    let count = list.len();
    let place = |at: usize| if forward { at } else { count - 1 - at };
    let (first, weights) = weights(place(cell), count);
    let sum: f64 = { weights.iter().enumerate() }
        .map(|(offset, weight)| weight * list[place(first + offset)])
        .sum();
    if forward { sum } else { -sum }
}

/// A pulley slips grossly where the belt slips everywhere by this share of its speed: creep is a fifth of that at the
/// usual loads of V-belts, and takes place on a part of the contact.
const GROSS: f64 = 0.01;

impl Dynamics for Rates<'_> {
    type Implicit = Infallible;

    fn mesh(&self) -> &Mesh {
        &self.system.mesh
    }

    fn wheels(&self) -> &[Wheel] {
        &self.system.wheels
    }

    fn axles(&self) -> &Axles {
        &self.axles
    }

    fn speeds(&self) -> Range<usize> {
        self.system.parts.speed.clone()
    }

    fn begin(&mut self, time: f64) {
        self.axles.begin(&self.system.wheels, time);
    }

    fn of(&mut self, time: f64, state: &mut [f64], rates: &mut [f64]) {
        let System { wheels, parts, .. } = self.system;
        let axles = &mut self.axles;
        axles.prescribe(wheels, time, &mut state[parts.speed.clone()]);
        self.settle(state);
        self.cells(state);
        self.faces(state, rates);
        self.sink(state, rates);
        let mut turnover = 0.0;
        let speeds = &state[parts.speed.clone()];
        self.axles
            .turn(wheels, time, speeds, |pulley, change, power| {
                rates[parts.speed.start + pulley] = change;
                rates[parts.work.start + pulley] = power;
                turnover += power.abs();
            });
        rates[parts.turnover] = turnover;
    }

    /// That of the fastest axial wave between two cells with the belt held by its bristles, of axial damping, of bristles
    /// that saturate.
    fn fastest(&self, state: &[f64]) -> (f64, StepBound) {
        let System {
            mass,
            axial_stiffness,
            axial_damping,
            bristle_stiffness,
            ref wheels,
            ref mesh,
            ref parts,
            ..
        } = *self.system;
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let stretch = largest(&mut self.stretch.iter().copied());
        let speeds = &state[parts.velocity.clone()];
        let speed = largest(&mut speeds.iter().map(|v| v.abs()));
        let cell = { mesh.lengths.iter().zip(&self.lengths) }
            .map(|(length, g)| length * g)
            .fold(f64::INFINITY, f64::min);
        let wave = 2.0 * (stretch * (axial_stiffness / mass).sqrt() + speed) / cell;
        let arcs = mesh.arcs.iter().zip(wheels).enumerate();
        let held = arcs.clone().map(|(pulley, (arc, wheel))| {
            let seated = self.seated[mesh.bristles[pulley].clone()].iter();
            let pressure = largest(&mut seated.map(|seated| seated.pressure));
            let length = arc.len() as f64 * mesh.lengths[arc.start];
            let per_mass = stretch / mass + length * wheel.mobility();
            let rate = 2.0 * pressure * bristle_stiffness * per_mass;
            (rate, StepBound::Bristles { pulley })
        });
        let elastic = with_waves(wave, held);
        let saturating = arcs.map(|(pulley, (arc, wheel))| {
            let seated = self.seated[mesh.bristles[pulley].clone()].iter();
            let slips = seated.enumerate().map(|(index, seated)| {
                let outward = self.middle[arc.start + index] * seated.direction[0];
                seated.slip.hypot(outward / self.system.groove[1])
            });
            let slip = largest(&mut { slips });
            let rate = bristle_stiffness * slip / wheel.friction_coefficient;
            (rate + 2.0 * speed / cell, StepBound::Bristles { pulley })
        });
        let damping = 4.0 * axial_damping * stretch * stretch / (mass * cell * cell);
        saturating.fold(larger(elastic, (damping, StepBound::AxialDamping)), larger)
    }

    fn implicit(&self, _: &[f64], _: f64) -> Option<Infallible> {
        None
    }

    fn wave_speed(&self) -> f64 {
        (self.system.axial_stiffness / self.system.mass).sqrt()
    }

    fn tension(&self, stretch: f64) -> f64 {
        self.system.tension(stretch)
    }

    fn stretches(&self) -> &[f64] {
        &self.stretch
    }

    fn middles(&self) -> &[f64] {
        &self.middle
    }

    fn slips(&self, state: &[f64], pulley: usize, index: usize) -> bool {
        let place = self.system.mesh.bristles[pulley].start + index;
        slips(self.bent(state, place), self.limit(pulley))
    }

    fn slips_grossly(&self, _: &[f64], pulley: usize) -> bool {
        let own = self.system.mesh.bristles[pulley].clone();
        let first = self.system.mesh.arcs[pulley].start;
        self.seated[own].iter().enumerate().all(|(index, seated)| {
            let slip = seated.slip.hypot(self.sliding(pulley, index));
            slip > GROSS * self.middle[first + index].abs()
        })
    }

    fn slipping(&self, state: &[f64], pulley: usize) -> f64 {
        let own = self.system.mesh.bristles[pulley].clone();
        let bent: Vec<_> = own.map(|place| self.bent(state, place)).collect();
        slipping(&bent, &vec![self.limit(pulley); bent.len()])
    }

    fn force(&self, state: &[f64], pulley: usize, index: usize) -> [f64; 2] {
        let System {
            groove: [sine, cosine],
            ref mesh,
            ref parts,
            ..
        } = *self.system;
        let place = mesh.bristles[pulley].start + index;
        let seated = &self.seated[place];
        let [along, up] = [&parts.along, &parts.up].map(|part| state[part.start + place]);
        let faces =
            2.0 * seated.pressure * seated.shape.length * mesh.lengths[mesh.arcs[pulley].start];
        [faces * along, faces * (sine - up * cosine)]
    }

    fn friction(&self, state: &[f64]) -> Vec<f64> {
        let System { mesh, parts, .. } = self.system;
        let mut friction = vec![0.0; mesh.cells()];
        for (arc, own) in mesh.arcs.iter().zip(&mesh.bristles) {
            let cells = self.seated[own.clone()].iter();
            let bristles = &state[parts.along.clone()][own.clone()];
            for (to, (seated, along)) in friction[arc.clone()].iter_mut().zip(cells.zip(bristles)) {
                *to = 2.0 * seated.pressure * along;
            }
        }
        friction
    }

    fn displacements<'a>(&self, _: &'a [f64], _: usize) -> &'a [f64] {
        &[]
    }

    fn energy(&self, state: &[f64]) -> f64 {
        self.system.energy(state, &self.lengths)
    }

    fn ledger(&self, state: &[f64], at_start: f64) -> Ledger {
        let parts = &self.system.parts;
        Ledger {
            work: state[parts.work.clone()].iter().sum(),
            stored: self.energy(state) - at_start,
            damped: state[parts.damped],
            contact: state[parts.friction],
            compression: state[parts.compression],
            turnover: at_start + state[parts.turnover],
            ..Ledger::default()
        }
    }

    fn unrest(&self, state: &[f64], rates: &[f64]) -> f64 {
        let amounts = &self.system.parts.amount;
        let (amount, changes) = (&state[amounts.clone()], &rates[amounts.clone()]);
        let tensions = self.stretch.iter().enumerate().map(|(cell, stretch)| {
            // The rate of T = EA (g/a − 1) over T.
            let rate = (self.lengthening[cell] - stretch * changes[cell]) / amount[cell];
            (rate / (stretch - 1.0)).abs()
        });
        tensions.fold(0.0, f64::max)
    }

    fn impossible(&self, state: &[f64]) -> Option<&'static str> {
        let mut amounts = state[self.system.parts.amount.clone()].iter();
        if self.depths.iter().flatten().any(|depth| depth.is_nan()) {
            return Some(
                "no depth in a groove balances its tension: the belt is slack there, or centrifugal force lifts it off",
            );
        }
        (amounts.any(|amount| *amount <= 0.0)).then_some("the belt is stretched without bounds")
    }
}
