//! Mesh selection: refine, coarsen and redistribute from the defects.

use crate::mesh::{Mesh, equidistribute, split};

/// New meshes aim at this fraction of the tolerance, so that one step usually suffices.
const AIM: f64 = 0.3;
/// An interval is not asked to be cut into more than this many at once: defects on intervals that
/// coarse do not yet follow their power law.
const LARGEST_CUT: f64 = 8.0;
/// Nor to grow more than by the inverse of this.
const SMALLEST_CUT: f64 = 0.2;
/// Neighbouring intervals may differ in length by about this factor.
const GRADING: f64 = 2.5;
/// Where at most this share of the intervals is too long, only they are cut.
const FEW: f64 = 0.12;

/// The next mesh, from the relative defects r on this one and the tolerance they must meet, given
/// that r ∝ hᵐ. Each interval wants to be cut into ν = (r / aim)^(1/m) parts; the new nodes
/// equidistribute the density ν/h, per segment.
pub(crate) fn next_mesh(mesh: &Mesh, defects: &[Vec<f64>], tolerance: f64, m: usize) -> Mesh {
    let next = |(nodes, defects): (&Vec<f64>, &Vec<f64>)| -> Vec<f64> {
        let wanted = |r: &f64| -> f64 {
            let cut = (r / (AIM * tolerance)).powf(1.0 / m as f64);
            cut.clamp(SMALLEST_CUT, LARGEST_CUT)
        };
        let cuts: Vec<f64> = defects.iter().map(wanted).collect();
        let too_long = defects.iter().filter(|&&r| r > tolerance).count();
        let total: f64 = cuts.iter().sum();
        let count = cuts.len() as f64;
        if (too_long as f64) <= FEW * count && total > 0.5 * count {
            let pieces: Vec<usize> = defects
                .iter()
                .zip(&cuts)
                .map(|(&r, &cut)| if r > tolerance { ceil(cut).max(2) } else { 1 })
                .collect();
            return split(nodes, &pieces);
        }
        let mut density: Vec<f64> = cuts
            .iter()
            .zip(nodes.windows(2))
            .map(|(cut, pair)| cut / (pair[1] - pair[0]))
            .collect();
        grade(&mut density);
        let total: f64 = density
            .iter()
            .zip(nodes.windows(2))
            .map(|(density, pair)| density * (pair[1] - pair[0]))
            .sum();
        equidistribute(nodes, &density, ceil(total).max(2))
    };
    mesh.iter().zip(defects).map(next).collect()
}

/// The mesh with all intervals shortened so that an error ∝ h^order falls from `error` to `aim`.
pub(crate) fn denser(mesh: &Mesh, error: f64, aim: f64, order: usize) -> Mesh {
    let factor = (error / aim).powf(1.0 / order as f64).clamp(1.2, 4.0);
    mesh.iter()
        .map(|nodes| {
            let density: Vec<f64> = nodes.windows(2).map(|p| 1.0 / (p[1] - p[0])).collect();
            equidistribute(nodes, &density, ceil(factor * density.len() as f64))
        })
        .collect()
}

/// Raises densities until neighbours differ by at most [`GRADING`].
fn grade(density: &mut [f64]) {
    for i in 1..density.len() {
        density[i] = density[i].max(density[i - 1] / GRADING);
    }
    for i in (1..density.len()).rev() {
        density[i - 1] = density[i - 1].max(density[i] / GRADING);
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts of intervals are positive and far below 2^53"
)]
fn ceil(x: f64) -> usize {
    x.ceil() as usize
}
