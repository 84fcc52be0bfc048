//! From one discretisation of the system to a better one.

use crate::branch::progress::Progress;
use crate::curve::corrector::{Accuracy, Condition};
use crate::curve::curve::{Curve, reverse};
use crate::difficulty::Difficulty;
use crate::special_points::branch_point::{choose_border, set_borders};
use crate::system::system::System;

/// A change of the discretisation may move a point by this share of the step that led there, or by
/// ten times the tolerance of the system. Further away may be another branch: far up its curve Bratu's
/// problem then fell back to the trivial one.
const SHIFT: f64 = 0.1;
/// A tangent from this near a point is that of the point.
const DRIFT: f64 = 1e-6;
/// The most corrections of a point in another discretisation.
pub(crate) const CORRECTIONS: usize = 30;

/// What a change of the discretisation concerns.
pub(crate) struct Discretisation<'s, 'a, S> {
    pub(crate) curve: &'s mut Curve<'a, S>,
    pub(crate) progress: &'s mut Progress,
    /// The accuracy of regular points.
    pub(crate) accuracy: f64,
}

impl<S: System> Discretisation<'_, '_, S> {
    /// Goes over to a better discretisation of the last point, reached by a step of this length, where
    /// the system has one; returns whether it has.
    pub(crate) fn adapt(&mut self, h: f64) -> Result<bool, Difficulty> {
        let kept = self.progress.take_vectors();
        let mut vectors = kept.clone();
        match self.curve.system.adapted(&mut vectors) {
            Ok(Some(system)) => {
                let tolerance = Some(self.curve.system.tolerance()).filter(|t| t.is_finite());
                let limit = (SHIFT * h).max(10.0 * tolerance.unwrap_or(0.0));
                self.exchange(system, vectors, kept, limit)?;
                Ok(true)
            }
            outcome => {
                self.progress.put_vectors(kept);
                outcome.map(|_| false).map_err(Difficulty::Adaptation)
            }
        }
    }

    /// Replaces the system by another discretisation, in which `vectors` are expressed, and brings
    /// the last point to its curve. If that fails or moves the point by more than `limit`, everything
    /// is as before, with the vectors that were `kept`.
    pub(crate) fn exchange(
        &mut self,
        system: S,
        vectors: Vec<Vec<f64>>,
        kept: Vec<Vec<f64>>,
        limit: f64,
    ) -> Result<(), Difficulty> {
        let old = std::mem::replace(self.curve.system, system);
        let (metric, border) = (self.curve.metric.clone(), self.curve.border.clone());
        let witness = self.curve.witness.clone();
        let (node, trend) = (self.progress.node.clone(), self.progress.trend);
        self.progress.put_vectors(vectors);
        let outcome = self.settle(limit);
        if outcome.is_err() {
            *self.curve.system = old;
            (self.curve.metric, self.curve.border) = (metric, border);
            self.curve.witness = witness;
            (self.progress.node, self.progress.trend) = (node, trend);
            self.progress.put_vectors(kept);
        }
        outcome
    }

    /// Brings the last node back to the curve after the system has changed, by `limit` at most.
    fn settle(&mut self, limit: f64) -> Result<(), Difficulty> {
        let Self {
            curve, progress, ..
        } = self;
        curve.metric.regroup(curve.system);
        curve.metric.normalise(&mut progress.first.tangent);
        if progress.is_at_branch_point() {
            // It is located already.
            curve.metric.normalise(&mut progress.node.tangent);
            return set_borders(curve, &progress.node.z);
        }
        let node = &mut progress.node;
        let mut z = node.z.clone();
        let plane = Condition::plane(&curve.metric, &node.tangent, &z);
        let report = curve.correct(&mut z, &plane, Accuracy::Length(self.accuracy), CORRECTIONS)?;
        let distance = curve.metric.distance(&z, &node.z);
        if distance > limit {
            return Err(Difficulty::Shift { distance, limit });
        }
        let mut tangent = curve.corrector.null().to_vec();
        if report.drift > DRIFT || !curve.metric.normalise(&mut tangent) {
            tangent = curve.tangent(&z)?;
        }
        node.along = curve.metric.dot(&tangent, &node.tangent) > 0.0;
        if !node.along {
            reverse(&mut tangent);
        }
        node.cusp = curve.system.cusp_function();
        (node.z, node.tangent) = (z, tangent);
        progress.trend = None;
        choose_border(curve, node)
    }
}
