//! Traces of V-belt drives: a drive and a range of one entry in, a branch out.

use super::found::{carried, find};
use super::state::describe;
use super::tracer::{Tracer, Until};
use crate::input::Key;
use crate::{Branch, Drive, SolveError, SolveOptions};
use continuation::Direction;
use web_time::Instant;

/// The branch of steady states of a V-belt drive over one entry of the drive file.
pub(crate) fn trace(
    drive: &Drive,
    key: &Key,
    range: [f64; 2],
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<Branch, SolveError> {
    let start = Instant::now();
    let tolerance = options.tolerance;
    let [from, to] = range;
    let ascending = [from.min(to), from.max(to)];
    let mut tracer = Tracer::new(drive, *key, ascending, tolerance, Until::RangeEnds);
    progress(0.0, "solving the first state");
    let first = tracer.drive_at(from);
    let (path, found) = find(&first, tolerance);
    let solved = carried(&path, found)?;
    describe(&path, &solved).verified()?;
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
