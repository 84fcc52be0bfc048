//! Steady states of every kind of drive: a drive in, a state or the reason why there is none out.

use crate::difficulty;
use crate::report::six_digits;
use crate::{BeltKind, Check, Drive, Impossible, LimitReason, SpanTension, SteadyState};
use crate::{flat, vbelt};
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

/// Finds the steady state of a drive, from nothing but the drive.
///
/// Every state returned satisfies its differential equations and conditions to the tolerance and
/// has passed the checks listed in [`SteadyState::checks`].
///
/// # Errors
/// [`SolveError::NoSteadyState`], [`SolveError::GrossSlip`] and [`SolveError::LiftsOff`] where the
/// drive does not carry the load, [`SolveError::NotConverged`] where that could not be decided,
/// [`SolveError::Violated`] if an invariant fails, [`SolveError::Tolerance`],
/// [`SolveError::NotModelled`].
pub fn solve(drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
    check(drive, options)?;
    match drive.belt.kind {
        BeltKind::V(_) => vbelt::solve(drive, options),
        BeltKind::Flat { .. } => flat::solve(drive, options),
    }
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
    match drive.belt.kind {
        BeltKind::V(_) => vbelt::solve_from(neighbour, drive, options),
        BeltKind::Flat { .. } => flat::solve(drive, options),
    }
}

/// Whether the options are in range and there is a model of the drive.
pub(crate) fn check(drive: &Drive, options: &SolveOptions) -> Result<(), SolveError> {
    let tolerance = options.tolerance;
    if !(1e-12..=1e-2).contains(&tolerance) {
        return Err(SolveError::Tolerance { tolerance });
    }
    let by_torque = |span| matches!(span, SpanTension::DrivenTorque(_));
    let torques = [drive.load.slack, drive.load.tight].map(by_torque);
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
