//! Closed curves: the first point met again.

use crate::branch::found::Found;
use crate::branch::progress::Progress;
use crate::curve::curve::Curve;
use crate::point::Kind;
use crate::special_points::node::{Located, Node};
use crate::special_points::span::Span;
use crate::system::system::System;

/// A closed curve is noticed after this many steps, ...
const FEWEST_STEPS: usize = 3;
/// ... when the start lies within this share of a step from the secant, ...
const NEAR: f64 = 0.3;
/// ... and is met with this accuracy, or to that of the discretisation.
const MET: f64 = 1e-6;

/// What the first point is sought with.
pub(crate) struct Closing<'s, 'a, S> {
    pub(crate) curve: &'s mut Curve<'a, S>,
    pub(crate) progress: &'s Progress,
}

impl<S: System> Closing<'_, '_, S> {
    /// The first point, if it is a branch point and among the ones `found`, met in the direction in
    /// which it was left.
    pub(crate) fn among(&self, found: &[Found]) -> Option<Located> {
        if self.progress.steps < FEWEST_STEPS || !self.progress.from_branch_point {
            return None;
        }
        let (first, metric) = (&self.progress.first, &self.curve.metric);
        let allowed = self.met();
        let mut crossings = found.iter().filter(|found| found.kind == Kind::BranchPoint);
        let same = crossings.find(|found| {
            metric.distance(&found.at.z, &first.z) <= allowed
                && metric.dot(&found.at.tangent, &first.tangent) > 0.5 * metric.norm(&first.tangent)
        });
        same.map(|found| Located {
            u: found.at.u,
            z: first.z.clone(),
            tangent: first.tangent.clone(),
            along: first.along,
        })
    }

    /// How far from the first point a closed curve may end.
    fn met(&self) -> f64 {
        let tolerance = Some(self.curve.system.tolerance()).filter(|t| t.is_finite());
        MET.max(10.0 * tolerance.unwrap_or(0.0))
    }

    /// The first point, if the step passes it in the direction in which it was left.
    pub(crate) fn on_step(&mut self, to: &Node) -> Option<Located> {
        if self.progress.steps < FEWEST_STEPS {
            return None;
        }
        let first = self.progress.first.clone();
        let allowed = self.met();
        let mut span = Span {
            curve: self.curve,
            from: &self.progress.node,
            to,
        };
        let u = span.place(&first.z);
        if !(u > 0.0 && u <= 1.0) {
            return None;
        }
        let ends = span.from.z.iter().zip(&to.z);
        let secant: Vec<f64> = ends.clone().map(|(a, b)| b - a).collect();
        let near: Vec<f64> = ends.map(|(a, b)| a + u * (b - a)).collect();
        let length = span.curve.metric.norm(&secant);
        let start = span.cubic(u);
        let ahead = 0.5 * length * span.curve.metric.norm(&first.tangent);
        let ahead = span.curve.metric.dot(&first.tangent, &secant) > ahead;
        if !ahead || span.curve.metric.distance(&near, &first.z) > NEAR * length {
            return None;
        }
        let met = span.across(&start, &first.tangent, &first.z).ok()?;
        let missed = span.curve.metric.distance(&met, &first.z);
        let (z, tangent, along) = (first.z, first.tangent, first.along);
        let at = Located {
            u,
            z,
            tangent,
            along,
        };
        (missed <= allowed).then_some(at)
    }
}
