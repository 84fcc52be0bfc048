//! The dense system of all ends and parameters that remains when the segments are eliminated.

use crate::kernels::lq::{lq_factor, lq_negative, lq_null_vector, lq_solve};
use crate::kernels::lu::lu;
use crate::newton_matrix::dependence::Dependence;
use crate::newton_matrix::singular::Singular;
use crate::problem::problem::Segment;
use faer::{ColRef, Mat};

/// An equilibrated system, factored: a square one with row pivoting, one with an equation fewer
/// than unknowns by orthogonal transformations.
#[derive(Clone, Debug)]
pub(crate) struct EndSystem {
    /// Unknowns.
    size: usize,
    /// The matrix, row-major; equilibrated once it is factored.
    matrix: Vec<f64>,
    /// Its factors.
    factors: Vec<f64>,
    /// Exchanges in the factorisation of a square matrix.
    pivots: Vec<usize>,
    /// Factors of the reflections of a matrix with fewer rows.
    tau: Vec<f64>,
    workspace: lu::Workspace,
    /// Equilibration of rows and columns.
    row_scale: Vec<f64>,
    column_scale: Vec<f64>,
}

impl EndSystem {
    /// A system of as many `equations` as unknowns, or one fewer.
    pub(crate) fn new(equations: usize, size: usize) -> Self {
        let square = equations == size;
        Self {
            size,
            matrix: vec![0.0; equations * size],
            factors: vec![],
            pivots: vec![0; if square { size } else { 0 }],
            tau: vec![0.0; if square { 0 } else { equations }],
            workspace: lu::Workspace::new(if square { size } else { 0 }),
            row_scale: vec![0.0; equations],
            column_scale: vec![0.0; size],
        }
    }

    /// The matrix, row-major, to be filled before [`factor`](Self::factor).
    pub(crate) fn matrix_mut(&mut self) -> &mut [f64] {
        &mut self.matrix
    }

    /// Factors the filled matrix. A square one must be regular; one with fewer rows must be finite
    /// and may have any rank.
    pub(crate) fn factor(&mut self) -> Result<(), Singular> {
        let size = self.size;
        self.equilibrate()?;
        self.factors.clone_from(&self.matrix);
        if self.pivots.is_empty() {
            lq_factor(&mut self.factors, size, &mut self.tau);
            return Ok(());
        }
        // In an equilibrated matrix a pivot at rounding level is a zero.
        let negligible = size as f64 * f64::EPSILON;
        lu::factor(
            &mut self.factors,
            size,
            &mut self.pivots,
            &mut self.workspace,
        )
        .map_err(|_| Singular::Ends)?;
        if self.smallest_pivot() > negligible {
            Ok(())
        } else {
            Err(Singular::Ends)
        }
    }

    /// The smallest pivot of the equilibrated square matrix.
    pub(crate) fn smallest_pivot(&self) -> f64 {
        lu::smallest_pivot(&self.factors, self.size)
    }

    /// Which conditions of a square matrix that proved singular depend on each other, and which unknown is
    /// left free. The conditions begin at row `first`.
    pub(crate) fn dependence(&self, first: usize, segments: &[Segment]) -> Dependence {
        Dependence::of(&self.matrix, self.size, first, segments)
    }

    /// What is left undetermined when the rows from `first` on, C δy, are taken for C (I − P) δy, if the matrix is
    /// not singular as it is. The projectors P begin at the given columns, and are for states in units of one; the
    /// states of this system have the given `units`.
    pub(crate) fn dependence_without(
        &self,
        first: usize,
        ranges: &[(usize, Mat<f64>)],
        units: &[f64],
        segments: &[Segment],
    ) -> Dependence {
        if self.dependence(first, segments) != Dependence::default() {
            return Dependence::default();
        }
        let mut matrix = self.matrix.clone();
        // The columns of the equilibrated matrix are those of C times these.
        let scale = |column: usize| units[column] * self.column_scale[column];
        for (column, range) in ranges {
            let (n, scale) = (range.nrows(), |state: usize| scale(column + state));
            let range = Mat::from_fn(n, n, |i, j| range[(i, j)] * scale(j) / scale(i));
            for row in matrix.chunks_exact_mut(self.size).skip(first) {
                let c = &mut row[*column..][..n];
                let part = ColRef::from_slice(c).transpose() * &range;
                c.iter_mut()
                    .zip(part.iter())
                    .for_each(|(c, part)| *c -= part);
            }
        }
        Dependence::of(&matrix, self.size, first, segments)
    }

    /// Scales rows, then columns, so that their largest entries are one; rows and columns of zeros stay.
    fn equilibrate(&mut self) -> Result<(), Singular> {
        self.column_scale.fill(0.0);
        let rows = self.matrix.chunks_exact_mut(self.size);
        for (row, scale) in rows.zip(&mut self.row_scale) {
            *scale = inverse_of_largest(row).ok_or(Singular::Ends)?;
            for (x, largest) in row.iter_mut().zip(&mut self.column_scale) {
                *x *= *scale;
                *largest = largest.max(x.abs());
            }
        }
        for scale in &mut self.column_scale {
            *scale = inverse_of_largest(&[*scale]).ok_or(Singular::Ends)?;
        }
        for row in self.matrix.chunks_exact_mut(self.size) {
            for (x, scale) in row.iter_mut().zip(&self.column_scale) {
                *x *= scale;
            }
        }
        Ok(())
    }

    /// Replaces right-hand sides, the first entries of `x`, by the solution of the factored system, or by
    /// one of its solutions if there is one equation fewer than unknowns.
    pub(crate) fn solve(&self, x: &mut [f64]) {
        for (x, scale) in x.iter_mut().zip(&self.row_scale) {
            *x *= scale;
        }
        if self.pivots.is_empty() {
            lq_solve(&self.factors, self.size, &self.tau, x);
        } else {
            lu::solve(&self.factors, self.size, &self.pivots, x);
        }
        self.unscale(x);
    }

    /// Writes a null vector of a system with one equation fewer than unknowns into `x`. With the number n
    /// returned, the sign of (−1)ⁿ det \[E; xᵀ\] is the same for all systems of a size.
    pub(crate) fn null_vector(&self, x: &mut [f64]) -> usize {
        lq_null_vector(&self.factors, self.size, &self.tau, x);
        self.unscale(x);
        lq_negative(&self.factors, self.size)
    }

    /// Scales a solution of the equilibrated system back.
    fn unscale(&self, x: &mut [f64]) {
        for (x, scale) in x.iter_mut().zip(&self.column_scale) {
            *x *= scale;
        }
    }
}

/// 1 / max |x|, 1 where all are zero, `None` where one is not finite.
fn inverse_of_largest(x: &[f64]) -> Option<f64> {
    let largest = x.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let finite = x.iter().all(|x| x.is_finite());
    finite.then(|| if largest > 0.0 { 1.0 / largest } else { 1.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernels::dense::dot;

    /// A well-conditioned matrix with rows of very different size.
    fn system(size: usize) -> EndSystem {
        let mut system = EndSystem::new(size, size);
        for (i, row) in system.matrix_mut().chunks_exact_mut(size).enumerate() {
            for (j, x) in row.iter_mut().enumerate() {
                let number = ((i * 7919 + j * 104_729) % 1000) as f64 / 1000.0 - 0.5;
                let diagonal = if (i * 5 + 3) % size == j {
                    size as f64
                } else {
                    0.0
                };
                *x = (number + diagonal) * 10f64.powi(i32::try_from(i % 7).unwrap() - 3);
            }
        }
        system
    }

    #[test]
    fn small_and_large_systems_are_solved() {
        // 5 and the sizes have no common factor, so that the large entries form a permutation.
        for size in [3, 33, lu::LARGE - 1, lu::LARGE, 101] {
            let mut system = system(size);
            let solution: Vec<f64> = (0..size).map(|i| 1.0 + i as f64).collect();
            let rows = system.matrix_mut().chunks_exact(size);
            let mut x: Vec<f64> = rows.map(|row| dot(row, &solution)).collect();
            system.factor().unwrap();
            system.solve(&mut x);
            for (found, exact) in x.iter().zip(&solution) {
                assert!(
                    (found / exact - 1.0).abs() < 1e-11,
                    "{size}: {found} for {exact}"
                );
            }
        }
    }

    #[test]
    fn a_repeated_row_is_singular_at_every_size() {
        for size in [3, 33, lu::LARGE, 101] {
            let mut system = system(size);
            let row = system.matrix_mut()[..size].to_vec();
            system.matrix_mut()[size..2 * size].copy_from_slice(&row);
            assert_eq!(system.factor(), Err(Singular::Ends), "{size}");
        }
    }
}
