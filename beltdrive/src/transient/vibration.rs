//! Modes of vibration of a linearised drive.

use super::dynamics::Dynamics;
use super::linearised::{Linearised, linearised};
use super::rates::Rates;
use super::simulation::TransientError;
use super::system::System;
use faer::c64;
use std::f64::consts::TAU;

/// A mode of vibration: every quantity follows Re(y exp(λ t)) with the shape y.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct VibrationMode {
    /// Rate of growth Re λ, 1/s; negative where the vibration decays.
    pub growth: f64,
    /// Angular frequency Im λ, rad/s; positive.
    pub angular_frequency: f64,
    /// Change of λ from a mesh with half the cells, 1/s: above the error of the mesh where the cells resolve the mode.
    pub error: f64,
    /// Share of each pulley in the kinetic energy of the mode; that of the belt is the rest.
    pub pulley_shares: Vec<f64>,
    /// Speed of each pulley as that of its rim, m/s, in the unit of `velocities`: real and imaginary part.
    pub rims: Vec<[f64; 2]>,
    /// Velocity of the belt at the faces of the mesh, real and imaginary part; the largest of all velocities is 1, and
    /// real.
    pub velocities: Vec<[f64; 2]>,
}

impl VibrationMode {
    /// Whether more than half of the kinetic energy is in pulleys.
    #[must_use]
    pub fn is_torsional(&self) -> bool {
        self.pulley_shares.iter().sum::<f64>() > 0.5
    }

    /// Damping ratio −Re λ/|λ|.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        -self.growth / self.growth.hypot(self.angular_frequency)
    }
}

/// Two meshes agree on a mode whose eigenvalue differs by less than this share of itself. Bristles that the belt
/// carries along have eigenvalues that are of the mesh alone: they double from one to the other.
const AGREE: f64 = 0.05;

/// Largest damping ratio of what is told as a vibration: it falls to less than a third within a period. More damped are
/// the motions that go with the bristles once through a contact, a row of them at multiples of its frequency.
const DAMPED: f64 = 0.2;

/// Least frequency of a vibration in that of the matrix: an eigenvalue of zero that is double, as the belt at rest has
/// many, is found to the root 1.5e-8 of rounding.
const LEAST: f64 = 1e-7;

/// Largest share of the frequency of waves once round the loop that may be lost to [`LEAST`]: heavy pulleys on long belts
/// vibrate a hundred times slower than those, and a mesh of 960 cells loses a ten-thousandth.
const LOST: f64 = 1e-2;

/// Whether the belt slips in the cells of all arcs; `None` if friction is to be below its limit everywhere.
pub(crate) type Slips = Option<Vec<bool>>;

/// The modes of a drive about a state in the order of frequency, at most so many. The states are those on a mesh and on
/// one with twice the cells. An error if eigenvalues cannot be computed in finite arithmetic, or if the slow ones are lost.
pub(crate) fn modes(
    [coarse, fine]: [(&System, Vec<f64>, Slips); 2],
    count: usize,
) -> Result<Vec<VibrationMode>, TransientError> {
    let known = at((coarse.0, coarse.1, coarse.2.as_deref()));
    let known = known.matrix.eigenvalues();
    let known = known.map_err(|_| TransientError::Eigenvalues)?;
    let system = fine.0;
    let found = at((system, fine.1, fine.2.as_deref()));
    let least = LEAST * found.matrix.norm_max();
    let waves = (system.axial_stiffness / system.mass).sqrt() / system.mesh.length();
    if least > LOST * TAU * waves {
        let least = least / TAU;
        return Err(TransientError::Lost { least });
    }
    let eigen = { found.matrix.eigen() }.map_err(|_| TransientError::Eigenvalues)?;
    let values: Vec<c64> = eigen.S().column_vector().iter().copied().collect();
    let mut agreed: Vec<_> = { values.iter().enumerate() }
        .filter(|(_, value)| value.im > least)
        .filter_map(|(index, value)| {
            let distances = known.iter().map(|other: &c64| (other - value).norm());
            let error = distances.fold(f64::INFINITY, f64::min);
            let is_mode = error < AGREE * value.norm() && -value.re < DAMPED * value.norm();
            is_mode.then_some((index, *value, error))
        })
        .collect();
    agreed.sort_by(|one, other| one.1.im.total_cmp(&other.1.im));
    agreed.truncate(count);
    let modes = agreed.into_iter().map(|(index, value, error)| {
        let shape: Vec<c64> = eigen.U().col(index).iter().copied().collect();
        mode(system, &found, &shape, (value, error))
    });
    Ok(modes.collect())
}

/// A drive linearised about a state.
fn at((system, mut state, slips): (&System, Vec<f64>, Option<&[bool]>)) -> Linearised {
    let mut rates = Rates::new(system);
    rates.begin(0.0);
    let mut changes = vec![0.0; state.len()];
    rates.of(0.0, &mut state, &mut changes);
    linearised(&rates, &state, slips)
}

fn mode(
    system: &System,
    found: &Linearised,
    shape: &[c64],
    (value, error): (c64, f64),
) -> VibrationMode {
    let faces = found.velocity..2 * found.velocity;
    let of_pulley = |unknown: &Option<usize>| unknown.map_or(0.0, |at| shape[at].norm_sqr());
    let pulleys: Vec<f64> = found.speed.iter().map(of_pulley).collect();
    let of_belt: f64 = faces.clone().map(|face| shape[face].norm_sqr()).sum();
    let all = pulleys.iter().sum::<f64>() + of_belt;
    let velocities: Vec<c64> = faces.map(|face| shape[face] * found.scales[face]).collect();
    let rims = found.speed.iter().zip(&system.wheels);
    let rims: Vec<c64> = rims
        .map(|(unknown, wheel)| {
            unknown.map_or(c64::ZERO, |unknown| {
                shape[unknown] * found.scales[unknown] * wheel.radius
            })
        })
        .collect();
    let largest = { velocities.iter().chain(&rims) }
        .max_by(|one, other| one.norm_sqr().total_cmp(&other.norm_sqr()))
        .copied();
    let scaled = |velocity: c64| {
        let of_largest = velocity / largest.unwrap_or(c64::ONE);
        [of_largest.re, of_largest.im]
    };
    VibrationMode {
        growth: value.re,
        angular_frequency: value.im,
        error,
        pulley_shares: pulleys.iter().map(|share| share / all).collect(),
        rims: rims.into_iter().map(scaled).collect(),
        velocities: velocities.into_iter().map(scaled).collect(),
    }
}
