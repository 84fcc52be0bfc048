//! The public face: a drive in, a steady state or the reason why there is none out.

use super::path::{Path, Stuck};
use super::state::steady_state;
use crate::{Check, Drive, SteadyState};
use std::time::Instant;

/// How a steady state is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolveOptions {
    /// Relative tolerance of profiles and constants, 1e-12 to 1e-2.
    pub tolerance: f64,
}

impl Default for SolveOptions {
    fn default() -> Self {
        Self { tolerance: 1e-6 }
    }
}

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The way to the steady state was not found.
    #[error("not converged: {cause}")]
    NotConverged {
        /// Why the last problem on the way was not solved.
        cause: bvp::Error,
    },
    /// A state was found that violates an invariant.
    #[error("the state found violates the {}: relative deviation {:.1e}, limit {:.1e}", .0.name, .0.deviation, .0.limit)]
    Violated(Check),
}

/// Finds the steady state of a drive, from nothing but the drive.
///
/// # Errors
/// [`SolveError`].
pub fn solve(drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let mut path = Path::new(drive, options.tolerance);
    let target = drive.load.tight.value() / path.scales.force;
    let solved = path
        .at_load(target)
        .map_err(|Stuck { cause, .. }| SolveError::NotConverged { cause })?;
    let state = steady_state(&path, &solved, start.elapsed().as_secs_f64());
    match state
        .checks
        .iter()
        .find(|check| !(check.deviation <= check.limit))
    {
        Some(check) => Err(SolveError::Violated(check.clone())),
        None => Ok(state),
    }
}
