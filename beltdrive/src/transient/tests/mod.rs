//! The equations on the mesh against what is known of them without friction or without motion.

mod conservation;
mod integrators;
mod linearised;
mod modes;
mod pulsation;
mod spans;
mod waves;

use super::axle::{Axle, Motion};
use super::dynamics::Dynamics;
use super::explicit::{Explicit, stable_step};
use super::mesh::{Mesh, Stretch};
use super::rates::Rates;
use super::schedule::Schedule;
use super::state::Parts;

use super::system::{Resistance, System, Wheel};

/// Stretch of the belt at rest.
const STRETCH: f64 = 1.00545;

/// The belt of Kim (2009) round two pulleys of 81.25 mm at 250 mm, with equal numbers of cells on arcs and spans.
fn system(cells: usize, friction: [f64; 2], axles: [Axle; 2]) -> System {
    let radius = 0.08125;
    let stretch = Stretch {
        arc: std::f64::consts::PI * radius,
        arc_cells: cells / 4,
        span: 0.25,
        span_cells: cells / 4,
    };
    let mesh = Mesh::new(&[stretch; 2]);
    let [friction_coefficient, friction_stiffness] = friction;
    let wheel = |axle| Wheel {
        radius,
        friction_coefficient,
        axle,
    };
    System {
        mass: 0.1036,
        axial_stiffness: 80_068.0,
        axial_damping: 0.0,
        resistance: Resistance::Bristles {
            stiffness: friction_stiffness,
            damping: 0.0,
        },
        across: None,
        wheels: axles.map(wheel).into(),
        parts: Parts::new(&mesh),
        mesh,
    }
}

/// A pulley that is held.
fn held() -> Axle {
    Axle {
        inertia: 0.01,
        motion: Motion::Speed(Schedule::constant(0.0)),
    }
}

/// Takes a state over a time in s and calls `look` with every state on the way.
fn follow(system: &System, state: &mut [f64], time: f64, mut look: impl FnMut(f64, &[f64])) {
    let (mut rates, mut explicit) = (Rates::new(system), Explicit::new(system.parts.len()));
    rates.begin(0.0);
    let steps = (time / stable_step(&rates, state)).ceil();
    let step = time / steps;
    let mut index = 0.0;
    while index < steps {
        look(index * step, state);
        explicit.rates(&mut rates, index * step, state);
        explicit.step(&mut rates, index * step, step, state);
        index += 1.0;
    }
    look(time, state);
}

/// The order p of errors e ~ h^p from meshes of which each has twice the cells of the one before.
fn order(errors: &[f64]) -> f64 {
    let ratio = errors[0] / errors[errors.len() - 1];
    ratio.abs().log2() / (errors.len() - 1) as f64
}
