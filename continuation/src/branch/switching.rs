//! From a branch point onto the other branch.

use crate::branch::start::CORRECTIONS;
use crate::curve::corrector::{Accuracy, Condition};
use crate::curve::curve::{Curve, ahead};
use crate::error::Error;
use crate::system::system::System;

/// The first step onto another branch is shortened at most to this.
pub(crate) const SHORTEST: f64 = 1e-6;

/// The two halves of the other branch at a branch point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HalfBranch {
    /// Along [`Point::other`](crate::Point::other).
    Forward,
    /// Against it.
    Backward,
}

/// The length of a first step along the `direction` of the other branch, at most `longest`, whose end lies
/// on it: its direction is nearer to that of the other branch than to the `old` one.
pub(crate) fn first_step<S: System>(
    curve: &mut Curve<'_, S>,
    z: &[f64],
    [old, direction]: [&[f64]; 2],
    longest: f64,
    accuracy: f64,
) -> Result<f64, Error> {
    let cosine = curve.metric.dot(old, direction) / curve.metric.norm(old);
    let between = cosine.abs().min(1.0).acos();
    let mut step = longest;
    while step >= SHORTEST {
        let mut end = ahead(z, direction, step);
        let plane = Condition::plane(&curve.metric, direction, &end);
        let corrected = curve.correct(&mut end, &plane, Accuracy::Length(accuracy), CORRECTIONS);
        let way: Vec<f64> = end.iter().zip(z).map(|(end, z)| end - z).collect();
        let cosine = curve.metric.dot(&way, direction) / curve.metric.norm(&way);
        if corrected.is_ok() && cosine.min(1.0).acos() < 0.5 * between {
            return Ok(step);
        }
        step *= 0.5;
    }
    Err(Error::Switch { step })
}
