//! The limit of one parameter as a curve over a second one.

use crate::input::Key;
use crate::{
    BeltKind, BranchEnd, Drive, LimitReason, SolveError, SolveOptions, StateSummary,
    TraceConvergence, flat, solve, vbelt,
};

/// How far a drive can be loaded, over a second entry of the drive file.
#[derive(Clone, Debug)]
pub struct LimitCurve {
    /// The parameter that has a limit.
    pub key: Key,
    /// The parameter over which the limit is followed.
    pub second: Key,
    /// The drive, of which both entries vary.
    pub drive: Drive,
    /// The limits, in the order in which they were followed.
    pub points: Vec<LimitCurvePoint>,
    /// The cusps, at which two limit points meet and vanish.
    pub cusps: Vec<LimitCurvePoint>,
    /// Why the curve ends.
    pub end: BranchEnd,
    /// How the curve was traced.
    pub convergence: TraceConvergence,
}

/// A limit.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitCurvePoint {
    /// The value of the second parameter, SI.
    pub second: f64,
    /// The limit, SI.
    pub value: f64,
    /// Its estimated absolute error, SI.
    pub value_error: Option<f64>,
    /// Why it is a limit.
    pub reason: LimitReason,
    /// The state there.
    pub state: StateSummary,
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
    solve::check(drive, options)?;
    match drive.belt.kind {
        BeltKind::V(_) => vbelt::limit_curve(drive, key, second, range, options, progress),
        BeltKind::Flat { .. } => flat::limit_curve(drive, key, second, range, options),
    }
}
