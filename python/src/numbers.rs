//! Numbers for `NumPy`.

use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Numbers that `NumPy` reads where they lie, by its array interface (protocol of version 3). It keeps this object as the
/// base of the array and does not write to it.
#[pyclass(frozen, module = "beltdrive._native")]
pub(crate) struct Numbers {
    numbers: Vec<f64>,
    /// In C order.
    shape: Vec<usize>,
}

impl Numbers {
    /// A row of numbers.
    pub(crate) fn row(numbers: Vec<f64>) -> Self {
        let shape = vec![numbers.len()];
        Self { numbers, shape }
    }

    /// A table, one row after the other.
    pub(crate) fn table(numbers: Vec<f64>, [rows, columns]: [usize; 2]) -> Self {
        let shape = vec![rows, columns];
        Self { numbers, shape }
    }
}

#[pymethods]
impl Numbers {
    /// Where the numbers lie.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let interface = PyDict::new(py);
        let shape = pyo3::types::PyTuple::new(py, &self.shape)?;
        let order = if cfg!(target_endian = "little") {
            "<f8"
        } else {
            ">f8"
        };
        interface.set_item("version", 3)?;
        interface.set_item("typestr", order)?;
        interface.set_item("shape", shape)?;
        interface.set_item("data", (self.numbers.as_ptr().addr(), true))?;
        Ok(interface)
    }
}
