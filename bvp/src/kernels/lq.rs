//! Orthogonal factorisation of a matrix with one row fewer than columns.
//!
//! A = \[L 0\] Qᵀ with L lower triangular; the last column of Q spans the null space of A. The
//! factorisation uses Householder reflections of the rows, so that every result is exact for a matrix
//! that differs from A by rounding, whatever its rank. Golub & Van Loan, *Matrix Computations*, 4th ed.,
//! sections 5.2 and 5.6.2. Matrices are row-major in slices.

use crate::kernels::dense::{add_scaled, dot};
use crate::kernels::householder::Reflection;

/// Replaces A by L on and below the diagonal and by the vectors of the reflections to its right. The
/// factors of the reflections go into `tau`, one per row. Pivots below the machine epsilon are raised
/// to it.
pub(crate) fn lq_factor(a: &mut [f64], columns: usize, tau: &mut [f64]) {
    for (j, tau) in tau.iter_mut().enumerate() {
        let (head, rows) = a[j * columns..].split_at_mut(columns);
        let (pivot, tail) = head[j..].split_at_mut(1);
        let square = pivot[0] * pivot[0] + dot(tail, tail);
        match Reflection::new(pivot[0], square) {
            Some(reflection) => {
                tail.iter_mut().for_each(|x| *x *= reflection.scale);
                (pivot[0], *tau) = (reflection.beta, reflection.tau);
            }
            None => *tau = 0.0,
        }
        for row in rows.chunks_exact_mut(columns) {
            reflect(&mut row[j..], *tau, tail);
        }
        if pivot[0].abs() < f64::EPSILON {
            pivot[0] = f64::EPSILON.copysign(pivot[0]);
        }
    }
}

/// x ← x − τ v vᵀ x, the first entry of v being one.
#[inline]
fn reflect(x: &mut [f64], tau: f64, v_tail: &[f64]) {
    let (head, tail) = x.split_at_mut(1);
    let product = tau * (head[0] + dot(v_tail, tail));
    head[0] -= product;
    add_scaled(tail, -product, v_tail);
}

/// Replaces b by the shortest solution of A x = b. On entry `x` holds b, one number per row of A, and a
/// last number that is ignored.
pub(crate) fn lq_solve(lq: &[f64], columns: usize, tau: &[f64], x: &mut [f64]) {
    for (i, row) in lq.chunks_exact(columns).enumerate() {
        x[i] = (x[i] - dot(&row[..i], &x[..i])) / row[i];
    }
    x[tau.len()] = 0.0;
    rotate(lq, columns, tau, x);
}

/// The unit vector x with A x = 0 whose direction makes det \[A; xᵀ\] positive if
/// [`lq_negative`] is even and negative if it is odd, up to one sign for all matrices of a size.
pub(crate) fn lq_null_vector(lq: &[f64], columns: usize, tau: &[f64], x: &mut [f64]) {
    x.fill(0.0);
    x[tau.len()] = 1.0;
    rotate(lq, columns, tau, x);
}

/// The number of negative pivots.
pub(crate) fn lq_negative(lq: &[f64], columns: usize) -> usize {
    let pivots = lq.iter().step_by(columns + 1);
    pivots.filter(|pivot| **pivot < 0.0).count()
}

/// x ← Q x.
fn rotate(lq: &[f64], columns: usize, tau: &[f64], x: &mut [f64]) {
    let rows = lq.chunks_exact(columns).zip(tau).enumerate();
    for (j, (row, tau)) in rows.rev() {
        reflect(&mut x[j..], *tau, &row[j + 1..]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;
    use proptest::prelude::*;

    /// The sign of det \[A; xᵀ\].
    fn sign(a: &[f64], x: &[f64]) -> f64 {
        let n = x.len();
        Mat::from_fn(n, n, |i, j| if i + 1 < n { a[i * n + j] } else { x[j] })
            .determinant()
            .signum()
    }

    proptest! {
        #[test]
        fn solutions_null_vectors_and_their_orientation(
            rows in 1usize..9,
            seed in prop::collection::vec(-1.0..1.0f64, 90),
            other in prop::collection::vec(-1.0..1.0f64, 90),
        ) {
            let columns = rows + 1;
            let oriented = |seed: &[f64]| {
                let a = &seed[..rows * columns];
                let (mut lq, mut tau) = (a.to_vec(), vec![0.0; rows]);
                lq_factor(&mut lq, columns, &mut tau);
                let mut x = vec![0.0; columns];
                lq_null_vector(&lq, columns, &tau, &mut x);
                let even = lq_negative(&lq, columns).is_multiple_of(2);
                let parity = if even { 1.0 } else { -1.0 };
                (lq, tau, sign(a, &x) * parity, x)
            };
            let a = &seed[..rows * columns];
            let (lq, tau, orientation, null) = oriented(&seed);
            let smallest = |lq: &[f64]| lq.iter().step_by(columns + 1).fold(1.0, |m: f64, x| m.min(x.abs()));
            prop_assume!(smallest(&lq) > 1e-3);
            prop_assert!((dot(&null, &null) - 1.0).abs() < 1e-13);
            let b = &seed[80..80 + rows];
            let mut x = [b, &[f64::NAN]].concat();
            lq_solve(&lq, columns, &tau, &mut x);
            prop_assert!(dot(&x, &null).abs() < 1e-9);
            for (row, b) in a.chunks_exact(columns).zip(b) {
                prop_assert!(dot(row, &null).abs() < 1e-13);
                prop_assert!((dot(row, &x) - b).abs() < 1e-9);
            }
            let (lq, _, of_other, _) = oriented(&other);
            prop_assume!(smallest(&lq) > 1e-3);
            prop_assert_eq!(orientation, of_other);
        }
    }

    #[test]
    fn a_dependent_row_leaves_everything_finite() {
        for second in [[1.0, -2.0, 0.5], [0.0; 3]] {
            let a = [[1.0, -2.0, 0.5], second].concat();
            let (mut lq, mut tau) = (a.clone(), [0.0; 2]);
            lq_factor(&mut lq, 3, &mut tau);
            let mut null = [0.0; 3];
            lq_null_vector(&lq, 3, &tau, &mut null);
            let mut x = [1.0, 1.0, 0.0];
            lq_solve(&lq, 3, &tau, &mut x);
            assert!(x.iter().all(|x| x.is_finite()));
            assert!(a.chunks_exact(3).all(|row| dot(row, &null).abs() < 1e-15));
        }
    }
}
