//! LU factors of large matrices, by the blocked kernels of faer.
//!
//! Row-major A is column-major Aᵀ, which is what faer factors fastest, so here P Aᵀ = L U.

use super::singular::SingularRow;
use crate::kernels::blocked::clear_wide_registers;
use crate::kernels::dense::dot;
use faer::dyn_stack::MemStack;
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::triangular_solve::{
    solve_unit_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{MatMut, MatRef, Par};
use std::mem::MaybeUninit;

/// Scratch space for the factorisation of an n × n matrix.
#[derive(Clone, Debug)]
pub(super) struct Workspace {
    inverse: Vec<usize>,
    memory: Vec<MaybeUninit<u8>>,
}

impl Workspace {
    pub(super) fn new(n: usize) -> Self {
        let memory = lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Default::default());
        Self {
            inverse: vec![0; n],
            memory: vec![MaybeUninit::uninit(); memory.unaligned_bytes_required()],
        }
    }
}

/// Replaces the n × n matrix `a` by the factors L and U of its transpose, P Aᵀ = L U, each entry in
/// the place of its mirror image. `pivots[i]` is the column of A that was exchanged with column i.
pub(super) fn factor(
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
    // faer returns a permutation: `pivots[i]` is the first place of the column that ends in place i.
    // A column whose first place j is before i has been moved by exchange j, and maybe by later ones;
    // following these gives the place with which place i is exchanged.
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

/// Solves A x = b in place with the factors of [`factor`], A = Uᵀ Lᵀ P.
pub(super) fn solve(lu: &[f64], n: usize, pivots: &[usize], b: &mut [f64]) {
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

/// Solves xᵀ A = bᵀ in place with the factors of [`factor`], for each row b of `rows` (n numbers
/// each).
pub(super) fn solve_transposed(lu: &[f64], n: usize, pivots: &[usize], rows: &mut [f64]) {
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
