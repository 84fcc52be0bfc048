//! Small motions about a state: the rates linearised, with the cells held in which the belt slips.
//!
//! Where the belt slips, the displacement of the bristles is at its largest, μ n λ/`k_f`, and follows stretch and
//! speed of the belt; where it sticks, it is an unknown. The edge between the two does not move: what it would add is
//! of second order, since friction is continuous there.

use super::dynamics::Dynamics;
use super::jacobian::{Unknowns, derivatives, of_cap};
use super::rates::Rates;
use faer::Mat;

/// The linearised rates y′ = A y, and what the unknowns are.
///
/// The unknowns are scaled so that half the square of each is an energy: the strain energy of a cell and of its
/// bristles, the kinetic energy of a face and of a pulley.
pub(crate) struct Linearised {
    /// The matrix A, 1/s.
    pub(crate) matrix: Mat<f64>,
    /// Of each unknown, the scale by which it is divided: what one has of the energy 1/2 J.
    pub(crate) scales: Vec<f64>,
    /// Where the unknowns of velocity at the faces begin, one for each; those of density in the cells stand before.
    pub(crate) velocity: usize,
    /// The unknown of the speed of each pulley; none where it is given.
    pub(crate) speed: Vec<Option<usize>>,
}

/// Linearises the rates about the last state for which they were computed. `slips` says of the cells of all arcs
/// whether the belt slips there. The belt runs forward.
pub(crate) fn linearised(rates: &Rates<'_>, state: &[f64], slips: &[bool]) -> Linearised {
    let system = rates.system;
    let (mesh, parts) = (&system.mesh, &system.parts);
    let cells = mesh.cells();
    let all = Unknowns::new(system);
    // The unknowns that are left: without the bristles that slip and the speeds that are given.
    let mut unknowns = 2 * cells;
    let mut kept: Vec<_> = (0..all.count()).map(Some).collect();
    let mut next = |unknown: usize, is_left: bool| {
        let place = unknowns;
        unknowns += usize::from(is_left);
        kept[unknown] = is_left.then_some(place);
        kept[unknown]
    };
    let of_bristle: Vec<_> = { slips.iter().enumerate() }
        .map(|(bristle, slips)| next(all.bristle(bristle), !slips))
        .collect();
    let speed: Vec<_> = { system.wheels.iter().enumerate() }
        .map(|(pulley, wheel)| next(all.speed(pulley), wheel.axle.slope(0.0).is_some()))
        .collect();
    let bristles = &state[parts.bristle.clone()];
    let mut of_caps = vec![[(0, 0.0); 3]; slips.len()];
    for pulley in 0..mesh.arcs.len() {
        for (cell, bristle) in mesh.arcs[pulley].clone().zip(mesh.bristles[pulley].clone()) {
            let sign = bristles[bristle].signum();
            of_caps[bristle] =
                of_cap(rates, pulley, cell).map(|(unknown, slope)| (unknown, sign * slope));
        }
    }

    let mut energies = vec![0.0; unknowns];
    for (cell, length) in mesh.lengths.iter().enumerate() {
        energies[cell] = system.stiffness(rates.stretches()[cell]) * length;
        energies[all.velocity(cell)] = rates.per_mass[cell].recip();
    }
    let on_arcs = (0..mesh.arcs.len())
        .flat_map(|pulley| mesh.arcs[pulley].clone().zip(mesh.bristles[pulley].clone()));
    for (cell, bristle) in on_arcs {
        if let Some(unknown) = of_bristle[bristle] {
            energies[unknown] = system.friction_stiffness() * mesh.lengths[cell];
        }
    }
    for (unknown, wheel) in speed.iter().zip(&system.wheels) {
        if let Some(unknown) = unknown {
            energies[*unknown] = wheel.axle.inertia;
        }
    }
    let scales: Vec<_> = { energies.iter() }
        .map(|energy: &f64| energy.sqrt().recip())
        .collect();
    let mut matrix = Mat::zeros(unknowns, unknowns);
    let mut add = |row: usize, column: usize, value: f64| {
        matrix[(row, column)] += value * scales[column] / scales[row];
    };
    derivatives(rates, state, &mut |row, column, value| {
        let Some(row) = kept[row] else {
            return;
        };
        match (kept[column], all.as_bristle(column)) {
            (Some(column), _) => add(row, column, value),
            (None, Some(bristle)) => {
                for (column, slope) in of_caps[bristle] {
                    add(row, column, value * slope);
                }
            }
            (None, None) => {}
        }
    });
    Linearised {
        matrix,
        scales,
        velocity: cells,
        speed,
    }
}
