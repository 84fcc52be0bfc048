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
//!
//! Of M only the part of the free states ([`Chains`]) is factored. With d links from state c to the
//! free state u its blocks are
//!
//! ```text
//! M_vu = δ_vu I − Σ_c diag(J_vc) h^(d+1) A^(d+1)      over all c whose chain ends at u
//! ```
//!
//! and det M is the determinant of this part.

use crate::chains::{Chains, Watch};
use crate::dense::{self, SingularRow, add_scaled, dot};
use crate::free_states::{apply, expand, fill_matrix, gather_free, scatter_free};
use crate::iterate::SegmentIterate;
use crate::large::{self, LARGE};
use crate::parallel::{Buffers, for_each_run};
use crate::specialise::specialise;
use crate::tableau::Tableau;
use std::convert::Infallible;

/// What the work on one interval needs beside what is kept of it.
#[derive(Clone, Debug, Default)]
struct IntervalBuffers {
    /// The columns of Xᵀ of the free states, n × mf.
    rows: Vec<f64>,
    /// Right-hand sides of the free states, mf, and what is known of all, mn.
    work: Vec<f64>,
    /// For the factorisation of M where it is large.
    workspace: Option<large::Workspace>,
}

impl Buffers for IntervalBuffers {}

/// What is kept of the stages of one segment to condense residuals and to recover corrections.
#[derive(Clone, Debug)]
pub(crate) struct Condensation {
    /// States n, parameters k and unknowns of all stages of an interval, mn.
    n: usize,
    k: usize,
    size: usize,
    /// The free states, f of them, and those chained to them.
    chains: Chains,
    /// Unknowns of the stages of the free states, mf.
    free_size: usize,
    /// LU factors of M, (mf)² per interval, and their pivots, mf per interval; free states one after
    /// the other, each with all its stages.
    lu: Vec<f64>,
    pivots: Vec<usize>,
    /// Xᵀ, n × mn per interval.
    adjoint: Vec<f64>,
    /// J and `F_p` side by side at the stages, m × n × (n + k) per interval.
    jacobians: Vec<f64>,
    buffers: IntervalBuffers,
}

impl Condensation {
    /// Buffers for a segment with n states, k parameters, m stages.
    pub(crate) fn new(n: usize, k: usize, m: usize, intervals: usize) -> Self {
        let size = m * n;
        Self {
            n,
            k,
            size,
            chains: Chains::default(),
            free_size: 0,
            lu: vec![],
            pivots: vec![],
            adjoint: vec![0.0; intervals * n * size],
            jacobians: vec![0.0; intervals * size * (n + k)],
            buffers: IntervalBuffers::default(),
        }
    }

    /// The Jacobians at the stages of all intervals, to be filled before
    /// [`condense`](Self::condense).
    pub(crate) fn jacobians_mut(&mut self) -> &mut [f64] {
        &mut self.jacobians
    }

    /// The Jacobians at the stages of all intervals, as last filled.
    pub(crate) fn jacobians(&self) -> &[f64] {
        &self.jacobians
    }

    /// Chains the states that all Jacobians show to be chained, before [`condense`](Self::condense).
    pub(crate) fn chain(&mut self, watch: &Watch) {
        if self.chains.update(watch) {
            let m = self.size / self.n;
            let intervals = self.adjoint.len() / (self.n * self.size);
            let free_size = self.chains.free.len() * m;
            self.free_size = free_size;
            self.lu.resize(intervals * free_size * free_size, 0.0);
            self.pivots.resize(intervals * free_size, 0);
            self.buffers.rows.resize(self.n * free_size, 0.0);
            self.buffers.work.resize(free_size + self.size, 0.0);
            let large = free_size >= LARGE;
            self.buffers.workspace = large.then(|| large::Workspace::new(free_size));
        }
    }

    /// Eliminates the stages of all intervals of a mesh: factors every M, finds Xᵀ and the link
    /// \[I + Xᵀ J, Xᵀ F\]; fails with the first interval whose M is singular.
    pub(crate) fn condense(
        &mut self,
        t: &Tableau,
        mesh: &[f64],
        links: &mut [f64],
    ) -> Result<(), usize> {
        let (n, m, size, columns) = (self.n, t.stages, self.size, self.n + self.k);
        let (chains, free_size) = (&self.chains, self.free_size);
        let all_jacobians = &self.jacobians;
        let written = (
            (&mut self.lu[..], &mut self.pivots[..]),
            (&mut self.adjoint[..], links),
        );
        for_each_run(
            0..mesh.len() - 1,
            free_size * free_size * (free_size / 3 + n) + n * size * columns,
            written,
            &mut self.buffers,
            &move |run, ((lu, pivots), (adjoint, links)), buffers| {
                let IntervalBuffers {
                    rows, workspace, ..
                } = buffers;
                let written = lu
                    .chunks_exact_mut(free_size * free_size)
                    .zip(pivots.chunks_exact_mut(free_size))
                    .zip(adjoint.chunks_exact_mut(n * size))
                    .zip(links.chunks_exact_mut(n * columns));
                for (i, (((lu, pivots), adjoint), link)) in run.zip(written) {
                    let h = mesh[i + 1] - mesh[i];
                    let jacobians = &all_jacobians[i * size * columns..][..size * columns];
                    specialise!(m in [4, 5, 6, 7] => fill_matrix(t, chains, [m, n, columns], h, jacobians, lu));
                    match workspace {
                        Some(workspace) => large::lu_factor(lu, free_size, pivots, workspace),
                        None => dense::lu_factor(lu, free_size, pivots),
                    }
                    .map_err(|SingularRow(_)| i)?;
                    rows.fill(0.0);
                    for (row, &(end, links)) in rows.chunks_exact_mut(free_size).zip(&chains.ends) {
                        let factor = (0..links).fold(h, |power, _| power * h);
                        let weights = &t.weights[links * m..][..m];
                        add_scaled(&mut row[end * m..][..m], factor, weights);
                    }
                    if workspace.is_some() {
                        large::lu_solve_transposed(lu, free_size, pivots, rows);
                    } else {
                        dense::lu_solve_transposed(lu, free_size, pivots, rows);
                    }
                    specialise!(m in [4, 5, 6, 7] => expand(t, chains, [m, n, columns], h, jacobians, rows, adjoint));
                    link.fill(0.0);
                    for row in 0..n {
                        link[row * columns + row] = 1.0;
                    }
                    if workspace.is_some() {
                        large::add_product(link, adjoint, jacobians, size, columns);
                    } else {
                        specialise!(columns in [1, 2, 3, 4, 5, 6] => dense::add_product(link, adjoint, jacobians, size, columns));
                    }
                }
                Ok(())
            },
        )
    }

    /// The number of exchanges and of negative pivots of all M: odd if the product of their
    /// determinants is negative.
    pub(crate) fn negative(&self) -> usize {
        let size = self.free_size;
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
        let Ok(()) = for_each_run::<_, _, Infallible>(
            0..nodes.len() / n - 1,
            n * size,
            &mut nodes[n..],
            &mut (),
            &move |run, loads, ()| {
                let intervals = self.adjoint[run.start * n * size..]
                    .chunks_exact(n * size)
                    .zip(residual.stages[run.start * size..].chunks_exact(size))
                    .zip(residual.nodes[(run.start + 1) * n..].chunks_exact(n))
                    .zip(loads.chunks_exact_mut(n));
                for (((adjoint, r), c), g) in intervals {
                    for ((g, row), c) in g.iter_mut().zip(adjoint.chunks_exact(size)).zip(c) {
                        *g = -dot(row, r) - c;
                    }
                }
                Ok(())
            },
        );
    }

    /// The corrections of the stages, δK = M⁻¹ (J δy + F δp − r), once those of the nodes and of
    /// the parameters are known.
    pub(crate) fn recover(
        &mut self,
        t: &Tableau,
        mesh: &[f64],
        residual: &SegmentIterate,
        correction: &mut SegmentIterate,
        dp: &[f64],
    ) {
        let (n, m, size, columns) = (self.n, t.stages, self.size, self.n + self.k);
        let (chains, free_size) = (&self.chains, self.free_size);
        let (all_jacobians, all_lu, all_pivots) = (&self.jacobians, &self.lu, &self.pivots);
        let SegmentIterate { nodes, stages } = correction;
        let nodes = &*nodes;
        let Ok(()) = for_each_run::<_, _, Infallible>(
            0..mesh.len() - 1,
            size * columns + free_size * free_size,
            &mut stages[..],
            &mut self.buffers,
            &|run,
              stages,
              IntervalBuffers {
                  work, workspace, ..
              }| {
                let (free, known) = work.split_at_mut(free_size);
                let intervals = stages
                    .chunks_exact_mut(size)
                    .zip(nodes[run.start * n..].chunks_exact(n))
                    .zip(residual.stages[run.start * size..].chunks_exact(size))
                    .zip(all_jacobians[run.start * size * columns..].chunks_exact(size * columns))
                    .zip(mesh[run.start..].windows(2));
                for (i, ((((stages, dy), r), jacobians), ends)) in run.zip(intervals) {
                    specialise!(columns in [1, 2, 3, 4, 5, 6] => apply(jacobians, columns, dy, dp, r, stages));
                    let h = ends[1] - ends[0];
                    specialise!(m in [4, 5, 6, 7] => gather_free(t, chains, [m, n, columns], h, jacobians, stages, free, known));
                    let lu = &all_lu[i * free_size * free_size..][..free_size * free_size];
                    let pivots = &all_pivots[i * free_size..][..free_size];
                    if workspace.is_some() {
                        large::lu_solve(lu, free_size, pivots, free);
                    } else {
                        dense::lu_solve(lu, free_size, pivots, free);
                    }
                    specialise!(m in [4, 5, 6, 7] => scatter_free(t, chains, [m, n, columns], h, free, stages));
                }
                Ok(())
            },
        );
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
                let mut mesh = vec![0.0];
                let mut watch = Watch::new(n);
                let all = stages.jacobians_mut().chunks_exact_mut(m * n * n);
                for (i, jacobians) in all.enumerate() {
                    // Intervals far too long for these equations.
                    let h = 10.0 * (1.0 + noise(trial + 31 * i));
                    mesh.push(mesh[i] + h);
                    let h = mesh[i + 1] - mesh[i];
                    for (j, x) in jacobians.iter_mut().enumerate() {
                        *x = noise(1000 * trial + 100 * i + j);
                    }
                    watch.look(jacobians, n, n);
                    let matrix = Mat::from_fn(m * n, m * n, |row, column| {
                        let a = t.a[row / n * m + column / n];
                        let identity = if row == column { 1.0 } else { 0.0 };
                        identity - h * a * jacobians[row * n + column % n]
                    });
                    sign *= matrix.determinant().signum();
                }
                stages.chain(&watch);
                let links = &mut vec![0.0; intervals * n * n];
                stages.condense(&t, &mesh, links).unwrap();
                let even = stages.negative().is_multiple_of(2);
                assert_eq!(even, sign > 0.0, "n = {n}, m = {m}, trial {trial}");
                seen[usize::from(even)] = true;
            }
        }
        assert_eq!(seen, [true, true]);
    }
}
