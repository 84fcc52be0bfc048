//! The mesh of a family: fitted to a solution, or halved.

use super::family::Family;
use crate::accuracy::defect::defects;
use crate::accuracy::mesh_selection::{GRADING, is_wasteful, next_mesh};
use crate::discretisation::mesh::{Mesh, halved, intervals, is_representable};
use crate::discretisation::restriction::restrict;
use crate::kernels::dense::max_or_nan;
use crate::newton::collocation::Collocation;
use crate::newton::newton::Failure;
use crate::result::error::Error;
use crate::result::solution::Quality;
use crate::solver::failure::{check_mesh, numerical};
use std::sync::Arc;

/// A mesh is not coarsened before it has served for so many calls of [`Family::adapt`].
const SETTLED: usize = 10;
/// New meshes are made for this fraction of the tolerance, so that they serve for a stretch of the
/// curve.
const MARGIN: f64 = 0.4;
/// Points on a new mesh are corrected until the corrections are this fraction of the tolerance, ...
const NEWTON_FRACTION: f64 = 0.01;
/// ... or below this and no longer shrink.
const ROUNDING: f64 = 1e-8;
/// The shortest damped step.
const SMALLEST_DAMPING: f64 = 1e-3;
/// A refined mesh may exceed the largest number of intervals by this factor.
const REFINED: usize = 4;

impl Family<'_> {
    /// Fits the mesh to the solution `z`: makes a better one if a defect exceeds the tolerance, or if
    /// the mesh has been kept for some calls and fewer than half of its intervals would do. The
    /// number of unknowns then changes, every one of `vectors` (points or tangents, laid out like
    /// `z`) is interpolated on the new mesh, and the answer is true. One that equals `z` is corrected
    /// there; the direction of [`null_vector`](Self::null_vector) is to be compared anew.
    ///
    /// # Errors
    /// [`Error::NonFiniteRhs`]; [`Error::MeshLimit`] or [`Error::Unresolved`] if the better mesh has
    /// more than the intervals allowed or cannot be represented; [`Error::NoConvergence`] if no
    /// solution is found there. The family and the vectors are then unchanged, and a shorter step
    /// along the curve is advised.
    ///
    /// # Panics
    /// If `z` or a vector is too short.
    pub fn adapt(&mut self, z: &[f64], vectors: &mut [Vec<f64>]) -> Result<bool, Error> {
        self.read_point(z);
        self.settled += 1;
        let Collocation {
            equations,
            tableau,
            mesh,
            ..
        } = &self.collocation;
        let (tolerance, m) = (self.options.tolerance, tableau.stages);
        let wanted = MARGIN * tolerance;
        let defects = match defects(
            equations,
            tableau,
            mesh,
            &self.x,
            &mut vec![],
            &mut self.stats,
        ) {
            Ok(defects) => defects,
            Err(what) => {
                let best = self.wrap(self.x.clone(), Quality::unknown(mesh));
                return Err(numerical(Failure::NonFinite(what), best, 0.0));
            }
        };
        let largest = defects
            .relative
            .iter()
            .flatten()
            .copied()
            .fold(0.0, max_or_nan);
        let resolved = largest <= tolerance;
        if resolved && (self.settled < SETTLED || !is_wasteful(&defects.relative, wanted, m)) {
            return Ok(false);
        }
        let next = next_mesh(mesh, &defects.relative, wanted, m, GRADING);
        if resolved {
            // Gradation may have eaten what is to be gained; and the first mesh was fine enough for
            // its author.
            let first = mesh.len() * self.options.initial_intervals;
            if 2 * intervals(&next).max(first) > intervals(mesh) {
                self.settled = 0;
                return Ok(false);
            }
        } else {
            let quality = Quality {
                defects,
                ..Quality::unknown(mesh)
            };
            check_mesh(&next, &self.options, &self.wrap(self.x.clone(), quality))?;
        }
        let mut adapted = self.on_mesh(next);
        let interpolated = |vector: &[f64]| {
            let old = self.wrap(self.iterate(vector), Quality::unknown(mesh));
            adapted.flat(&adapted.collocation.interpolate(&old))
        };
        let moved: Vec<Vec<f64>> = vectors.iter().map(|v| interpolated(v)).collect();
        let point = interpolated(z);
        let point = adapted.corrected(point)?;
        for (vector, moved) in vectors.iter_mut().zip(moved) {
            let is_the_point = vector.as_slice() == z;
            *vector = if is_the_point { point.clone() } else { moved };
        }
        *self = adapted;
        Ok(true)
    }

    /// The point near `z` with G = 0, by damped Gauss-Newton steps: every correction is the solution
    /// of J δ = −G that [`particular`](Self::particular) finds, which exists at limit points too.
    fn corrected(&mut self, mut z: Vec<f64>) -> Result<Vec<f64>, Error> {
        let wanted = (NEWTON_FRACTION * self.options.tolerance).max(100.0 * f64::EPSILON);
        let mut g = vec![0.0; z.len() - 1];
        let (mut delta, mut simplified) = (vec![0.0; z.len()], vec![0.0; z.len()]);
        let mut size = f64::INFINITY;
        for _ in 0..self.options.max_newton_steps {
            self.linearise(&z)?;
            let before = size;
            size = self.correction(&z, &z, &mut g, &mut delta);
            let rounding = size <= ROUNDING && size > 0.5 * before;
            if rounding {
                return Ok(z);
            }
            let mut damping = 1.0;
            let trial = loop {
                let steps = z.iter().zip(&delta);
                let trial: Vec<f64> = steps.map(|(z, d)| z + damping * d).collect();
                if size <= wanted {
                    return Ok(trial);
                }
                let shrunk = self.correction(&z, &trial, &mut g, &mut simplified);
                if shrunk <= (1.0 - 0.25 * damping) * size {
                    break trial;
                }
                damping *= 0.5;
                if damping < SMALLEST_DAMPING {
                    let best = self.iterate(&z);
                    let best = self.wrap(best, Quality::unknown(&self.collocation.mesh));
                    let failure = Failure::NoConvergence {
                        correction: size,
                        largest: None,
                    };
                    return Err(numerical(failure, best, wanted));
                }
            };
            z = trial;
        }
        Ok(z)
    }

    /// The correction at `place` with the Jacobian of the last linearisation, into `delta`; its
    /// largest entry relative to 1 + |z| is returned, which is infinite where G is not finite.
    fn correction(&mut self, z: &[f64], place: &[f64], g: &mut [f64], delta: &mut [f64]) -> f64 {
        self.residual(place, g);
        g.iter_mut().for_each(|g| *g = -*g);
        self.particular(g, delta);
        let relative = |(z, d): (&f64, &f64)| (d / (1.0 + z.abs())).abs();
        let largest = z
            .iter()
            .zip(delta.iter())
            .map(relative)
            .fold(0.0, max_or_nan);
        if largest.is_nan() {
            f64::INFINITY
        } else {
            largest
        }
    }

    /// The same family on the mesh with every interval halved, for an estimate of the error: the
    /// collocation polynomials of every one of `vectors` are expressed on it exactly. `None`, and
    /// nothing is changed, if that mesh has more than four times the intervals allowed or cannot be
    /// represented.
    ///
    /// # Panics
    /// If a vector is too short.
    pub fn refined(&self, vectors: &mut [Vec<f64>]) -> Option<Self> {
        let Collocation {
            equations,
            tableau,
            mesh,
            ..
        } = &self.collocation;
        let finer = halved(mesh);
        let limit = REFINED.saturating_mul(self.options.max_intervals);
        if intervals(&finer) > limit || !is_representable(&finer) {
            return None;
        }
        let refined = self.on_mesh(finer);
        for vector in vectors {
            let x = restrict(tableau, equations.segments(), mesh, &self.iterate(vector));
            *vector = refined.flat(&x);
        }
        Some(refined)
    }

    /// The same family on another mesh.
    fn on_mesh(&self, mesh: Mesh) -> Self {
        let Collocation {
            equations, tableau, ..
        } = &self.collocation;
        let collocation = Collocation::new(equations.clone(), Arc::clone(tableau), mesh);
        let (layout, options) = (self.layout.clone(), self.options.clone());
        let mut stats = self.stats;
        stats.meshes += 1;
        Self::on(collocation, layout, options, stats)
    }
}
