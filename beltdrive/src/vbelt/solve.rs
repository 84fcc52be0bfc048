//! A V-belt drive in, a steady state or the reason why there is none out.

use super::by_branch::by_branch;
use super::found::{carried, checked};
use super::limit::{Found, may_be_another};
use super::path::{Path, Stuck};
use crate::{Drive, SolveError, SolveOptions, SteadyState};
use std::mem::discriminant;
use web_time::Instant;

/// The steady state of a V-belt drive, from nothing but the drive: at its own load if it is found there, else along the
/// branch that leads there or to the limit of the load. Where there is no such branch, from states near the load.
pub(crate) fn solve(drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let tolerance = options.tolerance;
    let mut path = Path::new(drive, tolerance).for_error();
    let direct = match path.at_load(path.target()) {
        Ok(solved) if solved.driven_speed() > 0.0 && path.is_before_limit(&solved) => {
            let is_sure = !may_be_another(&solved) || path.is_reached(&solved);
            match checked(&path, solved, start) {
                fault @ Err(SolveError::Violated(_) | SolveError::Impossible(_)) => Some(fault),
                answer if is_sure => return answer,
                answer => Some(answer),
            }
        }
        _ => None,
    };
    // Beside the ends of contacts the pressure, which may not be negative, may need a small defect.
    path.for_error = false;
    if let Some(answer) = by_branch(&mut path, start).or(direct) {
        return answer;
    }
    let found = path.find(path.target());
    conclude(&path, found, start)
}

/// The steady state of a V-belt drive that differs little from one that is solved.
pub(crate) fn solve_from(
    neighbour: &SteadyState,
    drive: &Drive,
    options: &SolveOptions,
) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let tolerance = options.tolerance;
    let law = |drive: &Drive| discriminant(&drive.law);
    let Some(solved) = neighbour.restart.as_deref() else {
        return solve(drive, options);
    };
    if law(drive) != law(&neighbour.drive) || tolerance < neighbour.convergence.tolerance {
        return solve(drive, options);
    }
    let mut path = Path::new(drive, tolerance).for_error();
    path.smoothing_effect = neighbour.convergence.slip_normalisation_effect;
    match path.neighbour(solved) {
        Ok(solved) => {
            let found = path.classify(solved);
            match conclude(&path, found, start) {
                Err(SolveError::Violated(_) | SolveError::Impossible(_)) => solve(drive, options),
                answer => answer,
            }
        }
        Err(_) => solve(drive, options),
    }
}

/// The answer: a state that has passed its checks, or the reason why there is none.
fn conclude(
    path: &Path<'_>,
    found: Result<Found, Stuck>,
    start: Instant,
) -> Result<SteadyState, SolveError> {
    checked(path, carried(path, found)?, start)
}
