//! Traces of V-belt drives: a drive and a range of one entry in, a branch out.

use super::by_branch::by_branch;
use super::found::{carried, find, verified};
use super::path::Solved;
use super::tracer::{Tracer, Until};
use crate::input::Key;
use crate::{Branch, Drive, SolveError, SolveOptions};
use bvp::Stats;
use continuation::Direction;
use std::sync::Arc;
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
    let (solved, stats) = first_state(&first, tolerance)?;
    let direction = if to > from {
        Direction::Increasing
    } else {
        Direction::Decreasing
    };
    let end = tracer.run(solved, from, direction, progress);
    let mut convergence = tracer.convergence;
    convergence.count(&stats);
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

/// The state with which a branch begins, at its own load or, where it is not found there, at the end of the branch of the load
/// that leads there, and what it costs.
fn first_state(drive: &Drive, tolerance: f64) -> Result<(Solved, Stats), SolveError> {
    let start = Instant::now();
    let (mut path, found) = find(drive, tolerance);
    let direct = carried(&path, found).and_then(|solved| verified(&mut path, solved));
    let solved = match direct {
        Err(
            error @ (SolveError::NotConverged { .. }
            | SolveError::LiftsOff { .. }
            | SolveError::PressedThrough { .. }
            | SolveError::Violated(_)),
        ) => {
            let state = by_branch(&mut path, start, false).unwrap_or(Err(error.clone()))?;
            state.restart.map(Arc::unwrap_or_clone).ok_or(error)
        }
        direct => direct,
    };
    Ok((solved?, path.stats))
}
