//! Right-hand sides and Jacobians at the stages of a segment.

use crate::discretisation::iterate::{Interval, Iterate, NonFinite, SegmentIterate};
use crate::discretisation::mesh::Mesh;
use crate::discretisation::tableau::Tableau;
use crate::kernels::dense::all_finite;
use crate::kernels::few::Few;
use crate::kernels::parallel::Buffers;
use crate::newton_matrix::derivative_states::ObservedJacobians;
use crate::problem::equations::Equations;
use crate::problem::held::Held;
use crate::problem::problem::Segment;
use std::ops::Range;

/// What the evaluation of the stages of a segment needs.
#[derive(Clone)]
pub(crate) struct StageBuffers {
    /// One state.
    y: Few,
    /// What the last Jacobians have shown.
    pub(crate) observed: ObservedJacobians,
}

impl StageBuffers {
    pub(crate) fn new(segment: &Segment) -> Self {
        let n = segment.states;
        Self {
            y: Few::zeros(n),
            observed: ObservedJacobians::new(n),
        }
    }
}

impl Buffers for StageBuffers {
    fn merge(&mut self, copy: Self) {
        self.observed.merge(&copy.observed);
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

    /// Interval i, where there are m stages and n states.
    #[inline(always)]
    fn interval(&self, size: [usize; 2], i: usize) -> Interval<'a> {
        Interval::new(self.x, size, i, &self.mesh[i..i + 2])
    }

    /// The places of all stages of a run of intervals with m stages and n states, and the states there.
    #[inline(never)]
    fn stages(&self, [m, n]: [usize; 2], run: Range<usize>) -> (Vec<f64>, Vec<f64>) {
        let t = self.tableau;
        let mut places = Vec::with_capacity(run.len() * m);
        let mut states = vec![0.0; run.len() * m * n];
        for (i, states) in run.zip(states.chunks_exact_mut(m * n)) {
            let interval = self.interval([m, n], i);
            for (j, y) in states.chunks_exact_mut(n).enumerate() {
                places.push(interval.place(t.c[j]));
                interval.state(&t.a[j * m..][..m], y);
            }
        }
        (places, states)
    }

    /// The residuals of the stages and of the continuity of a run of intervals with m stages and n states.
    #[inline(always)]
    pub(crate) fn residuals(
        &self,
        [m, n]: [usize; 2],
        run: Range<usize>,
        stages: &mut [f64],
        continuity: &mut [f64],
        buffers: &mut StageBuffers,
    ) -> Result<(), NonFinite> {
        let t = self.tableau;
        let (a, c) = (&t.a[..m * m], &t.c[..m]);
        let y = &mut buffers.y[..n];
        let is_vectorised = self.equations.is_vectorised();
        if is_vectorised {
            stages.fill(f64::NAN);
            let (s, y) = self.stages([m, n], run.clone());
            self.equations
                .evaluate_rhs_at(self.index, &s, &y, self.p, stages);
        }
        let residuals = stages
            .chunks_exact_mut(m * n)
            .zip(continuity.chunks_exact_mut(n));
        for (i, (r, jump)) in run.zip(residuals) {
            let interval = self.interval([m, n], i);
            if !is_vectorised {
                r.fill(f64::NAN);
            }
            for (j, f) in r.chunks_exact_mut(n).enumerate() {
                let s = interval.place(c[j]);
                if !is_vectorised {
                    interval.state(&a[j * m..][..m], y);
                    self.equations.evaluate_rhs(self.index, s, y, self.p, f);
                }
                interval.stage_residual(j, f, self.index, s)?;
            }
            interval.continuity(t, jump);
        }
        Ok(())
    }

    /// The [`residuals`](Self::residuals), and the Jacobians at the stages, with k parameters.
    #[inline(always)]
    pub(crate) fn jacobians(
        &self,
        [m, n, k]: [usize; 3],
        run: Range<usize>,
        stages: &mut [f64],
        continuity: &mut [f64],
        jacobians: &mut [f64],
        buffers: &mut StageBuffers,
    ) -> Result<(), NonFinite> {
        let (t, columns) = (self.tableau, n + k);
        let (a, c) = (&t.a[..m * m], &t.c[..m]);
        let StageBuffers { y, observed } = buffers;
        let y = &mut y[..n];
        let is_vectorised = self.equations.is_vectorised();
        if is_vectorised {
            stages.fill(f64::NAN);
            jacobians.fill(f64::NAN);
            let (s, y) = self.stages([m, n], run.clone());
            self.equations
                .rhs_jacobian_at(self.index, &s, &y, self.p, stages, jacobians);
        }
        let residuals = stages
            .chunks_exact_mut(m * n)
            .zip(continuity.chunks_exact_mut(n))
            .zip(jacobians.chunks_exact_mut(m * n * columns));
        for (i, ((r, jump), jacobians)) in run.zip(residuals) {
            let interval = self.interval([m, n], i);
            if !is_vectorised {
                r.fill(f64::NAN);
                jacobians.fill(f64::NAN);
            }
            let written = r
                .chunks_exact_mut(n)
                .zip(jacobians.chunks_exact_mut(n * columns));
            for (j, (f, jacobian)) in written.enumerate() {
                let s = interval.place(c[j]);
                if !is_vectorised {
                    interval.state(&a[j * m..][..m], y);
                    self.equations
                        .rhs_jacobian(self.index, s, y, self.p, f, jacobian);
                }
                interval.stage_residual(j, f, self.index, s)?;
            }
            if let Some(row) = non_finite_row(jacobians, columns) {
                return Err(NonFinite::Rhs {
                    segment: self.index,
                    s: interval.place(c[row / n]),
                    component: row % n,
                });
            }
            observed.observe(interval.h, jacobians, [n, columns]);
            interval.continuity(t, jump);
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
