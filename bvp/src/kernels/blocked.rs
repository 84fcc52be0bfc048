//! Products of large matrices, row-major in slices, by the blocked kernels of faer.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};

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

/// Clears the upper halves of the vector registers, by finding the largest of a few numbers.
///
/// The kernels of faer leave these halves in use. Until they are cleared, every instruction of the
/// baseline, here and in the right-hand sides, takes up to three times as long. Compiled code clears them
/// on return from wide instructions, which faer uses to find a largest number. To be called after each
/// use of such a kernel.
pub(crate) fn clear_wide_registers(x: &[f64]) {
    let some = &x[..x.len().min(16)];
    std::hint::black_box(MatRef::from_column_major_slice(some, some.len(), 1).norm_max());
}
