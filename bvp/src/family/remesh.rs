//! The mesh of a family: adapted to a solution, or halved.

use super::family::Family;
use crate::accuracy::defect::defects;
use crate::accuracy::mesh_selection::{
    GRADING, GRADING_BY_ERROR, UNRESOLVED, is_wasteful, next_mesh, relevant,
};
use crate::discretisation::mesh::{Mesh, halved, intervals, is_representable};
use crate::discretisation::restriction::restrict;
use crate::kernels::dense::max_or_nan;
use crate::newton::collocation::Collocation;
use crate::newton::failure::Failure;
use crate::result::error::Error;
use crate::result::quality::{Defects, Quality, Samples};
use crate::result::restored::restored_error;
use crate::shares::AIM;
use crate::solver::failure::{check_mesh, numerical};
use crate::solver::options::Control;
use std::sync::Arc;

/// A mesh is not coarsened before it has served for this many calls of [`Family::adapted`].
const SETTLED: usize = 10;
/// New meshes are made for this fraction of the tolerance, so that they serve for a stretch of the
/// curve.
const MARGIN: f64 = 0.4;
/// A refined mesh may exceed the largest number of intervals by this factor.
const REFINED: usize = 4;

/// What is asked of a mesh: sizes on its intervals that are ∝ h to the power of an order, and how large they may be.
#[derive(Clone)]
struct Need {
    sizes: Vec<Vec<f64>>,
    allowed: f64,
    /// What a new mesh is made for.
    wanted: f64,
    order: usize,
    grading: f64,
}

impl Need {
    fn is_met(&self) -> bool {
        let largest = self.sizes.iter().flatten().copied().fold(0.0, max_or_nan);
        largest <= self.allowed
    }

    /// The mesh that meets it.
    fn mesh(&self, mesh: &Mesh) -> Mesh {
        next_mesh(mesh, &self.sizes, self.wanted, self.order, self.grading)
    }
}

impl Family<'_> {
    /// The same family on a mesh that suits its solution, the first of `vectors`: a better one if what
    /// [`Options::control`](crate::Options::control) names exceeds the tolerance, or if the mesh has been
    /// kept for some calls and fewer than half of its intervals would do. The error is that across the curve,
    /// by the last linearisation, which is to be nearby; before there is one, and where the error is larger
    /// than the tolerance but the defect is not, the defect decides. `vectors` (points or tangents, laid out
    /// like the first) are then interpolated on the new mesh; the point among them is to be corrected there,
    /// and the direction of
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
        let mut samples = vec![];
        let found = defects(
            equations,
            tableau,
            mesh,
            &self.x,
            &mut samples,
            &mut self.stats,
        );
        let defects = match found {
            Ok(defects) => defects,
            Err(what) => {
                let best = self.wrap(self.x.clone(), Quality::unknown(mesh));
                return Err(numerical(Failure::NonFinite(what), best, 0.0));
            }
        };
        // Beside a branch point the error is large on every mesh, since the linearisation nearly has a second null
        // vector: a mesh on which the defect is within the tolerance serves there.
        let needs = [
            self.need_by_error(&defects, &samples),
            Some(self.need_by_defect(&defects)),
        ];
        let mesh = &self.collocation.mesh;
        let needs = needs.into_iter().flatten();
        let serves = needs.clone().find(Need::is_met);
        if let Some(need) = serves {
            if self.settled < SETTLED || !is_wasteful(&need.sizes, need.wanted, need.order) {
                return Ok(None);
            }
            let next = need.mesh(mesh);
            // Gradation may have eaten what is to be gained; and the first mesh was fine enough for
            // its author.
            let first = mesh.len() * self.options.initial_intervals;
            if 2 * intervals(&next).max(first) > intervals(mesh) {
                self.settled = 0;
                return Ok(None);
            }
            return Ok(Some(next));
        }
        let next = needs.map(|need| need.mesh(mesh)).min_by_key(intervals);
        let next = next.expect("that of the defect");
        let quality = Quality {
            defects,
            ..Quality::unknown(mesh)
        };
        check_mesh(&next, 0, &self.options, &self.wrap(self.x.clone(), quality))?;
        Ok(Some(next))
    }

    /// What a defect within the tolerance asks of the mesh.
    fn need_by_defect(&self, defects: &Defects) -> Need {
        Need {
            sizes: defects.relative.clone(),
            allowed: self.options.tolerance,
            wanted: MARGIN * self.options.tolerance,
            order: self.collocation.tableau.stages,
            grading: GRADING,
        }
    }

    /// What an error across the curve within the tolerance asks of the mesh, by the last linearisation, which is
    /// nearby; `None` where another need is controlled or the error is not known.
    fn need_by_error(&mut self, defects: &Defects, samples: &Samples) -> Option<Need> {
        let tolerance = self.options.tolerance;
        if self.options.control != Control::Error || !self.linearised {
            return None;
        }
        let resolving: Vec<Vec<f64>> = relevant(defects, Some(tolerance))
            .map(Iterator::collect)
            .collect();
        let unresolved = Need {
            sizes: resolving,
            allowed: UNRESOLVED,
            wanted: AIM * UNRESOLVED,
            order: self.collocation.tableau.stages,
            grading: GRADING_BY_ERROR,
        };
        if !unresolved.is_met() {
            return Some(unresolved);
        }
        let known = (samples, &defects.local[..]);
        let [mut w, mut t] = [(); 2].map(|()| self.collocation.zeros());
        let (x, residual) = (&self.x, &mut self.residual);
        let errors = self
            .collocation
            .errors_across(x, known, residual, [&mut w, &mut t])?;
        let allowed = tolerance * defects.largest_local() / errors.largest();
        Some(Need {
            sizes: defects.local.clone(),
            allowed,
            wanted: MARGIN * allowed,
            order: self.collocation.tableau.scheme.dense_order(),
            grading: GRADING_BY_ERROR,
        })
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
