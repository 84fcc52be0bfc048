//! LU factors of large matrices and products with them, by the blocked kernels of faer.
//!
//! Matrices are row-major in slices, as in [`dense`](crate::dense). Row-major A is column-major Aᵀ,
//! which is what faer factors fastest, so here P Aᵀ = L U.

use crate::kernels::dense::{SingularRow, dot};
use faer::dyn_stack::MemStack;
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_unit_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, MatMut, MatRef, Par};
use std::mem::MaybeUninit;

/// Matrices of at least so many rows take less time here than in [`dense`](crate::dense).
pub(crate) const LARGE: usize = 32;

/// What the factorisation of an n × n matrix needs beside the matrix.
#[derive(Clone, Debug)]
pub(crate) struct Workspace {
    inverse: Vec<usize>,
    memory: Vec<MaybeUninit<u8>>,
}

impl Workspace {
    pub(crate) fn new(n: usize) -> Self {
        let memory = lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Default::default());
        Self {
            inverse: vec![0; n],
            memory: vec![MaybeUninit::uninit(); memory.unaligned_bytes_required()],
        }
    }
}

/// Replaces the n × n matrix `a` by the factors L and U of its transpose, P Aᵀ = L U, each entry in
/// the place of its mirror image. `pivots[i]` is the column of A that was exchanged with column i.
pub(crate) fn lu_factor(
    a: &mut [f64],
    n: usize,
    pivots: &mut [usize],
    workspace: &mut Workspace,
) -> Result<(), SingularRow> {
    lu_in_place(
        MatMut::from_column_major_slice_mut(a, n, n),
        pivots,
        &mut workspace.inverse,
        Par::Seq,
        MemStack::new(&mut workspace.memory),
        Default::default(),
    );
    clear_wide_registers(a);
    // faer tells where each column came from; before exchange i, the one that stood in place j < i
    // is where exchange j, and those after it, have put it.
    for i in 0..n {
        while pivots[i] < i {
            pivots[i] = pivots[pivots[i]];
        }
    }
    let mut diagonal = a.iter().step_by(n + 1);
    match diagonal.position(|pivot| !(pivot.abs() > 0.0 && pivot.is_finite())) {
        Some(row) => Err(SingularRow(row)),
        None => Ok(()),
    }
}

/// Solves A x = b in place with the factors of [`lu_factor`], A = Uᵀ Lᵀ P.
pub(crate) fn lu_solve(lu: &[f64], n: usize, pivots: &[usize], b: &mut [f64]) {
    for (i, row) in lu.chunks_exact(n).enumerate() {
        let (known, x) = b.split_at_mut(i);
        x[0] = (x[0] - dot(&row[..i], known)) / row[i];
    }
    for (i, row) in lu.chunks_exact(n).enumerate().rev() {
        let (x, known) = b[i..].split_at_mut(1);
        x[0] -= dot(&row[i + 1..], known);
    }
    for (i, &pivot) in pivots.iter().enumerate().rev() {
        b.swap(i, pivot);
    }
}

/// Solves xᵀ A = bᵀ in place with the factors of [`lu_factor`], for each row b of `rows` (n numbers
/// each).
pub(crate) fn lu_solve_transposed(lu: &[f64], n: usize, pivots: &[usize], rows: &mut [f64]) {
    for row in rows.chunks_exact_mut(n) {
        for (i, &pivot) in pivots.iter().enumerate() {
            row.swap(i, pivot);
        }
    }
    let lu = MatRef::from_column_major_slice(lu, n, n);
    let count = rows.len() / n;
    let mut x = MatMut::from_column_major_slice_mut(rows, n, count);
    solve_unit_lower_triangular_in_place(lu, x.as_mut(), Par::Seq);
    solve_upper_triangular_in_place(lu, x, Par::Seq);
    clear_wide_registers(rows);
}

/// C += A B, where A has `inner` columns and B has `columns`.
pub(crate) fn add_product(c: &mut [f64], a: &[f64], b: &[f64], inner: usize, columns: usize) {
    let rows = a.len() / inner;
    matmul(
        MatMut::from_row_major_slice_mut(c, rows, columns),
        Accum::Add,
        MatRef::from_row_major_slice(a, rows, inner),
        MatRef::from_row_major_slice(b, inner, columns),
        1.0,
        Par::Seq,
    );
    clear_wide_registers(c);
}

/// To be called after products by faer, on a few of their numbers. Its kernels leave the upper
/// halves of the vector registers in use, and until these are cleared every instruction of the
/// baseline, here and in the right-hand sides, takes up to three times as long. Compiled code clears
/// them on return from wide instructions, such as faer finds a largest number by.
pub(crate) fn clear_wide_registers(x: &[f64]) {
    let some = &x[..x.len().min(16)];
    std::hint::black_box(MatRef::from_column_major_slice(some, some.len(), 1).norm_max());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernels::dense;
    use proptest::prelude::*;

    /// Numbers of [−1, 1) by Knuth's multiplicative congruential generator.
    fn numbers(count: usize, mut seed: u64) -> Vec<f64> {
        let mut number = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        (0..count).map(|_| number()).collect()
    }

    fn difference(a: &[f64], b: &[f64]) -> f64 {
        let pairs = a.iter().zip(b);
        pairs.fold(0.0, |m, (a, b)| dense::max_or_nan(m, (a - b).abs()))
    }

    proptest! {
        #[test]
        fn agrees_with_the_small_kernels(n in 1usize..=80, count in 1usize..=9, seed: u64) {
            let mut a = numbers(n * n, seed);
            for i in 0..n {
                // A large entry in every row and column, seldom on the diagonal.
                a[i * n + (i + n / 3) % n] += n as f64;
            }
            let (mut small, mut large) = (a.clone(), a.clone());
            let (mut small_pivots, mut large_pivots) = (vec![0; n], vec![0; n]);
            prop_assert_eq!(dense::lu_factor(&mut small, n, &mut small_pivots), Ok(()));
            let workspace = &mut Workspace::new(n);
            prop_assert_eq!(lu_factor(&mut large, n, &mut large_pivots, workspace), Ok(()));

            let rows = numbers(count * n, seed ^ 1);
            let (mut x, mut y) = (rows.clone(), rows.clone());
            for (x, y) in x.chunks_exact_mut(n).zip(y.chunks_exact_mut(n)) {
                dense::lu_solve(&small, n, &small_pivots, x);
                lu_solve(&large, n, &large_pivots, y);
            }
            prop_assert!(difference(&x, &y) < 1e-12, "A x = b: {}", difference(&x, &y));

            let (mut x, mut y) = (rows.clone(), rows.clone());
            dense::lu_solve_transposed(&small, n, &small_pivots, &mut x);
            lu_solve_transposed(&large, n, &large_pivots, &mut y);
            prop_assert!(difference(&x, &y) < 1e-12, "xᵀ A = bᵀ: {}", difference(&x, &y));

            let mut product = vec![0.0; count * n];
            add_product(&mut product, &y, &a, n, n);
            prop_assert!(difference(&product, &rows) < 1e-12, "xᵀ A");
            let mut product = vec![0.0; count * n];
            dense::add_product(&mut product, &x, &a, n, n);
            prop_assert!(difference(&product, &rows) < 1e-12, "xᵀ A");
        }
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        for n in [2, 33, 64] {
            let mut a = numbers(n * n, 1);
            a[n - 1..].iter_mut().step_by(n).for_each(|x| *x = 0.0);
            let workspace = &mut Workspace::new(n);
            assert!(lu_factor(&mut a, n, &mut vec![0; n], workspace).is_err());
            let mut a = numbers(n * n, 1);
            a[n + 1] = f64::NAN;
            assert!(lu_factor(&mut a, n, &mut vec![0; n], workspace).is_err());
        }
    }
}
