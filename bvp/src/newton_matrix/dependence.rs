//! What a singular system of ends and parameters leaves undetermined.

use crate::problem::problem::Segment;
use crate::problem::unknown::Unknown;
use crate::shares::UNNOTICED;
use faer::{ColRef, MatRef};
use std::ops::Range;

/// Conditions that depend on each other, given the differential equations, and an unknown that they
/// leave free. Both are empty for a matrix that is regular or not finite.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Dependence {
    /// Indices of the conditions, ascending.
    pub(crate) conditions: Vec<usize>,
    /// The unknown that is determined least.
    pub(crate) free: Option<Unknown>,
}

impl Dependence {
    /// For an equilibrated square matrix, row-major, whose conditions begin at row `first`.
    ///
    /// With the singular value decomposition A = U Σ Vᵀ the last columns u, v of U and V have
    /// uᵀ A = σ vᵀ and A v = σ u, the smallest singular value σ being negligible: the rows with
    /// large uᵢ depend on each other, the unknowns with large vⱼ are free. Golub & Van Loan, *Matrix
    /// Computations*, 4th ed., section 2.4.
    pub(crate) fn of(matrix: &[f64], size: usize, first: usize, segments: &[Segment]) -> Self {
        let finite = matrix.iter().all(|x| x.is_finite());
        let Some(Ok(svd)) = finite.then(|| MatRef::from_row_major_slice(matrix, size, size).svd())
        else {
            return Self::default();
        };
        let sigma = svd.S().column_vector();
        if sigma[size - 1] > f64::EPSILON.sqrt() * sigma[0] {
            return Self::default();
        }
        let (u, v) = (svd.U().col(size - 1), svd.V().col(size - 1));
        let largest =
            |x: ColRef<'_, f64>, rows: Range<usize>| rows.fold(0.0, |m: f64, i| m.max(x[i].abs()));
        let (dependent, free) = (largest(u, first..size), largest(v, 0..size));
        // Conditions with less in the left null vector do not show in what depends.
        let conditions = (first..size).filter(|&i| u[i].abs() > UNNOTICED * dependent);
        // The first of those that are as free as any.
        let column = (0..size).find(|&j| v[j].abs() >= (1.0 - UNNOTICED) * free);
        Self {
            conditions: conditions.map(|i| i - first).collect(),
            free: column.map(|column| Unknown::of_column(segments, column)),
        }
    }
}
