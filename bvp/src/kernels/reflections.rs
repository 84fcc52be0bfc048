//! Elimination of the leading columns of a row-major matrix by Householder reflections, one after
//! the other or, where there are many, in blocks.
//!
//! The product of b reflections is Qᵀ = I − V Tᵀ Vᵀ, where the columns of V are their vectors and T is
//! upper triangular. A block therefore changes all columns to its right by products of matrices, which
//! faer computes. R. Schreiber & C. Van Loan, "A storage-efficient WY representation for products
//! of Householder transformations", SIAM J. Sci. Stat. Comput. 10 (1989) 53-57.

use crate::kernels::blocked::clear_wide_registers;
use crate::kernels::dense::add_scaled;
use crate::kernels::householder::Reflection;
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};

/// The least number of columns that is eliminated in blocks.
pub(crate) const MANY: usize = 16;

/// Columns of a block.
const BLOCK: usize = 8;

/// Annihilates column j below row j of `matrix` for all j < `tau.len()`. The vectors of the
/// reflections, with leading 1 implied, replace the zeros, and their factors go into `tau`. `row` is
/// scratch space for a row. `None` if the remaining part of a column vanishes or is not finite.
#[inline(always)]
pub(crate) fn eliminate(
    matrix: &mut [f64],
    width: usize,
    tau: &mut [f64],
    row: &mut [f64],
) -> Option<()> {
    for (j, tau) in tau.iter_mut().enumerate() {
        *tau = reflect(matrix, width, j, row)?;
    }
    Some(())
}

/// Annihilates column `j` and returns τ.
#[inline(always)]
fn reflect(matrix: &mut [f64], width: usize, j: usize, row: &mut [f64]) -> Option<f64> {
    let (above, below) = matrix.split_at_mut((j + 1) * width);
    let pivot_row = &mut above[j * width..];
    let head = pivot_row[j];
    let mut square = head * head;
    for r in below.chunks_exact(width) {
        square += r[j] * r[j];
    }
    let Reflection { beta, tau, scale } = Reflection::new(head, square)?;
    pivot_row[j] = beta;
    let row = &mut row[j + 1..width];
    row.copy_from_slice(&pivot_row[j + 1..]);
    for r in below.chunks_exact_mut(width) {
        r[j] *= scale;
        let (v, tail) = (r[j], &r[j + 1..]);
        add_scaled(row, v, tail);
    }
    add_scaled(&mut pivot_row[j + 1..], -tau, row);
    for r in below.chunks_exact_mut(width) {
        let factor = -tau * r[j];
        add_scaled(&mut r[j + 1..], factor, row);
    }
    Some(tau)
}

/// The buffers of an elimination in blocks.
#[derive(Clone, Debug)]
pub(crate) struct Blocks {
    /// First the columns of the block, then V; [`BLOCK`] numbers per row.
    v: Vec<f64>,
    /// V Tᵀ, likewise.
    scaled: Vec<f64>,
    /// Vᵀ V.
    gram: [f64; BLOCK * BLOCK],
    /// Tᵀ.
    t: [f64; BLOCK * BLOCK],
    /// Vᵀ times the columns right of the block.
    product: Vec<f64>,
}

impl Blocks {
    /// For matrices with the given numbers of rows and columns.
    pub(crate) fn new(rows: usize, width: usize) -> Self {
        Self {
            v: vec![0.0; rows * BLOCK],
            scaled: vec![0.0; rows * BLOCK],
            gram: [0.0; BLOCK * BLOCK],
            t: [0.0; BLOCK * BLOCK],
            product: vec![0.0; BLOCK * width],
        }
    }

    /// Does the same as [`eliminate`], in blocks.
    pub(crate) fn eliminate(
        &mut self,
        matrix: &mut [f64],
        width: usize,
        tau: &mut [f64],
    ) -> Option<()> {
        for (block, tau) in tau.chunks_mut(BLOCK).enumerate() {
            let (first, b) = (block * BLOCK, tau.len());
            let rest = &mut matrix[first * width..];
            self.factor(rest, width, first, tau)?;
            self.find_t(tau, rest.len() / width);
            self.apply(rest, width, first + b, b);
        }
        Some(())
    }

    /// Eliminates the columns of the block that begins at `first`, within the block only, and forms V.
    fn factor(
        &mut self,
        rows: &mut [f64],
        width: usize,
        first: usize,
        tau: &mut [f64],
    ) -> Option<()> {
        let b = tau.len();
        let v = &mut self.v[..rows.len() / width * b];
        for (v, row) in v.chunks_exact_mut(b).zip(rows.chunks_exact(width)) {
            v.copy_from_slice(&row[first..first + b]);
        }
        eliminate(v, b, tau, &mut self.product)?;
        for (v, row) in v.chunks_exact(b).zip(rows.chunks_exact_mut(width)) {
            row[first..first + b].copy_from_slice(v);
        }
        for (i, v) in v.chunks_exact_mut(b).take(b).enumerate() {
            v[i] = 1.0;
            v[i + 1..].fill(0.0);
        }
        Some(())
    }

    /// Finds Tᵀ row by row from Vᵀ V, and V Tᵀ. Row j of Tᵀ is −τⱼ vⱼᵀ V Tᵀ left of the diagonal and τⱼ on
    /// it.
    fn find_t(&mut self, tau: &[f64], rows: usize) {
        let b = tau.len();
        let v = MatRef::from_row_major_slice(&self.v[..rows * b], rows, b);
        let gram = &mut self.gram[..b * b];
        let product = MatMut::from_row_major_slice_mut(gram, b, b);
        matmul(product, Accum::Replace, v.transpose(), v, 1.0, Par::Seq);
        self.t.fill(0.0);
        for (j, tau) in tau.iter().enumerate() {
            let (known, row) = self.t[..(j + 1) * b].split_at_mut(j * b);
            for (known, factor) in known.chunks_exact(b).zip(&gram[j * b..]) {
                add_scaled(&mut row[..j], -tau * factor, &known[..j]);
            }
            row[j] = *tau;
        }
        let t = MatRef::from_row_major_slice(&self.t[..b * b], b, b);
        let scaled = MatMut::from_row_major_slice_mut(&mut self.scaled[..rows * b], rows, b);
        matmul(scaled, Accum::Replace, v, t, 1.0, Par::Seq);
    }

    /// Subtracts V Tᵀ Vᵀ times the columns from `next` on.
    fn apply(&mut self, rows: &mut [f64], width: usize, next: usize, b: usize) {
        let (count, columns) = (rows.len() / width, width - next);
        let v = MatRef::from_row_major_slice(&self.v[..count * b], count, b);
        let scaled = MatRef::from_row_major_slice(&self.scaled[..count * b], count, b);
        let product = &mut self.product[..b * columns];
        let mut product = MatMut::from_row_major_slice_mut(product, b, columns);
        // faer 0.24 exchanges the strides in `from_row_major_slice_with_stride_mut`.
        let rest = &mut rows[next..];
        let rest = MatMut::from_column_major_slice_with_stride_mut(rest, columns, count, width);
        let rest = rest.transpose_mut();
        let (replace, add) = (Accum::Replace, Accum::Add);
        matmul(
            product.as_mut(),
            replace,
            v.transpose(),
            rest.as_ref(),
            1.0,
            Par::Seq,
        );
        matmul(rest, add, scaled, product, -1.0, Par::Seq);
        clear_wide_registers(&self.product);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernels::dense::max_or_nan;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn blocks_agree_with_single_reflections(
            columns in 1usize..=50,
            more_rows in 0usize..=50,
            more_columns in 1usize..=30,
            mut seed: u64,
        ) {
            let (rows, width) = (columns + 1 + more_rows, columns + more_columns);
            // Knuth's multiplicative congruential generator, mapped to [−1, 1).
            let mut number = || {
                seed = seed
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
            };
            let mut single: Vec<f64> = (0..rows * width).map(|_| number()).collect();
            for i in 0..columns {
                single[i * width + i] += 10.0;
            }
            let mut blocked = single.clone();
            let (mut tau, mut tau_blocked) = (vec![0.0; columns], vec![0.0; columns]);
            let done = eliminate(&mut single, width, &mut tau, &mut vec![0.0; width]);
            prop_assert!(done.is_some());
            let mut blocks = Blocks::new(rows, width);
            prop_assert!(blocks.eliminate(&mut blocked, width, &mut tau_blocked).is_some());
            single.extend(tau);
            blocked.extend(tau_blocked);
            let pairs = single.iter().zip(&blocked);
            let error = pairs.fold(0.0, |m, (a, b)| max_or_nan(m, (a - b).abs()));
            prop_assert!(error < 1e-12, "{error:e}");
        }
    }

    #[test]
    fn a_column_that_is_not_finite_is_refused() {
        let (rows, width, columns) = (80, 120, 40);
        for place in [3, 39] {
            let mut matrix: Vec<f64> = (0..rows * width).map(|i| (i as f64).sin()).collect();
            matrix[50 * width + place] = f64::NAN;
            let mut blocks = Blocks::new(rows, width);
            let done = blocks.eliminate(&mut matrix, width, &mut vec![0.0; columns]);
            assert!(done.is_none());
        }
    }
}
