//! A problem linearised at a solution of it, on the mesh of the solution.

use crate::discretisation::iterate::{Iterate, Residual};
use crate::newton::collocation::Collocation;
use crate::newton::failure::Failure;
use crate::problem::equations::Equations;
use crate::problem::held::Held;
use crate::result::error::Error;
use crate::result::quality::Quality;
use crate::result::restored::{divided, restored_error};
use crate::result::solution::Solution;
use crate::result::stats::Stats;
use crate::solver::failure::numerical;
use crate::solver::options::Options;
use crate::solver::statement::{check_statement, first_mesh, in_units};
use std::sync::Arc;

/// A problem in pieces and units, linearised at a solution.
pub(crate) struct AtSolution<'a> {
    pub(crate) collocation: Collocation<'a>,
    /// The solution in these pieces and units.
    pub(crate) x: Iterate,
    pub(crate) residual: Residual,
    /// What the linearisation has cost.
    pub(crate) stats: Stats,
}

/// Linearises a problem at a solution. The errors are those of [`Solution::conditioning`].
pub(crate) fn at_solution<'a>(
    equations: &'a dyn Equations,
    solution: &Solution,
) -> Result<AtSolution<'a>, Error> {
    let equations = Held::none(equations);
    check_statement(&equations, 0)?;
    let any_size = Options {
        max_intervals: usize::MAX,
        absolute: solution.absolute.clone(),
        ..Options::default()
    };
    let mesh = first_mesh(&equations, solution, &any_size)?;
    let equations = in_units(&equations, &any_size)?;
    let x = divided(&equations, solution);
    let tableau = Arc::clone(&solution.tableau);
    let mut collocation = Collocation::new(equations, tableau, mesh);
    let mut residual = collocation.residual_buffer();
    let mut stats = Stats::default();
    match collocation.linearise(&x, &mut residual, &mut stats) {
        Ok(()) => Ok(AtSolution {
            collocation,
            x,
            residual,
            stats,
        }),
        Err(failure) => Err(failed(&collocation, &x, solution, Failure::from(failure))),
    }
}

/// The error for a solution at which something fails.
pub(crate) fn failed(
    collocation: &Collocation<'_>,
    x: &Iterate,
    solution: &Solution,
    failure: Failure,
) -> Error {
    let of_pieces = Solution {
        segments: collocation.equations.segments().to_vec(),
        mesh: collocation.mesh.clone(),
        x: x.clone(),
        quality: Quality::unknown(&collocation.mesh),
        ..solution.clone()
    };
    let error = numerical(failure, of_pieces, 0.0);
    let mut error = restored_error(&collocation.equations, error);
    if let Some(best) = error.best_mut() {
        *best = solution.clone();
    }
    error
}
