//! Both ends of the range of a parameter over which a drive has steady states.

use crate::{Branch, LimitReason, StateErrors, StateSummary};
use std::fmt;

/// The smallest and the largest value of a parameter that a drive carries.
#[derive(Clone, Debug)]
pub struct Limits {
    /// The branch between the ends, in order from the smallest to the largest value.
    pub branch: Branch,
    /// The lower end.
    pub smallest: Limit,
    /// The upper end.
    pub largest: Limit,
}

/// One end of the range.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// The value of the parameter, SI.
    pub value: f64,
    /// Its estimated absolute error, SI.
    pub value_error: Option<f64>,
    /// Why the range ends.
    pub reason: RangeEnd,
    /// The state at the end.
    pub state: StateSummary,
    /// Estimated absolute errors of the state.
    pub errors: Option<StateErrors>,
}

/// Why the range of a parameter ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RangeEnd {
    /// No steady state lies beyond.
    Limit(LimitReason),
    /// Both spans have the same tension: the drive transmits no torque.
    NoLoad,
    /// The search ended at a value that the drive still carries.
    NotFound,
}

impl fmt::Display for RangeEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Limit(reason) => reason.fmt(f),
            Self::NoLoad => {
                f.write_str("both spans have the same tension: the drive transmits no torque")
            }
            Self::NotFound => f.write_str("no limit was found up to here"),
        }
    }
}
