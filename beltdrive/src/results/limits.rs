//! Both ends of the range of a parameter over which a drive has steady states.

use super::v_warnings;
use crate::input::Key;
use crate::{BeltKind, Branch, Drive, Role, StateErrors, StateSummary, Warning};
use std::f64::consts::FRAC_PI_2;
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

impl Limit {
    /// Remarks on the validity of the state at this end of the range of `drive` over `key`.
    pub fn warnings(&self, drive: &Drive, key: &Key) -> Vec<Warning> {
        let mut drive = drive.clone();
        key.set(&mut drive, self.value);
        match drive.belt.kind {
            BeltKind::V(_) => v_warnings::beyond_model(&drive, &self.state),
            BeltKind::Flat { .. } => Vec::new(),
        }
    }
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

/// What ends the load range of a drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LimitReason {
    /// The driven pulley slips grossly: its speed has fallen to zero.
    DrivenSlips,
    /// The driver slips grossly: a limit point at small inclination.
    DriverSlips,
    /// Friction is exhausted over the whole arc of contact of the pulley of a flat belt: the ratio of
    /// the tensions has reached its capstan limit.
    Capstan(Role),
    /// The belt is too slack for its speed and lifts off the pulleys (flat belts).
    LiftsOff,
    /// The belt overhangs at the exit of the driver: a limit point beyond 90° of inclination.
    Overhang,
}

/// A driven pulley that has kept less than this share of its speed all but stands. With scalar elastic friction of one random drive
/// states are found down to 3e-5, and none at zero; the load at which it would stand is less than 1e-8 of it farther on.
pub(crate) const STANDS: f64 = 1e-3;

impl LimitReason {
    /// What a limit point means, from the inclination where the belt leaves the driver, rad, and the share of its speed that
    /// the driven pulley has kept.
    pub(crate) fn of_limit_point(exit_inclination: f64, driven_share: f64) -> Self {
        if exit_inclination > FRAC_PI_2 {
            Self::Overhang
        } else if driven_share < STANDS {
            Self::DrivenSlips
        } else {
            Self::DriverSlips
        }
    }
}

impl fmt::Display for LimitReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::DrivenSlips => "the driven pulley slips grossly and stops",
            Self::DriverSlips => "the driver slips grossly",
            Self::Capstan(Role::Driven) => "the belt slips grossly on the driven pulley",
            Self::Capstan(Role::Driver) => "the belt slips grossly on the driver",
            Self::LiftsOff => "the belt is too slack for its speed and lifts off the pulleys",
            Self::Overhang => "the belt overhangs at the exit of the driver",
        })
    }
}
