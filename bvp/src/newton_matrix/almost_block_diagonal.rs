//! The Newton matrix: almost block diagonal with a border, by structured orthogonal elimination.
//!
//! After the stages are condensed, the linearised problem on a segment with N intervals has one
//! transition block Γᵢ between each pair of neighbouring nodes. The conditions on all ends and the
//! parameters form a dense border:
//!
//! ```text
//!   δy₀   δy₁   δy₂  …  δy_N │ δp
//! ┌ −Γ₀    I                 │ −P₀ ┐   g₀
//! │       −Γ₁    I           │ −P₁ │   g₁
//! │             ⋱    ⋱       │  ⋮  │   ⋮
//! │              −Γ_N₋₁   I  │     │   g_N₋₁
//! ├──────────────────────────┼─────┤
//! └  C₀                  C_N │ C_p ┘   −r       (all segments)
//! ```
//!
//! Each interior node is eliminated by Householder reflections of the 2n rows that contain it,
//!
//! ```text
//!   δyᵢ   δyᵢ₊₁  δy₀   δp                  δyᵢ   δyᵢ₊₁  δy₀   δp
//! ┌  B     0     A     C  ┐            ┌   R     E      F     H  ┐   kept for back-substitution
//! └ −Γᵢ    I     0    −Pᵢ ┘   ──Qᵀ──▶  └   0     B'     A'    C' ┘   from y₀ to yᵢ₊₁
//! ```
//!
//! which leaves one equation A δy₀ + `B δy_N` + C δp = d per segment. These equations and the conditions
//! form a dense system for all ends and parameters. Eliminating with orthogonal transformations is
//! stable where row-pivoted block elimination loses all digits: S. J. Wright, "A collection of
//! problems for which Gaussian elimination with partial pivoting is unstable", SIAM J. Sci.
//! Comput. 14 (1993) 231-238; the method is that of S. J. Wright, "Stable parallel algorithms for
//! two-point boundary value problems", SIAM J. Sci. Stat. Comput. 13 (1992) 742-764.

use crate::discretisation::iterate::Iterate;
use crate::kernels::dense::{add_scaled, dot};
use crate::kernels::reflections::{Blocks, MANY, eliminate};
use crate::kernels::specialise::specialise;
use crate::newton_matrix::balance::balance;
use crate::newton_matrix::dependence::Dependence;
use crate::newton_matrix::end_system::EndSystem;
use crate::newton_matrix::singular::Singular;
use crate::problem::problem::Segment;

/// The transition blocks of one segment and their elimination.
#[derive(Clone, Debug)]
pub(crate) struct Transitions {
    /// States n.
    n: usize,
    /// Parameters k.
    k: usize,
    /// \[Γᵢ Pᵢ\], n × (n + k) per interval: the derivatives of yᵢ₊₁ with respect to yᵢ and p.
    blocks: Vec<f64>,
    /// Householder vectors below the diagonal and R on and above it, 2n × n per interior node.
    panels: Vec<f64>,
    /// Factors τ of the reflections I − τ v vᵀ, n per interior node.
    tau: Vec<f64>,
    /// \[E F H\], n × (2n + k) per interior node.
    couplings: Vec<f64>,
    /// \[A B C\], the equation between both ends and the parameters that remains, n × (2n + k).
    reduced: Vec<f64>,
    /// The 2n rows in which a node is eliminated, 2n × (3n + k).
    work: Vec<f64>,
    /// One row of `work`, or 2n right-hand sides.
    row: Vec<f64>,
    /// Buffers for the elimination in blocks, where there are many states.
    reflections: Option<Blocks>,
    /// The units of the states, all one unless they are `balanced`: see [`balance`].
    units: Vec<f64>,
    /// Whether the states are of very different size.
    balanced: bool,
}

impl Transitions {
    fn new(n: usize, k: usize) -> Self {
        Self {
            n,
            k,
            blocks: vec![],
            panels: vec![],
            tau: vec![],
            couplings: vec![],
            reduced: vec![0.0; n * (2 * n + k)],
            work: vec![0.0; 2 * n * (3 * n + k)],
            row: vec![0.0; 3 * n + k],
            reflections: (n >= MANY).then(|| Blocks::new(2 * n, 3 * n + k)),
            units: vec![1.0; n],
            balanced: false,
        }
    }

    /// Makes room for a number of intervals.
    fn resize(&mut self, intervals: usize) {
        let (n, k, interior) = (self.n, self.k, intervals - 1);
        self.blocks.resize(intervals * n * (n + k), 0.0);
        self.panels.resize(interior * 2 * n * n, 0.0);
        self.tau.resize(interior * n, 0.0);
        self.couplings.resize(interior * n * (2 * n + k), 0.0);
    }

    /// The blocks \[Γ P\] of all intervals, to be filled before [`AlmostBlockDiagonal::factor`].
    pub(crate) fn blocks_mut(&mut self) -> &mut [f64] {
        &mut self.blocks
    }

    /// Eliminates all interior nodes; fails with the node whose R is singular.
    fn eliminate(&mut self) -> Result<(), usize> {
        let n = self.n;
        let k = self.k;
        let sizes = &mut self.work[..n * n];
        self.balanced = balance(&mut self.blocks, k, &mut self.units, sizes);
        specialise!(n in [1, 2, 3, 4, 5, 6] => specialise!(k in [0] => self.eliminate_nodes(n, k)))
    }

    /// [`eliminate`](Self::eliminate) for values of n and k that the compiler may know.
    #[inline(always)]
    fn eliminate_nodes(&mut self, n: usize, k: usize) -> Result<(), usize> {
        let width = 3 * n + k;
        let block_size = n * (n + k);
        let work = &mut self.work[..2 * n * width];
        // The first interval: −Γ₀ δy₀ + δy₁ − P₀ δp = g₀.
        for i in 0..n {
            let row = &mut self.reduced[i * (2 * n + k)..][..2 * n + k];
            let row_of_block = &self.blocks[i * (n + k)..][..n + k];
            row.fill(0.0);
            add_scaled(&mut row[..n], -1.0, &row_of_block[..n]);
            row[n + i] = 1.0;
            add_scaled(&mut row[2 * n..], -1.0, &row_of_block[n..]);
        }
        let nodes = self
            .panels
            .chunks_exact_mut(2 * n * n)
            .zip(self.tau.chunks_exact_mut(n))
            .zip(self.couplings.chunks_exact_mut(n * (2 * n + k)))
            .zip(self.blocks.chunks_exact(block_size).skip(1));
        for (interior, (((panel, tau), coupling), block)) in nodes.enumerate() {
            // Columns of the work rows: δyᵢ, δyᵢ₊₁, δy₀, δp.
            let (top, bottom) = work.split_at_mut(n * width);
            for (i, row) in top.chunks_exact_mut(width).enumerate() {
                let reduced = &self.reduced[i * (2 * n + k)..][..2 * n + k];
                row[..n].copy_from_slice(&reduced[n..2 * n]);
                row[n..2 * n].fill(0.0);
                row[2 * n..3 * n].copy_from_slice(&reduced[..n]);
                row[3 * n..].copy_from_slice(&reduced[2 * n..]);
            }
            for (i, row) in bottom.chunks_exact_mut(width).enumerate() {
                let row_of_block = &block[i * (n + k)..][..n + k];
                row.fill(0.0);
                add_scaled(&mut row[..n], -1.0, &row_of_block[..n]);
                row[n + i] = 1.0;
                add_scaled(&mut row[3 * n..], -1.0, &row_of_block[n..]);
            }
            match &mut self.reflections {
                Some(reflections) => reflections.eliminate(work, width, tau),
                None => eliminate(work, width, tau, &mut self.row[..width]),
            }
            .ok_or(interior + 1)?;
            for (panel, row) in panel.chunks_exact_mut(n).zip(work.chunks_exact(width)) {
                panel.copy_from_slice(&row[..n]);
            }
            let (top, bottom) = work.split_at(n * width);
            for (coupling, row) in coupling
                .chunks_exact_mut(2 * n + k)
                .zip(top.chunks_exact(width))
            {
                coupling.copy_from_slice(&row[n..]);
            }
            for (reduced, row) in self
                .reduced
                .chunks_exact_mut(2 * n + k)
                .zip(bottom.chunks_exact(width))
            {
                reduced[..n].copy_from_slice(&row[2 * n..3 * n]);
                reduced[n..2 * n].copy_from_slice(&row[n..2 * n]);
                reduced[2 * n..].copy_from_slice(&row[3 * n..]);
            }
        }
        Ok(())
    }

    /// Applies the elimination to the right-hand sides gᵢ, which are in the slots of nodes i + 1. Those of
    /// the interior nodes stay in their slots; that of the remaining equation goes into `reduced`.
    fn forward(&mut self, nodes: &mut [f64], reduced: &mut [f64]) {
        let n = self.n;
        if self.balanced {
            for node in nodes.chunks_exact_mut(n) {
                let each = node.iter_mut().zip(&self.units);
                each.for_each(|(g, unit)| *g /= unit);
            }
        }
        specialise!(n in [1, 2, 3, 4, 5, 6] => self.forward_nodes(n, nodes, reduced));
    }

    /// [`forward`](Self::forward) for values of n that the compiler may know.
    #[inline(always)]
    fn forward_nodes(&mut self, n: usize, nodes: &mut [f64], reduced: &mut [f64]) {
        let (reduced, stacked) = (&mut reduced[..n], &mut self.row[..2 * n]);
        reduced.copy_from_slice(&nodes[n..2 * n]);
        let factors = self
            .panels
            .chunks_exact(2 * n * n)
            .zip(self.tau.chunks_exact(n));
        for (i, (panel, tau)) in factors.enumerate() {
            let node = i + 1;
            stacked[..n].copy_from_slice(reduced);
            stacked[n..].copy_from_slice(&nodes[(node + 1) * n..][..n]);
            for (j, tau) in tau.iter().enumerate() {
                let mut product = stacked[j];
                for r in j + 1..2 * n {
                    product += panel[r * n + j] * stacked[r];
                }
                product *= tau;
                stacked[j] -= product;
                for r in j + 1..2 * n {
                    stacked[r] -= panel[r * n + j] * product;
                }
            }
            nodes[node * n..][..n].copy_from_slice(&stacked[..n]);
            reduced.copy_from_slice(&stacked[n..]);
        }
    }

    /// The number of negative entries on the diagonals of all R.
    fn negative(&self) -> usize {
        let n = self.n;
        let diagonals = self.panels.chunks_exact(2 * n * n);
        let diagonals = diagonals.flat_map(|panel| panel[..n * n].iter().step_by(n + 1));
        diagonals.filter(|entry| **entry < 0.0).count()
    }

    /// The smallest entry on the diagonals of all R relative to the norm of its column.
    fn smallest_pivot(&self) -> f64 {
        let n = self.n;
        let relative = |r: &[f64], j: usize| {
            let square: f64 = (0..=j).map(|i| r[i * n + j] * r[i * n + j]).sum();
            r[j * n + j].abs() / square.sqrt()
        };
        let panels = self.panels.chunks_exact(2 * n * n);
        panels
            .flat_map(|r| (0..n).map(move |j| relative(r, j)))
            .fold(f64::INFINITY, f64::min)
    }

    /// Finds the interior nodes from both ends (already in their slots) and the parameters.
    fn backward(&self, nodes: &mut [f64], p: &[f64]) {
        let n = self.n;
        let k = self.k;
        specialise!(n in [1, 2, 3, 4, 5, 6] => specialise!(k in [0] => self.backward_nodes(n, k, nodes, p)));
        if self.balanced {
            for node in nodes.chunks_exact_mut(n) {
                let each = node.iter_mut().zip(&self.units);
                each.for_each(|(y, unit)| *y *= unit);
            }
        }
    }

    /// [`backward`](Self::backward) for values of n and k that the compiler may know.
    #[inline(always)]
    fn backward_nodes(&self, n: usize, k: usize, nodes: &mut [f64], p: &[f64]) {
        let factors = self
            .panels
            .chunks_exact(2 * n * n)
            .zip(self.couplings.chunks_exact(n * (2 * n + k)));
        for (i, (panel, coupling)) in factors.enumerate().rev() {
            let node = i + 1;
            let (known, next) = nodes.split_at_mut((node + 1) * n);
            let (start, known) = known.split_at_mut(n);
            let x = &mut known[(node - 1) * n..];
            for j in (0..n).rev() {
                let row = &coupling[j * (2 * n + k)..][..2 * n + k];
                let sum = dot(&row[..n], &next[..n])
                    + dot(&row[n..2 * n], start)
                    + dot(&row[2 * n..], p)
                    + dot(&panel[j * n + j + 1..(j + 1) * n], &x[j + 1..]);
                x[j] = (x[j] - sum) / panel[j * n + j];
            }
        }
    }
}

/// The whole matrix: one [`Transitions`] per segment and the dense system of all ends and parameters.
#[derive(Clone, Debug)]
pub(crate) struct AlmostBlockDiagonal {
    transitions: Vec<Transitions>,
    /// Parameters k.
    k: usize,
    /// The end system of Σ 2n + k unknowns: first the remaining equations of the segments, then the
    /// conditions.
    ends: EndSystem,
    /// Right-hand side and solution of the end system.
    unknowns: Vec<f64>,
}

impl AlmostBlockDiagonal {
    /// For segments with the given numbers of states, k parameters and a number of conditions, which is
    /// Σ n + k, or one fewer for a matrix with a null vector. There are no intervals yet.
    pub(crate) fn new(states: impl Iterator<Item = usize>, k: usize, conditions: usize) -> Self {
        let transitions: Vec<_> = states.map(|n| Transitions::new(n, k)).collect();
        let states: usize = transitions.iter().map(|of| of.n).sum();
        let unknowns = 2 * states + k;
        Self {
            transitions,
            k,
            ends: EndSystem::new(states + conditions, unknowns),
            unknowns: vec![0.0; unknowns],
        }
    }

    /// Makes room for the given numbers of intervals of the segments.
    pub(crate) fn resize(&mut self, intervals: impl Iterator<Item = usize>) {
        for (transitions, intervals) in self.transitions.iter_mut().zip(intervals) {
            transitions.resize(intervals);
        }
    }

    /// The transition blocks of one segment.
    pub(crate) fn transitions_mut(&mut self, segment: usize) -> &mut Transitions {
        &mut self.transitions[segment]
    }

    /// Factors the matrix from the filled transition blocks and the Jacobian of the conditions. Its rows
    /// have Σ 2n + k columns: start and end of each segment in turn, then the parameters.
    pub(crate) fn factor(&mut self, conditions: &[f64]) -> Result<(), Singular> {
        let size = self.unknowns.len();
        let ends = self.ends.matrix_mut();
        ends.fill(0.0);
        let (mut row, mut column) = (0, 0);
        for (segment, transitions) in self.transitions.iter_mut().enumerate() {
            transitions
                .eliminate()
                .map_err(|node| Singular::Node { segment, node })?;
            let (n, k) = (transitions.n, transitions.k);
            for reduced in transitions.reduced.chunks_exact(2 * n + k) {
                let end_row = &mut ends[row * size..][..size];
                end_row[column..column + 2 * n].copy_from_slice(&reduced[..2 * n]);
                end_row[size - k..].copy_from_slice(&reduced[2 * n..]);
                row += 1;
            }
            column += 2 * n;
        }
        let conditions_rows = &mut ends[row * size..];
        conditions_rows.copy_from_slice(conditions);
        let mut column = 0;
        for of_segment in &self.transitions {
            let n = of_segment.n;
            if of_segment.balanced {
                for row in conditions_rows.chunks_exact_mut(size) {
                    for of_end in row[column..column + 2 * n].chunks_exact_mut(n) {
                        let each = of_end.iter_mut().zip(&of_segment.units);
                        each.for_each(|(x, unit)| *x *= unit);
                    }
                }
            }
            column += 2 * n;
        }
        self.ends.factor()
    }

    /// Which conditions depend on each other and which unknown is left free, after the end system has
    /// proved singular.
    pub(crate) fn dependence(&self, segments: &[Segment]) -> Dependence {
        let first = segments.iter().map(|segment| segment.states).sum();
        self.ends.dependence(first, segments)
    }

    /// Solves with the factored matrix. On entry the slot of node i + 1 of `x` holds gᵢ and
    /// `r` the residuals of the conditions; on return `x` holds all δy and δp.
    pub(crate) fn solve(&mut self, x: &mut Iterate, r: &[f64]) {
        let mut row = 0;
        for (transitions, segment) in self.transitions.iter_mut().zip(&mut x.segments) {
            transitions.forward(
                &mut segment.nodes,
                &mut self.unknowns[row..row + transitions.n],
            );
            row += transitions.n;
        }
        for (unknown, r) in self.unknowns[row..].iter_mut().zip(r) {
            *unknown = -r;
        }
        self.ends.solve(&mut self.unknowns);
        self.backward(x);
    }

    /// The smallest pivot of the last factorisation relative to the largest entry, or the norm, of its
    /// column before. If no pivot is small, the matrix is well conditioned, at least node by node.
    pub(crate) fn smallest_pivot(&self) -> f64 {
        let pivots = self.transitions.iter().map(Transitions::smallest_pivot);
        pivots.fold(self.ends.smallest_pivot(), f64::min)
    }

    /// The null vector t of a matrix J with one condition fewer, in the nodes and the parameters of
    /// `x`. Its direction is such that det \[J; tᵀ\] has one sign for all matrices of a size.
    ///
    /// Let Q eliminate the interior nodes, tₑ be the part of t at the ends and E the matrix of the end
    /// system. Then det \[J; tᵀ\] has the sign of det Q Π det R det \[E; tₑᵀ\], because the row that the
    /// elimination makes of tᵀ has the product t · t > 0 with tₑ, and tₑᵀ itself has a positive product,
    /// too. The same holds for the elimination of the stages, whose determinants change the sign `stages`
    /// times.
    pub(crate) fn null_vector(&mut self, x: &mut Iterate, stages: usize) {
        let negative = stages
            + self.ends.null_vector(&mut self.unknowns)
            + self
                .transitions
                .iter()
                .map(Transitions::negative)
                .sum::<usize>();
        if negative % 2 == 1 {
            self.unknowns.iter_mut().for_each(|t| *t = -*t);
        }
        for segment in &mut x.segments {
            segment.nodes.fill(0.0);
        }
        self.backward(x);
    }

    /// Distributes the solution of the end system and finds the interior nodes from it.
    fn backward(&self, x: &mut Iterate) {
        x.p.copy_from_slice(&self.unknowns[self.unknowns.len() - self.k..]);
        let mut first = 0;
        for (transitions, segment) in self.transitions.iter().zip(&mut x.segments) {
            let (n, nodes) = (transitions.n, &mut segment.nodes);
            let last = nodes.len() - n;
            nodes[..n].copy_from_slice(&self.unknowns[first..first + n]);
            nodes[last..].copy_from_slice(&self.unknowns[first + n..first + 2 * n]);
            transitions.backward(nodes, &x.p);
            first += 2 * n;
        }
    }
}

#[cfg(test)]
mod tests;
