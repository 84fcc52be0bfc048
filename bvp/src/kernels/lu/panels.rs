//! LU factors of matrices of medium size, a few columns at a time.

use super::singular::SingularRow;
use crate::kernels::dense::{add_scaled, dot};
use std::ops::Range;

/// Columns eliminated together, and right-hand sides solved together: rows of a few dozen numbers
/// are too short for the bookkeeping of one update each.
const PANEL: usize = 4;

/// Factors A in place, P A = L U, with the inverse of the diagonal of U. Golub & Van Loan, *Matrix
/// Computations*, 4th ed., section 3.2.11.
pub(super) fn factor(a: &mut [f64], n: usize, pivots: &mut [usize]) -> Result<(), SingularRow> {
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

/// Solves A x = b in place. Rows go in panels, whose products with what is already known do not wait for
/// each other.
pub(super) fn solve(lu: &[f64], n: usize, pivots: &[usize], b: &mut [f64]) {
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

/// Solves xᵀ A = bᵀ in place for each row b of `rows`, [`PANEL`] of them at a time.
pub(super) fn solve_transposed(lu: &[f64], n: usize, pivots: &[usize], rows: &mut [f64]) {
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
    to: Range<usize>,
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
