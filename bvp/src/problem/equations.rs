//! The plain `f64` view of a problem that the solver works with.

use crate::problem::problem::{Ends, Segment};

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
    /// The smooth segments.
    fn segments(&self) -> &[Segment];

    /// Number k of unknown scalar parameters.
    fn parameters(&self) -> usize;

    /// Number of conditions; must equal Σ nᵢ + k, or less for a [`Family`](crate::Family).
    fn condition_count(&self) -> usize;

    /// `dy` = f(s, y, p) on `segment`; `y`, `dy` hold n numbers, `p` holds k.
    fn rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]);

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
    fn conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]);

    /// The conditions at `ends` (laid out as in [`Ends`]) and their derivatives: `jacobian` has a
    /// row per condition and Σ 2nᵢ + k columns, row-major: the ends in the order of [`Ends`],
    /// then the parameters.
    fn conditions_jacobian(&self, ends: &[f64], p: &[f64], r: &mut [f64], jacobian: &mut [f64]);
}
