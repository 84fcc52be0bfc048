//! The steady state of a drive as it is best told: as two pulleys, or as a loop.

use super::{drive, solve_with_margins};
use crate::belt_loop::LoopState;
use crate::quantity::two_pulleys::as_drive;
use crate::{Drive, SolveError, SolveOptions, SteadyState};

/// The steady state of any drive.
#[derive(Clone, Debug)]
pub enum Solved {
    /// Of a drive with two pulleys.
    Drive {
        /// Its state.
        state: Box<SteadyState>,
        /// The loop as which it was solved, with its state: where it is not closed by the tensions of both spans.
        as_loop: Option<Box<(Drive, LoopState)>>,
    },
    /// Of any other drive.
    Loop {
        /// The drive.
        drive: Box<Drive>,
        /// Its state, with margins.
        state: Box<LoopState>,
    },
}

/// The steady state of a drive with any number of pulleys and any closure. One with two pulleys, of which the second
/// takes power, is told as such.
///
/// # Errors
/// Those of [`solve`](crate::solve) and of [`belt_loop::solve`](crate::belt_loop::solve).
pub fn solve_any(drive: &Drive, options: &SolveOptions) -> Result<Solved, SolveError> {
    if drive.two_pulleys().is_some() {
        return Ok(Solved::Drive {
            state: Box::new(drive::solve(drive, options)?),
            as_loop: None,
        });
    }
    let state = solve_with_margins(drive, options)?;
    let drive = drive.clone();
    Ok(match as_drive(&drive, &state) {
        Some(two_pulleys) => Solved::Drive {
            state: Box::new(drive::solve(&two_pulleys, options)?),
            as_loop: Some(Box::new((drive, state))),
        },
        None => Solved::Loop {
            drive: Box::new(drive),
            state: Box::new(state),
        },
    })
}
