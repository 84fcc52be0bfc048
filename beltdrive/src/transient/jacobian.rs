//! The derivatives of the rates, entry by entry.
//!
//! The unknowns are the densities of the cells, the velocities at the faces, the displacements of the bristles in the
//! cells of all arcs and the speeds of all pulleys, in this order ([`Unknowns`]). Friction is taken as `k_f` b here, which
//! is what bristles below their largest displacement without damping have; [`of_cap`] has the derivatives of that
//! displacement, for the cells that slip, and [`of_slip`] those of the slip velocity, for damping and creep.

use super::bristle::weights;
use super::rates::Rates;
use super::system::System;

/// The numbers of the unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unknowns {
    cells: usize,
    bristles: usize,
    pulleys: usize,
}

impl Unknowns {
    /// The unknowns of a system.
    pub(super) fn new(system: &System) -> Self {
        Self {
            cells: system.mesh.cells(),
            bristles: system.mesh.bristle_cells(),
            pulleys: system.wheels.len(),
        }
    }

    /// How many there are.
    pub(super) fn count(self) -> usize {
        2 * self.cells + self.bristles + self.pulleys
    }

    /// The density of a cell.
    pub(super) fn density(self, cell: usize) -> usize {
        cell % self.cells
    }

    /// The velocity at a face.
    pub(super) fn velocity(self, face: usize) -> usize {
        self.cells + face % self.cells
    }

    /// The displacement of the bristles in a cell of all arcs.
    pub(super) fn bristle(self, cell: usize) -> usize {
        2 * self.cells + cell
    }

    /// The cell of all arcs whose displacement an unknown is.
    pub(super) fn as_bristle(self, unknown: usize) -> Option<usize> {
        let cell = unknown.checked_sub(2 * self.cells)?;
        (cell < self.bristles).then_some(cell)
    }

    /// The speed of a pulley.
    pub(super) fn speed(self, pulley: usize) -> usize {
        2 * self.cells + self.bristles + pulley
    }
}

/// Calls `entry` with row, column and value of every derivative of the rates at the last state for which they were
/// computed. Entries of the same place are to be added. Given speeds have no rows.
pub(super) fn derivatives(
    rates: &Rates<'_>,
    state: &[f64],
    entry: &mut impl FnMut(usize, usize, f64),
) {
    belt(rates, state, entry);
    for pulley in 0..rates.system.wheels.len() {
        bristles(rates, state, pulley, entry);
        axle(rates, state, pulley, entry);
    }
}

/// Derivatives of the largest displacement μ n λ/`k_f` in a cell of the loop, which is one on a pulley: unknowns and
/// values; zeros where nothing presses the belt on the pulley.
pub(super) fn of_cap(rates: &Rates<'_>, pulley: usize, cell: usize) -> [(usize, f64); 3] {
    let system = rates.system;
    let unknowns = Unknowns::new(system);
    let bristle = system.mesh.bristles[pulley].start + cell - system.mesh.arcs[pulley].start;
    let wheel = &system.wheels[pulley];
    let per_cap = match rates.caps[bristle] > 0.0 {
        true => wheel.friction_coefficient / (wheel.radius * system.friction_stiffness()),
        false => 0.0,
    };
    let stretch = rates.stretch[cell + 1];
    let per_density = system.axial_stiffness * (1.0 - 2.0 * stretch) * stretch * stretch;
    let per_speed = -per_cap * system.mass * rates.middle[cell];
    [
        (unknowns.density(cell), per_cap * per_density),
        (unknowns.velocity(cell), per_speed),
        (unknowns.velocity(cell + 1), per_speed),
    ]
}

/// Derivatives of the slip velocity v − R ω in a cell of the loop, which is one on a pulley: unknowns and values.
pub(super) fn of_slip(system: &System, pulley: usize, cell: usize) -> [(usize, f64); 3] {
    let unknowns = Unknowns::new(system);
    [
        (unknowns.velocity(cell), 0.5),
        (unknowns.velocity(cell + 1), 0.5),
        (unknowns.speed(pulley), -system.wheels[pulley].radius),
    ]
}

/// Mass and momentum.
fn belt(rates: &Rates<'_>, state: &[f64], entry: &mut impl FnMut(usize, usize, f64)) {
    let system = rates.system;
    let unknowns = Unknowns::new(system);
    let cells = system.mesh.cells();
    let density = &state[system.parts.density.clone()];
    let velocity = &state[system.parts.velocity.clone()];
    let damping = 0.5 * system.axial_damping;
    for face in 0..cells {
        let (behind, ahead) = ((face + cells - 1) % cells, face);
        let [share_behind, share_ahead] = rates.shares[face];
        let on_face = share_behind * density[face] + share_ahead * density[face + 1];
        // The flow through the face leaves one cell and enters the other.
        for (column, flux) in [
            (unknowns.velocity(face), on_face),
            (behind, velocity[face] * share_behind),
            (ahead, velocity[face] * share_ahead),
        ] {
            entry(ahead, column, flux * rates.per_cell[ahead]);
            entry(behind, column, -flux * rates.per_cell[behind]);
        }
        let row = unknowns.velocity(face);
        let per_mass = rates.per_mass[face];
        let both = rates.stretch[behind + 1] + rates.stretch[ahead + 1];
        let relative = rates.stretching[face + 1] - rates.stretching[face];
        for (cell, sign) in [(behind, -1.0), (ahead, 1.0)] {
            let stretch = rates.stretch[cell + 1];
            let per_stretch = -stretch * stretch;
            let elastic = system.stiffness(stretch) * stretch;
            let stretching = rates.stretching[cell + 1];
            // The rate of stretch λ Δv/h in proportion to λ and to Δv.
            let damped = damping * (relative + sign * both * stretching / stretch);
            let strained = per_mass * per_stretch * (sign * elastic + damped);
            entry(row, unknowns.density(cell), strained);
            let inertia = -0.5 * system.mass * rates.middle[cell];
            let rate = damping * both * stretch * rates.per_cell[cell];
            entry(
                row,
                unknowns.velocity(cell),
                per_mass * sign * (inertia - rate),
            );
            entry(
                row,
                unknowns.velocity(cell + 1),
                per_mass * sign * (inertia + rate),
            );
        }
    }
}

/// Friction in the cells of an arc, and the transport of its bristles.
fn bristles(
    rates: &Rates<'_>,
    state: &[f64],
    pulley: usize,
    entry: &mut impl FnMut(usize, usize, f64),
) {
    let system = rates.system;
    let unknowns = Unknowns::new(system);
    let (arc, own) = (&system.mesh.arcs[pulley], &system.mesh.bristles[pulley]);
    let (count, last) = (arc.len(), arc.len() - 1);
    let displaced = &state[system.parts.bristle.clone()][own.clone()];
    let runs_forward = rates.middle[arc.start] + rates.middle[arc.end - 1] >= 0.0;
    for (index, cell) in arc.clone().enumerate() {
        let row = unknowns.bristle(own.start + index);
        let friction = system.friction_stiffness() * system.mesh.lengths[cell];
        for face in [cell, cell + 1] {
            let face = face % system.mesh.cells();
            let per_mass = rates.per_mass[face];
            entry(unknowns.velocity(face), row, -0.5 * per_mass * friction);
        }
        // Where the belt runs backwards, the cells are counted from the other end.
        let (counted, sign) = match runs_forward {
            true => (index, 1.0),
            false => (last - index, -1.0),
        };
        let (first, weights) = weights(counted, count);
        let mut difference = 0.0;
        for (at, weight) in weights.into_iter().enumerate() {
            if weight == 0.0 {
                continue;
            }
            let weight = sign * weight * rates.per_cell[cell] / 6.0;
            let near = match runs_forward {
                true => first + at,
                false => last - first - at,
            };
            difference += weight * displaced[near];
            entry(
                row,
                unknowns.bristle(own.start + near),
                -rates.middle[cell] * weight,
            );
        }
        for face in [cell, cell + 1] {
            entry(row, unknowns.velocity(face), 0.5 * (1.0 - difference));
        }
        let radius = system.wheels[pulley].radius;
        entry(row, unknowns.speed(pulley), -radius);
    }
}

/// The speed of a pulley that is not given.
fn axle(
    rates: &Rates<'_>,
    state: &[f64],
    pulley: usize,
    entry: &mut impl FnMut(usize, usize, f64),
) {
    let system = rates.system;
    let unknowns = Unknowns::new(system);
    let wheel = &system.wheels[pulley];
    let row = unknowns.speed(pulley);
    let speed = state[system.parts.speed.start + pulley];
    let Some(slope) = wheel.axle.slope(speed) else {
        return;
    };
    let per_inertia = wheel.axle.inertia.recip();
    entry(row, row, slope * per_inertia);
    let (arc, own) = (&system.mesh.arcs[pulley], &system.mesh.bristles[pulley]);
    for (cell, bristle) in arc.clone().zip(own.clone()) {
        let per_force = wheel.radius * per_inertia;
        let stiffness = per_force * system.friction_stiffness() * system.mesh.lengths[cell];
        let density = state[system.parts.density.start + 1 + cell];
        let held = per_force * rates.friction[cell + 1];
        entry(row, unknowns.density(cell), held);
        entry(row, unknowns.bristle(bristle), stiffness * density);
    }
}
