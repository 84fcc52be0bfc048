//! What the search for a state has found, as an answer.

use super::limit::Found;
use super::path::{Path, Solved, Stuck};
use super::state::describe;
use crate::results::possible;
use crate::{Drive, Load, SolveError, SpanTension, SteadyState};
use std::mem::discriminant;
use std::sync::Arc;

/// Searches a state of a drive at its load from which a branch can be followed.
pub(super) fn find(drive: &Drive, tolerance: f64) -> (Path<'_>, Result<Found, Stuck>) {
    let mut path = Path::new(drive, tolerance);
    let found = path.find(path.target());
    (path, found)
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
