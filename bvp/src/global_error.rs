//! The estimate of the global error.

use crate::collocation::Collocation;
use crate::dense::max_or_nan;
use crate::held::Held;
use crate::iterate::Interval;
use crate::mesh::halved;
use crate::restriction::restrict;
use crate::{Equations, Solution, Stats};
use std::sync::Arc;

/// Estimated global errors, relative to 1 + |value|.
#[derive(Clone, Debug, Default)]
pub(crate) struct GlobalErrors {
    /// For every segment one number per state, the largest over the segment.
    pub(crate) states: Vec<Vec<f64>>,
    /// One number per parameter.
    pub(crate) parameters: Vec<f64>,
}

impl GlobalErrors {
    pub(crate) fn largest(&self) -> f64 {
        let all = self.states.iter().flatten().chain(&self.parameters);
        all.copied().fold(0.0, max_or_nan)
    }
}

/// The global error of a solution, by one Newton correction on the halved mesh started at the
/// solution itself. An error ∝ h^q shrinks to 2^−q of it there, so the correction is (1 − 2^−q) of
/// the error; q is the order between the nodes, which is right there and cautious at the nodes.
///
/// The correction is looked at as a polynomial at the nodes and at the m + 1 defect points of every
/// half interval: at nodes and midpoints alone even Gauss schemes hide the error in between, which
/// vanishes at the midpoint by symmetry. `None` if there is no finite correction.
pub(crate) fn global_errors(
    equations: &dyn Equations,
    solution: &Solution,
    stats: &mut Stats,
) -> Option<GlobalErrors> {
    let t = &*solution.tableau;
    let tableau = Arc::clone(&solution.tableau);
    let mesh = halved(&solution.mesh);
    let mut collocation = Collocation::new(Held::none(equations), tableau, mesh);
    let x = restrict(t, equations.segments(), &solution.mesh, &solution.x);
    let mut residual = collocation.residual_buffer();
    let mut correction = collocation.zeros();
    collocation.linearise(&x, &mut residual, stats).ok()?;
    collocation.correction(&residual, &mut correction);

    let order = i32::try_from(t.scheme.dense_order()).ok()?;
    let factor = 1.0 / (1.0 - 0.5f64.powi(order));
    let relative = |x: f64, d: f64| factor * (d / (1.0 + x.abs())).abs();
    let mut states = Vec::with_capacity(collocation.mesh.len());
    for (index, segment) in equations.segments().iter().enumerate() {
        let n = segment.states;
        let (mut y, mut d) = (vec![0.0; n], vec![0.0; n]);
        let mut largest = vec![0.0; n];
        let mut look = |y: &[f64], d: &[f64]| {
            for (largest, (&y, &d)) in largest.iter_mut().zip(y.iter().zip(d)) {
                *largest = max_or_nan(*largest, relative(y, d));
            }
        };
        for (i, pair) in collocation.mesh[index].windows(2).enumerate() {
            let here = Interval::new(&x.segments[index], n, t, i, pair);
            let change = Interval::new(&correction.segments[index], n, t, i, pair);
            look(here.y, change.y);
            look(here.next, change.next);
            for weights in t.defect_value.chunks_exact(t.stages) {
                here.state(weights, &mut y);
                change.state(weights, &mut d);
                look(&y, &d);
            }
        }
        states.push(largest);
    }
    let parameters = x.p.iter().zip(&correction.p);
    let errors = GlobalErrors {
        states,
        parameters: parameters.map(|(&x, &d)| relative(x, d)).collect(),
    };
    errors.largest().is_finite().then_some(errors)
}
