//! The plain `f64` view of a problem that the solver works with.

use crate::problem::problem::{Ends, Segment};

/// The sizes of a boundary value problem.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// The smooth segments, in the order in which they are numbered.
    pub segments: Vec<Segment>,
    /// Number k of unknown scalar parameters.
    pub parameters: usize,
    /// Number of conditions; must equal Σ nᵢ + k, or less for a [`Family`](crate::Family).
    pub conditions: usize,
}

impl Shape {
    /// The sizes of a problem with as many conditions as unknown constants, Σ nᵢ + k.
    pub fn new(segments: Vec<Segment>, parameters: usize) -> Self {
        let states: usize = segments.iter().map(|segment| segment.states).sum();
        Self {
            segments,
            parameters,
            conditions: states + parameters,
        }
    }
}

/// A boundary value problem with first derivatives, in plain `f64`.
///
/// Three providers: every [`Problem`](crate::Problem) (exact, by dual numbers), closures differenced by
/// [`FiniteDifferences`](crate::FiniteDifferences), or your own implementation. Compare any two
/// with [`check_jacobians`](crate::check_jacobians).
///
/// The solver fills every result with NaN beforehand, so that an entry which is not written is found
/// and reported: write zeros too.
///
/// A right-hand side is a pure function, and several threads may evaluate it at once.
pub trait Equations: Sync {
    /// The segments and the numbers of parameters and conditions. The solver asks once.
    fn shape(&self) -> Shape;

    /// `dy` = f(s, y, p) on `segment`; `y`, `dy` hold n numbers, `p` holds k.
    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]);

    /// The right-hand side and its derivatives: `jacobian` is n × (n + k), row-major, element
    /// (i, j) = ∂fᵢ/∂yⱼ for j < n and ∂fᵢ/∂pⱼ₋ₙ beyond.
    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    );

    /// `r` = g(ends, p), one number per condition.
    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]);

    /// The conditions and their derivatives: `jacobian` has a row per condition and Σ 2nᵢ + k
    /// columns, row-major: the ends in the order of [`Ends`], then the parameters.
    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    );
}
