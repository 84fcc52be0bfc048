//! The discretised problem: residual, linearisation, Newton corrections.
//!
//! Unknown on each interval of length h are the state yᵢ at its left node and the m stage slopes
//! Kⱼ; the equations are
//!
//! ```text
//! Kⱼ − f(sᵢ + cⱼ h, yᵢ + h Σₗ aⱼₗ Kₗ, p) = 0        (stages)
//! yᵢ₊₁ − yᵢ − h Σⱼ bⱼ Kⱼ = 0                         (continuity)
//! ```
//!
//! together with the conditions on all ends. The linearised equations lose their stages first
//! ([`Condensation`]), then their interior nodes ([`AlmostBlockDiagonal`]). Ascher, Mattheij &
//! Russell (1995), sections 5.6 and 7.2.

use crate::discretisation::iterate::{Iterate, NonFinite, Residual, SegmentIterate, resize};
use crate::discretisation::mesh::Mesh;
use crate::discretisation::tableau::Tableau;
use crate::kernels::dense::add_scaled;
use crate::kernels::parallel::for_each_run;
use crate::kernels::specialise::{outlined, specialise};
use crate::newton::evaluation::{SegmentAt, StageBuffers, non_finite_row};
use crate::newton_matrix::almost_block_diagonal::AlmostBlockDiagonal;
use crate::newton_matrix::condensation::Condensation;
use crate::newton_matrix::dependence::Dependence;
use crate::newton_matrix::singular::Singular;
use crate::problem::equations::Equations;
use crate::problem::guess::Guess;
use crate::problem::held::Held;
use crate::problem::problem::{Ends, Segment};
use crate::result::stats::Stats;
use faer::Mat;
use std::sync::Arc;

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

/// A problem discretised on a mesh, with the buffers of its Newton iteration.
#[derive(Clone)]
pub(crate) struct Collocation<'a> {
    pub(crate) equations: Held<'a>,
    pub(crate) tableau: Arc<Tableau>,
    pub(crate) mesh: Mesh,
    matrix: AlmostBlockDiagonal,
    pub(crate) stages: Vec<Condensation>,
    /// For every segment.
    buffers: Vec<StageBuffers>,
    /// Jacobian of the conditions, a row each with Σ 2n + k columns.
    pub(crate) conditions_jacobian: Vec<f64>,
    /// States at all ends, in the order of [`Ends`].
    ends: Vec<f64>,
}

impl<'a> Collocation<'a> {
    /// Equations with as many conditions as unknown constants, or one fewer, which leaves the
    /// Newton matrix with a null vector.
    pub(crate) fn new(equations: Held<'a>, tableau: Arc<Tableau>, mesh: Mesh) -> Self {
        let (segments, k) = (equations.segments(), equations.parameters());
        let conditions = equations.condition_count();
        let all_states = || segments.iter().map(|segment| segment.states);
        let states: usize = all_states().sum();
        let mut new = Self {
            matrix: AlmostBlockDiagonal::new(all_states(), k, conditions),
            stages: all_states()
                .map(|n| Condensation::new(n, k, tableau.stages))
                .collect(),
            buffers: segments.iter().map(StageBuffers::new).collect(),
            mesh: vec![],
            conditions_jacobian: vec![0.0; conditions * (2 * states + k)],
            ends: vec![0.0; 2 * states],
            equations,
            tableau,
        };
        new.set_mesh(mesh);
        new
    }

    /// Changes to another mesh.
    pub(crate) fn set_mesh(&mut self, mesh: Mesh) {
        self.mesh = mesh;
        let intervals = self.mesh.iter().map(|nodes| nodes.len() - 1);
        self.matrix.resize(intervals.clone());
        for (stages, intervals) in self.stages.iter_mut().zip(intervals) {
            stages.resize(intervals);
        }
    }

    /// Gives an iterate the size of this mesh.
    pub(crate) fn resize(&self, x: &mut Iterate) {
        let (segments, m) = (self.equations.segments(), self.tableau.stages);
        x.resize(segments, &self.mesh, m, self.equations.parameters());
    }

    /// Gives a residual the size of this mesh.
    pub(crate) fn resize_residual(&self, residual: &mut Residual) {
        let (segments, m) = (self.equations.segments(), self.tableau.stages);
        resize(&mut residual.equations, segments, &self.mesh, m);
        let conditions = self.equations.condition_count();
        residual.conditions.resize(conditions, 0.0);
    }

    /// A zero iterate of the right size.
    pub(crate) fn zeros(&self) -> Iterate {
        let mut x = Iterate::default();
        self.resize(&mut x);
        x
    }

    /// A residual of the right size.
    pub(crate) fn residual_buffer(&self) -> Residual {
        let mut residual = Residual::default();
        self.resize_residual(&mut residual);
        residual
    }

    /// The iterate whose collocation polynomials interpolate a guess.
    pub(crate) fn interpolate(&self, guess: &dyn Guess) -> Iterate {
        let k = self.equations.parameters();
        let segments = self.equations.segments();
        Iterate::interpolate(segments, &self.mesh, &self.tableau, k, guess)
    }

    /// One step of Picard's iteration from a guess: its slopes are replaced by f along it and integrated
    /// from the beginning of every segment. A guess that is no solution at all, such as a constant,
    /// becomes one with consistent slopes.
    pub(crate) fn picard(
        &mut self,
        guess: &dyn Guess,
        stats: &mut Stats,
    ) -> Result<Iterate, NonFinite> {
        let x = self.interpolate(guess);
        let mut integrated = x.clone();
        let mut residual = self.residual_buffer();
        self.residual(&x, &mut residual, stats)?;
        let (t, m) = (&*self.tableau, self.tableau.stages);
        for (index, segment) in self.equations.segments().iter().enumerate() {
            let n = segment.states;
            let SegmentIterate { nodes, stages } = &mut integrated.segments[index];
            // The residual of a stage is what its slope is over f.
            for (stage, over) in stages.iter_mut().zip(&residual.equations[index].stages) {
                *stage -= over;
            }
            for (i, pair) in self.mesh[index].windows(2).enumerate() {
                let (before, after) = nodes.split_at_mut((i + 1) * n);
                after[..n].copy_from_slice(&before[i * n..]);
                for (slope, weight) in stages[i * m * n..][..m * n].chunks_exact(n).zip(&t.b) {
                    add_scaled(&mut after[..n], weight * (pair[1] - pair[0]), slope);
                }
            }
        }
        Ok(integrated)
    }

    /// Evaluates the residual of `x`.
    pub(crate) fn residual(
        &mut self,
        x: &Iterate,
        residual: &mut Residual,
        stats: &mut Stats,
    ) -> Result<(), NonFinite> {
        for index in 0..self.mesh.len() {
            let (intervals, m) = (self.mesh[index].len() - 1, self.tableau.stages);
            let n = self.equations.segments()[index].states;
            let segment = SegmentAt::new(&self.equations, &self.tableau, &self.mesh, index, x);
            let SegmentIterate { nodes, stages } = &mut residual.equations[index];
            for_each_run(
                0..intervals,
                m * n * (m + n),
                (&mut stages[..], &mut nodes[n..]),
                &mut self.buffers[index],
                &|run, (stages, nodes), buffers| {
                    specialise!(n in [1, 2, 3, 4, 5, 6, 7] => specialise!(m in [6, 7] =>
                    outlined(|| segment.residuals([m, n], run, stages, nodes, buffers))))
                },
            )?;
            stats.rhs_evaluations += intervals * m;
        }
        self.conditions(x, &mut residual.conditions)
    }

    /// Evaluates the residuals of the conditions.
    pub(crate) fn conditions(&mut self, x: &Iterate, r: &mut [f64]) -> Result<(), NonFinite> {
        gather_ends(self.equations.segments(), x, &mut self.ends);
        r.fill(f64::NAN);
        let at = Ends::new(self.equations.segments(), &self.ends);
        self.equations.evaluate_conditions(at, &x.p, r);
        finite_conditions(r, 1)
    }

    /// Evaluates the residual of `x` together with all Jacobians and factors the Newton matrix.
    pub(crate) fn linearise(
        &mut self,
        x: &Iterate,
        residual: &mut Residual,
        stats: &mut Stats,
    ) -> Result<(), LinearisationError> {
        let k = x.p.len();
        for index in 0..self.mesh.len() {
            let (intervals, m) = (self.mesh[index].len() - 1, self.tableau.stages);
            let n = self.equations.segments()[index].states;
            let segment = SegmentAt::new(&self.equations, &self.tableau, &self.mesh, index, x);
            let condensation = &mut self.stages[index];
            let buffers = &mut self.buffers[index];
            let SegmentIterate { nodes, stages } = &mut residual.equations[index];
            buffers.observed.restart();
            for_each_run(
                0..intervals,
                m * n * (m + n * (n + k)),
                (
                    (&mut stages[..], &mut nodes[n..]),
                    condensation.jacobians_mut(),
                ),
                buffers,
                &|run, ((stages, nodes), jacobians), buffers| {
                    specialise!(n in [1, 2, 3, 4, 5, 6, 7] => specialise!(m in [6, 7] => specialise!(k in [0] =>
                    outlined(|| segment.jacobians([m, n, k], run, stages, nodes, jacobians, buffers)))))
                },
            )?;
            stats.rhs_evaluations += intervals * m;
            stats.jacobian_evaluations += intervals * m;
            condensation.reduce_order(&buffers.observed);
            let transitions = self.matrix.transitions_mut(index).blocks_mut();
            condensation
                .condense(&self.tableau, &self.mesh[index], transitions)
                .map_err(|node| {
                    let segment = index;
                    LinearisationError::Singular(Singular::Node { segment, node })
                })?;
        }
        gather_ends(self.equations.segments(), x, &mut self.ends);
        residual.conditions.fill(f64::NAN);
        self.conditions_jacobian.fill(f64::NAN);
        let at = Ends::new(self.equations.segments(), &self.ends);
        self.equations.conditions_jacobian(
            at,
            &x.p,
            &mut residual.conditions,
            &mut self.conditions_jacobian,
        );
        finite_conditions(&residual.conditions, 1)?;
        finite_conditions(&self.conditions_jacobian, self.ends.len() + x.p.len())?;
        stats.factorisations += 1;
        self.matrix
            .factor(&self.conditions_jacobian)
            .map_err(LinearisationError::Singular)
    }

    /// What the conditions leave open where the last linearisation proved singular at the ends.
    pub(crate) fn dependence(&self) -> Dependence {
        self.matrix.dependence(self.equations.segments())
    }

    /// What the conditions of the last linearisation leave open without their part on the ranges of projectors P, each
    /// n × n for the states at one end, which begin at a column of the Jacobian of the conditions.
    pub(crate) fn dependence_without(&self, ranges: &[(usize, Mat<f64>)]) -> Dependence {
        let segments = self.equations.segments();
        self.matrix.dependence_without(ranges, segments)
    }

    /// The Newton correction −J⁻¹ residual with the Jacobian of the last linearisation.
    pub(crate) fn correction(&mut self, residual: &Residual, correction: &mut Iterate) {
        self.node_correction(residual, correction);
        self.stage_correction(residual, correction);
    }

    /// Its nodes and parameters, which are all that a norm uses.
    pub(crate) fn node_correction(&mut self, residual: &Residual, correction: &mut Iterate) {
        let segments = residual.equations.iter().zip(&mut correction.segments);
        for (stages, (r, correction)) in self.stages.iter().zip(segments) {
            stages.reduce(r, &mut correction.nodes);
        }
        self.matrix.solve(correction, &residual.conditions);
    }

    /// Its stages, once nodes and parameters are known.
    pub(crate) fn stage_correction(&mut self, residual: &Residual, correction: &mut Iterate) {
        let Iterate { segments, p } = correction;
        let each = self.stages.iter_mut().zip(&self.mesh);
        for (((stages, mesh), r), correction) in each.zip(&residual.equations).zip(segments) {
            stages.recover(&self.tableau, mesh, r, correction, p);
        }
    }

    /// The smallest pivot of the last factorisation relative to the entries before the elimination.
    pub(crate) fn smallest_pivot(&self) -> f64 {
        self.matrix.smallest_pivot()
    }

    /// The null vector of the Newton matrix J, oriented so that det \[J; tᵀ\] has one sign for all
    /// linearisations on a mesh. `zeros` is a residual that vanishes.
    pub(crate) fn null_vector(&mut self, zeros: &Residual, t: &mut Iterate) {
        let stages = self.stages.iter().map(Condensation::negative).sum();
        self.matrix.null_vector(t, stages);
        self.stage_correction(zeros, t);
    }

    /// For every condition, from the last linearisation, the size of its terms, Σ |∂g/∂z| |z|, below which its
    /// residual is rounding, and its unit.
    pub(crate) fn condition_sizes(&mut self, x: &Iterate) -> impl Iterator<Item = (f64, f64)> {
        gather_ends(self.equations.segments(), x, &mut self.ends);
        let this = &*self;
        let rows = this
            .conditions_jacobian
            .chunks_exact(this.ends.len() + x.p.len());
        rows.map(|row| {
            let unknowns = this.ends.iter().chain(&x.p);
            let size = row.iter().zip(unknowns).map(|(a, z)| (a * z).abs()).sum();
            (size, this.unit_of(row))
        })
    }

    /// The unit of every condition; see [`unit_of`](Self::unit_of).
    pub(crate) fn condition_units(&self) -> Vec<f64> {
        let columns = self.ends.len() + self.equations.parameters();
        let rows = self.conditions_jacobian.chunks_exact(columns);
        rows.map(|row| self.unit_of(row)).collect()
    }

    /// The unit of a condition with this row in the Jacobian of the conditions: one; or, if the states and
    /// parameters have units, the most that a change of one of them by its unit changes it by.
    fn unit_of(&self, row: &[f64]) -> f64 {
        match self.equations.units() {
            None => 1.0,
            Some(_) => row.iter().fold(0.0, |m: f64, a| m.max(a.abs())),
        }
    }
}

/// Copies the states at all ends into `ends`, in the order of [`Ends`].
pub(crate) fn gather_ends(segments: &[Segment], x: &Iterate, mut ends: &mut [f64]) {
    for (segment, unknowns) in segments.iter().zip(&x.segments) {
        let n = segment.states;
        let (own, rest) = ends.split_at_mut(2 * n);
        own[..n].copy_from_slice(&unknowns.nodes[..n]);
        own[n..].copy_from_slice(&unknowns.nodes[unknowns.nodes.len() - n..]);
        ends = rest;
    }
}

/// Refuses conditions, or rows of their Jacobian, that are not finite or were not written.
fn finite_conditions(values: &[f64], columns: usize) -> Result<(), NonFinite> {
    match non_finite_row(values, columns) {
        Some(index) => Err(NonFinite::Condition { index }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
