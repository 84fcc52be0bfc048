//! An answer for Python.

use crate::numbers::Numbers;
use beltdrive::quantity::{self, UnitSystem};
use beltdrive::report::{self, Node};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// An answer, told as values or as text.
#[pyclass(frozen, module = "beltdrive._native")]
pub(crate) struct Answer {
    answer: quantity::Answer,
    /// The drive file that was found, if one was sought and found.
    #[pyo3(get)]
    drive_file: Option<String>,
}

impl Answer {
    pub(crate) fn new(answer: quantity::Answer) -> Self {
        let drive_file = None;
        Self { answer, drive_file }
    }

    /// The same answer with a drive file that was found.
    pub(crate) fn with_drive_file(self, drive_file: Option<String>) -> Self {
        Self { drive_file, ..self }
    }
}

/// A system of units by its name.
pub(crate) fn units(name: &str) -> PyResult<UnitSystem> {
    match name {
        "si" => Ok(UnitSystem::Si),
        "engineering" => Ok(UnitSystem::Engineering),
        "us" => Ok(UnitSystem::Us),
        _ => Err(crate::failure::InputError::new_err(format!(
            "there are no units `{name}`; expected `si`, `engineering` or `us`"
        ))),
    }
}

#[pymethods]
impl Answer {
    /// The values by their keys: dictionaries, lists, numbers, words and [`Numbers`].
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        object(py, report::tree(&self.answer))
    }

    /// The lines above a table.
    fn heading(&self) -> Vec<String> {
        self.answer.heading.clone()
    }

    /// The table that the program prints.
    fn table(&self, units: &str) -> PyResult<String> {
        Ok(report::table(&self.answer, self::units(units)?))
    }

    /// A piece of a page in HTML.
    fn html(&self, units: &str) -> PyResult<String> {
        Ok(report::html(&self.answer, self::units(units)?))
    }

    /// The JSON of the program, without its origin.
    fn json(&self) -> String {
        report::json(&self.answer)
    }

    /// The rows of the answer as CSV.
    fn csv(&self) -> String {
        report::csv(&self.answer)
    }
}

/// A part of an answer. Numbers in a row are for `NumPy` to take over as they lie in memory.
fn object(py: Python<'_>, node: Node) -> PyResult<Bound<'_, PyAny>> {
    Ok(match node {
        Node::Number(number) => number.into_pyobject(py)?.into_any(),
        Node::Count(count) => count.into_pyobject(py)?.into_any(),
        Node::Numbers(numbers) => Numbers::row(numbers).into_pyobject(py)?.into_any(),
        Node::Word(word) => word.into_pyobject(py)?.into_any(),
        Node::Object(entries) => {
            let dict = PyDict::new(py);
            for (key, value) in entries {
                dict.set_item(key, object(py, value)?)?;
            }
            dict.into_any()
        }
        Node::List(objects) => list(py, objects.into_iter().map(|node| object(py, node)))?,
        Node::Json(value) => json(py, value)?,
        _ => py.None().into_bound(py),
    })
}

/// A value of JSON.
fn json(py: Python<'_>, value: serde_json::Value) -> PyResult<Bound<'_, PyAny>> {
    use serde_json::Value;
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(value) => value.into_pyobject(py)?.to_owned().into_any(),
        Value::Number(number) => match number.as_u64() {
            Some(count) => count.into_pyobject(py)?.into_any(),
            None => number.as_f64().into_pyobject(py)?.into_any(),
        },
        Value::String(text) => text.into_pyobject(py)?.into_any(),
        Value::Array(values) => {
            let numbers: Option<Vec<_>> = values.iter().map(Value::as_f64).collect();
            match numbers.filter(|numbers| !numbers.is_empty()) {
                Some(numbers) => Numbers::row(numbers).into_pyobject(py)?.into_any(),
                None => list(py, values.into_iter().map(|value| json(py, value)))?,
            }
        }
        Value::Object(entries) => {
            let dict = PyDict::new(py);
            for (key, value) in entries {
                dict.set_item(key, json(py, value)?)?;
            }
            dict.into_any()
        }
    })
}

fn list<'py>(
    py: Python<'py>,
    objects: impl Iterator<Item = PyResult<Bound<'py, PyAny>>>,
) -> PyResult<Bound<'py, PyAny>> {
    let objects = objects.collect::<PyResult<Vec<_>>>()?;
    Ok(PyList::new(py, objects)?.into_any())
}
