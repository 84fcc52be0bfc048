//! The public face of traces: a drive and a range of one entry in, a branch out.

use super::solve::{carried, checked, find};
use super::tracer::{Tracer, Until};
use super::{SolveError, SolveOptions};
use crate::input::Key;
use crate::{Branch, Drive};
use continuation::Direction;
use std::time::Instant;

/// Traces the branch of steady states of a drive over one entry of the drive file, from the value
/// `range[0]` to `range[1]` (SI), around limit points where there are any.
///
/// The branch ends where it reaches the end of the range, where it has come back by a quarter of
/// its way behind a limit point, or where the driven pulley stands still: beyond that no state is a drive
/// state. What happens on the way — limit points, an inclination of 90°, friction zones that vanish —
/// is located and carries an error estimate. `progress` is called with the share of the range that is
/// done and what is being done.
///
/// # Errors
/// Those of [`solve`](crate::solve) at the beginning of the range. A branch that cannot be followed
/// to its end is no error; its end says so.
///
/// # Panics
/// If the entry is none of this drive.
pub fn trace(
    drive: &Drive,
    key: &Key,
    range: [f64; 2],
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<Branch, SolveError> {
    let start = Instant::now();
    let tolerance = checked(options)?;
    let [from, to] = range;
    let ascending = [from.min(to), from.max(to)];
    let mut tracer = Tracer::new(drive, *key, ascending, tolerance, Until::RangeEnds);
    progress(0.0, "solving the first state");
    let first = tracer.drive_at(from);
    let (path, found) = find(&first, tolerance);
    let solved = carried(&path, found)?;
    let direction = if to > from {
        Direction::Increasing
    } else {
        Direction::Decreasing
    };
    let end = tracer.run(solved, from, direction, progress);
    let mut convergence = tracer.convergence;
    convergence.count(&path.stats);
    convergence.seconds = start.elapsed().as_secs_f64();
    Ok(Branch {
        key: *key,
        drive: drive.clone(),
        points: tracer.points,
        events: tracer.events,
        end,
        convergence,
    })
}
