//! How a steady state is sought, and why there is none.

use crate::quantity::precision::six_digits;
use crate::results::difficulty;
use crate::{Check, Impossible, LimitReason};
use std::borrow::Cow;

/// How a steady state is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolveOptions {
    /// Relative tolerance of profiles and constants, 1e-12 to 1e-2.
    pub tolerance: f64,
}

impl Default for SolveOptions {
    /// Relative tolerance 1e-6.
    fn default() -> Self {
        Self { tolerance: 1e-6 }
    }
}

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// No steady state carries the load.
    #[error(
        "no steady state: {quantity} {asked:.2} N exceeds the limit {limit:.2} N of this drive, \
         where {reason} (driven speed {driven_speed:.2} rad/s, inclination at the driver's exit \
         {:.1}°)", .exit_inclination.to_degrees()
    )]
    NoSteadyState {
        /// The prescribed quantity that is too large.
        quantity: &'static str,
        /// Its value, N.
        asked: f64,
        /// The largest value that the drive carries, N.
        limit: f64,
        /// What happens there.
        reason: LimitReason,
        /// Angular speed of the driven pulley there, rad/s.
        driven_speed: f64,
        /// Inclination of the belt where it leaves the driver there, rad.
        exit_inclination: f64,
    },
    /// A flat belt slips grossly: friction is exhausted over a whole arc of contact.
    #[error(
        "no steady state: {quantity} {} {unit} exceeds the limit {} {unit} of this drive, where \
         {reason}", six_digits(*.asked), six_digits(*.limit)
    )]
    GrossSlip {
        /// The prescribed quantity that is too large.
        quantity: &'static str,
        /// Its unit.
        unit: &'static str,
        /// Its value, SI.
        asked: f64,
        /// The largest value that the drive carries, SI.
        limit: f64,
        /// What happens there.
        reason: LimitReason,
    },
    /// A flat belt does not press on the pulleys: it is too slack for its speed.
    #[error(
        "no steady state: at {} m/s centrifugal force takes up G V = {} N, and the slack tension of \
         {} N leaves nothing to press the belt on the pulleys",
        six_digits(*.speed), six_digits(*.centrifugal), six_digits(*.tension)
    )]
    LiftsOff {
        /// Belt tension of the slack span, N.
        tension: f64,
        /// Belt speed V there, m/s.
        speed: f64,
        /// Momentum flow G V there, N.
        centrifugal: f64,
    },
    /// The tight tension is below the slack one, which is seen once the belt speed is known.
    #[error(
        "the tight tension {} N is below the slack tension {} N", six_digits(*.tight),
        six_digits(*.slack)
    )]
    Backwards {
        /// Belt tension of the slack span, N.
        slack: f64,
        /// Belt tension of the tight span, N.
        tight: f64,
    },
    /// The eigenvalues of the axial motion were not found beyond doubt.
    #[error("the axial modes were not found beyond doubt: {cause}")]
    Stability {
        /// Why.
        cause: String,
    },
    /// There is no model of such a drive.
    #[error("{0}")]
    NotModelled(Cow<'static, str>),
    /// The way to the steady state was not found.
    #[error("not converged: {}; {}", reached(*.tight), difficulty::of_solver(.cause))]
    NotConverged {
        /// Tight tension up to which the state was found, N.
        tight: Option<f64>,
        /// Why the next problem on the way was not solved.
        cause: Box<bvp::Error>,
    },
    /// The tolerance is out of range.
    #[error("tolerance {tolerance:e} is outside 1e-12 to 1e-2")]
    Tolerance {
        /// The tolerance asked for.
        tolerance: f64,
    },
    /// No limit was found on a branch.
    #[error("no limit was found up to {reached}; the branch was not followed further: {cause}")]
    NoLimit {
        /// Value of the entry up to which the branch was followed, SI.
        reached: f64,
        /// Why it was not followed further.
        cause: String,
    },
    /// The state found is that of no drive.
    #[error("no possible steady state was found: {0}")]
    Impossible(Impossible),
    /// A state was found that violates an invariant.
    #[error(
        "the state found violates an invariant, {}: relative deviation {:.1e}, limit {:.1e}",
        .0.name, .0.deviation, .0.limit
    )]
    Violated(Check),
}

fn reached(tight: Option<f64>) -> String {
    match tight {
        Some(tight) => format!(
            "a first approximation was found at a tight tension of {} N, but no accurate state",
            six_digits(tight)
        ),
        None => "no state was found on the way".to_owned(),
    }
}
