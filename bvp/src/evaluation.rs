//! Right-hand sides and Jacobians at the stages of a segment.

use crate::chains::Watch;
use crate::dense::all_finite;
use crate::held::Held;
use crate::iterate::{Interval, Iterate, NonFinite, SegmentIterate};
use crate::mesh::Mesh;
use crate::parallel::Buffers;
use crate::tableau::Tableau;
use crate::{Equations, Segment};
use std::ops::Range;

/// What the evaluation of the stages of a segment needs.
#[derive(Clone)]
pub(crate) struct StageBuffers {
    /// One state and one right-hand side.
    y: Vec<f64>,
    f: Vec<f64>,
    /// What the last Jacobians have shown.
    pub(crate) watch: Watch,
}

impl StageBuffers {
    pub(crate) fn new(segment: &Segment) -> Self {
        let n = segment.states;
        Self {
            y: vec![0.0; n],
            f: vec![0.0; n],
            watch: Watch::new(n),
        }
    }
}

impl Buffers for StageBuffers {
    fn learn(&mut self, copy: Self) {
        self.watch.learn(&copy.watch);
    }
}

/// One segment of a problem at an iterate.
pub(crate) struct SegmentAt<'a> {
    equations: &'a Held<'a>,
    tableau: &'a Tableau,
    /// Which segment it is.
    index: usize,
    /// Its nodes and unknowns.
    mesh: &'a [f64],
    x: &'a SegmentIterate,
    /// Parameters p.
    p: &'a [f64],
}

impl<'a> SegmentAt<'a> {
    pub(crate) fn new(
        equations: &'a Held<'a>,
        tableau: &'a Tableau,
        mesh: &'a Mesh,
        index: usize,
        x: &'a Iterate,
    ) -> Self {
        Self {
            equations,
            tableau,
            index,
            mesh: &mesh[index],
            x: &x.segments[index],
            p: &x.p,
        }
    }

    /// Interval i, where there are n states.
    #[inline(always)]
    fn interval(&self, i: usize, n: usize) -> Interval<'a> {
        Interval::new(self.x, n, self.tableau, i, &self.mesh[i..i + 2])
    }

    /// The residuals of the stages and of the continuity of a run of intervals with n states.
    #[inline(always)]
    pub(crate) fn residuals(
        &self,
        n: usize,
        run: Range<usize>,
        stages: &mut [f64],
        continuity: &mut [f64],
        buffers: &mut StageBuffers,
    ) -> Result<(), NonFinite> {
        let t = self.tableau;
        let (y, f) = (&mut buffers.y[..n], &mut buffers.f[..n]);
        let residuals = stages
            .chunks_exact_mut(t.stages * n)
            .zip(continuity.chunks_exact_mut(n));
        for (i, (r, c)) in run.zip(residuals) {
            let interval = self.interval(i, n);
            for (j, r) in r.chunks_exact_mut(n).enumerate() {
                let s = interval.stage_state(t, j, y);
                f.fill(f64::NAN);
                self.equations.rhs(self.index, s, y, self.p, f);
                interval.stage_residual(j, f, r, self.index, s)?;
            }
            interval.continuity(t, c);
        }
        Ok(())
    }

    /// The [`residuals`](Self::residuals), and the Jacobians at the stages.
    #[inline(always)]
    pub(crate) fn jacobians(
        &self,
        n: usize,
        run: Range<usize>,
        stages: &mut [f64],
        continuity: &mut [f64],
        jacobians: &mut [f64],
        buffers: &mut StageBuffers,
    ) -> Result<(), NonFinite> {
        let (t, columns) = (self.tableau, n + self.p.len());
        let StageBuffers { y, f, watch } = buffers;
        let (y, f) = (&mut y[..n], &mut f[..n]);
        let residuals = stages
            .chunks_exact_mut(t.stages * n)
            .zip(continuity.chunks_exact_mut(n))
            .zip(jacobians.chunks_exact_mut(t.stages * n * columns));
        for (i, ((r, c), jacobians)) in run.zip(residuals) {
            let interval = self.interval(i, n);
            let jacobians = jacobians.chunks_exact_mut(n * columns);
            for (j, (r, jacobian)) in r.chunks_exact_mut(n).zip(jacobians).enumerate() {
                let s = interval.stage_state(t, j, y);
                f.fill(f64::NAN);
                jacobian.fill(f64::NAN);
                self.equations
                    .rhs_jacobian(self.index, s, y, self.p, f, jacobian);
                interval.stage_residual(j, f, r, self.index, s)?;
                if let Some(component) = non_finite_row(jacobian, columns) {
                    let segment = self.index;
                    return Err(NonFinite::Rhs {
                        segment,
                        s,
                        component,
                    });
                }
                watch.look(jacobian, n, columns);
            }
            interval.continuity(t, c);
        }
        Ok(())
    }
}

/// The first row of a row-major matrix with an entry that is not finite.
pub(crate) fn non_finite_row(matrix: &[f64], columns: usize) -> Option<usize> {
    if all_finite(matrix) {
        return None;
    }
    matrix
        .iter()
        .position(|x| !x.is_finite())
        .map(|i| i / columns)
}
