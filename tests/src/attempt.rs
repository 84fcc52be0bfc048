//! One case solved once: whether, how accurately and at what cost.

use crate::{Case, scaled_error};
use bvp::{Options, Solution, Stats};

/// A success whose true error exceeds the tolerance by more than this factor is a false one.
pub const FALSE_FROM: f64 = 10.0;

/// What came of solving a case from its guess.
///
/// The numbers of a failure are those of its best iterate, not-a-number and zero where it has none.
#[derive(Clone, Debug)]
pub struct Attempt {
    /// The name of the case.
    pub case: &'static str,
    /// The tolerance asked for.
    pub tolerance: f64,
    /// Success or the reason of the failure.
    pub outcome: Outcome,
    /// The true error as of [`true_error`].
    pub true_error: f64,
    /// The estimate of the solver for the error.
    pub estimate: Option<f64>,
    /// Intervals of the last mesh, over all segments.
    pub intervals: usize,
    /// Newton steps in all.
    pub newton_steps: usize,
    /// Factorisations of the Newton matrix in all.
    pub factorisations: usize,
    /// Evaluations of the right-hand side at one point in all.
    pub rhs_evaluations: usize,
}

/// How an attempt ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The solver returned a solution.
    Solved,
    /// It returned an error, with this text.
    Failed(String),
}

impl Attempt {
    /// Solves a case from its own guess.
    pub fn new(case: &Case, options: &Options) -> Self {
        let result = bvp::solve(&*case.equations, case, options);
        let (outcome, solution) = match &result {
            Ok(solution) => (Outcome::Solved, Some(solution)),
            Err(error) => (Outcome::Failed(error.to_string()), error.best()),
        };
        let stats = solution.map_or_else(Stats::default, |solution| *solution.stats());
        Self {
            case: case.id,
            tolerance: options.tolerance,
            outcome,
            true_error: solution.map_or(f64::NAN, |solution| true_error(case, solution)),
            estimate: solution.and_then(Solution::error_estimate),
            intervals: solution.map_or(0, intervals),
            newton_steps: stats.newton_steps,
            factorisations: stats.factorisations,
            rhs_evaluations: stats.rhs_evaluations,
        }
    }

    /// Whether a solution was returned.
    pub fn is_solved(&self) -> bool {
        self.outcome == Outcome::Solved
    }

    /// Whether a solution was returned that is wrong: its true error is beyond [`FALSE_FROM`]
    /// tolerances or not a number.
    pub fn is_false_success(&self) -> bool {
        let right = self.true_error <= FALSE_FROM * self.tolerance;
        self.is_solved() && !right
    }
}

/// The true error of a solution by [`scaled_error`]: at the points of the reference table of the
/// case, and of its parameters.
pub fn true_error(case: &Case, solution: &Solution) -> f64 {
    let reference = &case.reference;
    let of_parameters = scaled_error(solution.parameters(), &reference.parameters);
    let of_points = reference.points.iter().map(|(segment, x, y)| {
        let mut found = vec![f64::NAN; y.len()];
        solution.state(*segment, *x, &mut found);
        scaled_error(&found, y)
    });
    of_points.fold(of_parameters, max_or_nan)
}

/// The larger of two numbers, NaN if either is.
pub fn max_or_nan(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

/// Intervals of the mesh of a solution, over all segments.
fn intervals(solution: &Solution) -> usize {
    let segments = 0..solution.segments().len();
    segments.map(|i| solution.mesh(i).len() - 1).sum()
}
