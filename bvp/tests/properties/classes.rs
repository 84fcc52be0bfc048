//! Classes of problems beyond the plain one.

mod eigenvalues;
mod infinite;
mod integrals;
mod junctions;
mod singular;

use bvp::Solution;

/// Number of intervals over all segments.
fn intervals(solution: &Solution) -> usize {
    let segments = 0..solution.segments().len();
    segments.map(|i| solution.mesh(i).len() - 1).sum()
}
