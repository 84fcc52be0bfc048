//! What is asked of the steady state of any drive as a loop of pulleys.

use super::drive::summary;
use crate::belt_loop::LoopState;
use crate::drive::check;
use crate::model::model;
use crate::{Drive, SolveError, SolveOptions};
use std::borrow::Cow;

/// The steady state of a drive, to the relative tolerance 1e-6 where it is a V-belt.
///
/// A loop with a flat belt is judged with Coulomb friction first: it slips grossly if it does with Coulomb
/// friction at the same closure, whatever its friction law. A drive that is closed by the tensions of both spans
/// is solved as such first ([`crate::solve`]), then as the loop with the torque and the slack tension found.
///
/// # Errors
/// Those of [`SolveError`]; of several reasons the first in the order given there.
pub fn solve(drive: &Drive) -> Result<LoopState, SolveError> {
    solve_to(drive, &SolveOptions::default())
}

/// The steady state of a drive to a tolerance. Flat belts are solved in closed form, to rounding: on
/// them the tolerance has no effect.
///
/// # Errors
/// As [`solve`], and [`SolveError::Tolerance`].
pub fn solve_to(drive: &Drive, options: &SolveOptions) -> Result<LoopState, SolveError> {
    let drive = closed_once(drive, options)?;
    model(drive.belt.kind).solve_loop(&drive, options)
}

/// As [`solve_to`], with what takes longer than the state of a V-belt: how far all torques can be raised at the
/// same closure, with the friction law of the loop, until no steady state carries more
/// ([`LoopState::load_limit`]); and how far that of each pulley can be raised at the tension of its slack side
/// ([`PulleyState::torque_margin`](crate::belt_loop::PulleyState::torque_margin)). Both are `None` without
/// torques, or if nothing that ends the range was found.
///
/// # Errors
/// As [`solve_to`].
pub fn solve_with_margins(drive: &Drive, options: &SolveOptions) -> Result<LoopState, SolveError> {
    let drive = closed_once(drive, options)?;
    model(drive.belt.kind).solve_with_margins(&drive, options)
}

/// The drive with a closure that leaves its torques to the statement, once that is in range.
pub(super) fn closed_once<'d>(
    drive: &'d Drive,
    options: &SolveOptions,
) -> Result<Cow<'d, Drive>, SolveError> {
    if drive.two_pulleys().is_some() {
        let (found, _) = summary(None, drive, options)?;
        let slack = found.slack_tractive_tension;
        return Ok(Cow::Owned(drive.as_loop(found.driven.torque, slack)));
    }
    let tolerance = options.tolerance;
    if !(1e-12..=1e-2).contains(&tolerance) {
        return Err(SolveError::Tolerance { tolerance });
    }
    check::check(drive)?;
    Ok(Cow::Borrowed(drive))
}
