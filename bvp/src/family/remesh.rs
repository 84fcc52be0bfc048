//! The mesh of a family: fitted to a solution, or halved.

use super::Family;
use crate::collocation::Collocation;
use crate::defect::defects;
use crate::dense::max_or_nan;
use crate::error_control::{is_wasteful, next_mesh};
use crate::mesh::{Mesh, halved, intervals, is_representable};
use crate::newton::Failure;
use crate::restriction::restrict;
use crate::solution::Quality;
use crate::solver::{check_mesh, numerical};
use crate::{Equations, Error};
use std::sync::Arc;

/// A mesh is not coarsened before it has served for so many calls of [`Family::adapt`].
const SETTLED: usize = 10;
/// New meshes are made for this fraction of the tolerance, so that they serve for a stretch of the
/// curve.
const MARGIN: f64 = 0.4;
/// A refined mesh may exceed the largest number of intervals by this factor.
const REFINED: usize = 4;

impl Family<'_> {
    /// Fits the mesh to the solution `z`: makes a better one if a defect exceeds the tolerance, or if
    /// the mesh has been kept for some calls and fewer than half of its intervals would do. The
    /// number of unknowns then changes, every one of `vectors` (points or tangents, laid out like
    /// `z`) is interpolated on the new mesh, and the answer is true; the interpolated points are to
    /// be corrected, and the direction of [`null_vector`](Self::null_vector) compared anew.
    ///
    /// # Errors
    /// [`Error::NonFiniteRhs`]; [`Error::MeshLimit`] or [`Error::Unresolved`] if the better mesh has
    /// more than the intervals allowed or cannot be represented. The family and the vectors are then
    /// unchanged.
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
        let defects = match defects(equations, tableau, mesh, &self.x, &mut self.stats) {
            Ok(defects) => defects,
            Err(what) => {
                let best = self.wrap(self.x.clone(), Quality::unknown(mesh));
                return Err(numerical(Failure::NonFinite(what), best, 0.0));
            }
        };
        let largest = defects.iter().flatten().copied().fold(0.0, max_or_nan);
        let resolved = largest <= tolerance;
        if resolved && (self.settled < SETTLED || !is_wasteful(&defects, wanted, m)) {
            return Ok(false);
        }
        let next = next_mesh(mesh, &defects, wanted, m);
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
        let adapted = self.on_mesh(next);
        for vector in vectors {
            let unknown = Quality::unknown(mesh);
            let old = self.wrap(self.iterate(vector), unknown);
            *vector = adapted.flat(&adapted.collocation.interpolate(&old));
        }
        *self = adapted;
        Ok(true)
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
