//! The errors of solutions and iterates that are not good enough.

use crate::accuracy::rounding::UNIT_ROUNDOFF;
use crate::discretisation::iterate::NonFinite;
use crate::discretisation::mesh::{Mesh, intervals, is_representable};
use crate::newton::failure::Failure;
use crate::newton_matrix::dependence::Dependence;
use crate::result::error::Error;
use crate::result::solution::Solution;
use crate::solver::options::Options;

/// Meshes tried before the tolerance is declared out of reach.
const MAX_MESHES: usize = 40;

/// Refuses a mesh after `tried` others that is too large, too late or cannot be represented.
pub(crate) fn check_mesh(
    finer: &Mesh,
    tried: usize,
    options: &Options,
    best: &Solution,
) -> Result<(), Error> {
    let (needed, limit) = (intervals(finer), options.max_intervals);
    if needed > limit {
        let (segment, s, _) = best.worst_interval();
        return Err(Error::MeshLimit {
            needed,
            limit,
            defect: best.defect(),
            error: best.error_estimate().unwrap_or(f64::INFINITY),
            tolerance: options.tolerance,
            segment,
            s,
            best: Box::new(best.clone()),
        });
    }
    if tried < MAX_MESHES && is_representable(finer) {
        Ok(())
    } else {
        Err(unresolved(options, best))
    }
}

/// The error for a solution that no mesh seems to resolve.
fn unresolved(options: &Options, best: &Solution) -> Error {
    let (segment, s, length) = best.worst_interval();
    Error::Unresolved {
        segment,
        s,
        length,
        meshes: best.stats.meshes,
        defect: best.defect(),
        error: best.error_estimate().unwrap_or(f64::INFINITY),
        tolerance: options.tolerance,
        best: Box::new(best.clone()),
    }
}

/// The error for a failure of Newton's method.
pub(crate) fn numerical(failure: Failure, best: Solution, tolerance: f64) -> Error {
    let steps = best.stats.newton_steps;
    let best = Box::new(best);
    match failure {
        Failure::NonFinite(NonFinite::Rhs {
            segment,
            s,
            component,
        }) => Error::NonFiniteRhs {
            segment,
            s,
            component,
            best,
        },
        Failure::NonFinite(NonFinite::Condition { index }) => Error::NonFiniteCondition {
            condition: index,
            best,
        },
        Failure::Node { segment, node } => Error::SingularNode {
            segment,
            node,
            s: best.mesh[segment][node],
            best,
        },
        Failure::Ends(Dependence { conditions, free }) => Error::SingularConditions {
            conditions,
            free,
            shift: false,
            best,
        },
        Failure::NoConvergence {
            correction,
            largest,
        } => Error::NoConvergence {
            correction,
            largest,
            steps,
            tolerance,
            best,
        },
    }
}

/// The error for a solution that rounding hides.
pub(crate) fn ill_conditioned(rounding: f64, tolerance: f64, best: Solution) -> Error {
    // A solution has no more than all of its digits to lose.
    let rounding = if rounding < 1.0 { rounding } else { 1.0 };
    Error::IllConditioned {
        rounding,
        condition: rounding / UNIT_ROUNDOFF,
        tolerance,
        best: Box::new(best),
    }
}
