//! The unknown that Newton's method corrects most.

use crate::discretisation::iterate::Iterate;
use crate::discretisation::mesh::Mesh;
use crate::problem::unknown::Unknown;

/// The unknown whose correction is the largest relative to 1 + |x|; the first that is not a number.
pub(crate) fn most_corrected(mesh: &Mesh, x: &Iterate, correction: &Iterate) -> Option<Unknown> {
    let mut worst = (0.0f64, None);
    let mut compare = |x: f64, delta: f64, unknown: Unknown| {
        let relative = (delta / (1.0 + x.abs())).abs();
        if !worst.0.is_nan() && (relative.is_nan() || relative > worst.0) {
            worst = (relative, Some(unknown));
        }
    };
    let segments = x.segments.iter().zip(&correction.segments).zip(mesh);
    for (segment, ((x, delta), mesh)) in segments.enumerate() {
        let n = x.nodes.len() / mesh.len();
        for (i, (&x, &delta)) in x.nodes.iter().zip(&delta.nodes).enumerate() {
            let (s, component) = (mesh[i / n], i % n);
            let state = Unknown::State {
                segment,
                s,
                component,
            };
            compare(x, delta, state);
        }
    }
    for (index, (&x, &delta)) in x.p.iter().zip(&correction.p).enumerate() {
        compare(x, delta, Unknown::Parameter { index });
    }
    worst.1
}
