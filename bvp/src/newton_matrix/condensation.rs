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
//! With Xᵀ = h (bᵀ ⊗ I) M⁻¹ a transition block between the two nodes is left,
//!
//! ```text
//! δyᵢ₊₁ = (I + Xᵀ J) δyᵢ + (Xᵀ F_p) δp − Xᵀ r − c
//! ```
//!
//! so only n systems with Mᵀ are solved per interval, whatever the number of parameters. Ascher,
//! Mattheij & Russell (1995), section 5.6.
//!
//! Only the part of M that belongs to the free states is factored ([`StageReduction`]). Where `C_c` times the
//! free state u is the derivative of order d of state c, its blocks are
//!
//! ```text
//! M_vu = δ_vu I − Σ_c C_c diag(J_vc) h^(d+1) A^(d+1)      over all c whose highest derivative is u
//! ```
//!
//! and det M is the determinant of this part. Quadratures, on which no right-hand side depends, are no free states
//! either, and nor are followers c, which depend on one free state s only; these add `−diag(J_vc) h² A diag(J_cs) A`
//! to `M_vs`.
//!
//! There are many intervals with small matrices, so that loops cost more than arithmetic. The functions
//! are therefore compiled for fixed numbers of stages, of states and for a single free state with the
//! schemes that the solver chooses by itself, and for fixed numbers of stages with the others.

use crate::discretisation::iterate::SegmentIterate;
use crate::discretisation::tableau::Tableau;
use crate::kernels::blocked;
use crate::kernels::dense::{self, dot};
use crate::kernels::lu::lu;
use crate::kernels::parallel::{Buffers, for_each_run};
use crate::kernels::room::make_room;
use crate::kernels::specialise::{outlined, specialise};
use crate::newton_matrix::derivative_states::{ObservedJacobians, StageReduction};
use crate::newton_matrix::stage_system::StageSystem;
use std::convert::Infallible;
use std::ops::Range;

/// Scratch space for the work on one interval.
#[derive(Clone, Debug, Default)]
struct IntervalBuffers {
    /// The columns of Xᵀ of the free states, n × mf.
    rows: Vec<f64>,
    /// Right-hand sides of the free states, mf, and what is known of all, mn.
    work: Vec<f64>,
    /// For the factorisation of M.
    workspace: lu::Workspace,
}

impl Buffers for IntervalBuffers {}

/// The stages of one segment: the factors that condense residuals and recover corrections.
#[derive(Clone, Debug)]
pub(crate) struct Condensation {
    /// States n, parameters k and unknowns of all stages of an interval, mn.
    n: usize,
    k: usize,
    size: usize,
    /// The free states, f of them, and the derivative states.
    reduction: StageReduction,
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
    /// For a segment with n states, k parameters, m stages, without any intervals.
    pub(crate) fn new(n: usize, k: usize, m: usize) -> Self {
        Self {
            n,
            k,
            size: m * n,
            reduction: StageReduction::default(),
            free_size: 0,
            lu: vec![],
            pivots: vec![],
            adjoint: vec![],
            jacobians: vec![],
            buffers: IntervalBuffers::default(),
        }
    }

    /// Makes room for a number of intervals.
    pub(crate) fn resize(&mut self, intervals: usize) {
        let Self { n, k, size, .. } = *self;
        make_room(&mut self.adjoint, intervals * n * size);
        make_room(&mut self.jacobians, intervals * size * (n + k));
        self.resize_free();
    }

    /// Makes room for the systems of the free states.
    fn resize_free(&mut self) {
        let intervals = self.adjoint.len() / (self.n * self.size);
        let free_size = self.free_size;
        make_room(&mut self.lu, intervals * free_size * free_size);
        make_room(&mut self.pivots, intervals * free_size);
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

    /// Treats states whose rows are the same unit vector in all Jacobians as derivative states. To be
    /// called before [`condense`](Self::condense).
    pub(crate) fn reduce_order(&mut self, observed: &ObservedJacobians) {
        if self.reduction.update(observed) {
            let free_size = self.reduction.free.len() * self.size / self.n;
            self.free_size = free_size;
            self.resize_free();
            self.buffers.rows.resize(self.n * free_size, 0.0);
            self.buffers.work.resize(free_size + self.size, 0.0);
            self.buffers.workspace = lu::Workspace::new(free_size);
        }
    }

    /// Eliminates the stages of all intervals of a mesh: factors every M, finds Xᵀ and the
    /// transition block \[I + Xᵀ J, Xᵀ F\]; fails with the first interval whose M is singular.
    pub(crate) fn condense(
        &mut self,
        t: &Tableau,
        mesh: &[f64],
        transitions: &mut [f64],
    ) -> Result<(), usize> {
        let (n, k, m, size, columns) = (self.n, self.k, t.stages, self.size, self.n + self.k);
        let (reduction, f, free_size) =
            (&self.reduction, self.reduction.free.len(), self.free_size);
        let jacobians = &self.jacobians;
        let written = (
            (&mut self.lu[..], &mut self.pivots[..]),
            (&mut self.adjoint[..], transitions),
        );
        for_each_run(
            0..mesh.len() - 1,
            free_size * free_size * (free_size / 3 + n) + n * size * columns,
            written,
            &mut self.buffers,
            &move |run, written, buffers| {
                specialise!(m in [6, 7] => specialise!(n in [1, 2, 3, 4, 5, 6, 7] => specialise!(f in [1] => specialise!(k in [0] =>
                    outlined(|| condense_run(StageSystem::new(t, reduction, [m, n, k, f]), run, mesh, jacobians, written, buffers))
                ))), else specialise!(m in [1, 2, 3, 4, 5] =>
                    outlined(|| condense_run(StageSystem::new(t, reduction, [m, n, k, f]), run, mesh, jacobians, written, buffers))
                ))
            },
        )
    }

    /// Whether a state is the derivative of another one, but for a constant factor.
    pub(crate) fn is_slope(&self, state: usize) -> bool {
        let mut sources = self.reduction.sources.iter();
        sources.any(|&(_, source, _)| source == state)
    }

    /// The number of exchanges and of negative pivots of all M: odd if the product of their
    /// determinants is negative.
    pub(crate) fn negative(&self) -> usize {
        let size = self.free_size;
        let intervals = self
            .lu
            .chunks_exact(size * size)
            .zip(self.pivots.chunks_exact(size));
        intervals
            .map(|(lu, pivots)| lu::negative(lu, size, pivots))
            .sum()
    }

    /// The right-hand sides −Xᵀ r − c of all transitions, into the slots of nodes 1 … N of `nodes`.
    pub(crate) fn reduce(&self, residual: &SegmentIterate, nodes: &mut [f64]) {
        let (n, m) = (self.n, self.size / self.n);
        let Ok(()) = for_each_run::<_, _, Infallible>(
            0..nodes.len() / n - 1,
            m * n * n,
            &mut nodes[n..],
            &mut (),
            &move |run, loads, ()| {
                specialise!(m in [6, 7] => specialise!(n in [1, 2, 3, 4, 5, 6, 7] => {
                    let size = m * n;
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
                }));
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
        let (n, k, m, size, columns) = (self.n, self.k, t.stages, self.size, self.n + self.k);
        let (reduction, f, free_size) =
            (&self.reduction, self.reduction.free.len(), self.free_size);
        let SegmentIterate { nodes, stages } = correction;
        let factored = (&self.jacobians[..], &self.lu[..], &self.pivots[..]);
        let known = (mesh, &nodes[..], dp, &residual.stages[..]);
        let Ok(()) = for_each_run::<_, _, Infallible>(
            0..mesh.len() - 1,
            size * columns + free_size * free_size,
            &mut stages[..],
            &mut self.buffers,
            &|run, stages, buffers| {
                specialise!(m in [6, 7] => specialise!(n in [1, 2, 3, 4, 5, 6, 7] => specialise!(f in [1] => specialise!(k in [0] =>
                    outlined(|| recover_run(StageSystem::new(t, reduction, [m, n, k, f]), run, factored, known, stages, buffers))
                ))), else specialise!(m in [1, 2, 3, 4, 5] =>
                    outlined(|| recover_run(StageSystem::new(t, reduction, [m, n, k, f]), run, factored, known, stages, buffers))
                ));
                Ok(())
            },
        );
    }
}

/// The results for a run of intervals: factors of M with pivots, and Xᵀ with the transition blocks.
type Condensed<'a> = (
    (&'a mut [f64], &'a mut [usize]),
    (&'a mut [f64], &'a mut [f64]),
);

/// Eliminates the stages of a run of intervals; fails with the first one whose M is singular.
#[inline(always)]
fn condense_run(
    system: StageSystem<'_>,
    run: Range<usize>,
    mesh: &[f64],
    jacobians: &[f64],
    ((lu, pivots), (adjoint, transitions)): Condensed<'_>,
    buffers: &mut IntervalBuffers,
) -> Result<(), usize> {
    let StageSystem { m, n, k, f, .. } = system;
    let (size, free_size, columns) = (m * n, m * f, n + k);
    let workspace = &mut buffers.workspace;
    let rows = &mut buffers.rows[..n * free_size];
    for (place, i) in run.enumerate() {
        let h = mesh[i + 1] - mesh[i];
        let jacobians = &jacobians[i * size * columns..][..size * columns];
        let lu = &mut lu[place * free_size * free_size..][..free_size * free_size];
        let pivots = &mut pivots[place * free_size..][..free_size];
        let adjoint = &mut adjoint[place * n * size..][..n * size];
        let transition = &mut transitions[place * n * columns..][..n * columns];
        system.fill_matrix(h, jacobians, lu);
        system.fill_weights(h, jacobians, rows);
        lu::factor_and_solve_transposed(lu, free_size, pivots, rows, workspace).map_err(|_| i)?;
        system.expand(h, jacobians, rows, adjoint);
        transition.fill(0.0);
        for row in 0..n {
            transition[row * columns + row] = 1.0;
        }
        if free_size >= lu::LARGE {
            blocked::add_product(transition, adjoint, jacobians, size, columns);
        } else {
            specialise!(k in [0, 1] => dense::add_product(transition, adjoint, jacobians, size, n + k));
        }
    }
    Ok(())
}

/// The corrections of the stages of a run of intervals from all Jacobians, factors and pivots, and from
/// the mesh, the corrections of the nodes and of the parameters and the residuals of the stages.
#[inline(always)]
fn recover_run(
    system: StageSystem<'_>,
    run: Range<usize>,
    (jacobians, lu, pivots): (&[f64], &[f64], &[usize]),
    (mesh, nodes, dp, residuals): (&[f64], &[f64], &[f64], &[f64]),
    stages: &mut [f64],
    buffers: &mut IntervalBuffers,
) {
    let StageSystem { m, n, k, f, .. } = system;
    let (size, free_size, columns) = (m * n, m * f, n + k);
    let (free, known) = buffers.work.split_at_mut(free_size);
    let known = &mut known[..size];
    for (place, i) in run.enumerate() {
        let h = mesh[i + 1] - mesh[i];
        let jacobians = &jacobians[i * size * columns..][..size * columns];
        let lu = &lu[i * free_size * free_size..][..free_size * free_size];
        let pivots = &pivots[i * free_size..][..free_size];
        let (dy, r) = (&nodes[i * n..][..n], &residuals[i * size..][..size]);
        let stages = &mut stages[place * size..][..size];
        system.apply(jacobians, dy, dp, r, stages);
        system.gather_free(h, jacobians, stages, free, known);
        lu::solve(lu, free_size, pivots, free);
        system.scatter_free(h, jacobians, free, stages);
    }
}

#[cfg(test)]
mod tests;
