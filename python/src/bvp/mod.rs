//! Boundary value problems that Python states.

mod solution;
mod statement;

use crate::failure::InputError;
use ::bvp::{Control, Error, Options, Table};
use pyo3::prelude::*;
pub(crate) use solution::BvpSolution;
use statement::{Statement, numbers};

/// Why it ended, as in `SciPy`: solved, no room for the mesh, a singular Jacobian; and anything else.
const SOLVED: u8 = 0;
const NO_ROOM: u8 = 1;
const SINGULAR: u8 = 2;
const FAILED: u8 = 3;

/// Solves a boundary value problem with n states and k parameters from a guess at nodes. Numbers come as the bytes of
/// arrays: the nodes, the states at each node, one node after the other, and the parameters.
#[pyfunction]
#[expect(
    clippy::too_many_arguments,
    reason = "one for each part of the statement"
)]
pub(crate) fn solve_bvp(
    py: Python<'_>,
    fun: Py<PyAny>,
    fun_jac: Option<Py<PyAny>>,
    bc: Py<PyAny>,
    bc_jac: Option<Py<PyAny>>,
    nodes: &[u8],
    states: &[u8],
    parameters: &[u8],
    tolerance: f64,
    max_nodes: usize,
    with_defect: bool,
) -> PyResult<BvpSolution> {
    let nodes = numbers(nodes);
    let states = numbers(states);
    let parameters = numbers(parameters);
    let statement = Statement::new(
        [states.len() / nodes.len(), parameters.len()],
        [nodes[0], nodes[nodes.len() - 1]],
        [(fun, fun_jac), (bc, bc_jac)],
    );
    let guess = Table {
        nodes: vec![nodes],
        states: vec![states],
        parameters,
    };
    let options = Options {
        tolerance,
        max_intervals: max_nodes.saturating_sub(1),
        control: if with_defect {
            Control::Both
        } else {
            Control::Error
        },
        ..Options::default()
    };
    let solved = py.detach(|| ::bvp::solve(&statement, &guess, &options));
    if let Some(error) = statement.failure() {
        return Err(error);
    }
    let error = match solved {
        Ok(solution) => {
            let message = "The algorithm converged to the desired accuracy.".to_owned();
            return Ok(BvpSolution::new(solution, SOLVED, message));
        }
        Err(error) => error,
    };
    let status = match error {
        Error::MeshLimit { .. } | Error::FirstMesh { .. } => NO_ROOM,
        Error::SingularNode { .. } | Error::SingularConditions { .. } => SINGULAR,
        _ => FAILED,
    };
    match error.best() {
        Some(best) => Ok(BvpSolution::new(best.clone(), status, error.to_string())),
        None => Err(InputError::new_err(error.to_string())),
    }
}
