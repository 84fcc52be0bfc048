//! What is asked of a drive with two pulleys.

use crate::input::Key;
use crate::model::model;
use crate::{
    BeltKind, Branch, Drive, LimitCurve, Limits, SolveError, SolveOptions, SpanTension, Stability,
    StateSummary, SteadyState,
};

/// Finds the steady state of a drive, from nothing but the drive.
///
/// Every state returned satisfies its differential equations and conditions to the tolerance and
/// has passed the checks listed in [`SteadyState::checks`].
///
/// # Errors
/// [`SolveError::NoSteadyState`] and [`SolveError::TooSlack`] where the
/// drive does not carry the load, [`SolveError::NotConverged`] where that could not be decided,
/// [`SolveError::Violated`] if an invariant fails, [`SolveError::Tolerance`],
/// [`SolveError::NotModelled`].
pub fn solve(drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
    check(drive, options)?;
    model(drive.belt.kind).solve(drive, options)
}

/// Finds the steady state of a drive that differs little from one that is solved, much faster than
/// [`solve`]; where the difference turns out too great, or the friction law or the kind of belt is
/// another one, from nothing.
///
/// # Errors
/// As [`solve`].
pub fn solve_from(
    neighbour: &SteadyState,
    drive: &Drive,
    options: &SolveOptions,
) -> Result<SteadyState, SolveError> {
    check(drive, options)?;
    model(drive.belt.kind).solve_from(neighbour, drive, options)
}

/// As [`solve_from`], or as [`solve`] without a neighbour, the scalars of the state alone, and the state from which the
/// next one is sought, where that helps: a quarter of the work on flat belts, whose profiles are then not examined.
pub(crate) fn summary(
    neighbour: Option<&SteadyState>,
    drive: &Drive,
    options: &SolveOptions,
) -> Result<(StateSummary, Option<SteadyState>), SolveError> {
    check(drive, options)?;
    model(drive.belt.kind).summary(neighbour, drive, options)
}

/// Traces the branch of steady states of a drive over one entry of the drive file, from the value
/// `range[0]` to `range[1]` (SI), around limit points where there are any.
///
/// The branch ends where it reaches the end of the range, where it has come back by a quarter of
/// its way behind a limit point, or where the driven pulley stands still: beyond that no state is a drive
/// state. What happens on the way — limit points, an inclination of 90°, friction zones that vanish —
/// is located and carries an error estimate. `progress` is called with the share of the range that is
/// done and what is being done.
///
/// # Errors
/// Those of [`solve`](crate::solve) at the beginning of the range. A branch that cannot be followed
/// to its end is no error; its end says so.
///
/// # Panics
/// If the entry is none of this drive.
pub fn trace(
    drive: &Drive,
    key: &Key,
    range: [f64; 2],
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<Branch, SolveError> {
    check(drive, options)?;
    model(drive.belt.kind).trace(drive, key, range, options, progress)
}

/// Finds the smallest and the largest value of an entry, such as [`Key::load`], that the
/// drive carries, why the range ends there, and the branch between.
///
/// # Errors
/// Those of [`solve`](crate::solve), if no state is found from which to search.
///
/// # Panics
/// If the entry is none of this drive.
pub fn limits(
    drive: &Drive,
    key: &Key,
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<Limits, SolveError> {
    check(drive, options)?;
    model(drive.belt.kind).limits(drive, key, options, progress)
}

/// Finds the largest value of the entry `key` that a drive carries, and why, over the values of the
/// entry `second` from `range[0]` to `range[1]` (SI): the load limit against the coefficient of
/// friction, for instance.
///
/// At five values of `second` the limit is located on the branch of its own drive, which is followed
/// from a small load, so that it is known to be the first limit on the way. In between the limit is
/// followed by continuation: limit points as a curve of limit points, gross slip of the driven pulley
/// as states at which its speed is zero. A followed limit is accepted where it arrives at the next
/// limit located. Where the kind of limit changes, gross slip is followed until it ends, either in a
/// jump to the limit point behind it, or where the driven pulley stops just at the limit point; both
/// places are found exactly and have two points of the curve, one of each kind. Where a limit cannot
/// be followed, or the way does not arrive where it should, further limits are located, down to every
/// value of the chart and around a change of the kind of limit by bisection.
///
/// The error estimate of a followed limit is the largest relative error of the state, times its value.
///
/// # Errors
/// Those of [`solve`](crate::solve) at the beginning of the range.
///
/// # Panics
/// If an entry is none of this drive.
pub fn limit_curve(
    drive: &Drive,
    key: &Key,
    second: &Key,
    range: [f64; 2],
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<LimitCurve, SolveError> {
    check(drive, options)?;
    model(drive.belt.kind).limit_curve(drive, key, second, range, options, progress)
}

/// Finds the lowest `modes` of the axial motion on each pulley of a flat-belt drive, whether they
/// grow, and from which load on, in each [`LinearisedForm`](crate::LinearisedForm) of the linearised problem. The zones of the steady
/// state are held.
///
/// Every eigenvalue is found twice, by spectral elements and by Newton's method on the exact
/// characteristic function, and all are counted by the argument principle. `progress` is called with
/// the share of the work that is done and what is being done.
///
/// # Errors
/// Those of [`solve`](crate::solve); [`SolveError::NotModelled`] for V-belts, for creep-rate friction,
/// and where the belt sticks again behind a slip zone; [`SolveError::Stability`] where the methods
/// disagree.
pub fn stability(
    drive: &Drive,
    modes: usize,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<Stability, SolveError> {
    check(drive, &SolveOptions::default())?;
    model(drive.belt.kind).stability(drive, modes, progress)
}

/// Whether the options are in range and there is a model of the drive.
pub(crate) fn check(drive: &Drive, options: &SolveOptions) -> Result<(), SolveError> {
    let tolerance = options.tolerance;
    if !(1e-12..=1e-2).contains(&tolerance) {
        return Err(SolveError::Tolerance { tolerance });
    }
    let Some(two) = drive.two_pulleys() else {
        return Err(SolveError::NotModelled(
            "this needs an open belt round two pulleys, closed by the tensions of both spans; \
             belt_loop::solve, trace and limits take every drive"
                .into(),
        ));
    };
    let by_torque = |span| matches!(span, SpanTension::DrivenTorque(_));
    let torques = [two.load.slack, two.load.tight].map(by_torque);
    if let Some(reason) = drive.law.row().unsuited(drive.belt.kind) {
        return Err(SolveError::NotModelled(reason.into()));
    }
    let missing = match drive.belt.kind {
        BeltKind::V(_) if torques != [false; 2] => {
            "the load of a V-belt drive is given by both span tensions, not by a torque"
        }
        BeltKind::Flat { .. } if torques == [true; 2] => {
            "one span needs a tension: both cannot follow from the driven torque"
        }
        _ => return Ok(()),
    };
    Err(SolveError::NotModelled(missing.into()))
}
