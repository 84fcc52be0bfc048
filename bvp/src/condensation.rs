//! Elimination of the stages of every interval.
//!
//! With the Jacobians J of the right-hand side at the stages, its derivatives `F_p` with respect to
//! the parameters, stage residuals r and continuity residual c, the linearised equations of an
//! interval are
//!
//! ```text
//! ┌                    ┐ ┌ δK    ┐   ┌ J δyᵢ + F_p δp − r ┐
//! │  M               0 │ │       │ = │                    │      M = I − h (a ∘ J)
//! │ −h (bᵀ ⊗ I)      I │ └ δyᵢ₊₁ ┘   └ δyᵢ − c            ┘
//! └                    ┘
//! ```
//!
//! With Xᵀ = h (bᵀ ⊗ I) M⁻¹ a link between the two nodes is left,
//!
//! ```text
//! δyᵢ₊₁ = (I + Xᵀ J) δyᵢ + (Xᵀ F_p) δp − Xᵀ r − c
//! ```
//!
//! so only n systems with Mᵀ are solved per interval, whatever the number of parameters. Ascher,
//! Mattheij & Russell (1995), section 5.6.

use crate::dense::{self, SingularRow, dot};
use crate::iterate::SegmentIterate;
use crate::large::{self, LARGE};
use crate::scheme::Tableau;

/// What is kept of the stages of one segment to condense residuals and to recover corrections.
#[derive(Clone, Debug)]
pub(crate) struct Condensation {
    /// States n, parameters k and unknowns of all stages of an interval, mn.
    n: usize,
    k: usize,
    size: usize,
    /// LU factors of M, (mn)² per interval, and their pivots, mn per interval.
    lu: Vec<f64>,
    pivots: Vec<usize>,
    /// Xᵀ, n × mn per interval.
    adjoint: Vec<f64>,
    /// J and `F_p` side by side at the stages, m × n × (n + k) per interval.
    jacobians: Vec<f64>,
    /// For the factorisation of M where it is large.
    workspace: Option<large::Workspace>,
}

impl Condensation {
    /// Buffers for a segment with n states, k parameters, m stages.
    pub(crate) fn new(n: usize, k: usize, m: usize, intervals: usize) -> Self {
        let size = m * n;
        Self {
            n,
            k,
            size,
            lu: vec![0.0; intervals * size * size],
            pivots: vec![0; intervals * size],
            adjoint: vec![0.0; intervals * n * size],
            jacobians: vec![0.0; intervals * size * (n + k)],
            workspace: (size >= LARGE).then(|| large::Workspace::new(size)),
        }
    }

    /// The Jacobians at the stages of interval i, to be filled before [`condense`](Self::condense).
    pub(crate) fn jacobians_mut(&mut self, i: usize) -> &mut [f64] {
        let size = self.size * (self.n + self.k);
        &mut self.jacobians[i * size..][..size]
    }

    /// Eliminates the stages of interval i of length h: factors M, finds Xᵀ and the `link`
    /// \[I + Xᵀ J, Xᵀ F\].
    pub(crate) fn condense(
        &mut self,
        i: usize,
        t: &Tableau,
        h: f64,
        link: &mut [f64],
    ) -> Result<(), SingularRow> {
        let (m, n, size, columns) = (t.stages, self.n, self.size, self.n + self.k);
        let jacobians = &self.jacobians[i * size * columns..][..size * columns];
        let lu = &mut self.lu[i * size * size..][..size * size];
        let pivots = &mut self.pivots[i * size..][..size];
        let adjoint = &mut self.adjoint[i * n * size..][..n * size];
        let rows = lu.chunks_exact_mut(size);
        for (row, (matrix_row, jacobian_row)) in
            rows.zip(jacobians.chunks_exact(columns)).enumerate()
        {
            let stage = row / n;
            for (block, a) in matrix_row.chunks_exact_mut(n).zip(&t.a[stage * m..]) {
                for (x, j) in block.iter_mut().zip(jacobian_row) {
                    *x = -h * a * j;
                }
            }
            matrix_row[row] += 1.0;
        }
        match &mut self.workspace {
            Some(workspace) => large::lu_factor(lu, size, pivots, workspace)?,
            None => dense::lu_factor(lu, size, pivots)?,
        }
        adjoint.fill(0.0);
        for (row, x) in adjoint.chunks_exact_mut(size).enumerate() {
            for (b, x) in t.b.iter().zip(x[row..].iter_mut().step_by(n)) {
                *x = h * b;
            }
        }
        link.fill(0.0);
        for row in 0..n {
            link[row * columns + row] = 1.0;
        }
        if self.workspace.is_some() {
            large::lu_solve_transposed(lu, size, pivots, adjoint);
            large::add_product(link, adjoint, jacobians, size, columns);
        } else {
            dense::lu_solve_transposed(lu, size, pivots, adjoint);
            dense::add_product(link, adjoint, jacobians, size, columns);
        }
        Ok(())
    }

    /// The number of exchanges and of negative pivots of all M: odd if the product of their
    /// determinants is negative.
    pub(crate) fn negative(&self) -> usize {
        let size = self.size;
        let intervals = self
            .lu
            .chunks_exact(size * size)
            .zip(self.pivots.chunks_exact(size));
        let count = |(lu, pivots): (&[f64], &[usize])| {
            let exchanges = pivots.iter().enumerate().filter(|(i, pivot)| i != *pivot);
            let diagonal = lu.iter().step_by(size + 1);
            exchanges.count() + diagonal.filter(|pivot| **pivot < 0.0).count()
        };
        intervals.map(count).sum()
    }

    /// The right-hand sides −Xᵀ r − c of all links, into the slots of nodes 1 … N of `nodes`.
    pub(crate) fn reduce(&self, residual: &SegmentIterate, nodes: &mut [f64]) {
        let (n, size) = (self.n, self.size);
        let intervals = self
            .adjoint
            .chunks_exact(n * size)
            .zip(residual.stages.chunks_exact(size))
            .zip(residual.nodes[n..].chunks_exact(n))
            .zip(nodes[n..].chunks_exact_mut(n));
        for (((adjoint, r), c), g) in intervals {
            for ((g, row), c) in g.iter_mut().zip(adjoint.chunks_exact(size)).zip(c) {
                *g = -dot(row, r) - c;
            }
        }
    }

    /// The corrections of the stages, δK = M⁻¹ (J δy + F δp − r), once those of the nodes and of
    /// the parameters are known.
    pub(crate) fn recover(
        &self,
        residual: &SegmentIterate,
        correction: &mut SegmentIterate,
        dp: &[f64],
    ) {
        let (n, size, columns) = (self.n, self.size, self.n + self.k);
        let SegmentIterate { nodes, stages } = correction;
        let intervals = stages
            .chunks_exact_mut(size)
            .zip(nodes.chunks_exact(n))
            .zip(residual.stages.chunks_exact(size))
            .zip(self.jacobians.chunks_exact(size * columns));
        for (i, (((stages, dy), r), jacobians)) in intervals.enumerate() {
            let rows = stages.iter_mut().zip(jacobians.chunks_exact(columns));
            for ((slope, row), r) in rows.zip(r) {
                *slope = dot(&row[..n], dy) + dot(&row[n..], dp) - r;
            }
            let lu = &self.lu[i * size * size..][..size * size];
            let pivots = &self.pivots[i * size..][..size];
            if self.workspace.is_some() {
                large::lu_solve(lu, size, pivots, stages);
            } else {
                dense::lu_solve(lu, size, pivots, stages);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scheme;
    use faer::Mat;

    /// Numbers in [−1, 1) without a pattern.
    fn noise(i: usize) -> f64 {
        let x = (i as f64 + 0.5) * 0.754_877_666_246_692_8;
        2.0 * (x - x.floor()) - 1.0
    }

    #[test]
    fn the_sign_of_all_stage_determinants_is_known_in_small_and_large_systems() {
        let mut seen = [false; 2];
        for (n, m) in [(1, 3), (2, 4), (3, 1), (5, 7), (9, 4)] {
            let t = Tableau::new(Scheme::Gauss { stages: m });
            for trial in 0..20 {
                let intervals = 3;
                let mut stages = Condensation::new(n, 0, m, intervals);
                let mut sign = 1.0;
                for i in 0..intervals {
                    // Intervals far too long for these equations.
                    let h = 10.0 * (1.0 + noise(trial + 31 * i));
                    let first = 1000 * trial + 100 * i;
                    let jacobians = stages.jacobians_mut(i);
                    for (j, x) in jacobians.iter_mut().enumerate() {
                        *x = noise(first + j);
                    }
                    let jacobians = jacobians.to_vec();
                    let matrix = Mat::from_fn(m * n, m * n, |row, column| {
                        let a = t.a[row / n * m + column / n];
                        let identity = if row == column { 1.0 } else { 0.0 };
                        identity - h * a * jacobians[row * n + column % n]
                    });
                    sign *= matrix.determinant().signum();
                    stages.condense(i, &t, h, &mut vec![0.0; n * n]).unwrap();
                }
                let even = stages.negative().is_multiple_of(2);
                assert_eq!(even, sign > 0.0, "n = {n}, m = {m}, trial {trial}");
                seen[usize::from(even)] = true;
            }
        }
        assert_eq!(seen, [true, true]);
    }
}
