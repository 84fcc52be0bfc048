//! LU factors of matrices of a few rows. The compiler knows their number, which makes them three to five
//! times faster than loops of unknown length.

use super::singular::SingularRow;

/// Calls a function of this module where it is provided for n rows, or evaluates something else.
macro_rules! of_size {
    ($n:ident => $function:ident $arguments:tt, $else:expr) => {
        match $n {
            1 => crate::kernels::lu::small::$function::<1> $arguments,
            2 => crate::kernels::lu::small::$function::<2> $arguments,
            3 => crate::kernels::lu::small::$function::<3> $arguments,
            4 => crate::kernels::lu::small::$function::<4> $arguments,
            5 => crate::kernels::lu::small::$function::<5> $arguments,
            6 => crate::kernels::lu::small::$function::<6> $arguments,
            7 => crate::kernels::lu::small::$function::<7> $arguments,
            8 => crate::kernels::lu::small::$function::<8> $arguments,
            _ => $else,
        }
    };
}

pub(super) use of_size;

/// Factors A in place, as [`panels::factor`](super::panels::factor) does.
pub(super) fn factor<const N: usize>(
    a: &mut [f64],
    pivots: &mut [usize],
) -> Result<(), SingularRow> {
    factor_and_solve_transposed::<N>(a, pivots, &mut [])
}

/// Factors A in place and solves xᵀ A = bᵀ for each row b of `rows`.
pub(super) fn factor_and_solve_transposed<const N: usize>(
    a: &mut [f64],
    pivots: &mut [usize],
    rows: &mut [f64],
) -> Result<(), SingularRow> {
    let a: &mut [[f64; N]; N] = a.as_chunks_mut().0.try_into().expect("n rows");
    let pivots: &mut [usize; N] = pivots.try_into().expect("n pivots");
    eliminate(a, pivots)?;
    for b in rows.as_chunks_mut().0 {
        solve_transposed(a, pivots, b);
    }
    Ok(())
}

/// Eliminates one column after the other. The compiler knows the number of each, so that it unrolls all
/// loops and the matrix can stay in registers: a loop over the columns takes three times the instructions.
#[inline(always)]
fn eliminate<const N: usize>(
    a: &mut [[f64; N]; N],
    pivots: &mut [usize; N],
) -> Result<(), SingularRow> {
    macro_rules! columns {
        ($($column:literal)*) => {
            $(if $column < N {
                eliminate_column(a, pivots, $column)?;
            })*
        };
    }
    columns!(0 1 2 3 4 5 6 7);
    Ok(())
}

/// Brings the largest entry of a column to the diagonal and subtracts its row from those below.
#[expect(clippy::needless_range_loop, reason = "entries by their numbers")]
#[inline(always)]
fn eliminate_column<const N: usize>(
    a: &mut [[f64; N]; N],
    pivots: &mut [usize; N],
    column: usize,
) -> Result<(), SingularRow> {
    let (mut pivot, mut largest) = (column, a[column][column].abs());
    for row in column + 1..N {
        let candidate = a[row][column].abs();
        if candidate > largest {
            (pivot, largest) = (row, candidate);
        }
    }
    if !(largest > 0.0 && largest.is_finite()) {
        return Err(SingularRow(column));
    }
    pivots[column] = pivot;
    if pivot != column {
        a.swap(column, pivot);
    }
    let inverse = 1.0 / a[column][column];
    a[column][column] = inverse;
    for row in column + 1..N {
        let factor = a[row][column] * inverse;
        a[row][column] = factor;
        for j in column + 1..N {
            a[row][j] -= factor * a[column][j];
        }
    }
    Ok(())
}

/// Solves A x = b in place, column by column, so that no sum waits for another.
pub(super) fn solve<const N: usize>(lu: &[f64], pivots: &[usize], b: &mut [f64]) {
    let lu: &[[f64; N]; N] = lu.as_chunks().0.try_into().expect("n rows");
    let pivots: &[usize; N] = pivots.try_into().expect("n pivots");
    let b: &mut [f64; N] = b.try_into().expect("n numbers");
    exchange(b, pivots, 0..N);
    let mut x = *b;
    for k in 0..N {
        for i in k + 1..N {
            x[i] -= lu[i][k] * x[k];
        }
    }
    for k in (0..N).rev() {
        x[k] *= lu[k][k];
        for i in 0..k {
            x[i] -= lu[i][k] * x[k];
        }
    }
    *b = x;
}

/// Solves xᵀ A = bᵀ in place for one row b, likewise.
#[inline(always)]
fn solve_transposed<const N: usize>(lu: &[[f64; N]; N], pivots: &[usize; N], b: &mut [f64; N]) {
    let mut x = *b;
    for k in 0..N {
        x[k] *= lu[k][k];
        for j in k + 1..N {
            x[j] -= lu[k][j] * x[k];
        }
    }
    for k in (1..N).rev() {
        for j in 0..k {
            x[j] -= lu[k][j] * x[k];
        }
    }
    *b = x;
    exchange(b, pivots, (0..N).rev());
}

/// Exchanges entries as the rows were exchanged, in the given order. Most rows stay in place; writing
/// such an entry back would delay the next one.
#[inline(always)]
fn exchange<const N: usize>(
    b: &mut [f64; N],
    pivots: &[usize; N],
    order: impl Iterator<Item = usize>,
) {
    for i in order {
        if pivots[i] != i {
            b.swap(i, pivots[i]);
        }
    }
}
