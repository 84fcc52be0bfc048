//! A V-belt drive in, a steady state or the reason why there is none out.

use super::limit::Found;
use super::path::{Path, Solved, Stuck};
use super::state::{describe, steady_state};
use crate::results::possible;
use crate::{Drive, Load, SolveError, SolveOptions, SpanTension, SteadyState};
use std::mem::discriminant;
use std::sync::Arc;
use web_time::Instant;

/// The steady state of a V-belt drive, from nothing but the drive.
pub(crate) fn solve(drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let (path, found) = find(drive, options.tolerance);
    conclude(path, found, start)
}

/// Searches a state of a drive at its load from which a branch can be followed.
pub(super) fn find(drive: &Drive, tolerance: f64) -> (Path<'_>, Result<Found, Stuck>) {
    let mut path = Path::new(drive, tolerance);
    let found = path.find(path.target());
    (path, found)
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
            match conclude(path, found, start) {
                Err(SolveError::Violated(_) | SolveError::Impossible(_)) => solve(drive, options),
                answer => answer,
            }
        }
        Err(_) => solve(drive, options),
    }
}

/// The answer: a state that has passed its checks, or the reason why there is none.
fn conclude(
    path: Path<'_>,
    found: Result<Found, Stuck>,
    start: Instant,
) -> Result<SteadyState, SolveError> {
    let solved = carried(&path, found)?;
    let state = steady_state(&path, solved, start);
    state.verified()?;
    forwards(path.drive, &state).map(|()| state)
}

/// Refuses a state in which the tight span is the slacker one. Where one tension is stated as tractive and
/// the other as belt tension this is seen only once the belt speed is known.
pub(super) fn forwards(drive: &Drive, state: &SteadyState) -> Result<(), SolveError> {
    match is_crossed(drive) && state.tight_tension < state.slack_tension {
        true => Err(SolveError::Backwards {
            slack: state.slack_tension,
            tight: state.tight_tension,
        }),
        false => Ok(()),
    }
}

/// Whether the tension of one span is stated as tractive and that of the other as belt tension.
pub(super) fn is_crossed(drive: &Drive) -> bool {
    let Load { slack, tight } = drive.pair().load;
    discriminant(&slack) != discriminant(&tight)
}

/// The state found, or the reason why the load is not carried or not reached.
pub(super) fn carried(path: &Path<'_>, found: Result<Found, Stuck>) -> Result<Solved, SolveError> {
    let (load, scales) = (path.drive.pair().load, path.scales());
    let found = found.map_err(|Stuck { last, cause }| SolveError::NotConverged {
        tight: last.map(|last| last.tight_tension() * scales.units.force),
        cause: Arc::new(cause),
    })?;
    match found {
        Found::State(solved) => Ok(*solved),
        Found::Beyond(limit) => {
            let state = &limit.state;
            if let Some(fault) = possible::fault(&describe(path, state)) {
                return Err(SolveError::Impossible(fault));
            }
            Err(SolveError::NoSteadyState {
                quantity: match load.tight {
                    SpanTension::Tractive(_) => "tight tractive tension",
                    _ => "tight tension",
                },
                unit: "N",
                asked: load.tight.value(),
                limit: state.tight_tension() * scales.units.force,
                reason: limit.reason,
                driven_speed: Some(
                    state.driven_speed() * scales.units.angular_speed(scales.radius[super::DRIVEN]),
                ),
                exit_inclination: Some(state.exit(super::DRIVER)[super::INCLINATION]),
            })
        }
    }
}
