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
use crate::iterate::SegmentIterate;
use crate::large::{self, LARGE};
use crate::scheme::{MAX_STAGES, POWERS, Tableau};
use crate::specialise::specialise;

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
    /// The columns of Xᵀ of the free states, n × mf.
    rows: Vec<f64>,
    /// Right-hand sides of the free states, mf, and what is known of all, mn.
    work: Vec<f64>,
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
            chains: Chains::default(),
            free_size: 0,
            lu: vec![],
            pivots: vec![],
            adjoint: vec![0.0; intervals * n * size],
            jacobians: vec![0.0; intervals * size * (n + k)],
            rows: vec![],
            work: vec![],
            workspace: None,
        }
    }

    /// The Jacobians at the stages of interval i, to be filled before [`condense`](Self::condense).
    pub(crate) fn jacobians_mut(&mut self, i: usize) -> &mut [f64] {
        let size = self.size * (self.n + self.k);
        &mut self.jacobians[i * size..][..size]
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
            self.rows.resize(self.n * free_size, 0.0);
            self.work.resize(free_size + self.size, 0.0);
            self.workspace = (free_size >= LARGE).then(|| large::Workspace::new(free_size));
        }
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
        let (n, size, columns, free_size) = (self.n, self.size, self.n + self.k, self.free_size);
        let m = t.stages;
        let jacobians = &self.jacobians[i * size * columns..][..size * columns];
        let lu = &mut self.lu[i * free_size * free_size..][..free_size * free_size];
        let pivots = &mut self.pivots[i * free_size..][..free_size];
        let adjoint = &mut self.adjoint[i * n * size..][..n * size];
        let (chains, rows) = (&self.chains, &mut self.rows);
        specialise!(m in [4, 5, 6, 7] => fill_matrix(t, chains, [m, n, columns], h, jacobians, lu));
        match &mut self.workspace {
            Some(workspace) => large::lu_factor(lu, free_size, pivots, workspace)?,
            None => dense::lu_factor(lu, free_size, pivots)?,
        }
        rows.fill(0.0);
        for (row, &(end, links)) in rows.chunks_exact_mut(free_size).zip(&chains.ends) {
            let factor = h.powi(links as i32 + 1);
            add_scaled(
                &mut row[end * m..][..m],
                factor,
                &t.weights[links * m..][..m],
            );
        }
        if self.workspace.is_some() {
            large::lu_solve_transposed(lu, free_size, pivots, rows);
        } else {
            dense::lu_solve_transposed(lu, free_size, pivots, rows);
        }
        specialise!(m in [4, 5, 6, 7] => expand(t, chains, [m, n, columns], h, jacobians, rows, adjoint));
        link.fill(0.0);
        for row in 0..n {
            link[row * columns + row] = 1.0;
        }
        if self.workspace.is_some() {
            large::add_product(link, adjoint, jacobians, size, columns);
        } else {
            specialise!(columns in [1, 2, 3, 4, 5, 6] => dense::add_product(link, adjoint, jacobians, size, columns));
        }
        Ok(())
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
        &mut self,
        t: &Tableau,
        mesh: &[f64],
        residual: &SegmentIterate,
        correction: &mut SegmentIterate,
        dp: &[f64],
    ) {
        let (n, size, columns, free_size) = (self.n, self.size, self.n + self.k, self.free_size);
        let m = t.stages;
        let SegmentIterate { nodes, stages } = correction;
        let intervals = stages
            .chunks_exact_mut(size)
            .zip(nodes.chunks_exact(n))
            .zip(residual.stages.chunks_exact(size))
            .zip(self.jacobians.chunks_exact(size * columns))
            .zip(mesh.windows(2));
        let (chains, work) = (&self.chains, &mut self.work);
        let (free, known) = work.split_at_mut(free_size);
        for (i, ((((stages, dy), r), jacobians), ends)) in intervals.enumerate() {
            specialise!(columns in [1, 2, 3, 4, 5, 6] => apply(jacobians, columns, dy, dp, r, stages));
            let h = ends[1] - ends[0];
            specialise!(m in [4, 5, 6, 7] => gather_free(t, chains, [m, n, columns], h, jacobians, stages, free, known));
            let lu = &self.lu[i * free_size * free_size..][..free_size * free_size];
            let pivots = &self.pivots[i * free_size..][..free_size];
            if self.workspace.is_some() {
                large::lu_solve(lu, free_size, pivots, free);
            } else {
                dense::lu_solve(lu, free_size, pivots, free);
            }
            specialise!(m in [4, 5, 6, 7] => scatter_free(t, chains, [m, n, columns], h, free, stages));
        }
    }
}

/// The part of M of the free states.
#[inline(always)]
fn fill_matrix(
    t: &Tableau,
    chains: &Chains,
    [m, n, columns]: [usize; 3],
    h: f64,
    jacobians: &[f64],
    matrix: &mut [f64],
) {
    let free_size = chains.free.len() * m;
    let mut powers = [h; POWERS];
    for d in 1..POWERS {
        powers[d] = powers[d - 1] * h;
    }
    matrix.fill(0.0);
    for (v, rows) in matrix.chunks_exact_mut(m * free_size).enumerate() {
        for (j, row) in rows.chunks_exact_mut(free_size).enumerate() {
            let jacobian_row = &jacobians[(j * n + chains.free[v]) * columns..][..n];
            for (&slope, &(end, links)) in jacobian_row.iter().zip(&chains.ends) {
                let a = &t.powers[(links * m + j) * m..][..m];
                add_scaled(&mut row[end * m..][..m], -slope * powers[links], a);
            }
            row[v * m + j] += 1.0;
        }
    }
}

/// Xᵀ from its columns of the free states: for a chained state c and all that is chained to it
///
/// ```text
/// x_c = h b + h Aᵀ ( Σ_v diag(J_vc) x_v + Σ x_chained )      h b only in the row of c
/// ```
#[inline(always)]
fn expand(
    t: &Tableau,
    chains: &Chains,
    [m, n, columns]: [usize; 3],
    h: f64,
    jacobians: &[f64],
    rows: &[f64],
    adjoint: &mut [f64],
) {
    let free_size = chains.free.len() * m;
    let pairs = adjoint
        .chunks_exact_mut(m * n)
        .zip(rows.chunks_exact(free_size));
    for (row, (adjoint, free)) in pairs.enumerate() {
        for (x, &v) in free.chunks_exact(m).zip(&chains.free) {
            for (j, x) in x.iter().enumerate() {
                adjoint[j * n + v] = *x;
            }
        }
        for &(c, _) in chains.chained.iter().rev() {
            let mut sums = [0.0; MAX_STAGES];
            let sums = &mut sums[..m];
            for (j, sum) in sums.iter_mut().enumerate() {
                for &v in &chains.free {
                    *sum += jacobians[(j * n + v) * columns + c] * adjoint[j * n + v];
                }
                for &(chained, _) in chains.chained.iter().filter(|(_, source)| *source == c) {
                    *sum += adjoint[j * n + chained];
                }
            }
            let mut x = [0.0; MAX_STAGES];
            let x = &mut x[..m];
            for (sum, a) in sums.iter().zip(t.a.chunks_exact(m)) {
                add_scaled(x, h * *sum, a);
            }
            if c == row {
                add_scaled(x, h, &t.b);
            }
            for (j, x) in x.iter().enumerate() {
                adjoint[j * n + c] = *x;
            }
        }
    }
}

/// J δy + F δp − r into `stages`.
#[inline(always)]
fn apply(jacobians: &[f64], columns: usize, dy: &[f64], dp: &[f64], r: &[f64], stages: &mut [f64]) {
    let rows = stages.iter_mut().zip(jacobians.chunks_exact(columns));
    for ((slope, row), r) in rows.zip(r) {
        let terms = row.iter().zip(dy.iter().chain(dp));
        *slope = terms.map(|(a, x)| a * x).sum::<f64>() - r;
    }
}

/// The right-hand sides of the free states from those of all, which are those of a system where
/// every chained state c has its slopes
///
/// ```text
/// K_c = T_c + h^d A^d K_end,    T_c = ρ_c + h A T_source      without the last term if the source is free
/// ```
///
/// T is left in the place of ρ. `known` holds h A T.
#[expect(clippy::too_many_arguments, reason = "what an interval has, each once")]
#[inline(always)]
fn gather_free(
    t: &Tableau,
    chains: &Chains,
    [m, n, columns]: [usize; 3],
    h: f64,
    jacobians: &[f64],
    stages: &mut [f64],
    free: &mut [f64],
    known: &mut [f64],
) {
    for &(c, source) in &chains.chained {
        if chains.ends[source].1 > 0 {
            for j in 0..m {
                stages[j * n + c] += known[source * m + j];
            }
        }
        for (j, a) in t.a.chunks_exact(m).enumerate() {
            let sum: f64 = (0..m).map(|l| a[l] * stages[l * n + c]).sum();
            known[c * m + j] = h * sum;
        }
    }
    for (x, &v) in free.chunks_exact_mut(m).zip(&chains.free) {
        for (j, x) in x.iter_mut().enumerate() {
            *x = stages[j * n + v];
            for &(c, _) in &chains.chained {
                *x += jacobians[(j * n + v) * columns + c] * known[c * m + j];
            }
        }
    }
}

/// The slopes of all states from those of the free ones and T of the others.
#[inline(always)]
fn scatter_free(
    t: &Tableau,
    chains: &Chains,
    [m, n, _]: [usize; 3],
    h: f64,
    free: &[f64],
    stages: &mut [f64],
) {
    for (x, &v) in free.chunks_exact(m).zip(&chains.free) {
        for (j, x) in x.iter().enumerate() {
            stages[j * n + v] = *x;
        }
    }
    for &(c, _) in &chains.chained {
        let (end, links) = chains.ends[c];
        let factor = h.powi(links as i32);
        let slopes = &free[end * m..][..m];
        for (j, a) in t.powers[(links - 1) * m * m..][..m * m]
            .chunks_exact(m)
            .enumerate()
        {
            stages[j * n + c] += factor * dot(a, slopes);
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
                    let mut watch = Watch::new(n);
                    watch.look(&jacobians, n, n);
                    stages.chain(&watch);
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
