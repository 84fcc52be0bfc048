//! From a branch point onto the other branch.

use crate::branch::branch::Branch;
use crate::branch::branch::reverse;
use crate::curve::corrector::{Accuracy, Condition};
use crate::error::Error;
use crate::options::Options;
use crate::point::{Kind, Point};
use crate::system::system::System;

/// The first step onto another branch is shortened at most to this.
const SHORTEST_SWITCH: f64 = 1e-6;
/// The most corrections of the first point on it.
const CORRECTIONS: usize = 50;

/// The two halves of the other branch at a branch point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leg {
    /// Along [`Point::other`].
    Forward,
    /// Against it.
    Backward,
}

impl<'a, S: System> Branch<'a, S> {
    /// The other branch from a branch point. Its first point off the branch point is found before
    /// the branch is returned, and verified to lie in the direction of the other branch.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`Error::NoSecondBranch`] and [`Error::Switch`].
    pub fn switch(
        system: &'a mut S,
        point: &Point,
        leg: Leg,
        options: &Options,
    ) -> Result<Self, Error> {
        let Some(other) = &point.other else {
            return Err(Error::NoSecondBranch);
        };
        let mut onward = point.clone();
        onward.tangent.clone_from(other);
        if leg == Leg::Backward {
            reverse(&mut onward.tangent);
        }
        onward.kind = Kind::BranchPoint;
        let mut branch = Self::resume(system, &onward, options)?;
        let direction = branch.node.tangent.clone();
        let mut old = point.tangent.clone();
        branch.metric.normalise(&mut old);
        let between = branch.metric.dot(&old, &direction).abs().min(1.0).acos();
        while branch.step >= SHORTEST_SWITCH {
            let predicted: Vec<f64> = point
                .z
                .iter()
                .zip(&direction)
                .map(|(z, t)| z + branch.step * t)
                .collect();
            if let Some(angle) = branch.first_angle(&predicted, &direction)
                && angle < 0.5 * between
            {
                return Ok(branch);
            }
            branch.step *= 0.5;
        }
        Err(Error::Switch { step: branch.step })
    }

    /// The angle between the direction and the way to the point of the curve near `predicted`.
    fn first_angle(&mut self, predicted: &[f64], direction: &[f64]) -> Option<f64> {
        let mut z = predicted.to_vec();
        let plane = Condition::plane(&self.metric, direction, predicted);
        let accuracy = Accuracy::Length(self.accuracy());
        self.corrector
            .correct(
                self.system,
                &self.metric,
                &mut z,
                &plane,
                accuracy,
                CORRECTIONS,
            )
            .ok()?;
        let way: Vec<f64> = z.iter().zip(&self.node.z).map(|(z, a)| z - a).collect();
        let cosine = self.metric.dot(&way, direction) / self.metric.norm(&way);
        Some(cosine.min(1.0).acos())
    }
}
