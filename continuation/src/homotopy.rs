//! A solution at a wanted parameter.

use crate::branch::branch::{Branch, Direction};
use crate::error::Error;
use crate::options::Options;
use crate::point::Point;
use crate::stop::Stop;
use crate::system::system::System;

/// Solves G(x, λ) = 0 at λ = `goal` by following the branch from `start` at another λ: a homotopy.
///
/// # Errors
/// Those of [`Branch::new`]; [`Error::Homotopy`] with the last point if the branch ends elsewhere.
pub fn homotopy<S: System>(
    system: &mut S,
    start: &[f64],
    goal: f64,
    options: &Options,
) -> Result<Point, Error> {
    let from = start.last().copied().unwrap_or(goal);
    let direction = if goal >= from {
        Direction::Increasing
    } else {
        Direction::Decreasing
    };
    let options = Options {
        targets: vec![goal],
        ..options.clone()
    };
    let mut branch = Branch::new(system, start, direction, &options)?;
    let mut last = branch.start();
    for point in branch.by_ref() {
        last = point;
        if last.lambda() == goal {
            return Ok(last);
        }
    }
    let stop = branch.into_stop().unwrap_or(Stop::Steps {
        steps: options.steps,
    });
    let lambda = last.lambda();
    Err(Error::Homotopy {
        lambda,
        goal,
        stop,
        last: Box::new(last),
    })
}
