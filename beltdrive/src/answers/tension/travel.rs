//! How far a centre is moved to tension a belt.

use super::SetupQuestion;
use crate::mechanics::root::near_with_slope;
use crate::{Drive, Mount, SolveError};
use std::borrow::Cow;

/// How far the centre of a pulley is moved along the steepest growth of the length of the loop: away from the other
/// pulley where there are two, against its hub load at rest where there are more.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Travel {
    /// Index of the pulley.
    pub pulley: usize,
    /// Direction of the motion, of length 1.
    pub direction: [f64; 2],
    /// From where the belt just lies on the pulleys without tension to where it has the setup tension, m; none if
    /// the layout does not allow it.
    pub from_free: Option<f64>,
    /// Farther, to make up for the growth of the belt, m: exact for flat belts; a V-belt sinks a little less or more
    /// deeply where its wraps change.
    pub for_elongation: Option<f64>,
}

/// Whether the pulley that is to be moved can be.
pub(super) fn movable(drive: &Drive, moved: Option<usize>) -> Result<(), SolveError> {
    let Some(moved) = moved else { return Ok(()) };
    let wrong = |subject: &str, problem: &'static str| {
        Err(SolveError::Statement {
            subject: subject.to_owned(),
            problem: Cow::Borrowed(problem),
        })
    };
    match (drive.pulleys.get(moved), drive.tensioner()) {
        (None, _) => wrong("pulley to move", "there is no such pulley"),
        (Some(pulley), Some(_)) => wrong(
            &pulley.name,
            "cannot be moved to tension the belt, which the tensioner does",
        ),
        (Some(_), None) => Ok(()),
    }
}

/// The travel of a drive that is set up with a belt of an unstretched length.
pub(super) fn travel(
    drive: &Drive,
    question: SetupQuestion,
    unstretched: f64,
) -> Result<Option<Travel>, SolveError> {
    let only = (drive.pulleys.len() == 2).then(|| drive.driver());
    let moved = question.moved.or(only);
    let (Some(pulley), None) = (moved, drive.tensioner()) else {
        return Ok(None);
    };
    let layout = drive.layout(0.0)?;
    let [x, y] = layout.length_gradient(pulley);
    let slope = x.hypot(y);
    let direction = [x / slope, y / slope];
    // No pulley is moved by more than the length of the belt.
    let length = layout.length();
    let to = |asked: f64| {
        let excess = |travel: f64| Some(moved_by(drive, pulley, direction, travel)? - asked);
        near_with_slope(excess, 0.0, slope, [-length, length], ROUNDING * length)
    };
    Ok(Some(Travel {
        pulley,
        direction,
        from_free: to(unstretched).map(|travel| -travel),
        for_elongation: to(length * (1.0 + question.elongation)),
    }))
}

/// A length is met to this, relative: rounding errors of a layout.
const ROUNDING: f64 = 1e-14;

/// The length of the loop with a pulley moved in a direction, m, if it can be laid so.
fn moved_by(drive: &Drive, pulley: usize, direction: [f64; 2], travel: f64) -> Option<f64> {
    let mut drive = drive.clone();
    if let Mount::Fixed(centre) = &mut drive.pulleys[pulley].mount {
        for (part, along) in centre.iter_mut().zip(direction) {
            *part += travel * along;
        }
    }
    Some(drive.layout(0.0).ok()?.length())
}
