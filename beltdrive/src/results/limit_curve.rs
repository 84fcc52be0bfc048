//! The limit of one parameter as a curve over a second one.

use crate::input::Key;
use crate::{BranchEnd, Drive, LimitReason, StateSummary, TraceConvergence};

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
