//! Damped Newton iteration with the natural monotonicity test.
//!
//! A step x + λ Δx is accepted when the simplified correction at the new point, taken with the old
//! Jacobian, is smaller: ‖Δx̄‖ ≤ (1 − λ/4) ‖Δx‖. The test does not change when the equations are
//! multiplied by any matrix, so it needs no scaling of residuals. Where the simplified corrections
//! contract fast, the Jacobian is kept and they are the next steps. P. Deuflhard, *Newton Methods
//! for Nonlinear Problems* (Springer 2004), algorithms NLEQ-ERR (section 3.3.3) and QNERR; a damped
//! step that could have been longer is not repeated.

use crate::discretisation::iterate::{Iterate, NonFinite, Residual};
use crate::newton::collocation::Collocation;
use crate::newton::failure::Failure;
use crate::newton::largest_correction::most_corrected;
use crate::newton::norm::{Norm, norm, norm_of_sum};
use crate::result::quality::{Direction, GlobalErrors, Samples};
use crate::result::stats::Stats;
use crate::shares::{NEGLIGIBLE, ONE_SAMPLE, TWO_DIGITS};
use std::sync::Arc;

/// Simplified corrections that shrink at least this much per step keep the Jacobian: three such
/// steps gain more than one new linearisation and cost less.
const KEEP_JACOBIAN_BELOW: f64 = 0.25;

/// The shortest damped step: below it the path of the iteration has ended at a singular Jacobian.
const SMALLEST_DAMPING: f64 = 1e-5;

/// So many steps, one after the other, that are all damped by less than this lead nowhere. Of 2700 solves of random belt drives that
/// converge two have such a row, both behind a mesh on which the iteration fails; those that fail take a fifth of all Newton steps
/// behind it.
const MOST_SHORT_STEPS: usize = 8;
const SHORT_DAMPING: f64 = 0.03;

/// The buffers of the iteration, and what it learns.
pub(crate) struct Newton {
    /// The affine-invariant curvature 2 ‖Δx̄‖ / ‖Δx‖² of the last full step with a new Jacobian. It
    /// hardly depends on the mesh (Deuflhard 2004, section 8.1), and so may come from another one;
    /// infinite where nothing is known.
    pub(crate) curvature: f64,
    /// ‖Δx‖ over all steps since the last linearisation.
    pub(crate) moved: f64,
    delta: Iterate,
    simplified: Iterate,
    trial: Iterate,
    residual: Residual,
    /// The sizes of the states of the last [`amplification`](Self::amplification), a segment each.
    sizes: Vec<Vec<f64>>,
}

impl Newton {
    pub(crate) fn new(collocation: &Collocation<'_>) -> Self {
        Self {
            curvature: f64::INFINITY,
            moved: 0.0,
            delta: collocation.zeros(),
            simplified: collocation.zeros(),
            trial: collocation.zeros(),
            residual: collocation.residual_buffer(),
            sizes: vec![],
        }
    }

    /// Follows the collocation to another mesh.
    pub(crate) fn resize(&mut self, collocation: &Collocation<'_>) {
        let Self { residual, .. } = self;
        for x in [&mut self.delta, &mut self.simplified, &mut self.trial] {
            collocation.resize(x);
        }
        collocation.resize_residual(residual);
    }

    /// Improves `x` until a correction is at most `tolerance` relative to 1 + |x|. On failure `x`
    /// is the last accepted iterate.
    pub(crate) fn iterate(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: &mut Iterate,
        tolerance: f64,
        max_steps: usize,
        stats: &mut Stats,
    ) -> Result<(), Failure> {
        self.linearise(collocation, x, stats)?;
        let mut fresh = true;
        let mut size = norm(x, &self.delta);
        let mut damping = 1.0;
        let mut short_steps = 0;
        // Corrections within two digits of the tolerance that no longer shrink, or not as fast as those of
        // Newton's method do so near a solution, are rounding, unless they are larger than half of the digits:
        // rounding amplified by more is not told from a failure to converge.
        let rounding = (tolerance / TWO_DIGITS).min(f64::EPSILON.sqrt());
        for _ in 0..max_steps {
            if !size.largest.is_finite() {
                return Err(Failure::Ends(collocation.dependence()));
            }
            // The mean would hide an entry that is far larger than the others. A step need not be checked
            // whose own correction is expected to be small, by the curvature of one direction.
            let predicted = 0.5 * self.curvature * size.largest * size.largest;
            if size.largest <= tolerance || fresh && ONE_SAMPLE * predicted <= tolerance {
                self.full_step(x, size, stats);
                return Ok(());
            }
            let shrunk = match self.step(collocation, x, size, &mut damping, fresh, stats) {
                Ok(shrunk) => shrunk,
                Err(_) if size.largest <= rounding => return Ok(()),
                Err(_) if !fresh => {
                    // The kept Jacobian is too old: take a new one at the same point.
                    self.linearise(collocation, x, stats)?;
                    size = norm(x, &self.delta);
                    fresh = true;
                    continue;
                }
                Err(failure) => return Err(failure),
            };
            std::mem::swap(x, &mut self.trial);
            self.moved += damping * size.mean;
            stats.newton_steps += 1;
            short_steps = match damping < SHORT_DAMPING {
                true => short_steps + 1,
                false => 0,
            };
            if short_steps == MOST_SHORT_STEPS {
                return Err(self.no_convergence(collocation, x, size));
            }
            if fresh && damping == 1.0 {
                self.curvature = 2.0 * shrunk.mean / (size.mean * size.mean);
            }
            if damping == 1.0 && shrunk.largest <= NEGLIGIBLE * tolerance {
                return Ok(());
            }
            if damping == 1.0
                && (shrunk.largest <= tolerance || shrunk.mean <= KEEP_JACOBIAN_BELOW * size.mean)
            {
                std::mem::swap(&mut self.delta, &mut self.simplified);
                collocation.stage_correction(&self.residual, &mut self.delta);
                (size, fresh) = (shrunk, false);
                continue;
            }
            self.linearise(collocation, x, stats)?;
            let next = norm(x, &self.delta);
            let negligible = next.largest <= rounding;
            if negligible && next.mean > KEEP_JACOBIAN_BELOW * size.mean {
                // It may be one of slow convergence, too.
                self.full_step(x, next, stats);
                return Ok(());
            }
            // Prediction of the damping from the curvature seen over the last step.
            let bent = norm_of_sum(x, &self.simplified, -1.0, &self.delta);
            let curvature = bent.mean * next.mean;
            damping = if curvature > 0.0 {
                (damping * size.mean * shrunk.mean / curvature).clamp(SMALLEST_DAMPING, 1.0)
            } else {
                1.0
            };
            (size, fresh) = (next, true);
        }
        if size.largest <= tolerance {
            return Ok(());
        }
        Err(self.no_convergence(collocation, x, size))
    }

    /// Adds the correction of this size without a check.
    fn full_step(&mut self, x: &mut Iterate, size: Norm, stats: &mut Stats) {
        self.trial.set_sum(x, 1.0, &self.delta);
        std::mem::swap(x, &mut self.trial);
        self.moved += size.mean;
        stats.newton_steps += 1;
    }

    /// Whether the factors may be those of the iterate to rounding, as those of a linear problem are: ω ‖Δx‖,
    /// which estimates ‖A⁻¹ ΔA‖, is at most half of the digits since they were made. ω is known from one
    /// direction alone: with 1e-6, 4 of 1500 random shocks were accepted beside their place, with 1e-4 10,
    /// with this none.
    pub(crate) fn may_be_current(&self) -> bool {
        self.moved == 0.0 || self.curvature * self.moved <= f64::EPSILON.sqrt()
    }

    /// The largest entry of Newton's correction at `x` relative to 1 + |x|.
    pub(crate) fn correction(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: &Iterate,
        stats: &mut Stats,
    ) -> Result<f64, Failure> {
        self.factor(collocation, x, stats)?;
        collocation.node_correction(&self.residual, &mut self.delta);
        Ok(norm(x, &self.delta).largest)
    }

    /// The global errors of the solution `x` by the last linearisation; see
    /// [`Collocation::global_errors`].
    pub(crate) fn global_errors(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: &Iterate,
        samples: &Samples,
        local: &[Vec<f64>],
    ) -> Option<GlobalErrors> {
        let known = (samples, local);
        collocation.global_errors(x, known, &mut self.residual, &mut self.delta)
    }

    /// Leaves w, from which the error of the solution `x` follows by the last linearisation, for
    /// [`direction`](Self::direction); see [`Collocation::correct_defects`].
    pub(crate) fn correct_defects(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: &Iterate,
        samples: &Samples,
    ) -> Result<(), NonFinite> {
        let to_stage = &Arc::clone(&collocation.tableau).defect_to_stage;
        collocation.correct_defects(x, samples, to_stage, &mut self.residual, &mut self.delta)
    }

    /// The amplification of forcings by the last linearisation; see [`Collocation::amplification`].
    pub(crate) fn amplification(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: &Iterate,
        tolerance: f64,
    ) -> f64 {
        let (residual, v) = (&mut self.residual, &mut self.simplified);
        collocation.amplification(x, tolerance, &mut self.sizes, residual, v)
    }

    /// The growth of errors of the size of the tolerance by the last linearisation, at the solution of the last
    /// [`amplification`](Self::amplification), which stays; see [`Collocation::growth`].
    pub(crate) fn growth(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: &Iterate,
        tolerance: f64,
    ) -> f64 {
        let (residual, v) = (&mut self.residual, &mut self.trial);
        collocation.growth(x, tolerance, &mut self.sizes, residual, v)
    }

    /// The direction in which the solution `x` is not isolated, if so, after
    /// [`amplification`](Self::amplification) and [`correct_defects`](Self::correct_defects); see
    /// [`Collocation::direction`].
    pub(crate) fn direction(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: &Iterate,
        samples: &Samples,
        a: f64,
        tolerance: f64,
        stats: &mut Stats,
    ) -> Option<Direction> {
        let error = (samples, &self.delta);
        let null = (&self.simplified, a);
        collocation.direction(x, error, null, tolerance, &mut self.residual, stats)
    }

    /// The direction of the last [`amplification`](Self::amplification).
    pub(crate) fn amplified(
        &self,
        collocation: &Collocation<'_>,
        x: &Iterate,
        tolerance: f64,
    ) -> Direction {
        collocation.name(x, tolerance, &self.simplified)
    }

    /// The failure of corrections of this size at `x`.
    fn no_convergence(&self, collocation: &Collocation<'_>, x: &Iterate, size: Norm) -> Failure {
        Failure::NoConvergence {
            correction: size.largest,
            largest: most_corrected(&collocation.mesh, x, &self.delta),
        }
    }

    /// Linearises at `x` and leaves the Newton correction in `delta`.
    fn linearise(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: &Iterate,
        stats: &mut Stats,
    ) -> Result<(), Failure> {
        self.factor(collocation, x, stats)?;
        collocation.correction(&self.residual, &mut self.delta);
        Ok(())
    }

    /// Linearises at `x` and factors the matrix; leaves the residual.
    fn factor(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: &Iterate,
        stats: &mut Stats,
    ) -> Result<(), Failure> {
        let linearised = collocation.linearise(x, &mut self.residual, stats);
        linearised.map_err(|error| match error.into() {
            Failure::Ends(_) => Failure::Ends(collocation.dependence()),
            other => other,
        })?;
        self.moved = 0.0;
        Ok(())
    }

    /// Finds an acceptable damped step: leaves x + λ Δx in `trial`, its simplified correction (its
    /// nodes) in `simplified`, λ in `damping`, and returns the size of that correction. With a Jacobian that
    /// is not `fresh` only the full step is tried.
    fn step(
        &mut self,
        collocation: &mut Collocation<'_>,
        x: &Iterate,
        size: Norm,
        damping: &mut f64,
        fresh: bool,
        stats: &mut Stats,
    ) -> Result<Norm, Failure> {
        loop {
            self.trial.set_sum(x, *damping, &self.delta);
            let shorter = match collocation.residual(&self.trial, &mut self.residual, stats) {
                Err(what) if 0.25 * *damping < SMALLEST_DAMPING || !fresh => {
                    return Err(Failure::NonFinite(what));
                }
                Err(_) => 0.25 * *damping,
                Ok(()) => {
                    collocation.node_correction(&self.residual, &mut self.simplified);
                    let shrunk = norm(x, &self.simplified);
                    if shrunk.mean <= (1.0 - 0.25 * *damping) * size.mean {
                        return Ok(shrunk);
                    }
                    let linear = -(1.0 - *damping);
                    let bent = norm_of_sum(x, &self.simplified, linear, &self.delta);
                    let curvature = 0.5 * size.mean * *damping * *damping / bent.mean;
                    // NaN, where the correction overflowed, takes the fixed reduction.
                    if curvature < 0.5 * *damping {
                        curvature.max(0.1 * *damping)
                    } else {
                        0.5 * *damping
                    }
                }
            };
            if shorter < SMALLEST_DAMPING || !fresh {
                return Err(self.no_convergence(collocation, x, size));
            }
            *damping = shorter;
        }
    }
}
