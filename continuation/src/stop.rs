//! Why a branch ends.

use crate::difficulty::Difficulty;
use crate::number::Number;

/// Why a branch ends. None of these is a fault of the caller; the last point yielded is good.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Stop {
    /// λ has reached a bound; the last point lies on it.
    #[error("lambda has reached its bound {}", Number(*.lambda))]
    Bound {
        /// The bound.
        lambda: f64,
    },
    /// The branch approaches a bound of λ without reaching it: at the accuracy of the points λ can no
    /// longer be told from the bound, and other unknowns keep growing.
    #[error("the branch approaches lambda = {} without reaching it", Number(*.lambda))]
    Asymptote {
        /// The bound.
        lambda: f64,
    },
    /// The branch is a closed curve; the last point is the first one.
    #[error("the branch is closed")]
    Closed,
    /// The number of steps asked for has been taken.
    #[error("{steps} steps taken")]
    Steps {
        /// Number of steps.
        steps: usize,
    },
    /// The step has become too short.
    #[error("step {step:.1e} below the smallest: {difficulty}")]
    StepTooSmall {
        /// The step, in the arclength norm.
        step: f64,
        /// Why no longer step was possible.
        #[source]
        difficulty: Difficulty,
    },
    /// The discretisation error of a labelled point stays above the tolerance of the system. The
    /// point was yielded with its error.
    #[error("discretisation error {error:.1e} of a labelled point, tolerance {tolerance:.1e}")]
    Inaccurate {
        /// Estimated relative error.
        error: f64,
        /// Tolerance of the system.
        tolerance: f64,
    },
}
