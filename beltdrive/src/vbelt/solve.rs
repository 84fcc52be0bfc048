//! A V-belt drive in, a steady state or the reason why there is none out.

use super::by_branch::by_branch;
use super::found::{carried, checked, find};
use super::limit::Found;
use super::path::{Path, Stuck};
use crate::{Drive, SolveError, SolveOptions, SteadyState};
use std::mem::discriminant;
use web_time::Instant;

/// The steady state of a V-belt drive, from nothing but the drive.
pub(crate) fn solve(drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let (path, found) = find(drive, options.tolerance);
    let is_certain = match &found {
        Ok(Found::State(_)) => true,
        Ok(Found::Beyond(limit)) => limit.is_on_branch(path.target()),
        Err(_) => false,
    };
    let along = || by_branch(drive, options.tolerance, start);
    if !is_certain && let Some(answer) = along() {
        return answer;
    }
    match conclude(&path, found, start) {
        Err(SolveError::Violated(violated)) if is_certain => {
            along().unwrap_or(Err(SolveError::Violated(violated)))
        }
        answer => answer,
    }
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
    let mut path = Path::new(drive, tolerance);
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
