//! How large a correction is beside an iterate.

use crate::discretisation::iterate::Iterate;
use crate::kernels::dense::max_or_nan;
use crate::problem::problem::Segment;

/// One state at all nodes of a segment.
pub(crate) struct Component<'a> {
    index: usize,
    /// Number of states of the segment.
    n: usize,
    nodes: &'a [f64],
    /// Its largest absolute value.
    pub(crate) largest: f64,
}

impl<'a> Component<'a> {
    /// State `index` of a segment with n states, from its states at all nodes.
    pub(crate) fn new(nodes: &'a [f64], n: usize, index: usize) -> Self {
        let values = nodes.iter().skip(index).step_by(n);
        let largest = values.fold(0.0, |m, y| max_or_nan(m, y.abs()));
        Self {
            index,
            n,
            nodes,
            largest,
        }
    }

    /// The value at node i.
    pub(crate) fn at(&self, i: usize) -> f64 {
        self.nodes[i * self.n + self.index]
    }
}

/// The largest entry of a correction of `x` relative to the size of the state at its node, which is asked for
/// by component and node, or of the parameter with a value; not a number if one is not.
pub(crate) fn largest_ratio(
    segments: &[Segment],
    x: &Iterate,
    correction: &Iterate,
    of_state: impl Fn(&Component<'_>, usize) -> f64,
    of_parameter: impl Fn(f64) -> f64,
) -> f64 {
    let mut largest = 0.0f64;
    let each = segments.iter().zip(&x.segments).zip(&correction.segments);
    for ((&Segment { states: n, .. }, x), correction) in each {
        for index in 0..n {
            let component = Component::new(&x.nodes, n, index);
            let changes = correction.nodes.iter().skip(index).step_by(n);
            for (i, change) in changes.enumerate() {
                largest = max_or_nan(largest, change.abs() / of_state(&component, i));
            }
        }
    }
    let parameters = x.p.iter().zip(&correction.p);
    parameters.fold(largest, |m, (&p, c)| {
        max_or_nan(m, c.abs() / of_parameter(p))
    })
}
