//! Why there is no branch.

use crate::difficulty::Difficulty;
use crate::number::Number;
use crate::point::Point;
use crate::stop::Stop;

/// Why there is no branch.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The bounds of λ are no interval.
    #[error("bounds of lambda: {} to {} is no interval", Number(*.low), Number(*.high))]
    Bounds {
        /// Lower bound.
        low: f64,
        /// Upper bound.
        high: f64,
    },
    /// A setting is out of range.
    #[error("option {name}: {} is out of range", Number(*.value))]
    Setting {
        /// The setting.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// The weights do not fit the system.
    #[error("weights: {given} given for {unknowns} unknowns")]
    WeightCount {
        /// Number of weights.
        given: usize,
        /// Number of unknowns.
        unknowns: usize,
    },
    /// The start has the wrong number of values.
    #[error("start: {given} values given for {unknowns} unknowns")]
    StartCount {
        /// Number of values.
        given: usize,
        /// Number of unknowns.
        unknowns: usize,
    },
    /// λ at the start is not within the bounds.
    #[error("start: lambda = {} is outside the bounds {} to {}", Number(*.lambda), Number(*.low), Number(*.high))]
    StartOutside {
        /// λ at the start.
        lambda: f64,
        /// Lower bound.
        low: f64,
        /// Upper bound.
        high: f64,
    },
    /// No point of the branch was found at the start.
    #[error("start: no point of the branch found near it: {0}")]
    Start(#[source] Difficulty),
    /// More than one direction leads on from the start: it is a branch point, or the equations are
    /// degenerate there. The units of the equations do not matter to this. Those of the unknowns do where
    /// all of these are zero and stay so, on a trivial branch: nothing tells their sizes then, and units in
    /// which these differ by more than about 1e10 look degenerate.
    #[error("start: the jacobian has more than one null vector there")]
    SingularStart,
    /// The point has no second branch to switch to.
    #[error("the point is no branch point with a second branch")]
    NoSecondBranch,
    /// No point was found on the second branch.
    #[error("no point found on the second branch down to a step of {step:.1e}")]
    Switch {
        /// Length of the shortest step tried.
        step: f64,
    },
    /// The point is none of a limit point or branch point curve.
    #[error("no {kind} near the given point: {difficulty}")]
    NotSpecial {
        /// What was expected.
        kind: &'static str,
        /// What happened instead.
        #[source]
        difficulty: Difficulty,
    },
    /// A homotopy ended before its goal.
    #[error("homotopy: reached lambda = {}, goal {}; {stop}", Number(*.lambda), Number(*.goal))]
    Homotopy {
        /// λ of the last point.
        lambda: f64,
        /// λ wanted.
        goal: f64,
        /// Why it ended there.
        stop: Stop,
        /// The last point.
        last: Box<Point>,
    },
    /// Deflated Newton iteration found no further solution.
    #[error(
        "deflation: no further solution found: correction {correction:.1e} after {steps} steps"
    )]
    Deflation {
        /// Length of the last correction.
        correction: f64,
        /// Number of steps.
        steps: usize,
    },
}

/// A vector of unknowns must have the length that the system says.
pub(crate) fn check_length(z: &[f64], unknowns: usize) -> Result<(), Error> {
    match z.len() {
        given if given == unknowns => Ok(()),
        given => Err(Error::StartCount { given, unknowns }),
    }
}
