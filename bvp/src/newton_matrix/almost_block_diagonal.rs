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
use crate::newton_matrix::dependence::Dependence;
use crate::newton_matrix::end_system::EndSystem;
use crate::newton_matrix::singular::Singular;
use crate::newton_matrix::transitions::Transitions;
use crate::problem::problem::Segment;
use faer::Mat;

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

    /// What is left undetermined when the conditions C δy of a regular matrix are taken for C (I − P) δy, with
    /// projectors P on parts of the states at ends, which begin at the given columns.
    pub(crate) fn dependence_without(
        &self,
        ranges: &[(usize, Mat<f64>)],
        segments: &[Segment],
    ) -> Dependence {
        let first = segments.iter().map(|segment| segment.states).sum();
        let mut units = vec![];
        for of_segment in &self.transitions {
            units.extend_from_slice(&of_segment.units);
            units.extend_from_slice(&of_segment.units);
        }
        self.ends
            .dependence_without(first, ranges, &units, segments)
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
