//! The LU factorisation of a sparse square matrix, with the sign of its determinant.

use crate::system::permutation::parity;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::perm::PermRef;
use faer::sparse::linalg::colamd;
use faer::sparse::linalg::lu::simplicial::{
    SimplicialLu, factorize_simplicial_numeric_lu, factorize_simplicial_numeric_lu_scratch,
    solve_in_place_scratch,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par};

/// A sparse matrix by columns, entries of a column in any order.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    pub(crate) starts: Vec<usize>,
    pub(crate) rows: Vec<usize>,
    pub(crate) values: Vec<f64>,
}

impl Columns {
    fn matrix(&self) -> SparseColMatRef<'_, usize, f64> {
        let order = self.starts.len() - 1;
        let pattern = SymbolicSparseColMatRef::new_unsorted_checked(
            order,
            order,
            &self.starts,
            None,
            &self.rows,
        );
        SparseColMatRef::new(pattern, &self.values)
    }
}

/// P A Q = L U with partial pivoting (Gilbert & Peierls 1988; faer), for one pattern of entries.
#[derive(Clone)]
pub(crate) struct SparseLu {
    /// The order of the columns and its inverse, for little fill.
    columns: [Vec<usize>; 2],
    /// The order of the rows and its inverse, by the pivots.
    rows: [Vec<usize>; 2],
    lu: SimplicialLu<usize, f64>,
}

impl SparseLu {
    /// Chooses the order of the columns for the pattern of a matrix by the approximate minimum degree
    /// of Aᵀ A (Davis, Gilbert, Larimore & Ng 2004); `None` where there is no memory for it.
    pub(crate) fn new(matrix: &Columns) -> Option<Self> {
        let order = matrix.starts.len() - 1;
        let mut columns = [vec![0; order], vec![0; order]];
        let [forward, inverse] = &mut columns;
        let entries = matrix.rows.len();
        let mut memory = buffer(colamd::order_scratch::<usize>(order, order, entries))?;
        colamd::order(
            forward,
            inverse,
            matrix.matrix().symbolic(),
            colamd::Control::default(),
            MemStack::new(&mut memory),
        )
        .ok()?;
        Some(Self {
            columns,
            rows: [vec![0; order], vec![0; order]],
            lu: SimplicialLu::new(),
        })
    }

    /// Factors a matrix of the same pattern; false where a pivot is zero or not finite.
    pub(crate) fn factor(&mut self, matrix: &Columns) -> bool {
        let order = matrix.starts.len() - 1;
        let need = factorize_simplicial_numeric_lu_scratch::<usize, f64>(order, order);
        let Some(mut memory) = buffer(need) else {
            return false;
        };
        let [rows, inverse] = &mut self.rows;
        let columns = PermRef::new_checked(&self.columns[0], &self.columns[1], order);
        let stack = MemStack::new(&mut memory);
        let (lu, matrix) = (&mut self.lu, matrix.matrix());
        let done = factorize_simplicial_numeric_lu(rows, inverse, lu, matrix, columns, stack);
        done.is_ok() && self.pivots().all(|pivot| pivot.is_finite() && pivot != 0.0)
    }

    /// The diagonal of U, whose entries stand last in their columns.
    fn pivots(&self) -> impl Iterator<Item = f64> {
        let upper = self.lu.u_factor_unsorted();
        (0..upper.ncols()).map(move |j| upper.val_of_col(j).last().copied().unwrap_or(0.0))
    }

    /// The sign of the determinant of the matrix factored last.
    pub(crate) fn sign(&self) -> f64 {
        let order = parity(&self.rows[0]) * parity(&self.columns[0]);
        self.pivots()
            .fold(order, |sign, pivot| sign * pivot.signum())
    }

    /// Solves A x = b in the place of b.
    pub(crate) fn solve(&self, b: &mut [f64]) {
        let order = b.len();
        let need = solve_in_place_scratch::<usize, f64>(order, 1, Par::Seq);
        let Some(mut memory) = buffer(need) else {
            return b.fill(f64::NAN);
        };
        let [rows, columns] = [&self.rows, &self.columns]
            .map(|[forward, inverse]| PermRef::new_checked(forward, inverse, order));
        let b = MatMut::from_column_major_slice_mut(b, order, 1);
        let stack = MemStack::new(&mut memory);
        self.lu
            .solve_in_place_with_conj(rows, columns, Conj::No, b, Par::Seq, stack);
    }
}

fn buffer(need: StackReq) -> Option<MemBuffer> {
    MemBuffer::try_new(need).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    /// A sparse matrix of this order with pseudorandom entries.
    fn random(order: usize, seed: u64) -> Columns {
        let mut state = seed;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut matrix = Columns {
            starts: vec![0],
            rows: vec![],
            values: vec![],
        };
        for j in 0..order {
            for i in 0..order {
                if i == (j + 1) % order || next() < 0.3 {
                    matrix.rows.push(i);
                    matrix.values.push(next() - 0.5);
                }
            }
            matrix.starts.push(matrix.rows.len());
        }
        matrix
    }

    #[test]
    fn sign_and_solution_are_those_of_the_dense_matrix() {
        for order in 1..12 {
            for seed in 0..20 {
                let matrix = random(order, 1000 * seed + 7);
                let mut dense = Mat::<f64>::zeros(order, order);
                for j in 0..order {
                    for entry in matrix.starts[j]..matrix.starts[j + 1] {
                        dense[(matrix.rows[entry], j)] = matrix.values[entry];
                    }
                }
                let determinant = dense.determinant();
                if determinant.abs() < 1e-10 {
                    continue;
                }
                let mut lu = SparseLu::new(&matrix).unwrap();
                assert!(lu.factor(&matrix));
                assert_eq!(
                    lu.sign(),
                    determinant.signum(),
                    "order {order}, seed {seed}"
                );
                let exact: Vec<f64> = (0..order).map(|i| i as f64 - 1.5).collect();
                let mut b: Vec<f64> = (0..order)
                    .map(|i| (0..order).map(|j| dense[(i, j)] * exact[j]).sum())
                    .collect();
                lu.solve(&mut b);
                let error = b.iter().zip(&exact).map(|(a, b)| (a - b).abs());
                assert!(error.fold(0.0, f64::max) < 1e-12 / determinant.abs());
            }
        }
    }
}
