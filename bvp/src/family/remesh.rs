//! The mesh of a family: adapted to a solution, or halved.

use super::family::Family;
use crate::accuracy::defect::defects;
use crate::accuracy::mesh_selection::{GRADING, is_wasteful, next_mesh};
use crate::discretisation::mesh::{Mesh, halved, intervals, is_representable};
use crate::discretisation::restriction::restrict;
use crate::kernels::dense::max_or_nan;
use crate::newton::collocation::Collocation;
use crate::newton::failure::Failure;
use crate::result::error::Error;
use crate::result::quality::Quality;
use crate::result::restored::restored_error;
use crate::solver::failure::{check_mesh, numerical};
use std::sync::Arc;

/// A mesh is not coarsened before it has served for this many calls of [`Family::adapted`].
const SETTLED: usize = 10;
/// New meshes are made for this fraction of the tolerance, so that they serve for a stretch of the
/// curve.
const MARGIN: f64 = 0.4;
/// A refined mesh may exceed the largest number of intervals by this factor.
const REFINED: usize = 4;

impl Family<'_> {
    /// The same family on a mesh that suits its solution, the first of `vectors`: a better one if a
    /// defect exceeds the tolerance, or if the mesh has been kept for some calls and fewer than half of
    /// its intervals would do. `vectors` (points or tangents, laid out like the first) are then
    /// interpolated on the new mesh; the point among them is to be corrected there, and the direction of
    /// [`null_vector`](Self::null_vector) to be compared anew. `None`, with the vectors unchanged, where
    /// the present mesh serves. This family stays valid: to return to it is to keep it.
    ///
    /// # Errors
    /// [`Error::NonFiniteRhs`]; [`Error::MeshLimit`] or [`Error::Unresolved`] if the better mesh has
    /// more than the intervals allowed or cannot be represented. A shorter step along the curve is then
    /// advised.
    ///
    /// # Panics
    /// If there is no vector or one is too short.
    pub fn adapted(&mut self, vectors: &mut [Vec<f64>]) -> Result<Option<Self>, Error> {
        self.read_point(&vectors[0]);
        self.settled += 1;
        let better = self
            .better_mesh()
            .map_err(|error| restored_error(&self.collocation.equations, error))?;
        let Some(mesh) = better else {
            return Ok(None);
        };
        self.settled = 0;
        let adapted = self.moved_to(mesh);
        let mesh = &self.collocation.mesh;
        for vector in vectors {
            let old = self.wrap(self.iterate(vector), Quality::unknown(mesh));
            *vector = adapted.flat(adapted.collocation.interpolate(&old));
        }
        Ok(Some(adapted))
    }

    /// The mesh that suits the iterate in work, unless the present one serves.
    fn better_mesh(&mut self) -> Result<Option<Mesh>, Error> {
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
            return Ok(None);
        }
        let next = next_mesh(mesh, &defects.relative, wanted, m, GRADING);
        if resolved {
            // Gradation may have eaten what is to be gained; and the first mesh was fine enough for
            // its author.
            let first = mesh.len() * self.options.initial_intervals;
            if 2 * intervals(&next).max(first) > intervals(mesh) {
                self.settled = 0;
                return Ok(None);
            }
        } else {
            let quality = Quality {
                defects,
                ..Quality::unknown(mesh)
            };
            check_mesh(&next, 0, &self.options, &self.wrap(self.x.clone(), quality))?;
        }
        Ok(Some(next))
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
        let refined = self.moved_to(finer);
        for vector in vectors {
            let x = restrict(tableau, equations.segments(), mesh, &self.iterate(vector));
            *vector = refined.flat(x);
        }
        Some(refined)
    }

    /// The same family on another mesh.
    fn moved_to(&self, mesh: Mesh) -> Self {
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
