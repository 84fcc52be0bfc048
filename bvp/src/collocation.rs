//! The discretised problem: residual, linearisation with condensed stages, Newton corrections.
//!
//! Unknown on each interval of length h are the state yᵢ at its left node and the m stage slopes
//! Kⱼ; the equations are
//!
//! ```text
//! Kⱼ − f(sᵢ + cⱼ h, yᵢ + h Σₗ aⱼₗ Kₗ, p) = 0        (stages)
//! yᵢ₊₁ − yᵢ − h Σⱼ bⱼ Kⱼ = 0                         (continuity)
//! ```
//!
//! With M = I − h (a ∘ J), J the Jacobians at the stages and Xᵀ = h (bᵀ ⊗ I) M⁻¹, eliminating the
//! stages of an interval leaves a link between its two nodes,
//!
//! ```text
//! δyᵢ₊₁ = (I + Xᵀ J) δyᵢ + (Xᵀ F_p) δp − Xᵀ r − c
//! ```
//!
//! so that only n systems with Mᵀ are solved per interval, whatever the number of parameters.
//! Ascher, Mattheij & Russell (1995), section 5.6 and 7.2.

use crate::almost_block_diagonal::{AlmostBlockDiagonal, Singular};
use crate::dense::{SingularRow, add_scaled, dot, lu_factor, lu_solve, lu_solve_transposed};
use crate::mesh::Mesh;
use crate::scheme::Tableau;
use crate::{Ends, Equations, Guess, Segment, Stats};

/// The unknowns of the discretised problem, or a correction of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Iterate {
    pub(crate) segments: Vec<SegmentIterate>,
    /// Parameters p.
    pub(crate) p: Vec<f64>,
}

/// The unknowns of one segment with N intervals.
#[derive(Clone, Debug, Default)]
pub(crate) struct SegmentIterate {
    /// States at the nodes, (N + 1) × n.
    pub(crate) nodes: Vec<f64>,
    /// Stage slopes dy/ds, N × m × n.
    pub(crate) stages: Vec<f64>,
}

impl Iterate {
    /// Zeros, for the given segments, mesh, stages and number of parameters.
    pub(crate) fn zeros(segments: &[Segment], mesh: &Mesh, stages: usize, k: usize) -> Self {
        let segments = segments
            .iter()
            .zip(mesh)
            .map(|(segment, nodes)| SegmentIterate {
                nodes: vec![0.0; nodes.len() * segment.states],
                stages: vec![0.0; (nodes.len() - 1) * stages * segment.states],
            })
            .collect();
        Self {
            segments,
            p: vec![0.0; k],
        }
    }

    /// self ← x + factor · correction.
    pub(crate) fn set_sum(&mut self, x: &Self, factor: f64, correction: &Self) {
        let set = |target: &mut [f64], x: &[f64], d: &[f64]| {
            for ((target, x), d) in target.iter_mut().zip(x).zip(d) {
                *target = x + factor * d;
            }
        };
        for ((target, x), d) in self
            .segments
            .iter_mut()
            .zip(&x.segments)
            .zip(&correction.segments)
        {
            set(&mut target.nodes, &x.nodes, &d.nodes);
            set(&mut target.stages, &x.stages, &d.stages);
        }
        set(&mut self.p, &x.p, &correction.p);
    }
}

/// The residual of the discretised problem.
#[derive(Clone, Debug, Default)]
pub(crate) struct Residual {
    /// Continuity residuals in the slots of nodes 1 … N, stage residuals in those of the stages.
    equations: Vec<SegmentIterate>,
    /// Residuals of the conditions.
    pub(crate) conditions: Vec<f64>,
}

/// A value of the right-hand side or of a condition that is not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NonFinite {
    Rhs {
        segment: usize,
        s: f64,
        component: usize,
    },
    Condition {
        index: usize,
    },
}

/// Why a linearisation failed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LinearisationError {
    NonFinite(NonFinite),
    Singular(Singular),
}

impl From<NonFinite> for LinearisationError {
    fn from(error: NonFinite) -> Self {
        Self::NonFinite(error)
    }
}

/// What is kept of the stages of one segment to condense residuals and to recover corrections.
#[derive(Clone, Debug)]
struct StageBlocks {
    /// LU factors of M, (mn)² per interval, and their pivots, mn per interval.
    lu: Vec<f64>,
    pivots: Vec<usize>,
    /// Xᵀ, n × mn per interval.
    adjoint: Vec<f64>,
    /// \[J F_p\] at the stages, m × n × (n + k) per interval.
    jacobians: Vec<f64>,
}

/// A problem discretised on a mesh, with the buffers of its Newton iteration.
pub(crate) struct Collocation<'a> {
    equations: &'a dyn Equations,
    pub(crate) tableau: &'a Tableau,
    pub(crate) mesh: Mesh,
    matrix: AlmostBlockDiagonal,
    blocks: Vec<StageBlocks>,
    /// Jacobian of the conditions, (Σ n + k) × (Σ 2n + k).
    conditions_jacobian: Vec<f64>,
    /// States at all ends, in the order of [`Ends`].
    ends: Vec<f64>,
    /// One state, one right-hand side, one vector of stages, and conditions with the sign turned.
    y: Vec<f64>,
    f: Vec<f64>,
    stage: Vec<f64>,
    negative_conditions: Vec<f64>,
}

impl<'a> Collocation<'a> {
    pub(crate) fn new(equations: &'a dyn Equations, tableau: &'a Tableau, mesh: Mesh) -> Self {
        let (segments, k, m) = (equations.segments(), equations.parameters(), tableau.stages);
        let sizes = || {
            segments
                .iter()
                .zip(&mesh)
                .map(|(s, x)| (s.states, x.len() - 1))
        };
        let blocks = sizes()
            .map(|(n, intervals)| StageBlocks {
                lu: vec![0.0; intervals * (m * n) * (m * n)],
                pivots: vec![0; intervals * m * n],
                adjoint: vec![0.0; intervals * n * m * n],
                jacobians: vec![0.0; intervals * m * n * (n + k)],
            })
            .collect();
        let states: usize = segments.iter().map(|s| s.states).sum();
        let widest = segments.iter().map(|s| s.states).max().unwrap_or(0);
        let matrix = AlmostBlockDiagonal::new(sizes(), k);
        Self {
            equations,
            tableau,
            matrix,
            blocks,
            mesh,
            conditions_jacobian: vec![0.0; (states + k) * (2 * states + k)],
            ends: vec![0.0; 2 * states],
            y: vec![0.0; widest],
            f: vec![0.0; widest],
            stage: vec![0.0; m * widest],
            negative_conditions: vec![0.0; states + k],
        }
    }

    /// A zero iterate of the right size.
    pub(crate) fn zeros(&self) -> Iterate {
        Iterate::zeros(
            self.equations.segments(),
            &self.mesh,
            self.tableau.stages,
            self.equations.parameters(),
        )
    }

    /// A residual of the right size.
    pub(crate) fn residual_buffer(&self) -> Residual {
        Residual {
            equations: self.zeros().segments,
            conditions: vec![0.0; self.negative_conditions.len()],
        }
    }

    /// The iterate whose collocation polynomials interpolate a guess.
    pub(crate) fn interpolate(&self, guess: &dyn Guess) -> Iterate {
        let t = self.tableau;
        let (m, points) = (t.stages, t.stages + 1);
        let mut x = self.zeros();
        guess.parameters(&mut x.p);
        for (index, (segment, unknowns)) in self
            .equations
            .segments()
            .iter()
            .zip(&mut x.segments)
            .enumerate()
        {
            let n = segment.states;
            let nodes = &self.mesh[index];
            let mut values = vec![0.0; points * n];
            for (i, pair) in nodes.windows(2).enumerate() {
                let h = pair[1] - pair[0];
                for (value, theta) in values.chunks_exact_mut(n).zip(&t.guess_points) {
                    guess.state(index, pair[0] + theta * h, value);
                }
                unknowns.nodes[i * n..][..n].copy_from_slice(&values[..n]);
                let stages = &mut unknowns.stages[i * m * n..][..m * n];
                for (stage, slopes) in stages
                    .chunks_exact_mut(n)
                    .zip(t.guess_slope.chunks_exact(points))
                {
                    for (value, slope) in values.chunks_exact(n).zip(slopes) {
                        add_scaled(stage, slope / h, value);
                    }
                }
            }
            let last = nodes.len() - 1;
            guess.state(index, nodes[last], &mut unknowns.nodes[last * n..]);
        }
        x
    }

    /// Evaluates the residual of `x`.
    pub(crate) fn residual(
        &mut self,
        x: &Iterate,
        residual: &mut Residual,
        stats: &mut Stats,
    ) -> Result<(), NonFinite> {
        let t = self.tableau;
        for (index, segment) in self.equations.segments().iter().enumerate() {
            let n = segment.states;
            let (y, f) = (&mut self.y[..n], &mut self.f[..n]);
            for (i, pair) in self.mesh[index].windows(2).enumerate() {
                let interval = Interval::new(&x.segments[index], n, t, i, pair);
                let r = interval.stages_of(&mut residual.equations[index]);
                for (j, r) in r.chunks_exact_mut(n).enumerate() {
                    let s = interval.stage_state(t, j, y);
                    f.fill(f64::NAN);
                    self.equations.rhs(index, s, y, &x.p, f);
                    stats.rhs_evaluations += 1;
                    interval.stage_residual(j, f, r, index, s)?;
                }
                interval.continuity(t, &mut residual.equations[index]);
            }
        }
        self.gather_ends(x);
        residual.conditions.fill(f64::NAN);
        let at = Ends::new(self.equations.segments(), &self.ends);
        self.equations
            .conditions(at, &x.p, &mut residual.conditions);
        finite_conditions(&residual.conditions)
    }

    /// Evaluates the residual of `x` together with all Jacobians and factors the Newton matrix.
    pub(crate) fn linearise(
        &mut self,
        x: &Iterate,
        residual: &mut Residual,
        stats: &mut Stats,
    ) -> Result<(), LinearisationError> {
        let t = self.tableau;
        let (m, k) = (t.stages, x.p.len());
        for (index, segment) in self.equations.segments().iter().enumerate() {
            let n = segment.states;
            let (size, columns) = (m * n, n + k);
            let (y, f) = (&mut self.y[..n], &mut self.f[..n]);
            let blocks = &mut self.blocks[index];
            let chain = self.matrix.chain_mut(index);
            for (i, pair) in self.mesh[index].windows(2).enumerate() {
                let interval = Interval::new(&x.segments[index], n, t, i, pair);
                let jacobians = &mut blocks.jacobians[i * size * columns..][..size * columns];
                let r = interval.stages_of(&mut residual.equations[index]);
                let stages = r
                    .chunks_exact_mut(n)
                    .zip(jacobians.chunks_exact_mut(n * columns));
                for (j, (r, jacobian)) in stages.enumerate() {
                    let s = interval.stage_state(t, j, y);
                    self.equations.rhs_jacobian(index, s, y, &x.p, f, jacobian);
                    stats.rhs_evaluations += 1;
                    stats.jacobian_evaluations += 1;
                    interval.stage_residual(j, f, r, index, s)?;
                    let row = jacobian.chunks_exact(columns).position(|row| {
                        let sum: f64 = row.iter().sum();
                        !sum.is_finite()
                    });
                    if let Some(component) = row {
                        return Err(NonFinite::Rhs {
                            segment: index,
                            s,
                            component,
                        }
                        .into());
                    }
                }
                interval.continuity(t, &mut residual.equations[index]);
                condense(
                    t,
                    interval.h,
                    n,
                    jacobians,
                    &mut blocks.lu[i * size * size..][..size * size],
                    &mut blocks.pivots[i * size..][..size],
                    &mut blocks.adjoint[i * n * size..][..n * size],
                    chain.link_mut(i),
                )
                .map_err(|SingularRow(_)| {
                    LinearisationError::Singular(Singular::Node {
                        segment: index,
                        node: i,
                    })
                })?;
            }
        }
        self.gather_ends(x);
        self.equations.conditions_jacobian(
            &self.ends,
            &x.p,
            &mut residual.conditions,
            &mut self.conditions_jacobian,
        );
        finite_conditions(&residual.conditions)?;
        stats.factorisations += 1;
        self.matrix
            .factor(&self.conditions_jacobian)
            .map_err(LinearisationError::Singular)
    }

    /// The Newton correction −J⁻¹ residual with the Jacobian of the last linearisation.
    pub(crate) fn correction(&mut self, residual: &Residual, correction: &mut Iterate) {
        let m = self.tableau.stages;
        let k = correction.p.len();
        let segments = self.equations.segments();
        for (index, segment) in segments.iter().enumerate() {
            let n = segment.states;
            let size = m * n;
            let r = &residual.equations[index];
            let nodes = &mut correction.segments[index].nodes;
            let intervals = self.blocks[index]
                .adjoint
                .chunks_exact(n * size)
                .zip(r.stages.chunks_exact(size))
                .zip(r.nodes[n..].chunks_exact(n))
                .zip(nodes[n..].chunks_exact_mut(n));
            for (((adjoint, r), c), g) in intervals {
                for ((g, row), c) in g.iter_mut().zip(adjoint.chunks_exact(size)).zip(c) {
                    *g = -dot(row, r) - c;
                }
            }
        }
        for (negative, r) in self
            .negative_conditions
            .iter_mut()
            .zip(&residual.conditions)
        {
            *negative = -r;
        }
        self.matrix.solve(correction, &self.negative_conditions);
        for (index, segment) in segments.iter().enumerate() {
            let n = segment.states;
            let (size, columns) = (m * n, n + k);
            let blocks = &self.blocks[index];
            let r = &residual.equations[index].stages;
            let SegmentIterate { nodes, stages } = &mut correction.segments[index];
            for (i, stages) in stages.chunks_exact_mut(size).enumerate() {
                let jacobians = &blocks.jacobians[i * size * columns..][..size * columns];
                let dy = &nodes[i * n..][..n];
                for ((slope, row), r) in stages
                    .iter_mut()
                    .zip(jacobians.chunks_exact(columns))
                    .zip(&r[i * size..])
                {
                    *slope = dot(&row[..n], dy) + dot(&row[n..], &correction.p) - r;
                }
                lu_solve(
                    &blocks.lu[i * size * size..][..size * size],
                    size,
                    &blocks.pivots[i * size..][..size],
                    stages,
                );
            }
        }
    }

    /// The size of every condition's terms, Σ |∂g/∂z| |z|, from the last linearisation: the scale
    /// below which its residual is rounding.
    pub(crate) fn condition_scales(&mut self, x: &Iterate) -> Vec<f64> {
        self.gather_ends(x);
        let columns = self.ends.len() + x.p.len();
        let row_scale = |row: &[f64]| {
            let unknowns = self.ends.iter().chain(&x.p);
            row.iter().zip(unknowns).map(|(a, z)| (a * z).abs()).sum()
        };
        self.conditions_jacobian
            .chunks_exact(columns)
            .map(row_scale)
            .collect()
    }

    /// Relative defect of the continuous solution, one number per interval and segment:
    ///
    /// ```text
    /// rᵢ² = ∫₀¹ maxᶜ [ (S' − f(s, S, p)) / (1 + |f|) ]² dθ
    /// ```
    ///
    /// over the interval, by the Gauss rule with m + 1 points. Kierzenka & Shampine, "A BVP solver
    /// based on residual control and the MATLAB PSE", ACM Trans. Math. Softw. 27 (2001) 299-316.
    pub(crate) fn defects(
        &mut self,
        x: &Iterate,
        stats: &mut Stats,
    ) -> Result<Vec<Vec<f64>>, NonFinite> {
        let t = self.tableau;
        let mut all = Vec::with_capacity(self.mesh.len());
        for (index, segment) in self.equations.segments().iter().enumerate() {
            let n = segment.states;
            let (y, f) = (&mut self.y[..n], &mut self.f[..n]);
            let slope = &mut self.stage[..n];
            let mut defects = Vec::with_capacity(self.mesh[index].len() - 1);
            for (i, pair) in self.mesh[index].windows(2).enumerate() {
                let interval = Interval::new(&x.segments[index], n, t, i, pair);
                let mut square = 0.0;
                for (q, weight) in t.defect_rule.weights.iter().enumerate() {
                    let row = |table: &'a [f64]| &table[q * t.stages..][..t.stages];
                    let s = interval.s + t.defect_rule.points[q] * interval.h;
                    interval.state(row(&t.defect_value), y);
                    interval.slope(row(&t.defect_slope), slope);
                    f.fill(f64::NAN);
                    self.equations.rhs(index, s, y, &x.p, f);
                    stats.rhs_evaluations += 1;
                    let mut largest: f64 = 0.0;
                    for (component, (slope, f)) in slope.iter().zip(&*f).enumerate() {
                        if !f.is_finite() {
                            return Err(NonFinite::Rhs {
                                segment: index,
                                s,
                                component,
                            });
                        }
                        largest = largest.max(((slope - f) / (1.0 + f.abs())).abs());
                    }
                    square += weight * largest * largest;
                }
                defects.push(square.sqrt());
            }
            all.push(defects);
        }
        Ok(all)
    }

    fn gather_ends(&mut self, x: &Iterate) {
        let mut ends = self.ends.as_mut_slice();
        for (segment, unknowns) in self.equations.segments().iter().zip(&x.segments) {
            let n = segment.states;
            let (own, rest) = ends.split_at_mut(2 * n);
            own[..n].copy_from_slice(&unknowns.nodes[..n]);
            own[n..].copy_from_slice(&unknowns.nodes[unknowns.nodes.len() - n..]);
            ends = rest;
        }
    }
}

/// The unknowns on one interval.
struct Interval<'a> {
    index: usize,
    n: usize,
    s: f64,
    h: f64,
    y: &'a [f64],
    next: &'a [f64],
    stages: &'a [f64],
}

impl<'a> Interval<'a> {
    fn new(x: &'a SegmentIterate, n: usize, t: &Tableau, index: usize, ends: &[f64]) -> Self {
        Self {
            index,
            n,
            s: ends[0],
            h: ends[1] - ends[0],
            y: &x.nodes[index * n..][..n],
            next: &x.nodes[(index + 1) * n..][..n],
            stages: &x.stages[index * t.stages * n..][..t.stages * n],
        }
    }

    /// y = yᵢ + h Σ weightsₗ Kₗ.
    fn state(&self, weights: &[f64], y: &mut [f64]) {
        y.copy_from_slice(self.y);
        for (weight, slope) in weights.iter().zip(self.stages.chunks_exact(self.n)) {
            add_scaled(y, self.h * weight, slope);
        }
    }

    /// slope = Σ weightsₗ Kₗ.
    fn slope(&self, weights: &[f64], slope: &mut [f64]) {
        slope.fill(0.0);
        for (weight, stage) in weights.iter().zip(self.stages.chunks_exact(self.n)) {
            add_scaled(slope, *weight, stage);
        }
    }

    /// The state at stage j; returns its s.
    fn stage_state(&self, t: &Tableau, j: usize, y: &mut [f64]) -> f64 {
        self.state(&t.a[j * t.stages..][..t.stages], y);
        self.s + t.c[j] * self.h
    }

    /// r = Kⱼ − f, refusing an f that is not finite.
    fn stage_residual(
        &self,
        j: usize,
        f: &[f64],
        r: &mut [f64],
        segment: usize,
        s: f64,
    ) -> Result<(), NonFinite> {
        let slopes = &self.stages[j * self.n..][..self.n];
        for (component, ((r, slope), f)) in r.iter_mut().zip(slopes).zip(f).enumerate() {
            if !f.is_finite() {
                return Err(NonFinite::Rhs {
                    segment,
                    s,
                    component,
                });
            }
            *r = slope - f;
        }
        Ok(())
    }

    /// Writes the continuity residual yᵢ₊₁ − yᵢ − h Σ bⱼ Kⱼ.
    fn continuity(&self, t: &Tableau, residual: &mut SegmentIterate) {
        let c = &mut residual.nodes[(self.index + 1) * self.n..][..self.n];
        self.state(&t.b, c);
        for (c, next) in c.iter_mut().zip(self.next) {
            *c = next - *c;
        }
    }

    fn stages_of<'r>(&self, residual: &'r mut SegmentIterate) -> &'r mut [f64] {
        let size = self.stages.len();
        &mut residual.stages[self.index * size..][..size]
    }
}

/// Eliminates the stages of one interval: factors M, finds Xᵀ and the link \[Γ P\].
#[expect(
    clippy::too_many_arguments,
    reason = "one output buffer per factor of the elimination"
)]
fn condense(
    t: &Tableau,
    h: f64,
    n: usize,
    jacobians: &[f64],
    lu: &mut [f64],
    pivots: &mut [usize],
    adjoint: &mut [f64],
    link: &mut [f64],
) -> Result<(), SingularRow> {
    let m = t.stages;
    let size = m * n;
    let columns = jacobians.len() / size;
    for (row, (matrix_row, jacobian_row)) in lu
        .chunks_exact_mut(size)
        .zip(jacobians.chunks_exact(columns))
        .enumerate()
    {
        let stage = row / n;
        for (block, a) in matrix_row.chunks_exact_mut(n).zip(&t.a[stage * m..]) {
            for (x, j) in block.iter_mut().zip(jacobian_row) {
                *x = -h * a * j;
            }
        }
        matrix_row[row] += 1.0;
    }
    lu_factor(lu, size, pivots)?;
    for (i, (x, link)) in adjoint
        .chunks_exact_mut(size)
        .zip(link.chunks_exact_mut(columns))
        .enumerate()
    {
        x.fill(0.0);
        for (b, x) in t.b.iter().zip(x[i..].iter_mut().step_by(n)) {
            *x = h * b;
        }
        lu_solve_transposed(lu, size, pivots, x);
        link.fill(0.0);
        link[i] = 1.0;
        for (x, row) in x.iter().zip(jacobians.chunks_exact(columns)) {
            add_scaled(link, *x, row);
        }
    }
    Ok(())
}

fn finite_conditions(conditions: &[f64]) -> Result<(), NonFinite> {
    match conditions.iter().position(|r| !r.is_finite()) {
        Some(index) => Err(NonFinite::Condition { index }),
        None => Ok(()),
    }
}
