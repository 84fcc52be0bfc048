//! The continuous solution.

use crate::discretisation::iterate::Iterate;
use crate::discretisation::mesh::{Mesh, intervals};
use crate::discretisation::scheme::MAX_STAGES;
use crate::discretisation::scheme::Scheme;
use crate::discretisation::tableau::Tableau;
use crate::kernels::dense::{add_scaled, max_or_nan};
use crate::problem::guess::Guess;
use crate::problem::guess::interval_of;
use crate::problem::problem::Segment;
use crate::result::quality::{GlobalErrors, Quality};
use crate::result::stats::Stats;
use std::fmt;
use std::sync::Arc;

/// A solution (or, in an [`Error`](crate::Error), the best iterate): a collocation polynomial on
/// every interval, the parameters, and what is known of their accuracy.
#[derive(Clone)]
pub struct Solution {
    pub(crate) segments: Vec<Segment>,
    /// The units of the states of all segments and of the parameters; empty if they are all one.
    pub(crate) absolute: Vec<f64>,
    pub(crate) tableau: Arc<Tableau>,
    pub(crate) mesh: Mesh,
    pub(crate) x: Iterate,
    pub(crate) quality: Quality,
    pub(crate) stats: Stats,
}

impl Solution {
    /// The states of `segment` at `s`, into `y` (n numbers). Accurate to the order
    /// [`Scheme::dense_order`] everywhere; outside the segment the last polynomial is extended.
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let (i, h, theta) = self.locate(segment, s);
        let mut weights = [0.0; MAX_STAGES];
        self.tableau
            .value_weights(theta, &mut weights[..self.tableau.stages]);
        y.copy_from_slice(self.node(segment, i));
        self.add_stages(segment, i, &weights, h, y);
    }

    /// The states of `segment` at all of `places`, in any order, into `states`: n numbers a place, one
    /// place after the other. Each is that of [`state`](Self::state).
    ///
    /// ```
    /// # use bvp::{Constant, Options, TwoPoint, solve};
    /// # let line = TwoPoint::new(
    /// #     [2, 0],
    /// #     [0.0, 1.0],
    /// #     |s, y, _p, dy| dy.copy_from_slice(&[y[1], 0.0 * s]),
    /// #     |start, end, _p, r| r.copy_from_slice(&[start[0], end[0] - 1.0]),
    /// # );
    /// # let solution = solve(&line, &Constant::new([0.0, 0.0]), &Options::default())?;
    /// // The straight line from (0, 0) to (1, 1), with its slope.
    /// let mut states = [0.0; 4];
    /// solution.states(0, &[0.25, 0.5], &mut states);
    /// assert!((states[0] - 0.25).abs() < 1e-12 && (states[2] - 0.5).abs() < 1e-12);
    /// # Ok::<(), bvp::Error>(())
    /// ```
    ///
    /// # Panics
    /// If there is no such segment, or the numbers of places and states do not suit each other.
    pub fn states(&self, segment: usize, places: &[f64], states: &mut [f64]) {
        let n = self.segments[segment].states;
        assert_eq!(states.len(), n * places.len(), "n states a place");
        for (s, y) in places.iter().zip(states.chunks_exact_mut(n)) {
            self.state(segment, *s, y);
        }
    }

    /// The derivatives dy/ds of the continuous solution of `segment` at `s`, into `slope`.
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn derivative(&self, segment: usize, s: f64, slope: &mut [f64]) {
        let (i, _, theta) = self.locate(segment, s);
        let mut weights = [0.0; MAX_STAGES];
        self.tableau
            .slope_weights(theta, &mut weights[..self.tableau.stages]);
        slope.fill(0.0);
        self.add_stages(segment, i, &weights, 1.0, slope);
    }

    /// The parameters, k numbers.
    pub fn parameters(&self) -> &[f64] {
        &self.x.p
    }

    /// The mesh nodes of a segment from its start to its end, joined points among them.
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn mesh(&self, segment: usize) -> &[f64] {
        &self.mesh[segment]
    }

    /// The states at a mesh node, where the order is highest.
    ///
    /// # Panics
    /// If there is no such segment or node.
    pub fn node(&self, segment: usize, node: usize) -> &[f64] {
        let n = self.segments[segment].states;
        &self.x.segments[segment].nodes[node * n..][..n]
    }

    /// The states at the start of a segment.
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn start(&self, segment: usize) -> &[f64] {
        self.node(segment, 0)
    }

    /// The states at the end of a segment.
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn end(&self, segment: usize) -> &[f64] {
        self.node(segment, self.mesh[segment].len() - 1)
    }

    /// The segments that were solved.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The scheme that was used.
    pub fn scheme(&self) -> Scheme {
        self.tableau.scheme
    }

    /// The relative defect of every interval of a segment, root mean square over the interval.
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn defects(&self, segment: usize) -> &[f64] {
        &self.quality.defects.relative[segment]
    }

    /// The largest relative defect; infinite for an iterate that never converged.
    pub fn defect(&self) -> f64 {
        let all = self.quality.defects.relative.iter().flatten();
        all.copied().reduce(max_or_nan).unwrap_or(f64::INFINITY)
    }

    /// The largest |residual| among the conditions; infinite for an iterate that never converged.
    pub fn condition_residual(&self) -> f64 {
        let all = self.quality.conditions.iter().copied();
        all.reduce(f64::max).unwrap_or(f64::INFINITY)
    }

    /// The largest estimated global error of all states and parameters, relative to 1 + |value|;
    /// `None` with [`Control::Defect`](crate::Control::Defect) or where the estimate failed.
    pub fn error_estimate(&self) -> Option<f64> {
        self.quality.errors.as_ref().map(GlobalErrors::largest)
    }

    /// The estimated global error of each state of a segment, the largest over the segment,
    /// relative to 1 + |y|; `None` as for [`error_estimate`](Self::error_estimate).
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn state_errors(&self, segment: usize) -> Option<&[f64]> {
        let errors = self.quality.errors.as_ref()?;
        Some(&errors.states[segment])
    }

    /// The estimated global error of each parameter, relative to 1 + |p|; `None` as for
    /// [`error_estimate`](Self::error_estimate).
    pub fn parameter_errors(&self) -> Option<&[f64]> {
        let errors = self.quality.errors.as_ref()?;
        Some(&errors.parameters)
    }

    /// The cost of the solution.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// The interval with the largest defect: its segment, start and length.
    pub(crate) fn worst_interval(&self) -> (usize, f64, f64) {
        let (mut worst, mut place) = (f64::NEG_INFINITY, (0, f64::NAN, f64::NAN));
        for (segment, (nodes, defects)) in self
            .mesh
            .iter()
            .zip(&self.quality.defects.relative)
            .enumerate()
        {
            for (pair, &defect) in nodes.windows(2).zip(defects) {
                if defect > worst {
                    (worst, place) = (defect, (segment, pair[0], pair[1] - pair[0]));
                }
            }
        }
        place
    }

    /// The interval of `segment` with `s`, its length, and the place in it from 0 to 1.
    fn locate(&self, segment: usize, s: f64) -> (usize, f64, f64) {
        let nodes = &self.mesh[segment];
        let i = interval_of(nodes, s);
        let h = nodes[i + 1] - nodes[i];
        (i, h, (s - nodes[i]) / h)
    }

    /// y += factor Σ weightsₗ Kₗ on interval i.
    fn add_stages(&self, segment: usize, i: usize, weights: &[f64], factor: f64, y: &mut [f64]) {
        let (n, m) = (y.len(), self.tableau.stages);
        let stages = &self.x.segments[segment].stages[i * m * n..][..m * n];
        for (weight, stage) in weights.iter().zip(stages.chunks_exact(n)) {
            add_scaled(y, factor * weight, stage);
        }
    }
}

/// What it is and how accurate, without its many numbers.
impl fmt::Debug for Solution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Solution")
            .field("segments", &self.segments)
            .field("scheme", &self.scheme())
            .field("intervals", &intervals(&self.mesh))
            .field("parameters", &self.x.p)
            .field("error_estimate", &self.error_estimate())
            .field("defect", &self.defect())
            .finish_non_exhaustive()
    }
}

impl Guess for Solution {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        Self::state(self, segment, s, y);
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.x.p);
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        Some(self.mesh.clone())
    }

    fn state_values(&self, index: usize, _segment: &Segment) -> Option<usize> {
        Some(self.x.segments.get(index).map_or(0, |x| x.nodes.len()))
    }

    fn parameter_values(&self) -> Option<usize> {
        Some(self.x.p.len())
    }
}
