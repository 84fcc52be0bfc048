//! Why a step was not possible.

use crate::number::Number;

/// Why a system could not be linearised or adapted, in its own words.
pub type Cause = Box<dyn std::error::Error + Send + Sync>;

/// Why a step from one point of a branch to the next was not possible.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Difficulty {
    /// The residual is not finite.
    #[error("the residual is not finite: equation {equation} at lambda = {}", Number(*.lambda))]
    NotFinite {
        /// Index of the equation.
        equation: usize,
        /// λ there.
        lambda: f64,
    },
    /// The system could not be linearised.
    #[error("the system cannot be linearised: {0}")]
    Linearisation(#[source] Cause),
    /// The system could not adapt its discretisation to the point.
    #[error("the discretisation cannot be adapted: {0}")]
    Adaptation(#[source] Cause),
    /// The point lies elsewhere in a better discretisation: perhaps on another branch.
    #[error("a better discretisation moves the point by {distance:.1e}, limit {limit:.1e}")]
    Shift {
        /// How far, in the arclength norm.
        distance: f64,
        /// The farthest accepted.
        limit: f64,
    },
    /// The null vector or the particular solution is not finite.
    #[error("the linearised system is singular")]
    Singular,
    /// Newton's method did not converge.
    #[error("newton: correction {correction:.1e} after {steps} steps, {}", wanted(*.limit))]
    NoConvergence {
        /// Length of the last correction.
        correction: f64,
        /// Number of corrections.
        steps: usize,
        /// Length wanted; 0 for rounding.
        limit: f64,
    },
    /// Newton's method left the bounds of λ.
    #[error("newton: lambda = {} is outside the bounds", Number(*.lambda))]
    OutOfBounds {
        /// λ there.
        lambda: f64,
    },
    /// The tangent turns too much: another branch, or a kink.
    #[error("the tangent turns by {angle:.2} rad in one step, limit {limit:.2}")]
    Turn {
        /// Angle between the tangents, rad.
        angle: f64,
        /// Largest angle accepted, rad.
        limit: f64,
    },
    /// Nearby there may be another sheet of solutions, to which the step has led.
    #[error(
        "the point and its tangent tell of different places, between which the equations change otherwise than linearly by {change:.2}, limit {limit:.2}"
    )]
    Departure {
        /// The largest change that is not linear, relative to the linear one.
        change: f64,
        /// The largest accepted.
        limit: f64,
    },
    /// A special point persists neither exactly nor nearby: the bifurcation is imperfect.
    #[error("the branches miss each other by {gap:.1e}")]
    Imperfect {
        /// Distance of the branches in the arclength norm.
        gap: f64,
    },
}

/// The length of a correction that was wanted.
fn wanted(limit: f64) -> String {
    match limit > 0.0 {
        true => format!("limit {limit:.1e}"),
        false => "limit: rounding".to_owned(),
    }
}
