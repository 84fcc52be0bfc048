//! Solutions for Python.

use super::statement::numbers;
use crate::numbers::Numbers;
use ::bvp::Solution;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A solution, or the best iterate where there is none. Arrays are of all states, then of all places.
#[pyclass(frozen, module = "beltdrive._native")]
pub(crate) struct BvpSolution {
    solution: Solution,
    #[pyo3(get)]
    status: u8,
    #[pyo3(get)]
    message: String,
}

impl BvpSolution {
    pub(super) fn new(solution: Solution, status: u8, message: String) -> Self {
        Self {
            solution,
            status,
            message,
        }
    }

    fn states(&self) -> usize {
        self.solution.segments()[0].states
    }

    /// A table of what is written for each place.
    fn table(&self, places: &[f64], write: impl Fn(f64, &mut [f64])) -> Numbers {
        let (n, m) = (self.states(), places.len());
        let (mut table, mut column) = (vec![0.0; n * m], vec![0.0; n]);
        for (place, &s) in places.iter().enumerate() {
            write(s, &mut column);
            for (state, value) in column.iter().enumerate() {
                table[state * m + place] = *value;
            }
        }
        Numbers::table(table, [n, m])
    }
}

#[pymethods]
impl BvpSolution {
    fn mesh(&self) -> Numbers {
        Numbers::row(self.solution.mesh(0).to_vec())
    }

    fn parameters(&self) -> Numbers {
        Numbers::row(self.solution.parameters().to_vec())
    }

    /// The states at places, which come as the bytes of an array.
    fn values(&self, places: &[u8]) -> Numbers {
        self.table(&numbers(places), |s, y| self.solution.state(0, s, y))
    }

    /// The slopes there.
    fn slopes(&self, places: &[u8]) -> Numbers {
        self.table(&numbers(places), |s, y| self.solution.derivative(0, s, y))
    }

    fn defects(&self) -> Numbers {
        Numbers::row(self.solution.defects(0).to_vec())
    }

    fn error_estimate(&self) -> Option<f64> {
        self.solution.error_estimate()
    }

    fn state_errors(&self) -> Option<Numbers> {
        let errors = self.solution.state_errors(0);
        errors.map(|errors| Numbers::row(errors.to_vec()))
    }

    fn parameter_errors(&self) -> Option<Numbers> {
        let errors = self.solution.parameter_errors();
        errors.map(|errors| Numbers::row(errors.to_vec()))
    }

    /// The cost of the solution.
    fn stats<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let stats = self.solution.stats();
        let all = PyDict::new(py);
        all.set_item("rhs_evaluations", stats.rhs_evaluations)?;
        all.set_item("jacobian_evaluations", stats.jacobian_evaluations)?;
        all.set_item("factorisations", stats.factorisations)?;
        all.set_item("newton_steps", stats.newton_steps)?;
        all.set_item("meshes", stats.meshes)?;
        all.set_item("seconds", stats.seconds)?;
        Ok(all)
    }
}
