//! Small motions about a state: the rates linearised, with the cells held in which friction is at its limit.
//!
//! In every cell of an arc friction q is a function of other unknowns, whose change is one of
//!
//! ```text
//! bristles   δq = k_f δb + c_f δ(v − R ω)                     where |k_f b + c_f (v − R ω)| < μ n λ
//!            δq = ± δ(μ n λ)                                  else
//! creep      δq = (v − R ω)/v_c δ(μ n λ) + μ n λ/v_c δ(v − R ω)       where |v − R ω| < v_c
//!            δq = ± δ(μ n λ)                                  else
//! ```
//!
//! with μ n λ a function of stretch and speed of the belt. The displacement b of bristles is an unknown of its own where
//! it is below its largest one, μ n λ/`k_f`, and follows that where the belt slips. With damping there are cells between:
//! friction is at its limit there before the displacement is at its own, which grows on along the belt. Creep has no
//! bristles and no such unknowns.
//!
//! The edges between these cells do not move: what they would add is of second order, since friction is continuous
//! there.

use super::dynamics::Dynamics;
use super::jacobian::{Unknowns, derivatives, of_cap, of_slip};
use super::rates::Rates;
use super::system::Resistance;
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
/// whether the belt slips there; without it friction is taken to be below its limit everywhere. The belt runs forward.
pub(crate) fn linearised(rates: &Rates<'_>, state: &[f64], slips: Option<&[bool]>) -> Linearised {
    let system = rates.system;
    let mesh = &system.mesh;
    let cells = mesh.cells();
    let all = Unknowns::new(system);
    let on_arcs = (0..mesh.arcs.len()).flat_map(|pulley| {
        let cells = mesh.arcs[pulley].clone().zip(mesh.bristles[pulley].clone());
        cells.map(move |(cell, bristle)| [pulley, cell, bristle])
    });
    let contact: Vec<_> = { on_arcs.clone() }
        .map(|place @ [.., bristle]| {
            Contact::new(rates, state, place, slips.map(|slips| slips[bristle]))
        })
        .collect();
    // The unknowns that are left: without the bristles that slip and the speeds that are given.
    let mut unknowns = 2 * cells;
    let mut kept: Vec<_> = (0..all.count()).map(Some).collect();
    let mut next = |unknown: usize, is_left: bool| {
        let place = unknowns;
        unknowns += usize::from(is_left);
        kept[unknown] = is_left.then_some(place);
        kept[unknown]
    };
    let of_bristle: Vec<_> = { contact.iter().enumerate() }
        .map(|(bristle, contact)| next(all.bristle(bristle), contact.is_carried))
        .collect();
    let speed: Vec<_> = { system.wheels.iter().enumerate() }
        .map(|(pulley, wheel)| next(all.speed(pulley), wheel.axle.slope(0.0).is_some()))
        .collect();

    let mut energies = vec![0.0; unknowns];
    for (cell, length) in mesh.lengths.iter().enumerate() {
        energies[cell] = system.stiffness(rates.stretches()[cell]) * length;
        energies[all.velocity(cell)] = rates.per_mass[cell].recip();
    }
    for [_, cell, bristle] in on_arcs {
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
        let Some(place) = kept[row] else {
            return;
        };
        let mut add = |unknown: usize, value: f64| {
            if let Some(column) = kept[unknown] {
                add(place, column, value);
            }
        };
        match all.as_bristle(column) {
            None => add(column, value),
            Some(bristle) => {
                // Bristles are displaced by each other, everything else by their friction.
                let contact = &contact[bristle];
                let slopes = match all.as_bristle(row) {
                    Some(_) => &contact.displacement,
                    None => &contact.friction,
                };
                for (unknown, slope) in slopes {
                    add(*unknown, value * slope);
                }
            }
        }
    });
    Linearised {
        matrix,
        scales,
        velocity: cells,
        speed,
    }
}

/// A cell of an arc in small motions.
struct Contact {
    /// Whether the belt carries bristles along, whose displacement is an unknown.
    is_carried: bool,
    /// Derivatives of that displacement: unknowns and values.
    displacement: Vec<(usize, f64)>,
    /// Derivatives of friction over [`Resistance::stiffness`].
    friction: Vec<(usize, f64)>,
}

impl Contact {
    /// A cell, by the numbers of its pulley, on the loop and among those of all arcs, in which the belt slips or not; with
    /// `None` friction is taken to be below its limit.
    fn new(
        rates: &Rates<'_>,
        state: &[f64],
        [pulley, cell, bristle]: [usize; 3],
        slips: Option<bool>,
    ) -> Self {
        let system = rates.system;
        let own = Unknowns::new(system).bristle(bristle);
        let cap = rates.caps[bristle];
        let scaled = |slopes: [(usize, f64); 3], by: f64| {
            { slopes.into_iter() }.map(move |(unknown, slope)| (unknown, by * slope))
        };
        let of_cap = |share: f64| scaled(of_cap(rates, pulley, cell), share);
        let of_slip = |rise: f64| scaled(of_slip(system, pulley, cell), rise);
        match system.resistance {
            Resistance::Bristles { stiffness, damping } => {
                let displaced = state[system.parts.bristle.start + bristle];
                let rise = damping / stiffness;
                let pulled = rates.pulled(state, [pulley, cell, bristle]);
                let is_carried = slips != Some(true);
                let displacement: Vec<_> = match is_carried {
                    true => vec![(own, 1.0)],
                    false => of_cap(displaced.signum()).collect(),
                };
                let friction = match slips {
                    Some(true) => displacement.clone(),
                    Some(false) if damping > 0.0 && pulled.abs() >= cap => {
                        of_cap(pulled.signum()).collect()
                    }
                    _ => [(own, 1.0)].into_iter().chain(of_slip(rise)).collect(),
                };
                Self {
                    is_carried,
                    displacement,
                    friction,
                }
            }
            Resistance::Creep { velocity } => {
                let slip = rates.slip(state, [pulley, cell]);
                let developed = (slip / velocity).clamp(-1.0, 1.0);
                let friction = match slips {
                    Some(true) => of_cap(developed.signum()).collect(),
                    _ => of_cap(developed).chain(of_slip(cap / velocity)).collect(),
                };
                Self {
                    is_carried: false,
                    displacement: vec![],
                    friction,
                }
            }
        }
    }
}
