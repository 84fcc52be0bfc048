//! Many drives from a table, and their answers as a table.

mod input;
mod output;

use crate::failure::{Failure, InputError};
use crate::stated::Stated;
use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{RecordBatch, RecordBatchIterator};
use arrow_schema::{ArrowError, SchemaRef};
use beltdrive::belt_loop::Varied;
use beltdrive::input::TableHead;
use beltdrive::quantity::sweep::Columns;
use beltdrive::report::{Field, Head};
use beltdrive::{Sweep, SweepQuestion, SweepRow, SweepSummary};
use input::Input;
use output::Output;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict};
use std::ffi::CStr;

/// What a capsule with a stream of record batches is called
/// (<https://arrow.apache.org/docs/format/CDataInterface/PyCapsuleInterface.html>).
const STREAM: &CStr = c"arrow_array_stream";

/// A table in Arrow, for any library that takes an object with `__arrow_c_stream__`: `pyarrow.table(table)`,
/// `polars.DataFrame(table)`, `pandas.DataFrame.from_arrow(table)`.
#[pyclass(frozen, module = "beltdrive")]
pub(crate) struct Table {
    schema: SchemaRef,
    batches: Vec<RecordBatch>,
    summary: SweepSummary,
}

#[pymethods]
impl Table {
    /// The number of rows.
    #[getter]
    fn num_rows(&self) -> usize {
        self.batches.iter().map(RecordBatch::num_rows).sum()
    }

    /// The names of the columns.
    #[getter]
    fn column_names(&self) -> Vec<String> {
        let fields = self.schema.fields().iter();
        fields.map(|field| field.name().clone()).collect()
    }

    /// The number of rows with an answer.
    #[getter]
    fn answered(&self) -> usize {
        self.summary.answered()
    }

    /// How many rows have no answer, by reason.
    #[getter]
    fn refusals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let reasons = PyDict::new(py);
        for (reason, count, _) in self.summary.refusals.by_reason() {
            reasons.set_item(reason, count)?;
        }
        Ok(reasons)
    }

    fn __len__(&self) -> usize {
        self.num_rows()
    }

    fn __repr__(&self) -> String {
        let columns = self.schema.fields().len();
        let (rows, answered) = (self.num_rows(), self.answered());
        format!("<Table: {rows} rows of {columns} columns, {answered} answered>")
    }

    /// The record batches as a capsule; a schema that is asked for makes no difference.
    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let _ = requested_schema;
        let batches: Vec<Result<_, ArrowError>> = self.batches.iter().cloned().map(Ok).collect();
        let reader = RecordBatchIterator::new(batches, self.schema.clone());
        PyCapsule::new_with_value(py, FFI_ArrowArrayStream::new(Box::new(reader)), STREAM)
    }
}

/// A question asked of the drive of each row of a table.
#[pyfunction]
pub(crate) fn solve_table(
    py: Python<'_>,
    stated: Stated,
    table: &Bound<'_, PyAny>,
    question: &str,
    keep: Vec<String>,
) -> PyResult<Table> {
    let question = self::question(question)?;
    let input = Input::read(table, &keep)?;
    let (sweep, rows) = stated.ask(py, |file, options| {
        // A drive file that is at fault says so itself.
        file.drive()?;
        let headings: Vec<_> = input.headings().collect();
        let head = TableHead::new("table", &headings, file).map_err(|error| {
            Failure::Input(format!(
                "{error}\nhelp: `keep=[…]` names columns that are carried over"
            ))
        })?;
        let varied = head.keys().map(Varied::of).collect();
        let sweep = Sweep::new(file, varied, question, *options);
        let sweep = sweep.map_err(Failure::input)?;
        Ok((sweep, input.rows(&head)))
    })?;
    let columns = Columns::new(&sweep);
    let head = Head::of(&columns.quantities());
    let metadata = stated.metadata(sweep.question().name());
    let mut output = Output::new(&head, &input, metadata)?;
    let mut summary = SweepSummary::default();
    let mut first = 0;
    for chunk in rows.chunks(sweep.usual_chunk()) {
        // An interrupt from the keyboard ends the work here.
        py.check_signals()?;
        let (counted, fields) = py.detach(|| answers(&sweep, &columns, &head, chunk, first));
        counted.into_iter().for_each(|row| summary.join(row));
        output.write(&fields)?;
        first += chunk.len();
    }
    let (schema, batches) = output.finish();
    Ok(Table {
        schema,
        batches,
        summary,
    })
}

/// The answers of rows, of which the first has a number, as fields of columns, and how many there are.
fn answers(
    sweep: &Sweep,
    columns: &Columns<'_>,
    head: &Head,
    rows: &[SweepRow],
    first: usize,
) -> (Vec<SweepSummary>, Vec<Vec<Option<Field>>>) {
    let answers = sweep.answer(rows, |index, row, answer| {
        let mut counted = SweepSummary::default();
        counted.add(answer);
        (
            counted,
            head.row(columns.values(first + index, row, answer)),
        )
    });
    answers.into_iter().unzip()
}

/// A question by its name.
fn question(name: &str) -> PyResult<SweepQuestion> {
    let mut questions = SweepQuestion::ALL.into_iter();
    let found = questions.find(|question| question.name() == name);
    found.ok_or_else(|| {
        InputError::new_err(format!(
            "there is no question `{name}` to ask of a table; expected `solve`, `check` or `limits`"
        ))
    })
}
