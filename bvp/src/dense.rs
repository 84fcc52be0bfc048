//! Dense factorisations of the small matrices inside the solver, row-major in slices.

/// The matrix is singular: the pivot of this row vanishes or is not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SingularRow(pub(crate) usize);

/// Replaces the n × n matrix `a` by its factors L and U with row pivoting, P A = L U.
/// `pivots[i]` is the row that was exchanged with row i.
pub(crate) fn lu_factor(a: &mut [f64], n: usize, pivots: &mut [usize]) -> Result<(), SingularRow> {
    for column in 0..n {
        let mut pivot = column;
        let mut largest = a[column * n + column].abs();
        for row in column + 1..n {
            let candidate = a[row * n + column].abs();
            if candidate > largest {
                (pivot, largest) = (row, candidate);
            }
        }
        if !(largest > 0.0 && largest.is_finite()) {
            return Err(SingularRow(column));
        }
        pivots[column] = pivot;
        if pivot != column {
            let (upper, lower) = a.split_at_mut(pivot * n);
            upper[column * n..][..n].swap_with_slice(&mut lower[..n]);
        }
        let (upper, lower) = a.split_at_mut((column + 1) * n);
        let pivot_row = &upper[column * n..];
        let inverse = 1.0 / pivot_row[column];
        for row in lower.chunks_exact_mut(n) {
            if row[column] != 0.0 {
                let factor = row[column] * inverse;
                row[column] = factor;
                for (x, u) in row[column + 1..].iter_mut().zip(&pivot_row[column + 1..]) {
                    *x -= factor * u;
                }
            }
        }
    }
    Ok(())
}

/// Solves A x = b in place with the factors of [`lu_factor`].
pub(crate) fn lu_solve(lu: &[f64], n: usize, pivots: &[usize], b: &mut [f64]) {
    for (i, &pivot) in pivots.iter().enumerate().take(n) {
        b.swap(i, pivot);
    }
    for i in 1..n {
        let (known, rest) = b.split_at_mut(i);
        rest[0] -= dot(&lu[i * n..][..i], known);
    }
    for i in (0..n).rev() {
        let row = &lu[i * n..][..n];
        let sum = dot(&row[i + 1..], &b[i + 1..n]);
        b[i] = (b[i] - sum) / row[i];
    }
}

/// Solves xᵀ A = bᵀ in place with the factors of [`lu_factor`].
pub(crate) fn lu_solve_transposed(lu: &[f64], n: usize, pivots: &[usize], b: &mut [f64]) {
    for k in 0..n {
        let row = &lu[k * n..][..n];
        let (head, tail) = b.split_at_mut(k + 1);
        head[k] /= row[k];
        let factor = head[k];
        if factor != 0.0 {
            for (x, u) in tail.iter_mut().zip(&row[k + 1..]) {
                *x -= factor * u;
            }
        }
    }
    for k in (1..n).rev() {
        let factor = b[k];
        for (x, l) in b[..k].iter_mut().zip(&lu[k * n..][..k]) {
            *x -= factor * l;
        }
    }
    for i in (0..n).rev() {
        b.swap(i, pivots[i]);
    }
}

/// The inner product of two vectors of the same length.
#[inline]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// y += factor x.
#[inline]
pub(crate) fn add_scaled(y: &mut [f64], factor: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// The larger of two numbers, NaN if either is: what [`f64::max`] would lose.
#[inline]
pub(crate) fn max_or_nan(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn both_solves_reproduce_the_right_hand_side(
            n in 1usize..12,
            seed in prop::collection::vec(-1.0..1.0f64, 144 + 12),
        ) {
            let mut a: Vec<f64> = seed[..n * n].to_vec();
            for i in 0..n {
                a[i * n + (i * 5 + 3) % n] += 3.0;
            }
            let x = &seed[144..144 + n];
            let mut lu = a.clone();
            let mut pivots = vec![0; n];
            prop_assume!(lu_factor(&mut lu, n, &mut pivots).is_ok());
            prop_assume!((0..n).all(|i| lu[i * n + i].abs() > 1e-3));
            let mut b: Vec<f64> = (0..n).map(|i| dot(&a[i * n..][..n], x)).collect();
            lu_solve(&lu, n, &pivots, &mut b);
            let mut bt: Vec<f64> = (0..n)
                .map(|j| (0..n).map(|i| x[i] * a[i * n + j]).sum())
                .collect();
            lu_solve_transposed(&lu, n, &pivots, &mut bt);
            for i in 0..n {
                prop_assert!((b[i] - x[i]).abs() < 1e-9);
                prop_assert!((bt[i] - x[i]).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_maximum_keeps_nan() {
        assert_eq!([1.0, 3.0, 2.0].into_iter().fold(0.0, max_or_nan), 3.0);
        for values in [
            [f64::NAN, 1.0, 2.0],
            [1.0, f64::NAN, 2.0],
            [1.0, 2.0, f64::NAN],
        ] {
            assert!(values.into_iter().fold(0.0, max_or_nan).is_nan());
        }
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        let mut a = vec![1.0, 2.0, 2.0, 4.0];
        assert_eq!(lu_factor(&mut a, 2, &mut [0; 2]), Err(SingularRow(1)));
    }
}
