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

/// How far the driven speeds of one state that is found twice may be apart, relative, or ten times the tolerance: that of
/// `v-power` at 11 000 rpm, where two tensions belong to two states, differs by 1e-3 and more.
const SAME: f64 = 1e-4;

/// The steady state of a drive with any number of pulleys and any closure. One with two pulleys, of which the second
/// takes power, is told as such, unless its tensions belong to another state, too, and that is found in its place, or none.
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
    let as_two = as_drive(drive, &state)
        .and_then(|two| drive::solve(&two, options).ok())
        .filter(|two| is_same(two, drive, &state, options));
    let drive = drive.clone();
    Ok(match as_two {
        Some(two) => Solved::Drive {
            state: Box::new(two),
            as_loop: Some(Box::new((drive, state))),
        },
        None => Solved::Loop {
            drive: Box::new(drive),
            state: Box::new(state),
        },
    })
}

/// Whether two pulleys turn as those of a loop do.
fn is_same(two: &SteadyState, drive: &Drive, state: &LoopState, options: &SolveOptions) -> bool {
    let driven = &state.pulleys[1 - drive.driver()];
    let off = (two.driven.angular_speed / driven.angular_speed - 1.0).abs();
    off <= SAME.max(10.0 * options.tolerance)
}
