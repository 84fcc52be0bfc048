//! The curve of solutions of a system, and the way back to it.

use crate::curve::corrector::{Accuracy, Condition, Correction, Corrector};
use crate::curve::metric::Metric;
use crate::difficulty::Difficulty;
use crate::system::system::System;

/// Points are corrected to this share of the tolerance of the system, so that what is left of the
/// corrections is no defect: with the accuracy 1e-9 and the tolerance 1e-10 the mesh of a boundary value problem
/// grew to 240 000 unknowns, where 341 do.
const SHARE_OF_TOLERANCE: f64 = 0.01;

/// The curve G(z) = 0 of a system within bounds of λ, measured by a metric.
pub(crate) struct Curve<'a, S> {
    pub(crate) system: &'a mut S,
    pub(crate) metric: Metric,
    pub(crate) corrector: Corrector,
    /// The bordering vector b of the test function for branch points.
    pub(crate) border: Vec<f64>,
    /// Another bordering vector, whose second vector turns at branch points that b overlooks: those at which it
    /// is nearly in the range of J.
    pub(crate) witness: Vec<f64>,
}

impl<'a, S: System> Curve<'a, S> {
    pub(crate) fn new(system: &'a mut S, metric: Metric, bounds: [f64; 2]) -> Self {
        Self {
            system,
            metric,
            corrector: Corrector::within(bounds),
            border: Vec::new(),
            witness: Vec::new(),
        }
    }

    /// Corrects `z` onto the curve and a condition by at most `limit` corrections.
    pub(crate) fn correct(
        &mut self,
        z: &mut [f64],
        condition: &Condition,
        accuracy: Accuracy,
        limit: usize,
    ) -> Result<Correction, Difficulty> {
        self.corrector
            .correct(self.system, &self.metric, z, condition, accuracy, limit)
    }

    /// Linearises the system at `z` and returns the unit tangent as the system orients it.
    pub(crate) fn tangent(&mut self, z: &[f64]) -> Result<Vec<f64>, Difficulty> {
        self.corrector.tangent(self.system, &self.metric, z)
    }

    /// The accuracy of regular points: the one `wanted`, or finer where the tolerance of the system is.
    pub(crate) fn accuracy(&self, wanted: f64) -> f64 {
        wanted.min(SHARE_OF_TOLERANCE * self.system.tolerance())
    }

    /// The rate of λ along a unit tangent, with the range of λ as unit.
    pub(crate) fn rate(&self, tangent: &[f64]) -> f64 {
        tangent[tangent.len() - 1] / self.metric.range()
    }
}

/// Turns a tangent round.
pub(crate) fn reverse(tangent: &mut [f64]) {
    tangent.iter_mut().for_each(|t| *t = -*t);
}
