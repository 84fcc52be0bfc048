//! LU factors of matrices of a few rows, whose number the compiler knows: three to five times faster than
//! loops of unknown length.

use crate::dense::SingularRow;

/// Calls a function of this module where it is provided for n rows, or evaluates something else.
macro_rules! of_size {
    ($n:ident => $function:ident $arguments:tt, $else:expr) => {
        match $n {
            1 => crate::small::$function::<1> $arguments,
            2 => crate::small::$function::<2> $arguments,
            3 => crate::small::$function::<3> $arguments,
            4 => crate::small::$function::<4> $arguments,
            5 => crate::small::$function::<5> $arguments,
            6 => crate::small::$function::<6> $arguments,
            7 => crate::small::$function::<7> $arguments,
            8 => crate::small::$function::<8> $arguments,
            _ => $else,
        }
    };
}

pub(crate) use of_size;

/// [`lu_factor`](crate::dense::lu_factor) of a matrix of few rows, one column after the other.
pub(crate) fn lu_factor<const N: usize>(
    a: &mut [f64],
    pivots: &mut [usize],
) -> Result<(), SingularRow> {
    let (a, _) = a.as_chunks_mut::<N>();
    let a: &mut [[f64; N]; N] = a.try_into().expect("n rows");
    let pivots: &mut [usize; N] = pivots.try_into().expect("n pivots");
    for column in 0..N {
        let (mut pivot, mut largest) = (column, a[column][column].abs());
        for (row, entries) in a.iter().enumerate().skip(column + 1) {
            let candidate = entries[column].abs();
            if candidate > largest {
                (pivot, largest) = (row, candidate);
            }
        }
        if !(largest > 0.0 && largest.is_finite()) {
            return Err(SingularRow(column));
        }
        pivots[column] = pivot;
        a.swap(column, pivot);
        let mut pivot_row = a[column];
        let inverse = 1.0 / pivot_row[column];
        pivot_row[column] = inverse;
        a[column] = pivot_row;
        for row in &mut a[column + 1..] {
            let factor = row[column] * inverse;
            row[column] = factor;
            for j in column + 1..N {
                row[j] -= factor * pivot_row[j];
            }
        }
    }
    Ok(())
}

/// [`lu_solve`](crate::dense::lu_solve) of few equations, column by column: no sum waits for another.
pub(crate) fn lu_solve<const N: usize>(lu: &[f64], pivots: &[usize], b: &mut [f64]) {
    let (lu, _) = lu.as_chunks::<N>();
    let lu: &[[f64; N]; N] = lu.try_into().expect("n rows");
    let pivots: &[usize; N] = pivots.try_into().expect("n pivots");
    let b: &mut [f64; N] = b.try_into().expect("n numbers");
    for (i, &pivot) in pivots.iter().enumerate() {
        b.swap(i, pivot);
    }
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

/// [`lu_solve_transposed`](crate::dense::lu_solve_transposed) of few equations.
pub(crate) fn lu_solve_transposed<const N: usize>(lu: &[f64], pivots: &[usize], rows: &mut [f64]) {
    let (lu, _) = lu.as_chunks::<N>();
    let lu: &[[f64; N]; N] = lu.try_into().expect("n rows");
    let pivots: &[usize; N] = pivots.try_into().expect("n pivots");
    for b in rows.as_chunks_mut::<N>().0 {
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
        for i in (0..N).rev() {
            b.swap(i, pivots[i]);
        }
    }
}
