//! The rates of a state: mass, momentum, bristles and pulleys on the staggered mesh.
//!
//! Density and bristles stand in the middles of the cells, velocities at the faces, second order:
//!
//! ```text
//! mass       h ρ̇ = −Δ(v ρ̂)
//! momentum   m h̄ v̇ = Δ(½ EA λ² − ½ m v̂²) + c_d λ̄ Δλ̇ − ½ (q₋ h₋ + q₊ h₊)       λ = 1/ρ     λ̇ = λ ∂v/∂σ
//! friction   q = k_f b, |b| ≤ μ n λ/k_f                n = max(EA (λ − 1) − m v²/λ, 0)/R
//! pulley     J ω̇ = R ∫ q ρ dσ + M
//! ```

use super::axle::{Load, Motion, Motor};
use super::bristle::transport;
use super::string::Room;
use super::sums::{LANES, dot, total};
use super::system::{SLACK, System};

/// The rates of the states of a system; what they are computed from stays until the next ones.
pub(crate) struct Rates<'s> {
    pub(crate) system: &'s System,
    /// 1/h of each cell, 1/m.
    pub(super) per_cell: Vec<f64>,
    /// Shares of the cells behind and before a face in the density there.
    pub(super) shares: Vec<[f64; 2]>,
    /// 1/(m h̄) of each face, 1/kg.
    pub(super) per_mass: Vec<f64>,
    /// Of the cells, after that of the last one: stretch λ, its rate in 1/s, ½ EA λ² − ½ m v̂² in N, friction q h in N.
    pub(super) stretch: Vec<f64>,
    pub(super) stretching: Vec<f64>,
    pub(super) pressure: Vec<f64>,
    friction: Vec<f64>,
    /// Velocity in the middles of the cells, m/s.
    pub(super) middle: Vec<f64>,
    /// Mass flow over m through the faces, m/s.
    pub(super) flux: Vec<f64>,
    /// Largest displacement μ n λ/`k_f` of the bristles, m.
    pub(super) caps: Vec<f64>,
    /// Friction q ρ h on the arcs, N.
    forces: Vec<f64>,
    /// Torque of the belt on each pulley along the motion of the belt, N·m.
    pub(crate) torque: Vec<f64>,
    /// Torque of the axle on each pulley along the motion of the belt, N·m.
    pub(crate) shaft: Vec<f64>,
    /// On which straight line of its schedules each axle is.
    lines: Vec<[usize; 2]>,
    /// What the rates of a span across are computed from.
    pub(super) room: Room,
}

/// ½ EA λ² − ½ m v² of a stretch and a velocity, N; its slope over λ is λ times that of the tension, also in compression.
pub(super) fn pressure(axial_stiffness: f64, mass: f64, [stretch, middle]: [f64; 2]) -> f64 {
    let elastic = axial_stiffness * stretch * stretch;
    // In compression the second is larger.
    let elastic = elastic.max((1.0 - SLACK) * axial_stiffness + SLACK * elastic);
    0.5 * (elastic - mass * middle * middle)
}

impl<'s> Rates<'s> {
    /// The rates of a system.
    pub(crate) fn new(system: &'s System) -> Self {
        let lengths = &system.mesh.lengths;
        let cells = lengths.len();
        let around = |face: usize| [lengths[(face + cells - 1) % cells], lengths[face]];
        let share = |face: usize| {
            let [behind, before] = around(face);
            [before, behind].map(|other| other / (behind + before))
        };
        let per_mass = |face: usize| {
            let [behind, before] = around(face);
            2.0 / (system.mass * (behind + before))
        };
        let closed = || vec![0.0; cells + 1];
        let pulleys = system.wheels.len();
        Self {
            per_cell: lengths.iter().map(|length| length.recip()).collect(),
            shares: (0..cells).map(share).collect(),
            per_mass: (0..cells).map(per_mass).collect(),
            stretch: closed(),
            stretching: closed(),
            pressure: closed(),
            friction: closed(),
            middle: vec![0.0; cells],
            flux: closed(),
            caps: vec![0.0; system.mesh.bristle_cells()],
            forces: vec![0.0; system.mesh.bristle_cells()],
            torque: vec![0.0; pulleys],
            shaft: vec![0.0; pulleys],
            lines: vec![[0; 2]; pulleys],
            room: Room::default(),
            system,
        }
    }

    /// Takes what is given over time from the straight lines that hold from a time in s on.
    pub(crate) fn begin(&mut self, time: f64) {
        for (lines, wheel) in self.lines.iter_mut().zip(&self.system.wheels) {
            let given = wheel.axle.schedule();
            *lines = given.map(|given| given.map_or(0, |given| given.line(time)));
        }
    }

    /// The rates of a state at a time in s. Bristles beyond their largest displacement and prescribed speeds are set
    /// right in the state.
    pub(crate) fn of(&mut self, time: f64, state: &mut [f64], rates: &mut [f64]) {
        self.cells(state);
        self.prescribe(time, state);
        self.raise(state);
        let contact = self.arcs(state, rates);
        self.faces(state, rates);
        self.axles(time, state, rates);
        self.across(state, rates);
        let parts = &self.system.parts;
        let damped = self.damped(&state[parts.density.clone()]);
        rates[parts.damped] = damped;
        rates[parts.contact] = contact;
    }

    fn cells(&mut self, state: &[f64]) {
        let System {
            mass,
            axial_stiffness,
            ref parts,
            ..
        } = *self.system;
        let cells = self.per_cell.len();
        let density = &state[parts.density.clone()][1..];
        let velocity = &state[parts.velocity.clone()];
        let (behind, before) = (&velocity[..cells], &velocity[1..=cells]);
        let (density, per_cell) = (&density[..cells], &self.per_cell[..cells]);
        let stretches = &mut self.stretch[1..=cells];
        let stretching = &mut self.stretching[1..=cells];
        let pressures = &mut self.pressure[1..=cells];
        let middles = &mut self.middle[..cells];
        for cell in 0..cells {
            let stretch = density[cell].recip();
            let middle = 0.5 * (behind[cell] + before[cell]);
            stretches[cell] = stretch;
            stretching[cell] = stretch * (before[cell] - behind[cell]) * per_cell[cell];
            pressures[cell] = pressure(axial_stiffness, mass, [stretch, middle]);
            middles[cell] = middle;
        }
        for closed in [&mut self.stretch, &mut self.stretching, &mut self.pressure] {
            closed[0] = closed[cells];
        }
    }

    /// Sets the speeds that are given.
    fn prescribe(&self, time: f64, state: &mut [f64]) {
        let speeds = &mut state[self.system.parts.speed.clone()];
        for ((speed, wheel), lines) in speeds.iter_mut().zip(&self.system.wheels).zip(&self.lines) {
            if let Motion::Speed(given) = &wheel.axle.motion {
                *speed = given.on(lines[0], time)[0];
            }
        }
    }

    /// Friction and bristles on the arcs; the power that goes into the contact, W.
    fn arcs(&mut self, state: &mut [f64], rates: &mut [f64]) -> f64 {
        let System {
            mass,
            axial_stiffness,
            friction_stiffness,
            ref wheels,
            ref mesh,
            ref parts,
            ..
        } = *self.system;
        let mut power = 0.0;
        let (before, bristles) = state.split_at_mut(parts.bristle.start);
        let (bristles, speeds) = bristles.split_at_mut(parts.bristle.len());
        let density = &before[parts.density.clone()][1..];
        for (pulley, wheel) in wheels.iter().enumerate() {
            let (arc, bristle) = (mesh.arcs[pulley].clone(), mesh.bristles[pulley].clone());
            let cells = arc.len();
            let cell_length = mesh.lengths[arc.start];
            let rim = wheel.radius * speeds[pulley];
            let bristles = &mut bristles[bristle.clone()];
            let caps = &mut self.caps[bristle.clone()];
            let forces = &mut self.forces[bristle.clone()];
            let density = &density[arc.clone()];
            let stretch = &self.stretch[arc.start + 1..][..cells];
            let middle = &self.middle[arc.clone()];
            let friction = &mut self.friction[arc.start + 1..][..cells];
            let per_cap = wheel.friction_coefficient / (wheel.radius * friction_stiffness);
            for cell in 0..cells {
                let (stretch, v) = (stretch[cell], middle[cell]);
                // n R λ, from which inertia takes m v².
                let pressed = axial_stiffness * (stretch - 1.0) * stretch - mass * v * v;
                let cap = per_cap * pressed.max(0.0);
                let held = bristles[cell].max(-cap).min(cap);
                caps[cell] = cap;
                bristles[cell] = held;
                friction[cell] = friction_stiffness * held * cell_length;
                forces[cell] = friction[cell] * density[cell];
            }
            let force = total(forces);
            self.torque[pulley] = wheel.radius * force;
            power += dot(forces, middle) - rim * force;
            let places = parts.bristle.start + bristle.start..parts.bristle.start + bristle.end;
            transport(&mut rates[places], bristles, middle, rim, cell_length);
        }
        let cells = mesh.cells();
        self.friction[0] = self.friction[cells];
        power
    }

    fn faces(&mut self, state: &[f64], rates: &mut [f64]) {
        let (parts, damping) = (&self.system.parts, 0.5 * self.system.axial_damping);
        let cells = self.per_cell.len();
        let density = &state[parts.density.clone()][..=cells];
        let velocity = &state[parts.velocity.clone()][..=cells];
        let (stretch, stretching) = (&self.stretch[..=cells], &self.stretching[..=cells]);
        let (pressure, friction) = (&self.pressure[..=cells], &self.friction[..=cells]);
        let (shares, per_mass) = (&self.shares[..cells], &self.per_mass[..cells]);
        let flux = &mut self.flux[..=cells];
        let accelerations = &mut rates[parts.velocity.clone()][..=cells];
        for face in 0..cells {
            let [behind, before] = shares[face];
            flux[face] = velocity[face] * (behind * density[face] + before * density[face + 1]);
            let elastic = pressure[face + 1] - pressure[face];
            let damped = damping
                * (stretch[face] + stretch[face + 1])
                * (stretching[face + 1] - stretching[face]);
            let held = 0.5 * (friction[face] + friction[face + 1]);
            accelerations[face] = (elastic + damped - held) * per_mass[face];
        }
        flux[cells] = flux[0];
        accelerations[cells] = accelerations[0];
        let thinning = &mut rates[parts.density.clone()][..=cells];
        let per_cell = &self.per_cell[..cells];
        for cell in 0..cells {
            thinning[cell + 1] = (flux[cell] - flux[cell + 1]) * per_cell[cell];
        }
        thinning[0] = thinning[cells];
    }

    fn axles(&mut self, time: f64, state: &[f64], rates: &mut [f64]) {
        let parts = &self.system.parts;
        let mut turnover = 0.0;
        for (pulley, wheel) in self.system.wheels.iter().enumerate() {
            let (torque, lines) = (self.torque[pulley], self.lines[pulley]);
            let speed = state[parts.speed.start + pulley];
            let inertia = wheel.axle.inertia;
            let (shaft, change) = match &wheel.axle.motion {
                Motion::Speed(given) => {
                    let change = given.on(lines[0], time)[1];
                    (inertia * change - torque, change)
                }
                Motion::Torques { motor, load } => {
                    let drives = match motor {
                        Some(Motor::Torque(given)) => given.on(lines[0], time)[0],
                        Some(Motor::Characteristic(over_speed)) => over_speed.at(speed),
                        None => 0.0,
                    };
                    let given = load.torque.on(lines[1], time)[0];
                    let shaft = drives - load.against(given, speed, drives + torque);
                    (shaft, (shaft + torque) / inertia)
                }
            };
            let power = shaft * speed;
            self.shaft[pulley] = shaft;
            rates[parts.speed.start + pulley] = change;
            rates[parts.work.start + pulley] = power;
            turnover += power.abs();
        }
        rates[parts.turnover] = turnover;
    }

    /// Power lost in axial damping, W.
    fn damped(&self, density: &[f64]) -> f64 {
        let damping = self.system.axial_damping;
        if damping == 0.0 {
            return 0.0;
        }
        let lengths = &self.system.mesh.lengths[..];
        let cells = lengths.len();
        let (density, stretching) = (&density[1..=cells], &self.stretching[1..=cells]);
        let mut parts = [0.0; LANES];
        for cell in 0..cells {
            let rate = stretching[cell];
            parts[cell % LANES] += lengths[cell] * density[cell] * rate * rate;
        }
        damping * parts.iter().sum::<f64>()
    }

    /// The load of a pulley that stops it where its speed changes sign at a time in s.
    pub(crate) fn holds(&self, pulley: usize, time: f64) -> bool {
        match &self.system.wheels[pulley].axle.motion {
            Motion::Speed(_) => false,
            Motion::Torques { load, .. } => {
                let Load { torque, .. } = load;
                load.holds(torque.on(self.lines[pulley][1], time)[0])
            }
        }
    }

    /// Stretches of the cells at the last rates.
    pub(crate) fn stretches(&self) -> &[f64] {
        &self.stretch[1..]
    }

    /// Velocities in the middles of the cells at the last rates, m/s.
    pub(crate) fn middles(&self) -> &[f64] {
        &self.middle
    }

    /// Largest displacements of the bristles of a pulley at the last rates, m.
    pub(crate) fn caps(&self, pulley: usize) -> &[f64] {
        &self.caps[self.system.mesh.bristles[pulley].clone()]
    }
}
