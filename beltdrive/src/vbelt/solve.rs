//! The public face: a drive in, a steady state or the reason why there is none out.

use super::limit::{Found, LimitReason};
use super::path::{Path, Solved, Stuck};
use super::state::steady_state;
use crate::{Check, Drive, SpanTension, SteadyState};
use std::time::Instant;

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
    /// The way to the steady state was not found.
    #[error("not converged: {}; {cause}", reached(*.tight))]
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
    /// A state was found that violates an invariant.
    #[error(
        "the state found violates an invariant, {}: relative deviation {:.1e}, limit {:.1e}",
        .0.name, .0.deviation, .0.limit
    )]
    Violated(Check),
}

fn reached(tight: Option<f64>) -> String {
    match tight {
        Some(tight) => format!("the state was followed to a tight tension of {tight:.2} N"),
        None => "no state was found on the way".to_owned(),
    }
}

/// Finds the steady state of a drive, from nothing but the drive.
///
/// Every state returned satisfies its differential equations and conditions to the tolerance and
/// has passed the checks listed in [`SteadyState::checks`].
///
/// # Errors
/// [`SolveError::NoSteadyState`] where the load exceeds what the drive carries,
/// [`SolveError::NotConverged`] where that could not be decided, [`SolveError::Violated`] if an
/// invariant fails, [`SolveError::Tolerance`].
pub fn solve(drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let (path, found) = find(drive, checked(options)?);
    conclude(path, found, start)
}

/// Searches the state of a drive at its load.
pub(super) fn find(drive: &Drive, tolerance: f64) -> (Path<'_>, Result<Found, Stuck>) {
    let mut path = Path::new(drive, tolerance);
    let found = path.find(drive.load.tight.value() / path.scales.force);
    (path, found)
}

/// Finds the steady state of a drive that differs little from one that is solved, much faster than
/// [`solve`]; where the difference turns out too great, or the friction law is another one, from
/// nothing.
///
/// # Errors
/// As [`solve`].
pub fn solve_from(
    neighbour: &SteadyState,
    drive: &Drive,
    options: &SolveOptions,
) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let tolerance = checked(options)?;
    let law = |drive: &Drive| drive.law.name();
    let Some(solved) = neighbour.restart.as_deref() else {
        return solve(drive, options);
    };
    if law(drive) != law(&neighbour.drive) || tolerance < neighbour.convergence.tolerance {
        return solve(drive, options);
    }
    let mut path = Path::new(drive, tolerance);
    path.epsilon_effect = neighbour.convergence.slip_normalisation_effect;
    match path.neighbour(solved) {
        Ok(solved) => {
            let found = path.classify(solved);
            match conclude(path, found, start) {
                Err(SolveError::Violated(_)) => solve(drive, options),
                answer => answer,
            }
        }
        Err(_) => solve(drive, options),
    }
}

pub(super) fn checked(options: &SolveOptions) -> Result<f64, SolveError> {
    let tolerance = options.tolerance;
    if (1e-12..=1e-2).contains(&tolerance) {
        Ok(tolerance)
    } else {
        Err(SolveError::Tolerance { tolerance })
    }
}

/// The answer: a state that has passed its checks, or the reason why there is none.
fn conclude(
    path: Path<'_>,
    found: Result<Found, Stuck>,
    start: Instant,
) -> Result<SteadyState, SolveError> {
    let solved = carried(&path, found)?;
    let state = steady_state(&path, solved, start);
    match violated(&state) {
        Some(check) => Err(SolveError::Violated(check.clone())),
        None => Ok(state),
    }
}

/// The first invariant that a state violates.
pub(super) fn violated(state: &SteadyState) -> Option<&Check> {
    let violated = |check: &&Check| check.deviation.is_nan() || check.deviation > check.limit;
    state.checks.iter().find(violated)
}

/// The state found, or the reason why the load is not carried or not reached.
pub(super) fn carried(path: &Path<'_>, found: Result<Found, Stuck>) -> Result<Solved, SolveError> {
    let (drive, scales) = (path.drive, path.scales);
    let found = found.map_err(|Stuck { last, cause }| SolveError::NotConverged {
        tight: last.map(|last| last.tight_tension() * scales.force),
        cause: Box::new(cause),
    })?;
    match found {
        Found::State(solved) => Ok(*solved),
        Found::Beyond(limit) => {
            let state = &limit.state;
            Err(SolveError::NoSteadyState {
                quantity: match drive.load.tight {
                    SpanTension::Tractive(_) => "tight tractive tension",
                    SpanTension::Belt(_) => "tight tension",
                },
                asked: drive.load.tight.value(),
                limit: state.tight_tension() * scales.force,
                reason: limit.reason,
                driven_speed: state.driven_speed() * scales.angular_speed(super::DRIVEN),
                exit_inclination: state.exit(super::DRIVER)[super::INCLINATION],
            })
        }
    }
}
