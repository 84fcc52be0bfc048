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

use crate::almost_block_diagonal::{AlmostBlockDiagonal, Singular};
use crate::chains::Watch;
use crate::condensation::Condensation;
use crate::dense::{SingularRow, add_scaled, all_finite};
use crate::dependence::Dependence;
use crate::held::Held;
use crate::iterate::{Interval, Iterate, NonFinite, Residual, SegmentIterate};
use crate::mesh::Mesh;
use crate::scheme::Tableau;
use crate::specialise::specialise;
use crate::{Ends, Equations, Guess, Segment, Stats};
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
    /// What the last Jacobians have shown of every segment.
    watches: Vec<Watch>,
    /// Jacobian of the conditions, a row each with Σ 2n + k columns.
    pub(crate) conditions_jacobian: Vec<f64>,
    /// States at all ends, in the order of [`Ends`].
    ends: Vec<f64>,
    /// One state, one right-hand side, and conditions with the sign turned.
    y: Vec<f64>,
    f: Vec<f64>,
    negative_conditions: Vec<f64>,
}

impl<'a> Collocation<'a> {
    /// Equations with as many conditions as unknown constants, or one fewer, which leaves the
    /// Newton matrix with a null vector.
    pub(crate) fn new(equations: Held<'a>, tableau: Arc<Tableau>, mesh: Mesh) -> Self {
        let (segments, k) = (equations.segments(), equations.parameters());
        let conditions = equations.condition_count();
        let sizes = || {
            let pairs = segments.iter().zip(&mesh);
            pairs.map(|(segment, nodes)| (segment.states, nodes.len() - 1))
        };
        let states: usize = segments.iter().map(|s| s.states).sum();
        let widest = segments.iter().map(|s| s.states).max().unwrap_or(0);
        Self {
            matrix: AlmostBlockDiagonal::new(sizes(), k, conditions),
            stages: sizes()
                .map(|(n, intervals)| Condensation::new(n, k, tableau.stages, intervals))
                .collect(),
            watches: segments.iter().map(|s| Watch::new(s.states)).collect(),
            mesh,
            conditions_jacobian: vec![0.0; conditions * (2 * states + k)],
            ends: vec![0.0; 2 * states],
            y: vec![0.0; widest],
            f: vec![0.0; widest],
            negative_conditions: vec![0.0; conditions],
            equations,
            tableau,
        }
    }

    /// A zero iterate of the right size.
    pub(crate) fn zeros(&self) -> Iterate {
        let k = self.equations.parameters();
        let segments = self.equations.segments();
        Iterate::zeros(segments, &self.mesh, self.tableau.stages, k)
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
        let k = self.equations.parameters();
        let segments = self.equations.segments();
        Iterate::interpolate(segments, &self.mesh, &self.tableau, k, guess)
    }

    /// One step of Picard's iteration from a guess: its slopes are replaced by f along it and integrated
    /// from the beginning of every segment. A guess that is no solution at all, such as a constant,
    /// becomes one with consistent slopes.
    pub(crate) fn swept(
        &mut self,
        guess: &dyn Guess,
        stats: &mut Stats,
    ) -> Result<Iterate, NonFinite> {
        let x = self.interpolate(guess);
        let mut swept = x.clone();
        let mut residual = self.residual_buffer();
        self.residual(&x, &mut residual, stats)?;
        let (t, m) = (&*self.tableau, self.tableau.stages);
        for (index, segment) in self.equations.segments().iter().enumerate() {
            let n = segment.states;
            let SegmentIterate { nodes, stages } = &mut swept.segments[index];
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
        Ok(swept)
    }

    /// Evaluates the residual of `x`.
    pub(crate) fn residual(
        &mut self,
        x: &Iterate,
        residual: &mut Residual,
        stats: &mut Stats,
    ) -> Result<(), NonFinite> {
        for index in 0..self.mesh.len() {
            let n = self.equations.segments()[index].states;
            specialise!(n in [1, 2, 3, 4, 5, 6] => self.segment_residual(index, n, x, residual))?;
            stats.rhs_evaluations += (self.mesh[index].len() - 1) * self.tableau.stages;
        }
        self.conditions(x, &mut residual.conditions)
    }

    /// The residuals of a segment of n states.
    #[inline(always)]
    fn segment_residual(
        &mut self,
        index: usize,
        n: usize,
        x: &Iterate,
        residual: &mut Residual,
    ) -> Result<(), NonFinite> {
        let t = &*self.tableau;
        let (y, f) = (&mut self.y[..n], &mut self.f[..n]);
        for (i, pair) in self.mesh[index].windows(2).enumerate() {
            let interval = Interval::new(&x.segments[index], n, t, i, pair);
            let r = interval.stages_of(&mut residual.equations[index]);
            for (j, r) in r.chunks_exact_mut(n).enumerate() {
                let s = interval.stage_state(t, j, y);
                f.fill(f64::NAN);
                self.equations.rhs(index, s, y, &x.p, f);
                interval.stage_residual(j, f, r, index, s)?;
            }
            interval.continuity(t, &mut residual.equations[index]);
        }
        Ok(())
    }

    /// Evaluates the residuals of the conditions.
    pub(crate) fn conditions(&mut self, x: &Iterate, r: &mut [f64]) -> Result<(), NonFinite> {
        gather_ends(self.equations.segments(), x, &mut self.ends);
        r.fill(f64::NAN);
        let at = Ends::new(self.equations.segments(), &self.ends);
        self.equations.conditions(at, &x.p, r);
        finite_conditions(r, 1)
    }

    /// Evaluates the residual of `x` together with all Jacobians and factors the Newton matrix.
    pub(crate) fn linearise(
        &mut self,
        x: &Iterate,
        residual: &mut Residual,
        stats: &mut Stats,
    ) -> Result<(), LinearisationError> {
        for index in 0..self.mesh.len() {
            let n = self.equations.segments()[index].states;
            specialise!(n in [1, 2, 3, 4, 5, 6] => self.segment_jacobians(index, n, x, residual))?;
            let evaluations = (self.mesh[index].len() - 1) * self.tableau.stages;
            stats.rhs_evaluations += evaluations;
            stats.jacobian_evaluations += evaluations;
            let stages = &mut self.stages[index];
            stages.chain(&self.watches[index]);
            let chain = self.matrix.chain_mut(index);
            for (i, pair) in self.mesh[index].windows(2).enumerate() {
                stages
                    .condense(i, &self.tableau, pair[1] - pair[0], chain.link_mut(i))
                    .map_err(|SingularRow(_)| {
                        let (segment, node) = (index, i);
                        LinearisationError::Singular(Singular::Node { segment, node })
                    })?;
            }
        }
        gather_ends(self.equations.segments(), x, &mut self.ends);
        residual.conditions.fill(f64::NAN);
        self.conditions_jacobian.fill(f64::NAN);
        self.equations.conditions_jacobian(
            &self.ends,
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

    /// The residuals of a segment of n states, and the Jacobians.
    #[inline(always)]
    fn segment_jacobians(
        &mut self,
        index: usize,
        n: usize,
        x: &Iterate,
        residual: &mut Residual,
    ) -> Result<(), NonFinite> {
        let t = &*self.tableau;
        let columns = n + x.p.len();
        let (y, f) = (&mut self.y[..n], &mut self.f[..n]);
        let stages = &mut self.stages[index];
        let watch = &mut self.watches[index];
        watch.restart();
        for (i, pair) in self.mesh[index].windows(2).enumerate() {
            let interval = Interval::new(&x.segments[index], n, t, i, pair);
            let r = interval.stages_of(&mut residual.equations[index]);
            let jacobians = stages.jacobians_mut(i).chunks_exact_mut(n * columns);
            for (j, (r, jacobian)) in r.chunks_exact_mut(n).zip(jacobians).enumerate() {
                let s = interval.stage_state(t, j, y);
                f.fill(f64::NAN);
                jacobian.fill(f64::NAN);
                self.equations.rhs_jacobian(index, s, y, &x.p, f, jacobian);
                interval.stage_residual(j, f, r, index, s)?;
                if let Some(component) = non_finite_row(jacobian, columns) {
                    let segment = index;
                    return Err(NonFinite::Rhs {
                        segment,
                        s,
                        component,
                    });
                }
                watch.look(jacobian, n, columns);
            }
            interval.continuity(t, &mut residual.equations[index]);
        }
        Ok(())
    }

    /// What the conditions leave open where the last linearisation proved singular at the ends.
    pub(crate) fn dependence(&self) -> Dependence {
        self.matrix.dependence(self.equations.segments())
    }

    /// The Newton correction −J⁻¹ residual with the Jacobian of the last linearisation.
    pub(crate) fn correction(&mut self, residual: &Residual, correction: &mut Iterate) {
        self.node_correction(residual, correction);
        self.stage_correction(residual, correction);
    }

    /// Its nodes and parameters, which are all that a norm looks at.
    pub(crate) fn node_correction(&mut self, residual: &Residual, correction: &mut Iterate) {
        let segments = residual.equations.iter().zip(&mut correction.segments);
        for (stages, (r, correction)) in self.stages.iter().zip(segments) {
            stages.reduce(r, &mut correction.nodes);
        }
        let conditions = self.negative_conditions.iter_mut();
        for (negative, r) in conditions.zip(&residual.conditions) {
            *negative = -r;
        }
        self.matrix.solve(correction, &self.negative_conditions);
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

    /// The size of every condition's terms, Σ |∂g/∂z| |z|, from the last linearisation: the scale
    /// below which its residual is rounding.
    pub(crate) fn condition_scales(&mut self, x: &Iterate) -> Vec<f64> {
        gather_ends(self.equations.segments(), x, &mut self.ends);
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

/// The first row of a row-major matrix with an entry that is not finite.
fn non_finite_row(matrix: &[f64], columns: usize) -> Option<usize> {
    if all_finite(matrix) {
        return None;
    }
    matrix
        .iter()
        .position(|x| !x.is_finite())
        .map(|i| i / columns)
}

/// Refuses conditions, or rows of their Jacobian, that are not finite or were not written.
fn finite_conditions(values: &[f64], columns: usize) -> Result<(), NonFinite> {
    match non_finite_row(values, columns) {
        Some(index) => Err(NonFinite::Condition { index }),
        None => Ok(()),
    }
}
