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

    /// Whether the solver shall evaluate many points in one call where it knows them before: where a call costs more than
    /// what is done in it, as one of an interpreter does. By default it does not, which saves the room for the points.
    fn is_vectorised(&self) -> bool {
        false
    }

    /// The right-hand side at many points of a segment: `s` has a number, `y` and `dy` have n numbers for each, one point
    /// after the other. By default the points are evaluated one by one.
    fn evaluate_rhs_at(&self, segment: usize, s: &[f64], y: &[f64], p: &[f64], dy: &mut [f64]) {
        let n = (y.len() / s.len().max(1)).max(1);
        let points = y.chunks_exact(n).zip(dy.chunks_exact_mut(n));
        for (&s, (y, dy)) in s.iter().zip(points) {
            self.evaluate_rhs(segment, s, y, p, dy);
        }
    }

    /// The right-hand side and its derivatives at many points of a segment, as for
    /// [`evaluate_rhs_at`](Self::evaluate_rhs_at): `jacobians` has n × (n + k) numbers for each.
    fn rhs_jacobian_at(
        &self,
        segment: usize,
        s: &[f64],
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobians: &mut [f64],
    ) {
        let n = (y.len() / s.len().max(1)).max(1);
        let points = y.chunks_exact(n).zip(dy.chunks_exact_mut(n));
        let jacobians = jacobians.chunks_exact_mut(n * (n + p.len()));
        for (&s, ((y, dy), jacobian)) in s.iter().zip(points.zip(jacobians)) {
            self.rhs_jacobian(segment, s, y, p, dy, jacobian);
        }
    }

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
