//! The same collocation polynomials on the halved mesh.

use crate::discretisation::iterate::{Interval, Iterate, SegmentIterate};
use crate::discretisation::mesh::Mesh;
use crate::discretisation::tableau::Tableau;
use crate::kernels::specialise::specialise;
use crate::problem::problem::Segment;

/// The polynomials of `x`, given on `mesh`, on the mesh with every interval halved, exact up to
/// rounding.
pub(crate) fn restrict(t: &Tableau, segments: &[Segment], mesh: &Mesh, x: &Iterate) -> Iterate {
    let pairs = segments.iter().zip(mesh).zip(&x.segments);
    Iterate {
        segments: pairs
            .map(|((segment, nodes), x)| {
                let n = segment.states;
                specialise!(n in [1, 2, 3, 4, 5, 6] => restrict_segment(t, n, nodes, x))
            })
            .collect(),
        p: x.p.clone(),
    }
}

#[inline(always)]
fn restrict_segment(t: &Tableau, n: usize, mesh: &[f64], from: &SegmentIterate) -> SegmentIterate {
    let size = t.stages * n;
    let mut to = SegmentIterate {
        nodes: vec![0.0; 2 * from.nodes.len() - n],
        stages: vec![0.0; 2 * from.stages.len()],
    };
    let halves = to
        .stages
        .chunks_exact_mut(2 * size)
        .zip(to.nodes.chunks_exact_mut(2 * n));
    for (i, ((stages, nodes), ends)) in halves.zip(mesh.windows(2)).enumerate() {
        let interval = Interval::new(from, [t.stages, n], i, ends);
        let (left, middle) = nodes.split_at_mut(n);
        left.copy_from_slice(interval.y);
        interval.state(&t.half_value, middle);
        let weights = t.half_slopes.chunks_exact(t.stages);
        for (stage, weights) in stages.chunks_exact_mut(n).zip(weights) {
            interval.slope(weights, stage);
        }
    }
    let last = to.nodes.len() - n;
    to.nodes[last..].copy_from_slice(&from.nodes[from.nodes.len() - n..]);
    to
}
