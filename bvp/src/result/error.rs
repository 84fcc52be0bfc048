//! What can go wrong.

use crate::discretisation::scheme::Scheme;
use crate::problem::unknown::Unknown;
use crate::result::messages::{amplified, and_parameters, estimate, hint, of, undetermined};
use crate::result::solution::Solution;

/// Why a problem was not solved.
///
/// Statement errors (the first group) are found before any arithmetic. Numerical failures carry
/// the best iterate, which may serve as a guess for another attempt.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The number of conditions is not the number of unknown constants.
    #[error(
        "{conditions} conditions given, {unknowns} needed: {states} for the states and {parameters} for the parameters{}",
        hint(*.conditions, *.unknowns)
    )]
    ConditionCount {
        /// Conditions stated.
        conditions: usize,
        /// Conditions needed, states + parameters.
        unknowns: usize,
        /// States of all segments.
        states: usize,
        /// Parameters that the conditions must determine.
        parameters: usize,
    },
    /// The parameter of a [`Family`](crate::Family), or one that it holds, is not there or is named
    /// twice.
    #[error("parameter {parameter} of a family is not one of {parameters} or is named twice")]
    FamilyParameter {
        /// The index given.
        parameter: usize,
        /// Parameters of the problem.
        parameters: usize,
    },
    /// The parameter of an [`Embedding`](crate::Embedding) is not there, or one of its values is not
    /// finite.
    #[error("parameter {parameter} of {parameters} cannot be led from {from} to {to}")]
    Embedding {
        /// The index given.
        parameter: usize,
        /// Parameters of the problem.
        parameters: usize,
        /// The value to start from.
        from: f64,
        /// The value wanted.
        to: f64,
    },
    /// There are no segments.
    #[error("a problem needs at least one segment")]
    NoSegments,
    /// A segment has no states.
    #[error("segment {segment} has no states")]
    NoStates {
        /// Index of the segment.
        segment: usize,
    },
    /// The interval of a segment is empty or not finite.
    #[error("segment {segment} runs from {from} to {to}; its ends must differ and be finite")]
    Interval {
        /// Index of the segment.
        segment: usize,
        /// Its start.
        from: f64,
        /// Its end.
        to: f64,
    },
    /// A joined point lies outside its segment, at one of its ends, or not behind the one before.
    #[error(
        "joined point {point} of segment {segment}: the points must lie inside it, in order from {from} to {to}"
    )]
    Joined {
        /// Index of the segment.
        segment: usize,
        /// The point.
        point: f64,
        /// Start of the segment.
        from: f64,
        /// End of the segment.
        to: f64,
    },
    /// The mesh of the guess does not fit the segments.
    #[error(
        "the mesh of the guess for segment {segment} must run from {from} to {to} without turning back"
    )]
    GuessMesh {
        /// Index of the segment.
        segment: usize,
        /// Left end of the segment.
        from: f64,
        /// Right end of the segment.
        to: f64,
    },
    /// The guess has too few or too many numbers for the states of a segment.
    #[error("the guess has {found} numbers for the states of segment {segment}, {needed} needed")]
    GuessStates {
        /// Index of the segment.
        segment: usize,
        /// Numbers given, over all nodes if it has a table of them.
        found: usize,
        /// Numbers needed.
        needed: usize,
    },
    /// The guess has too few or too many parameters.
    #[error("the guess has {found} parameters, {needed} needed")]
    GuessParameters {
        /// Parameters given.
        found: usize,
        /// Parameters needed.
        needed: usize,
    },
    /// The guess is not finite.
    #[error("the guess is not finite in segment {segment} at s = {s}")]
    Guess {
        /// Index of the segment.
        segment: usize,
        /// The place s.
        s: f64,
    },
    /// A guessed parameter is not finite.
    #[error("the guess of parameter {parameter} is not finite")]
    GuessParameter {
        /// Index of the parameter.
        parameter: usize,
    },
    /// The first mesh is larger than the mesh limit.
    #[error("the first mesh has {intervals} intervals, {limit} allowed")]
    FirstMesh {
        /// Intervals to start on, over all segments.
        intervals: usize,
        /// Intervals allowed.
        limit: usize,
    },
    /// The tolerance is out of range.
    #[error("tolerance {tolerance:e} is outside 1e-13 to 1e-1")]
    Tolerance {
        /// The tolerance asked for.
        tolerance: f64,
    },
    /// The scheme is not provided with this number of stages.
    #[error("{scheme:?} is not provided: Gauss has 1 to 7 stages, Lobatto IIIA has 3 or 4")]
    Stages {
        /// The scheme asked for.
        scheme: Scheme,
    },
    /// A mesh without intervals was asked for.
    #[error("at least one initial interval per segment is needed")]
    NoIntervals,
    /// A number of [`Options::absolute`](crate::Options::absolute) is not a size.
    #[error(
        "number {position} of absolute is {value:e}, not positive, finite and at least 2.3e-308"
    )]
    Absolute {
        /// Its place, from zero.
        position: usize,
        /// Its value.
        value: f64,
    },
    /// [`Options::absolute`](crate::Options::absolute) has too few or too many numbers.
    #[error(
        "absolute has {found} numbers; needed is one for every state of all segments, {states}{}, or none at all",
        and_parameters(*.states, *.parameters)
    )]
    AbsoluteCount {
        /// Numbers given.
        found: usize,
        /// States of all segments.
        states: usize,
        /// Parameters of the problem.
        parameters: usize,
    },

    /// A right-hand side or its derivative is not finite at the iterate, and no shorter step
    /// avoids it.
    #[error(
        "right-hand side of component {component} is not finite in segment {segment} at s = {s}; write every component and keep the guess inside its domain"
    )]
    NonFiniteRhs {
        /// Index of the segment.
        segment: usize,
        /// The place s.
        s: f64,
        /// Index of the state whose derivative it is.
        component: usize,
        /// The iterate.
        best: Box<Solution>,
    },
    /// A condition is not finite (or was never written) at the iterate.
    #[error(
        "condition {condition} is not finite or was not written; keep the guess inside its domain"
    )]
    NonFiniteCondition {
        /// Index of the condition.
        condition: usize,
        /// The iterate.
        best: Box<Solution>,
    },
    /// The Newton matrix is singular inside a segment.
    #[error(
        "singular Newton matrix in segment {segment} at node {node}, s = {s}; start on other intervals"
    )]
    SingularNode {
        /// Index of the segment.
        segment: usize,
        /// Index of the mesh node.
        node: usize,
        /// Where it is.
        s: f64,
        /// The iterate.
        best: Box<Solution>,
    },
    /// The conditions do not determine the solution near the iterate.
    #[error(
        "singular Newton matrix: the conditions do not determine the solution locally{}",
        undetermined(.conditions, .free.as_ref(), *.shift)
    )]
    SingularConditions {
        /// Indices of the conditions that depend on each other, given the differential equations;
        /// none if that cannot be told.
        conditions: Vec<usize>,
        /// The unknown at the ends that is determined least, if that can be told.
        free: Option<Unknown>,
        /// Whether a shift of the whole solution in s gives another one, as where a periodic orbit has no
        /// phase condition.
        shift: bool,
        /// The iterate.
        best: Box<Solution>,
    },
    /// Newton's method did not converge.
    #[error(
        "newton: relative correction {correction:.1e}{} after {steps} steps, tolerance {tolerance:.1e}; try a better guess, or solve_embedded from an easier problem",
        of(.largest.as_ref())
    )]
    NoConvergence {
        /// Size of the last correction relative to 1 + |y|.
        correction: f64,
        /// The unknown with that correction, if it is known.
        largest: Option<Unknown>,
        /// Newton steps in all.
        steps: usize,
        /// Size asked for.
        tolerance: f64,
        /// The iterate.
        best: Box<Solution>,
    },
    /// The mesh limit is reached with too large an error.
    #[error(
        "mesh limit: {needed} intervals needed, {limit} allowed; defect {defect:.1e}, estimated error {}, tolerance {tolerance:.1e}; worst in segment {segment} near s = {s}; raise max_intervals or the tolerance",
        estimate(*.error)
    )]
    MeshLimit {
        /// Intervals that the next mesh would have.
        needed: usize,
        /// Intervals allowed.
        limit: usize,
        /// Relative defect reached.
        defect: f64,
        /// Estimated relative global error reached; infinite where it is not known.
        error: f64,
        /// Tolerance asked for.
        tolerance: f64,
        /// Index of the segment with the largest defect.
        segment: usize,
        /// Left end of the interval with the largest defect.
        s: f64,
        /// The solution on the last mesh.
        best: Box<Solution>,
    },
    /// The tolerance is not met although many meshes were tried, or intervals shrank to the spacing
    /// of floating-point numbers: either the right-hand side is not smooth there, which
    /// [`Segment::joined`](crate::Segment::joined) tells the solver, or the solution has a layer whose place
    /// hardly feels the conditions, which [`solve_embedded`](crate::solve_embedded) may follow.
    #[error(
        "defect {defect:.1e}, estimated error {}, tolerance {tolerance:.1e} after {meshes} meshes; worst in segment {segment} near s = {s}, interval length {length:.1e}; a kink or jump of the right-hand side needs a joined point there, a layer inside solve_embedded from a wider one",
        estimate(*.error)
    )]
    Unresolved {
        /// Index of the segment with the largest defect.
        segment: usize,
        /// Left end of the interval with the largest defect.
        s: f64,
        /// Its length.
        length: f64,
        /// Meshes tried.
        meshes: usize,
        /// Relative defect reached.
        defect: f64,
        /// Estimated relative global error reached; infinite where it is not known.
        error: f64,
        /// Tolerance asked for.
        tolerance: f64,
        /// The solution on the last mesh.
        best: Box<Solution>,
    },
    /// The conditions hold less accurately than the tolerance asks.
    #[error(
        "condition {condition} violated: residual {residual:.1e}, tolerance {tolerance:.1e}; compare its derivatives with check_jacobians"
    )]
    ConditionViolated {
        /// Index of the condition.
        condition: usize,
        /// Its residual.
        residual: f64,
        /// Tolerance times its scale.
        tolerance: f64,
        /// The solution.
        best: Box<Solution>,
    },
    /// The problem amplifies the rounding of double precision until it hides the solution: the
    /// conditions fix something that they hardly reach through a layer, or the problem is next to one
    /// without or with many solutions, such as at an eigenvalue. No mesh helps. Put the conditions
    /// where they act, shift the problem away, state it for other unknowns such as the difference
    /// from a known solution, or ask for a larger tolerance.
    #[error(
        "ill-conditioned: {}, tolerance {tolerance:.1e}; other conditions, another formulation or a larger tolerance may help, a finer mesh cannot",
        amplified(*.rounding, *.condition)
    )]
    IllConditioned {
        /// Estimated rounding error relative to 1 + |y|. From 0.01 on no digit of the solution is
        /// known, nor one of this number.
        rounding: f64,
        /// `rounding` divided by the unit roundoff 1.1e-16: an estimate of the condition number, or a lower
        /// bound of it where no digit is known.
        condition: f64,
        /// Tolerance asked for.
        tolerance: f64,
        /// What was found: any of the solutions that differ by rounding.
        best: Box<Solution>,
    },
    /// [`solve_embedded`](crate::solve_embedded) did not come to the wanted value of the parameter, or
    /// came there only roughly.
    #[error("parameter {parameter} reached {reached} on the way to {to}: {cause}")]
    Unreached {
        /// Index of the parameter.
        parameter: usize,
        /// The last value with a solution; `to` if only the final accuracy failed.
        reached: f64,
        /// The value wanted.
        to: f64,
        /// The failure after that.
        cause: Box<Self>,
        /// The rough solution at the value reached, with the cost of everything.
        best: Box<Solution>,
    },
}

/// Checks that numbers of [`Options::absolute`](crate::Options::absolute) are sizes: positive and normal.
pub(crate) fn check_sizes(absolute: &[f64]) -> Result<(), Error> {
    let is_size = |size: f64| size.is_normal() && size > 0.0;
    match absolute.iter().position(|&size| !is_size(size)) {
        Some(position) => Err(Error::Absolute {
            position,
            value: absolute[position],
        }),
        None => Ok(()),
    }
}

/// The best iterate of the failures that have one, borrowed as the error is.
macro_rules! best_of {
    ($error:expr) => {
        match $error {
            Error::NonFiniteRhs { best, .. }
            | Error::NonFiniteCondition { best, .. }
            | Error::SingularNode { best, .. }
            | Error::SingularConditions { best, .. }
            | Error::NoConvergence { best, .. }
            | Error::MeshLimit { best, .. }
            | Error::Unresolved { best, .. }
            | Error::ConditionViolated { best, .. }
            | Error::IllConditioned { best, .. }
            | Error::Unreached { best, .. } => Some(best),
            _ => None,
        }
    };
}

impl Error {
    /// Whether it is a failure of Newton's method.
    pub(crate) fn is_of_newton(&self) -> bool {
        matches!(
            self,
            Self::NonFiniteRhs { .. }
                | Self::NonFiniteCondition { .. }
                | Self::SingularNode { .. }
                | Self::SingularConditions { .. }
                | Self::NoConvergence { .. }
        )
    }

    /// The best iterate of a numerical failure; `None` for a statement error.
    pub fn best(&self) -> Option<&Solution> {
        best_of!(self)
    }

    /// The same, to be changed.
    pub(crate) fn best_mut(&mut self) -> Option<&mut Solution> {
        best_of!(self)
    }
}
