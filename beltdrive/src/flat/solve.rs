//! A flat-belt drive in, a steady state or the reason why there is none out.

use super::closed_form::{ClosedForm, Refusal};
use super::limits::largest_load;
use super::state::{self, steady_state};
use crate::input::Key;
use crate::{Drive, SolveError, SolveOptions, StateSummary, SteadyState};
use web_time::Instant;

/// The steady state of a flat-belt drive.
pub(crate) fn solve(drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let solved = ClosedForm::find(&drive.pair()).map_err(|refusal| refused(drive, refusal))?;
    let mut state = steady_state(drive, &solved, start);
    state.convergence.tolerance = options.tolerance;
    state.verified().map(|()| state)
}

/// The scalars of the steady state of a flat-belt drive.
pub(super) fn summary(drive: &Drive, options: &SolveOptions) -> Result<StateSummary, SolveError> {
    let solved = ClosedForm::find(&drive.pair()).map_err(|refusal| refused(drive, refusal))?;
    match state::summary(drive, &solved) {
        Some(found) => Ok(found),
        // The whole state says what is wrong.
        None => Ok(StateSummary::from(&solve(drive, options)?)),
    }
}

/// The reason in engineering words, with the largest load.
pub(super) fn refused(drive: &Drive, refusal: Refusal) -> SolveError {
    match refusal {
        Refusal::LiftsOff {
            tension,
            speed,
            centrifugal,
        } => SolveError::TooSlack {
            tension,
            speed,
            centrifugal,
        },
        Refusal::Backwards {
            tension: [slack, tight],
        } => SolveError::Backwards { slack, tight },
        Refusal::Slips(reason) => {
            let key = Key::load(drive);
            let asked = key.get(drive);
            let limit = largest_load(drive, &key);
            SolveError::NoSteadyState {
                quantity: key.name(),
                unit: key.unit(),
                asked,
                limit: limit.map_or(f64::NAN, |limit| limit.value),
                reason: limit.map_or(reason, |limit| limit.reason),
                driven_speed: None,
                exit_inclination: None,
            }
        }
    }
}
