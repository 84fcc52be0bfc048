//! The transition blocks of one segment: the elimination of its interior nodes by Householder reflections.
//!
//! Notation of [`almost_block_diagonal`](super::almost_block_diagonal).

use crate::kernels::dense::{add_scaled, dot};
use crate::kernels::reflections::{Blocks, MANY, eliminate};
use crate::kernels::room::make_room;
use crate::kernels::specialise::{outlined, specialise};
use crate::newton_matrix::balance::balance;

/// The transition blocks of one segment and their elimination.
#[derive(Clone, Debug)]
pub(crate) struct Transitions {
    /// States n.
    pub(super) n: usize,
    /// Parameters k.
    pub(super) k: usize,
    /// \[Γᵢ Pᵢ\], n × (n + k) per interval: the derivatives of yᵢ₊₁ with respect to yᵢ and p.
    blocks: Vec<f64>,
    /// Householder vectors below the diagonal and R on and above it, 2n × n per interior node.
    panels: Vec<f64>,
    /// Factors τ of the reflections I − τ v vᵀ, n per interior node.
    tau: Vec<f64>,
    /// \[E F H\], n × (2n + k) per interior node.
    couplings: Vec<f64>,
    /// \[A B C\], the equation between both ends and the parameters that remains, n × (2n + k).
    pub(super) reduced: Vec<f64>,
    /// The 2n rows in which a node is eliminated, 2n × (3n + k).
    work: Vec<f64>,
    /// One row of `work`, or 2n right-hand sides.
    row: Vec<f64>,
    /// Buffers for the elimination in blocks, where there are many states.
    reflections: Option<Blocks>,
    /// The units of the states, all one unless they are `balanced`: see [`balance`].
    pub(super) units: Vec<f64>,
    /// Whether the states are of very different size.
    pub(super) balanced: bool,
}

impl Transitions {
    pub(super) fn new(n: usize, k: usize) -> Self {
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
    pub(super) fn resize(&mut self, intervals: usize) {
        let (n, k, interior) = (self.n, self.k, intervals - 1);
        make_room(&mut self.blocks, intervals * n * (n + k));
        make_room(&mut self.panels, interior * 2 * n * n);
        make_room(&mut self.tau, interior * n);
        make_room(&mut self.couplings, interior * n * (2 * n + k));
    }

    /// The blocks \[Γ P\] of all intervals, to be filled before [`AlmostBlockDiagonal::factor`].
    pub(crate) fn blocks_mut(&mut self) -> &mut [f64] {
        &mut self.blocks
    }

    /// Eliminates all interior nodes; fails with the node whose R is singular.
    pub(super) fn eliminate(&mut self) -> Result<(), usize> {
        let n = self.n;
        let k = self.k;
        let sizes = &mut self.work[..n * n];
        self.balanced = balance(&mut self.blocks, k, &mut self.units, sizes);
        specialise!(n in [1, 2, 3, 4, 5, 6, 7] => specialise!(k in [0] => outlined(|| self.eliminate_nodes(n, k))))
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
    pub(super) fn forward(&mut self, nodes: &mut [f64], reduced: &mut [f64]) {
        let n = self.n;
        if self.balanced {
            for node in nodes.chunks_exact_mut(n) {
                let each = node.iter_mut().zip(&self.units);
                each.for_each(|(g, unit)| *g /= unit);
            }
        }
        specialise!(n in [1, 2, 3, 4, 5, 6, 7] => outlined(|| self.forward_nodes(n, nodes, reduced)));
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
    pub(super) fn negative(&self) -> usize {
        let n = self.n;
        let diagonals = self.panels.chunks_exact(2 * n * n);
        let diagonals = diagonals.flat_map(|panel| panel[..n * n].iter().step_by(n + 1));
        diagonals.filter(|entry| **entry < 0.0).count()
    }

    /// The smallest entry on the diagonals of all R relative to the norm of its column.
    pub(super) fn smallest_pivot(&self) -> f64 {
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
    pub(super) fn backward(&self, nodes: &mut [f64], p: &[f64]) {
        let n = self.n;
        let k = self.k;
        specialise!(n in [1, 2, 3, 4, 5, 6, 7] => specialise!(k in [0] => outlined(|| self.backward_nodes(n, k, nodes, p))));
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
