//! Dense factorisations of the small matrices inside the solver, row-major in slices.

use crate::kernels::small;

/// The matrix is singular: the pivot of this row vanishes or is not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SingularRow(pub(crate) usize);

/// Columns eliminated together, and right-hand sides solved together: rows of a few dozen numbers
/// are too short for the bookkeeping of one update each.
const PANEL: usize = 4;

/// Replaces the n × n matrix `a` by its factors L and U with row pivoting, P A = L U (Golub & Van Loan,
/// *Matrix Computations*, 4th ed., section 3.4); the diagonal of U by its inverse, which is what solving
/// needs. `pivots[i]` is the row that was exchanged with row i.
#[inline]
pub(crate) fn lu_factor(a: &mut [f64], n: usize, pivots: &mut [usize]) -> Result<(), SingularRow> {
    small::of_size!(n => lu_factor(a, pivots), lu_factor_in_panels(a, n, pivots))
}

/// [`lu_factor`] in panels of [`PANEL`] columns (Golub & Van Loan, section 3.2.11).
fn lu_factor_in_panels(a: &mut [f64], n: usize, pivots: &mut [usize]) -> Result<(), SingularRow> {
    for first in (0..n).step_by(PANEL) {
        let last = (first + PANEL).min(n);
        for column in first..last {
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
            let pivot_row = &mut upper[column * n..][..last];
            let inverse = 1.0 / pivot_row[column];
            pivot_row[column] = inverse;
            for row in lower.chunks_exact_mut(n) {
                let factor = row[column] * inverse;
                row[column] = factor;
                add_scaled(
                    &mut row[column + 1..last],
                    -factor,
                    &pivot_row[column + 1..],
                );
            }
        }
        // The rows of U to the right of the panel.
        for i in first + 1..last {
            let (upper, lower) = a.split_at_mut(i * n);
            let (factors, row) = lower[..n].split_at_mut(last);
            for (pivot_row, factor) in upper[first * n..].chunks_exact(n).zip(&factors[first..]) {
                add_scaled(row, -factor, &pivot_row[last..]);
            }
        }
        // What remains, which is nothing after a last panel of less than full width.
        let (upper, lower) = a.split_at_mut(last * n);
        let mut pivot_rows = upper[first * n..].chunks_exact(n).map(|row| &row[last..]);
        let panel = [(); PANEL].map(|()| pivot_rows.next().unwrap_or(&[]));
        for row in lower.chunks_exact_mut(n) {
            let (factors, row) = row.split_at_mut(last);
            let factors = &factors[first..];
            if factors.iter().any(|&factor| factor != 0.0) {
                subtract_four(row, factors, panel);
            }
        }
    }
    Ok(())
}

/// x −= f₀ u₀ + f₁ u₁ + f₂ u₂ + f₃ u₃. One index over slices of one length vectorises where nested
/// zips do not.
#[inline]
fn subtract_four(x: &mut [f64], f: &[f64], u: [&[f64]; PANEL]) {
    let length = x.len();
    let [u0, u1, u2, u3] = u.map(|u| &u[..length]);
    let [f0, f1, f2, f3] = [f[0], f[1], f[2], f[3]];
    for j in 0..length {
        x[j] -= (f0 * u0[j] + f1 * u1[j]) + (f2 * u2[j] + f3 * u3[j]);
    }
}

/// Solves A x = b in place with the factors of [`lu_factor`].
#[inline]
pub(crate) fn lu_solve(lu: &[f64], n: usize, pivots: &[usize], b: &mut [f64]) {
    small::of_size!(n => lu_solve(lu, pivots, b), lu_solve_in_panels(lu, n, pivots, b));
}

/// [`lu_solve`] of many equations. Rows go in panels, whose products with what is already known do not
/// wait for each other.
fn lu_solve_in_panels(lu: &[f64], n: usize, pivots: &[usize], b: &mut [f64]) {
    for (i, &pivot) in pivots.iter().enumerate().take(n) {
        b.swap(i, pivot);
    }
    let b = &mut b[..n];
    for first in (0..n).step_by(PANEL) {
        let last = (first + PANEL).min(n);
        let (known, panel) = b.split_at_mut(first);
        for (x, row) in panel
            .iter_mut()
            .zip(lu[first * n..last * n].chunks_exact(n))
        {
            *x -= dot(&row[..first], known);
        }
        for i in first + 1..last {
            let (known, x) = b[first..].split_at_mut(i - first);
            x[0] -= dot(&lu[i * n + first..][..known.len()], known);
        }
    }
    for first in (0..n).step_by(PANEL).rev() {
        let last = (first + PANEL).min(n);
        let (panel, known) = b.split_at_mut(last);
        let rows = lu[first * n..last * n].chunks_exact(n);
        for (x, row) in panel[first..].iter_mut().zip(rows) {
            *x -= dot(&row[last..], known);
        }
        for i in (first..last).rev() {
            let (x, known) = panel[i..].split_at_mut(1);
            let row = &lu[i * n..][i..last];
            x[0] = (x[0] - dot(&row[1..], known)) * row[0];
        }
    }
}

/// Factors A as [`lu_factor`] does and solves xᵀ A = bᵀ in place for each row b of `rows` (n numbers
/// each).
#[inline]
pub(crate) fn lu_factor_and_solve_transposed(
    a: &mut [f64],
    n: usize,
    pivots: &mut [usize],
    rows: &mut [f64],
) -> Result<(), SingularRow> {
    small::of_size!(n => lu_factor_and_solve_transposed(a, pivots, rows), {
        lu_factor_in_panels(a, n, pivots)?;
        lu_solve_transposed(a, n, pivots, rows);
        Ok(())
    })
}

/// Solves xᵀ A = bᵀ in place with the factors of [`lu_factor`] for each row b of `rows`, [`PANEL`] of
/// them at a time.
pub(crate) fn lu_solve_transposed(lu: &[f64], n: usize, pivots: &[usize], rows: &mut [f64]) {
    for rows in rows.chunks_mut(PANEL * n) {
        for k in 0..n {
            let u = &lu[k * n..][..n];
            subtract_multiples(rows, n, k, u[k], k + 1..n, &u[k + 1..]);
        }
        for k in (1..n).rev() {
            subtract_multiples(rows, n, k, 1.0, 0..k, &lu[k * n..][..k]);
        }
        for row in rows.chunks_exact_mut(n) {
            for i in (0..n).rev() {
                row.swap(i, pivots[i]);
            }
        }
    }
}

/// In each of up to [`PANEL`] `rows` of n numbers: scales entry k by `scale`, then subtracts entry
/// k times `u` from the entries `to`.
fn subtract_multiples(
    rows: &mut [f64],
    n: usize,
    k: usize,
    scale: f64,
    to: std::ops::Range<usize>,
    u: &[f64],
) {
    for row in rows.chunks_exact_mut(n) {
        row[k] *= scale;
    }
    if rows.len() == PANEL * n {
        let (a, rest) = rows.split_at_mut(n);
        let (b, rest) = rest.split_at_mut(n);
        let (c, d) = rest.split_at_mut(n);
        let [fa, fb, fc, fd] = [a[k], b[k], c[k], d[k]];
        let length = u.len();
        let (a, b) = (&mut a[to.clone()][..length], &mut b[to.clone()][..length]);
        let (c, d) = (&mut c[to.clone()][..length], &mut d[to][..length]);
        for j in 0..length {
            a[j] -= fa * u[j];
            b[j] -= fb * u[j];
            c[j] -= fc * u[j];
            d[j] -= fd * u[j];
        }
    } else {
        for row in rows.chunks_exact_mut(n) {
            let factor = row[k];
            add_scaled(&mut row[to.clone()], -factor, u);
        }
    }
}

/// Columns of a product that are summed together, in registers.
const LANES: usize = 4;

/// C += A B, where A has `inner` columns and B has `columns`.
#[inline(always)]
pub(crate) fn add_product(c: &mut [f64], a: &[f64], b: &[f64], inner: usize, columns: usize) {
    for (a, c) in a.chunks_exact(inner).zip(c.chunks_exact_mut(columns)) {
        let whole = columns - columns % LANES;
        for first in (0..whole).step_by(LANES) {
            add_combination(c, a, b, columns, first, LANES);
        }
        add_combination(c, a, b, columns, whole, columns - whole);
    }
}

/// Adds to at most [`LANES`] entries of c, from `first` on, those of the sum of the rows of B times the
/// numbers in a.
#[inline(always)]
fn add_combination(
    c: &mut [f64],
    a: &[f64],
    b: &[f64],
    columns: usize,
    first: usize,
    width: usize,
) {
    let c = &mut c[first..][..width];
    let mut sums = [0.0; LANES];
    let sums = &mut sums[..width];
    sums.copy_from_slice(c);
    for (factor, b) in a.iter().zip(b.chunks_exact(columns)) {
        add_scaled(sums, *factor, &b[first..][..width]);
    }
    c.copy_from_slice(sums);
}

/// The inner product of two vectors of the same length.
#[inline]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Four independent sums: one would wait for each addition in turn.
    let (a_blocks, b_blocks) = (a.chunks_exact(4), b.chunks_exact(4));
    let (a_rest, b_rest) = (a_blocks.remainder(), b_blocks.remainder());
    let mut sums = [0.0; 4];
    for (a, b) in a_blocks.zip(b_blocks) {
        for (sum, (x, y)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += x * y;
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Whether all numbers are finite: zero times anything else is NaN, and a sum keeps it.
#[inline(always)]
pub(crate) fn all_finite(x: &[f64]) -> bool {
    let blocks = x.chunks_exact(4);
    let rest: f64 = blocks.remainder().iter().map(|x| 0.0 * x).sum();
    let mut sums = [rest; 4];
    for block in blocks {
        for (sum, x) in sums.iter_mut().zip(block) {
            *sum += 0.0 * x;
        }
    }
    sums.iter().all(|sum| *sum == 0.0)
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
            let mut b: Vec<f64> = (0..n).map(|i| dot(&a[i * n..][..n], x)).collect();
            // Six rows: a full panel and a rest.
            let mut bt: Vec<f64> = (0..6 * n)
                .map(|j| {
                    let factor = 1.0 + (j / n) as f64;
                    (0..n).map(|i| factor * x[i] * a[i * n + j % n]).sum()
                })
                .collect();
            let done = lu_factor_and_solve_transposed(&mut lu, n, &mut pivots, &mut bt);
            prop_assume!(done.is_ok());
            prop_assume!((0..n).all(|i| lu[i * n + i].abs() < 1e3));
            lu_solve(&lu, n, &pivots, &mut b);
            for i in 0..n {
                prop_assert!((b[i] - x[i]).abs() < 1e-9);
                for (row, solved) in bt.chunks_exact(n).enumerate() {
                    prop_assert!((solved[i] / (1.0 + row as f64) - x[i]).abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn one_number_that_is_not_finite_is_found() {
        for length in [1, 3, 4, 11] {
            let mut x = vec![1e300; length];
            assert!(all_finite(&x));
            for place in 0..length {
                for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let kept = std::mem::replace(&mut x[place], value);
                    assert!(!all_finite(&x));
                    x[place] = kept;
                }
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
