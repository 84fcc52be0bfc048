//! The first point of a branch.

use crate::branch::progress::Progress;
use crate::curve::corrector::{Accuracy, Condition};
use crate::curve::curve::{Curve, reverse};
use crate::curve::metric::FARTHEST;
use crate::difficulty::Difficulty;
use crate::error::Error;
use crate::point::{Kind, Point};
use crate::special_points::branch_point::choose_border;
use crate::special_points::node::Node;
use crate::system::system::System;

/// A start whose Jacobian comes this close to a second null vector, relative to its size, is
/// refused.
const SINGULAR: f64 = 1e-11;
/// λ turns, or rests, where its rate along the unit tangent, with its range as unit, is below this.
pub(crate) const TURNING: f64 = 1e-12;
/// The most corrections of a first point.
pub(crate) const CORRECTIONS: usize = 50;

/// Corrects a start at its λ, else across the curve, and finds its tangent.
pub(crate) fn correct_start<S: System>(
    curve: &mut Curve<'_, S>,
    node: &mut Node,
) -> Result<(), Error> {
    let n = node.z.len() - 1;
    let condition = Condition::lambda(n + 1, node.z[n]);
    let mut z = node.z.clone();
    match curve.correct(&mut z, &condition, Accuracy::Rounding, CORRECTIONS) {
        Ok(_) => {
            z[n] = node.z[n];
            node.z = z;
        }
        Err(difficulty) => {
            let tangent = curve.tangent(&node.z);
            let across = tangent.and_then(|tangent| correct_across(curve, node, &tangent));
            across.map_err(|_| Error::Start(difficulty))?;
        }
    }
    curve.metric.observe(&node.z);
    node.tangent = curve.tangent(&node.z).map_err(Error::Start)?;
    curve.metric.reach(&node.tangent, FARTHEST);
    curve.metric.normalise(&mut node.tangent);
    choose_border(curve, node).map_err(Error::Start)?;
    if curve.branch_points && node.eta().abs() < SINGULAR {
        return Err(Error::SingularStart);
    }
    Ok(())
}

/// Corrects a node across `tangent` and finds its own tangent.
pub(crate) fn correct_across<S: System>(
    curve: &mut Curve<'_, S>,
    node: &mut Node,
    tangent: &[f64],
) -> Result<(), Difficulty> {
    let mut z = node.z.clone();
    let plane = Condition::plane(&curve.metric, tangent, &z);
    curve.correct(&mut z, &plane, Accuracy::Rounding, CORRECTIONS)?;
    node.tangent = curve.tangent(&z)?;
    node.z = z;
    Ok(())
}

/// Makes the node the first point, to be left along its tangent or against it.
pub(crate) fn set_out<S: System>(curve: &Curve<'_, S>, progress: &mut Progress, along: bool) {
    let node = &mut progress.node;
    if !along {
        reverse(&mut node.tangent);
    }
    node.along = along;
    node.cusp = curve.system.cusp_function();
    progress.first = node.clone();
    let start = node.point(Kind::Start);
    let turning = curve.rate(&node.tangent).abs() < TURNING;
    progress.queue.push_back(start.clone());
    if turning && !progress.unoriented {
        progress.queue.push_back(Point {
            kind: Kind::LimitPoint,
            ..start
        });
    }
}
