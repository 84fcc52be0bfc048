//! LU factors with row pivoting of square matrices, row-major in slices, by kernels for their size.
//!
//! Up to 8 rows the compiler knows the number of rows, up to [`LARGE`] rows columns are eliminated in
//! narrow panels, and beyond that the blocked kernels of faer are faster. Each kernel has its own form of
//! the factors; only the functions of this module read them. Golub & Van Loan, *Matrix Computations*,
//! 4th ed., section 3.4.

use super::singular::SingularRow;
use super::{large, panels, small};

/// Matrices of at least this many rows are factored faster by blocked kernels.
pub(crate) const LARGE: usize = 32;

/// Scratch space for the factorisation of n × n matrices, which only large ones need.
#[derive(Clone, Debug, Default)]
pub(crate) struct Workspace(Option<large::Workspace>);

impl Workspace {
    /// For n × n matrices.
    pub(crate) fn new(n: usize) -> Self {
        Self((n >= LARGE).then(|| large::Workspace::new(n)))
    }
}

/// Replaces the n × n matrix `a` by its factors. `pivots[i]` is the row, or for large matrices the column,
/// that was exchanged with number i; `workspace` is one for n × n matrices.
#[inline]
pub(crate) fn factor(
    a: &mut [f64],
    n: usize,
    pivots: &mut [usize],
    workspace: &mut Workspace,
) -> Result<(), SingularRow> {
    match &mut workspace.0 {
        Some(workspace) => large::factor(a, n, pivots, workspace),
        None => small::of_size!(n => factor(a, pivots), panels::factor(a, n, pivots)),
    }
}

/// Factors A as [`factor`] does and solves xᵀ A = bᵀ in place for each row b of `rows`, n numbers each.
#[inline]
pub(crate) fn factor_and_solve_transposed(
    a: &mut [f64],
    n: usize,
    pivots: &mut [usize],
    rows: &mut [f64],
    workspace: &mut Workspace,
) -> Result<(), SingularRow> {
    match &mut workspace.0 {
        Some(workspace) => {
            large::factor(a, n, pivots, workspace)?;
            large::solve_transposed(a, n, pivots, rows);
            Ok(())
        }
        None => small::of_size!(n => factor_and_solve_transposed(a, pivots, rows), {
            panels::factor(a, n, pivots)?;
            panels::solve_transposed(a, n, pivots, rows);
            Ok(())
        }),
    }
}

/// Solves A x = b in place with the factors of A.
#[inline]
pub(crate) fn solve(lu: &[f64], n: usize, pivots: &[usize], b: &mut [f64]) {
    if n >= LARGE {
        large::solve(lu, n, pivots, b);
    } else {
        small::of_size!(n => solve(lu, pivots, b), panels::solve(lu, n, pivots, b));
    }
}

/// The smallest magnitude of the pivots, the diagonal of U; infinite for n = 0.
pub(crate) fn smallest_pivot(lu: &[f64], n: usize) -> f64 {
    let stored = lu.iter().step_by(n + 1).map(|entry| entry.abs());
    if n >= LARGE {
        stored.fold(f64::INFINITY, f64::min)
    } else {
        // The inverse of the diagonal is stored, which is what solving needs.
        stored.fold(f64::INFINITY, |smallest, inverse| {
            smallest.min(1.0 / inverse)
        })
    }
}

/// The number of row exchanges and of negative pivots: odd if det A is negative.
pub(crate) fn negative(lu: &[f64], n: usize, pivots: &[usize]) -> usize {
    let exchanges = pivots.iter().enumerate().filter(|(i, pivot)| i != *pivot);
    let diagonal = lu.iter().step_by(n + 1);
    exchanges.count() + diagonal.filter(|pivot| **pivot < 0.0).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernels::blocked;
    use crate::kernels::dense::{self, dot};
    use faer::Mat;
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
        fn both_solves_reproduce_the_right_hand_sides(
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
            let done = factor_and_solve_transposed(&mut lu, n, &mut pivots, &mut bt, &mut Workspace::new(n));
            prop_assume!(done.is_ok());
            prop_assume!(smallest_pivot(&lu, n) > 1e-3);
            solve(&lu, n, &pivots, &mut b);
            for i in 0..n {
                prop_assert!((b[i] - x[i]).abs() < 1e-9);
                for (row, solved) in bt.chunks_exact(n).enumerate() {
                    prop_assert!((solved[i] / (1.0 + row as f64) - x[i]).abs() < 1e-9);
                }
            }
        }
    }

    proptest! {
        #[test]
        fn kernels_of_all_sizes_agree(n in 1usize..=80, count in 1usize..=9, seed: u64) {
            let mut a = numbers(n * n, seed);
            for i in 0..n {
                // A large entry in every row and column, seldom on the diagonal.
                a[i * n + (i + n / 3) % n] += n as f64;
            }
            let (mut by_panels, mut by_large, mut chosen) = (a.clone(), a.clone(), a.clone());
            let [mut panel_pivots, mut large_pivots, mut pivots] = [(); 3].map(|()| vec![0; n]);
            prop_assert_eq!(panels::factor(&mut by_panels, n, &mut panel_pivots), Ok(()));
            let workspace = &mut large::Workspace::new(n);
            prop_assert_eq!(large::factor(&mut by_large, n, &mut large_pivots, workspace), Ok(()));
            let workspace = &mut Workspace::new(n);
            prop_assert_eq!(factor(&mut chosen, n, &mut pivots, workspace), Ok(()));
            let determinant = Mat::from_fn(n, n, |i, j| a[i * n + j]).determinant();
            prop_assert_eq!(negative(&chosen, n, &pivots) % 2 == 1, determinant < 0.0);

            let rows = numbers(count * n, seed ^ 1);
            let [mut x, mut y, mut z] = [(); 3].map(|()| rows.clone());
            for ((x, y), z) in x.chunks_exact_mut(n).zip(y.chunks_exact_mut(n)).zip(z.chunks_exact_mut(n)) {
                panels::solve(&by_panels, n, &panel_pivots, x);
                large::solve(&by_large, n, &large_pivots, y);
                solve(&chosen, n, &pivots, z);
            }
            prop_assert!(difference(&x, &y) < 1e-12, "A x = b: {}", difference(&x, &y));
            prop_assert!(difference(&x, &z) < 1e-12, "A x = b: {}", difference(&x, &z));

            let [mut x, mut y, mut z] = [(); 3].map(|()| rows.clone());
            panels::solve_transposed(&by_panels, n, &panel_pivots, &mut x);
            large::solve_transposed(&by_large, n, &large_pivots, &mut y);
            let solved = factor_and_solve_transposed(&mut a.clone(), n, &mut pivots, &mut z, workspace);
            prop_assert_eq!(solved, Ok(()));
            prop_assert!(difference(&x, &y) < 1e-12, "xᵀ A = bᵀ: {}", difference(&x, &y));
            prop_assert!(difference(&x, &z) < 1e-12, "xᵀ A = bᵀ: {}", difference(&x, &z));

            for add_product in [blocked::add_product, dense::add_product] {
                let mut product = vec![0.0; count * n];
                add_product(&mut product, &x, &a, n, n);
                prop_assert!(difference(&product, &rows) < 1e-12, "xᵀ A");
            }
        }
    }

    #[test]
    fn the_smallest_pivot_is_that_of_a_triangular_matrix() {
        for n in [3, 20, LARGE, 64] {
            let mut a = vec![0.0; n * n];
            for i in 0..n {
                a[i * n + i] = (1 + i) as f64 * if i == 1 { -1e-3 } else { 1.0 };
            }
            let mut pivots = vec![0; n];
            factor(&mut a, n, &mut pivots, &mut Workspace::new(n)).unwrap();
            let relative = smallest_pivot(&a, n) / 2e-3;
            assert!((relative - 1.0).abs() < 1e-15, "{n}");
            assert_eq!(negative(&a, n, &pivots), 1, "{n}");
        }
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        let mut a = vec![1.0, 2.0, 2.0, 4.0];
        let singular = factor(&mut a, 2, &mut [0; 2], &mut Workspace::new(2));
        assert_eq!(singular, Err(SingularRow(1)));
        for n in [2, 12, 33, 64] {
            let workspace = &mut Workspace::new(n);
            let mut a = numbers(n * n, 1);
            a[n - 1..].iter_mut().step_by(n).for_each(|x| *x = 0.0);
            assert!(factor(&mut a, n, &mut vec![0; n], workspace).is_err());
            let mut a = numbers(n * n, 1);
            a[n + 1] = f64::NAN;
            assert!(factor(&mut a, n, &mut vec![0; n], workspace).is_err());
        }
    }
}
