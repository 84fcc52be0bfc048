//! What a user must know of a state of a drive with two pulleys and a V-belt that is none for practice.

use super::warning::{Warning, beyond_model as beyond, overhangs};
use crate::{Drive, Role, StateSummary, SteadyState};

/// The remarks on a state.
pub(crate) fn warnings(state: &SteadyState) -> Vec<Warning> {
    let pulleys = [
        (Role::Driven, &state.driven.profile),
        (Role::Driver, &state.driver.profile),
    ];
    let overhangs = overhangs(pulleys.into_iter());
    let beyond = beyond_model(&state.drive, &StateSummary::from(state));
    overhangs.chain(beyond).collect()
}

/// Remarks on a state that the model is not for, of which the scalars tell: a belt below its groove, or
/// stretched too far.
pub(crate) fn beyond_model(drive: &Drive, state: &StateSummary) -> Vec<Warning> {
    let pulleys = [
        (Role::Driven, state.driven.max_penetration),
        (Role::Driver, state.driver.max_penetration),
    ];
    beyond(&drive.belt, state.tight_tension, pulleys.into_iter()).collect()
}
