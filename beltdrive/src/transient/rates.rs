//! The rates of a state: mass, momentum, bristles and pulleys on the staggered mesh.
//!
//! Density and bristles stand in the middles of the cells, velocities at the faces, second order:
//!
//! ```text
//! mass       h ρ̇ = −Δ(v ρ̂)
//! momentum   m h̄ v̇ = Δ(½ EA λ² − ½ m v̂²) + c_d λ̄ Δλ̇ − ½ (q₋ h₋ + q₊ h₊)       λ = 1/ρ     λ̇ = λ ∂v/∂σ
//! friction   q = k_f b, |b| ≤ μ n λ/k_f                n = max(EA (λ − 1) − m v²/λ, 0)/R
//!            q = k_f b + c_f (v − R ω), |q| ≤ μ n λ    with damping of the bristles
//!            q = μ n λ (v − R ω)/v_c, |q| ≤ μ n λ      with creep-rate friction (Leamy and Wasfy, 2002)
//! pulley     J ω̇ = R ∫ q ρ dσ + M
//! ```

use super::axles::Axles;
use super::bristle::transport;
use super::dynamics::{Dynamics, StepLimits};
use super::explicit::{PER_SINE, larger, with_waves};
use super::implicit::Implicit;
use super::ledger::Ledger;
use super::mesh::Mesh;
use super::simulation::StepBound;
use super::slip::{slipping, slips};
use super::string::{self, Room};
use super::sums::{LANES, dot, total};
use super::system::{Resistance, SLACK, System, Wheel};
use pulp::{Arch, NullaryFnOnce};
use std::ops::Range;

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
    pub(super) friction: Vec<f64>,
    /// Velocity in the middles of the cells, m/s.
    pub(super) middle: Vec<f64>,
    /// Mass flow over m through the faces, m/s.
    pub(super) flux: Vec<f64>,
    /// Largest displacement μ n λ/`k_f` of the bristles, m.
    pub(super) caps: Vec<f64>,
    /// Friction q ρ h on the arcs, N.
    forces: Vec<f64>,
    /// Torques on the pulleys.
    axles: Axles,
    /// What the rates of a span across are computed from.
    pub(super) room: Room,
    /// The instructions of the machine: registers of four numbers in place of two take 28 % off the time of a run.
    arch: Arch,
}

/// ½ EA λ² − ½ m v² of a stretch and a velocity, N; its slope over λ is λ times that of the tension, also in compression.
#[inline(always)]
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
        let per_mass = |face: usize| {
            let [behind, before] = [(face + cells - 1) % cells, face].map(|cell| lengths[cell]);
            2.0 / (system.mass * (behind + before))
        };
        let closed = || vec![0.0; cells + 1];
        let pulleys = system.wheels.len();
        Self {
            per_cell: lengths.iter().map(|length| length.recip()).collect(),
            shares: system.mesh.shares(),
            per_mass: (0..cells).map(per_mass).collect(),
            stretch: closed(),
            stretching: closed(),
            pressure: closed(),
            friction: closed(),
            middle: vec![0.0; cells],
            flux: closed(),
            caps: vec![0.0; system.mesh.bristle_cells()],
            forces: vec![0.0; system.mesh.bristle_cells()],
            axles: Axles::new(pulleys),
            room: Room::default(),
            arch: Arch::new(),
            system,
        }
    }

    #[inline(always)]
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

    /// Friction and bristles on the arcs; the power that goes into the contact, W.
    #[inline(always)]
    fn arcs(&mut self, state: &mut [f64], rates: &mut [f64]) -> f64 {
        let System {
            mass,
            axial_stiffness,
            resistance,
            ref wheels,
            ref mesh,
            ref parts,
            ..
        } = *self.system;
        let friction_stiffness = resistance.stiffness();
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
            }
            let places = parts.bristle.start + bristle.start..parts.bristle.start + bristle.end;
            let changes = &mut rates[places];
            match resistance {
                Resistance::Bristles { damping, .. } => {
                    if damping > 0.0 {
                        for cell in 0..cells {
                            let most = friction_stiffness * caps[cell] * cell_length;
                            let damped = damping * (middle[cell] - rim) * cell_length;
                            friction[cell] = (friction[cell] + damped).max(-most).min(most);
                        }
                    }
                    transport(changes, bristles, middle, rim, cell_length);
                }
                Resistance::Creep { velocity } => {
                    for cell in 0..cells {
                        let developed = ((middle[cell] - rim) / velocity).clamp(-1.0, 1.0);
                        bristles[cell] = developed * caps[cell];
                        friction[cell] = bristles[cell] * cell_length;
                    }
                    changes.fill(0.0);
                }
            }
            for (force, (friction, density)) in forces.iter_mut().zip(friction.iter().zip(density))
            {
                *force = friction * density;
            }
            let force = total(forces);
            self.axles.torque[pulley] = wheel.radius * force;
            power += dot(forces, middle) - rim * force;
        }
        let cells = mesh.cells();
        self.friction[0] = self.friction[cells];
        power
    }

    #[inline(always)]
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

    /// Power lost in axial damping, W.
    #[inline(always)]
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

    /// Slip velocity v − R ω in a cell of the arc of a pulley, by the number of the cell on the loop, m/s.
    pub(super) fn slip(&self, state: &[f64], [pulley, cell]: [usize; 2]) -> f64 {
        let rim = self.system.wheels[pulley].radius;
        self.middle[cell] - rim * state[self.system.parts.speed.start + pulley]
    }

    /// The displacement b + `c_f` (v − R ω)/`k_f` that bristles without damping would have with the friction that there would be
    /// without its limit, m: in a cell, by its numbers on the loop and among those of all arcs.
    pub(super) fn pulled(&self, state: &[f64], [pulley, cell, bristle]: [usize; 3]) -> f64 {
        let displaced = state[self.system.parts.bristle.start + bristle];
        match self.system.resistance {
            Resistance::Bristles { stiffness, damping } => {
                displaced + damping / stiffness * self.slip(state, [pulley, cell])
            }
            Resistance::Creep { .. } => displaced,
        }
    }

    /// Displacements of the bristles of a pulley in a state, m.
    fn bristles<'a>(&self, state: &'a [f64], pulley: usize) -> &'a [f64] {
        &state[self.system.parts.bristle.clone()][self.system.mesh.bristles[pulley].clone()]
    }

    /// Largest displacements of the bristles of a pulley at the last rates, m.
    pub(crate) fn caps(&self, pulley: usize) -> &[f64] {
        &self.caps[self.system.mesh.bristles[pulley].clone()]
    }
}

/// An evaluation of rates, which is compiled anew for each set of instructions, with all that it calls in the loops over
/// cells in place.
struct Evaluation<'r, 's> {
    of: &'r mut Rates<'s>,
    time: f64,
    state: &'r mut [f64],
    rates: &'r mut [f64],
}

impl NullaryFnOnce for Evaluation<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self {
            of,
            time,
            state,
            rates,
        } = self;
        let System { wheels, parts, .. } = of.system;
        of.cells(state);
        let axles = &mut of.axles;
        axles.prescribe(wheels, time, &mut state[parts.speed.clone()]);
        of.raise(state);
        rates[parts.contact] = of.arcs(state, rates);
        of.faces(state, rates);
        let places = (&parts.speed, &parts.work, parts.turnover);
        of.axles.turn((wheels, time), places, state, rates);
        of.across(state, rates);
        rates[parts.damped] = of.damped(&state[parts.density.clone()]);
    }
}

impl Dynamics for Rates<'_> {
    type Implicit = Implicit;

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
        self.arch.dispatch(Evaluation {
            of: self,
            time,
            state,
            rates,
        });
    }

    /// That of the fastest axial wave between two cells with the belt held by its bristles, of damping, of rims with
    /// run-out.
    fn fastest(&self, state: &[f64]) -> (f64, StepBound) {
        let System {
            mass,
            axial_stiffness,
            axial_damping,
            resistance,
            ref across,
            ref wheels,
            ref mesh,
            ref parts,
        } = *self.system;
        let densities = state[parts.density.clone()].iter().copied();
        // Waves across are slower than axial ones by the root of the strain.
        let stretch = densities.fold(f64::INFINITY, f64::min).recip();
        let speeds = state[parts.velocity.clone()].iter().copied();
        let speed = speeds.map(f64::abs).fold(0.0, f64::max);
        let cell = mesh.shortest();
        let wave = 2.0 * (stretch * (axial_stiffness / mass).sqrt() + speed) / cell;
        // A belt held on a pulley that turns: its mass beside that of the pulley at the rim.
        let per_mass = |pulley: usize| {
            let arc = &mesh.arcs[pulley];
            let length = arc.len() as f64 * mesh.lengths[arc.start];
            mass.recip() + length * wheels[pulley].mobility()
        };
        let pulleys = 0..wheels.len();
        let held = pulleys.clone().map(|pulley| {
            let stiffness = match resistance {
                Resistance::Bristles { stiffness, .. } => stiffness,
                Resistance::Creep { .. } => 0.0,
            };
            (stiffness * per_mass(pulley), StepBound::Bristles { pulley })
        });
        let rubbing = pulleys.map(|pulley| {
            let damping = match resistance {
                Resistance::Bristles { damping, .. } => damping,
                Resistance::Creep { velocity } => {
                    let largest = self.caps(pulley).iter().copied().fold(0.0, f64::max);
                    RISE * largest / velocity
                }
            };
            (damping * per_mass(pulley), StepBound::Bristles { pulley })
        });
        let first = with_waves(wave, held);
        let axial = 4.0 * axial_damping * stretch * stretch / (mass * cell * cell);
        let damping = across.as_ref().map_or(0.0, |across| across.damping);
        let ends = across.iter().flat_map(|across| &across.spans);
        let ends = ends.flat_map(|span| span.ends).map(|end| {
            let round = end.order * state[parts.speed.start + end.pulley].abs();
            let rate = if end.amplitude == 0.0 {
                0.0
            } else {
                PER_SINE * round
            };
            (rate, StepBound::RunOut { pulley: end.pulley })
        });
        let damped = [
            (axial, StepBound::AxialDamping),
            (damping * stretch / mass, StepBound::DampingAcross),
        ];
        damped
            .into_iter()
            .chain(rubbing)
            .chain(ends)
            .fold(first, larger)
    }

    fn implicit(&self, state: &[f64], limits: StepLimits) -> Option<Implicit> {
        let is_straight = self.system.across.is_none();
        { is_straight.then(|| Implicit::new(self, state, limits)) }.filter(Implicit::is_worthwhile)
    }

    fn wave_speed(&self) -> f64 {
        (self.system.axial_stiffness / self.system.mass).sqrt()
    }

    fn tension(&self, stretch: f64) -> f64 {
        self.system.tension(stretch)
    }

    fn stretches(&self) -> &[f64] {
        &self.stretch[1..]
    }

    fn middles(&self) -> &[f64] {
        &self.middle
    }

    fn slips(&self, state: &[f64], pulley: usize, index: usize) -> bool {
        slips(
            self.bristles(state, pulley)[index],
            self.caps(pulley)[index],
        )
    }

    fn slips_grossly(&self, state: &[f64], pulley: usize) -> bool {
        let mut cells = 0..self.system.mesh.arcs[pulley].len();
        cells.all(|index| self.slips(state, pulley, index))
    }

    fn slipping(&self, state: &[f64], pulley: usize) -> f64 {
        slipping(self.bristles(state, pulley), self.caps(pulley))
    }

    fn force(&self, _: &[f64], pulley: usize, index: usize) -> [f64; 2] {
        let system = self.system;
        let of_loop = system.mesh.arcs[pulley].start + index;
        // The largest friction k_f b is μ n λ.
        let per_cap = system.friction_stiffness() / system.wheels[pulley].friction_coefficient;
        let pressure = per_cap * self.caps(pulley)[index];
        let unstretched = system.mesh.lengths[of_loop] / self.stretches()[of_loop];
        let place = system.mesh.bristles[pulley].start + index;
        [self.forces[place], unstretched * pressure]
    }

    fn friction(&self, _: &[f64]) -> Vec<f64> {
        let mesh = &self.system.mesh;
        let mut friction = vec![0.0; mesh.cells()];
        for (arc, own) in mesh.arcs.iter().zip(&mesh.bristles) {
            for (cell, place) in arc.clone().zip(own.clone()) {
                friction[cell] = self.forces[place] / mesh.lengths[cell];
            }
        }
        friction
    }

    fn displacements<'a>(&self, state: &'a [f64], span: usize) -> &'a [f64] {
        string::displacements(self.system, state, span)
    }

    fn energy(&self, state: &[f64]) -> f64 {
        self.system.energy(state)
    }

    fn ledger(&self, state: &[f64], at_start: f64) -> Ledger {
        Ledger::of(self.system, state, at_start)
    }

    fn unrest(&self, state: &[f64], rates: &[f64]) -> f64 {
        let densities = &self.system.parts.density;
        let tensions = state[densities.clone()]
            .iter()
            .zip(&rates[densities.clone()]);
        // The rate of T = EA (1/ρ − 1) over T.
        let tensions =
            tensions.map(|(density, change)| (change / (density * (1.0 - density))).abs());
        let across = string::fastest(self.system, rates) / self.system.mesh.length();
        tensions.fold(across, f64::max)
    }

    fn impossible(&self, state: &[f64]) -> Option<&'static str> {
        let mut densities = state[self.system.parts.density.clone()].iter();
        if densities.any(|density| *density <= 0.0) {
            return Some("the belt is stretched without bounds");
        }
        (string::steepest(self.system, state) > STEEPEST)
            .then_some("a span moves across with a slope beyond which its stretch is wrong")
    }
}

/// The largest friction may rise so much until the next look at it, within the time of 100 steps, in which waves pass 40
/// cells: as a pulley starts or a load comes, tensions do not double in less.
const RISE: f64 = 2.0;

/// Largest slope of a span that moves across: the stretch leaves out s⁴/8, which is then a thousandth.
const STEEPEST: f64 = 0.3;
