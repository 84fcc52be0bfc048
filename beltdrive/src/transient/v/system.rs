//! What the equations of motion of a V-belt are made of.

use super::super::mesh::Mesh;
use super::super::system::Wheel;
use super::state::Parts;

/// A V-belt in the grooves of its pulleys.
#[derive(Clone, Debug)]
pub(crate) struct System {
    /// Mass m per unstretched length, kg/m.
    pub(crate) mass: f64,
    /// Axial stiffness EA, N.
    pub(crate) axial_stiffness: f64,
    /// Axial damping `c_d`, N·s.
    pub(crate) axial_damping: f64,
    /// Stiffness κ of the bristles per normal force, 1/m.
    pub(crate) bristle_stiffness: f64,
    /// Radial stiffness k, N/m².
    pub(crate) radial_stiffness: f64,
    /// Sine and cosine of the half groove angle β.
    pub(crate) groove: [f64; 2],
    /// The pulleys in belt order; their radii are those of the pitch circles.
    pub(crate) wheels: Vec<Wheel>,
    /// The mesh along the pitch line.
    pub(crate) mesh: Mesh,
    /// Where the parts of a state stand.
    pub(crate) parts: Parts,
}

impl System {
    /// Tension EA (λ − 1) at a stretch, without damping, N.
    pub(crate) fn tension(&self, stretch: f64) -> f64 {
        self.axial_stiffness * (stretch - 1.0)
    }

    /// Unstretched length of the belt, m.
    pub(crate) fn unstretched_length(&self, state: &[f64]) -> f64 {
        let amounts = &state[self.parts.amount.clone()];
        let lengths = self.mesh.lengths.iter();
        lengths.zip(amounts).map(|(length, a)| length * a).sum()
    }

    /// Pressure 2 p of both faces and outward load n per length, each per k x. The derivative of the latter with `B_w` is
    /// minus the square of the former.
    pub(crate) fn pressing(&self, up: f64) -> [f64; 2] {
        let [sine, cosine] = self.groove;
        let pressure = (cosine + up * sine).recip();
        [pressure, (sine - up * cosine) * pressure]
    }

    /// Kinetic energy of pulleys and belt and strain energy of the belt, whose cells have lengths g per length of the
    /// pitch line, J.
    pub(crate) fn energy(&self, state: &[f64], lengths: &[f64]) -> f64 {
        let parts = &self.parts;
        let speeds = self.wheels.iter().zip(&state[parts.speed.clone()]);
        let pulleys = speeds.map(|(wheel, speed)| wheel.energy(*speed));
        let amount = &state[parts.amount.clone()];
        let velocity = &state[parts.velocity.clone()];
        let cells = amount.len();
        let belt = (0..cells).map(|cell| {
            let next = (cell + 1) % cells;
            let squares = 0.5 * (velocity[cell].powi(2) + velocity[next].powi(2));
            let strain = lengths[cell] / amount[cell] - 1.0;
            let per_amount = 0.5 * (self.mass * squares + self.axial_stiffness * strain * strain);
            per_amount * amount[cell] * self.mesh.lengths[cell]
        });
        pulleys.sum::<f64>() + belt.sum::<f64>()
    }
}
