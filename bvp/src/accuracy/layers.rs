//! Layers that the equations allow at the ends of segments and the mesh cannot show.
//!
//! Where solutions of the linearised equations decay from an end into a segment on a length far below
//! that of the interval there, collocation at Gauss points takes them for oscillations and so forbids
//! them. If the conditions ask for a layer there, another solution is found that satisfies them without, the
//! same on every mesh that is as coarse there. A mesh that resolves the layer tells.

use crate::discretisation::mesh::{Mesh, ceil};
use crate::newton::collocation::Collocation;
use crate::problem::problem::Segment;
use faer::MatRef;

/// An interval longer than this many decay lengths does not show a layer.
const HIDDEN: f64 = 20.0;
/// What the first of the inserted intervals is of the decay length, at most.
const SHOWN: f64 = 2.0;

impl Collocation<'_> {
    /// The mesh with intervals inserted at all ends where a layer may hide, by the Jacobians of the last
    /// linearisation; `None` where none may.
    pub(crate) fn with_possible_layers(&self) -> Option<Mesh> {
        let mut found = None;
        let k = self.equations.parameters();
        for (index, Segment { states: n, .. }) in self.equations.segments().iter().enumerate() {
            let jacobians = self.stages[index].jacobians();
            // Those of the first and of the last interval farthest from the end: there a coefficient
            // that is singular at the end is not large.
            let (size, far) = (n * (n + k), self.tableau.stages - 1);
            let first = &jacobians[far * size..][..size];
            let last = &jacobians[jacobians.len() - (far + 1) * size..][..size];
            let nodes = &self.mesh[index];
            let end = nodes.len() - 1;
            let (h0, h1) = (nodes[1] - nodes[0], nodes[end] - nodes[end - 1]);
            let mut insert = |at: usize, places: &mut dyn Iterator<Item = f64>| {
                let mesh = found.get_or_insert_with(|| self.mesh.clone());
                mesh[index].splice(at..at, places);
            };
            // The right end first: it leaves the places of the others.
            if let Some(rate) = fastest_growth(last, *n, h1, 1.0) {
                insert(
                    end,
                    &mut distances(h1, rate).into_iter().map(|d| nodes[end] - d),
                );
            }
            if let Some(rate) = fastest_growth(first, *n, h0, -1.0) {
                let ascending = distances(h0, rate).into_iter().rev();
                insert(1, &mut ascending.map(|d| nodes[0] + d));
            }
        }
        found
    }
}

/// The rate at which the fastest solution of a Jacobian grows in a direction, 1 or −1, if that is too
/// fast for an interval of length h: the largest real part among the eigenvalues, or minus the smallest.
fn fastest_growth(jacobian: &[f64], n: usize, h: f64, direction: f64) -> Option<f64> {
    let columns = jacobian.len() / n;
    let rows = jacobian.chunks_exact(columns).map(|row| &row[..n]);
    let norm = rows.map(|row| row.iter().map(|x| x.abs()).sum::<f64>());
    // No eigenvalue exceeds the norm.
    if norm.fold(0.0, f64::max) * h <= HIDDEN {
        return None;
    }
    let matrix = MatRef::from_row_major_slice_with_stride(jacobian, n, n, columns);
    let rate = if n == 2 {
        // They are the mean of the diagonal ± √(…), complex where that is of a negative number.
        let [mean, distance] =
            [1.0, -1.0].map(|sign| 0.5 * (matrix[(0, 0)] + sign * matrix[(1, 1)]));
        let square = distance * distance + matrix[(0, 1)] * matrix[(1, 0)];
        direction * mean + square.max(0.0).sqrt()
    } else {
        let eigenvalues = matrix.to_owned().eigenvalues().ok()?;
        let rates = eigenvalues.iter().map(|z| direction * z.re);
        rates.fold(0.0, f64::max)
    };
    (rate.is_finite() && rate * h > HIDDEN).then_some(rate)
}

/// Distances from the end, descending, at which an interval of length h is cut for a layer that grows
/// at this rate: each the same share of the one before, and at least half of it. At most a quarter in the place of
/// the half, and a last interval of what is left, so short that the next mesh is short around it, took 9, 9 and 7 %
/// more instructions on the reference set at 1e-3, 1e-6 and 1e-9, at least a third 3, 1 and 2 %.
fn distances(h: f64, rate: f64) -> Vec<f64> {
    let first = SHOWN / rate;
    let cuts = ceil((h / first).log2());
    let share = (first / h).powf(1.0 / cuts as f64);
    let ascending = std::iter::successors(Some(first), |&d| Some(d / share));
    let mut distances: Vec<f64> = ascending.take(cuts).collect();
    distances.reverse();
    distances
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rate_is_that_of_the_fastest_growing_solution() {
        // Eigenvalues 100 and −300; a third column is a parameter.
        let jacobian = [0.0, 1.0, 5.0, 30_000.0, -200.0, 5.0];
        let rate = fastest_growth(&jacobian, 2, 1.0, 1.0).unwrap();
        assert!((rate - 100.0).abs() < 1e-9);
        let rate = fastest_growth(&jacobian, 2, 1.0, -1.0).unwrap();
        assert!((rate - 300.0).abs() < 1e-9);
        assert_eq!(fastest_growth(&jacobian, 2, 0.1, 1.0), None);
        let overflow = [1e200, 0.0, 0.0, -1e200];
        assert_eq!(fastest_growth(&overflow, 2, 1.0, 1.0), None);
        let oscillation = [0.0, 1.0, -1e6, 0.0];
        assert_eq!(fastest_growth(&oscillation, 2, 1.0, 1.0), None);
    }

    #[test]
    fn cuts_reach_from_the_interval_to_the_layer() {
        let found = distances(1.0, 100.0);
        let shares = found.windows(2).map(|pair| pair[1] / pair[0]);
        assert_eq!((found.len(), found[5]), (6, 0.02));
        assert!(
            shares
                .chain([found[0]])
                .all(|share| (share - 0.02_f64.powf(1.0 / 6.0)).abs() < 1e-15)
        );
    }
}
