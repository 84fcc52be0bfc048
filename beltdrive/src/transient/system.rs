//! What the equations of motion are made of.

use super::axle::Axle;
use super::mesh::Mesh;
use super::state::Parts;
use super::string;
use super::transverse::Across;

/// Share of the axial stiffness that the belt has in compression. A slack belt gives way, but with none of it nothing
/// would hold its cells at a length; with this one the excess of 1 % pushes with 1e-5 EA, a newton of a belt of 100 kN.
pub(crate) const SLACK: f64 = 1e-3;

/// A flat belt on its pulleys.
#[derive(Clone, Debug)]
pub(crate) struct System {
    /// Mass m per unstretched length, kg/m.
    pub(crate) mass: f64,
    /// Axial stiffness EA, N.
    pub(crate) axial_stiffness: f64,
    /// Axial damping `c_d`, N·s.
    pub(crate) axial_damping: f64,
    /// How friction is held against.
    pub(crate) resistance: Resistance,
    /// What moves the spans across, if they move so.
    pub(crate) across: Option<Across>,
    /// The pulleys in belt order.
    pub(crate) wheels: Vec<Wheel>,
    /// The mesh.
    pub(crate) mesh: Mesh,
    /// Where the parts of a state stand.
    pub(crate) parts: Parts,
}

/// What friction grows with, up to its limit μ n λ per unstretched length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Resistance {
    /// With the displacement b of bristles and the slip velocity, `k_f` b + `c_f` (v − R ω).
    Bristles {
        /// Stiffness `k_f` of friction per unstretched length, N/m².
        stiffness: f64,
        /// Damping `c_f` of the bristles per unstretched length, N·s/m².
        damping: f64,
    },
    /// With the slip velocity v − R ω, up to one in m/s at which it is fully developed.
    Creep {
        /// That slip velocity, m/s.
        velocity: f64,
    },
}

impl Resistance {
    /// Friction per unstretched length over what stands in the place of a bristle in a state, N/m²: `k_f` where that is a
    /// displacement; 1 with creep, where it is the friction itself.
    pub(crate) fn stiffness(self) -> f64 {
        match self {
            Self::Bristles { stiffness, .. } => stiffness,
            Self::Creep { .. } => 1.0,
        }
    }
}

/// A pulley.
#[derive(Clone, Debug)]
pub(crate) struct Wheel {
    /// Radius R, m.
    pub(crate) radius: f64,
    /// Coefficient of friction μ.
    pub(crate) friction_coefficient: f64,
    /// What drives and what loads it.
    pub(crate) axle: Axle,
}

impl System {
    /// [`Resistance::stiffness`], N/m².
    pub(crate) fn friction_stiffness(&self) -> f64 {
        self.resistance.stiffness()
    }

    /// The same drive with so many cells in place of each; its spans do not move across.
    pub(crate) fn refined(&self, by: usize) -> Self {
        let mesh = self.mesh.refined(by);
        Self {
            parts: Parts::new(&mesh),
            mesh,
            across: None,
            wheels: self.wheels.clone(),
            ..*self
        }
    }

    /// How much the tension rises with a stretch, N: EA, and [`SLACK`] of it in compression.
    pub(crate) fn stiffness(&self, stretch: f64) -> f64 {
        match stretch < 1.0 {
            true => SLACK * self.axial_stiffness,
            false => self.axial_stiffness,
        }
    }

    /// Tension EA (λ − 1) without damping at a stretch, N; with [`SLACK`] of EA in compression.
    pub(crate) fn tension(&self, stretch: f64) -> f64 {
        self.stiffness(stretch) * (stretch - 1.0)
    }

    /// Unstretched length of the belt, m.
    pub(crate) fn unstretched_length(&self, state: &[f64]) -> f64 {
        let densities = &state[self.parts.density.clone()][1..];
        let lengths = self.mesh.lengths.iter();
        lengths
            .zip(densities)
            .map(|(length, density)| length * density)
            .sum()
    }

    /// Kinetic energy of pulleys and belt and strain energy of the belt, J.
    pub(crate) fn energy(&self, state: &[f64]) -> f64 {
        let speeds = self.wheels.iter().zip(&state[self.parts.speed.clone()]);
        let pulleys = speeds.map(|(wheel, speed)| wheel.energy(*speed));
        let lengths = &self.mesh.lengths;
        let density = &state[self.parts.density.clone()];
        let velocity = &state[self.parts.velocity.clone()];
        let cells = lengths.len();
        let belt = (0..cells).map(|cell| {
            let before = lengths[(cell + cells - 1) % cells];
            let on_face = 0.5 * (density[cell] * before + density[cell + 1] * lengths[cell]);
            let stretch = density[cell + 1].recip();
            let strain = stretch - 1.0;
            let elastic = 0.5 * self.stiffness(stretch) * strain * strain;
            0.5 * self.mass * on_face * velocity[cell] * velocity[cell]
                + elastic * density[cell + 1] * lengths[cell]
        });
        pulleys.sum::<f64>() + belt.sum::<f64>() + string::energy(self, state)
    }
}

impl Wheel {
    /// Its kinetic energy at a speed in rad/s, J.
    pub(super) fn energy(&self, speed: f64) -> f64 {
        0.5 * self.axle.inertia * speed * speed
    }

    /// R²/J, by which a force at the rim accelerates it, 1/kg; 0 without an inertia, as of a given speed.
    pub(super) fn mobility(&self) -> f64 {
        match self.axle.inertia > 0.0 {
            true => self.radius * self.radius / self.axle.inertia,
            false => 0.0,
        }
    }
}
