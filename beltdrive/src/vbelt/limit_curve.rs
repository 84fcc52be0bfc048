//! The limit of one entry over a second one: a design chart.

use super::chart::Chart;
use super::{SolveError, SolveOptions};
use crate::input::Key;
use crate::{Drive, LimitCurve};
use std::time::Instant;

/// Finds the largest value of the entry `key` that a drive carries, and why, over the values of the
/// entry `second` from `range[0]` to `range[1]` (SI): the load limit against the coefficient of
/// friction, for instance.
///
/// At five values of `second` the limit is located on the branch of its own drive, which is followed
/// from a small load, so that it is known to be the first limit on the way. In between the limit is
/// followed by continuation: limit points as a curve of limit points, gross slip of the driven pulley
/// as states at which its speed is zero. A followed limit is accepted where it arrives at the next
/// limit located. Where the kind of limit changes, gross slip is followed until it ends, either in a
/// jump to the limit point behind it, or where the driven pulley stops just at the limit point; both
/// places are found exactly and have two points of the curve, one of each kind. Where a limit cannot
/// be followed, or the way does not arrive where it should, further limits are located, down to every
/// value of the chart and around a change of the kind of limit by bisection.
///
/// The error estimate of a followed limit is the largest relative error of the state, times its value.
///
/// # Errors
/// Those of [`solve`](crate::solve) at the beginning of the range.
///
/// # Panics
/// If an entry is none of this drive.
pub fn limit_curve(
    drive: &Drive,
    key: &Key,
    second: &Key,
    range: [f64; 2],
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<LimitCurve, SolveError> {
    let start = Instant::now();
    let mut chart = Chart::new(drive, [*key, *second], range, options)?;
    let end = chart.trace(progress)?;
    chart.convergence.seconds = start.elapsed().as_secs_f64();
    Ok(LimitCurve {
        key: *key,
        second: *second,
        drive: drive.clone(),
        points: chart.points,
        cusps: chart.cusps,
        end,
        convergence: chart.convergence,
    })
}
