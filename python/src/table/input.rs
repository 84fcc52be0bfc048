//! The rows of a table from Python.

use super::STREAM;
use crate::failure::InputError;
use arrow_array::cast::AsArray;
use arrow_array::ffi_stream::{FFI_ArrowArrayStream, RecordBatchStreamReader};
use arrow_array::types::{
    Float16Type, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type,
    UInt16Type, UInt32Type, UInt64Type,
};
use arrow_array::{Array, ArrayRef, ArrowPrimitiveType, RecordBatch, RecordBatchReader};
use arrow_schema::{ArrowError, DataType, FieldRef, SchemaRef};
use beltdrive::SweepRow;
use beltdrive::input::TableHead;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

/// A table with the columns that vary and others that are carried over.
pub(super) struct Input {
    schema: SchemaRef,
    pub(super) batches: Vec<RecordBatch>,
    /// The places of the columns of numbers.
    varied: Vec<usize>,
    /// The places of those that are carried over.
    kept: Vec<usize>,
}

impl Input {
    /// The table that an object holds which has `__arrow_c_stream__`, or `__arrow_c_array__` for one batch.
    pub(super) fn read(table: &Bound<'_, PyAny>, keep: &[String]) -> PyResult<Self> {
        if !table.hasattr("__arrow_c_stream__")? {
            let name = table.get_type().name()?;
            return Err(InputError::new_err(format!(
                "a table has `__arrow_c_stream__`, as those of pyarrow, polars and pandas have, not {name}"
            )));
        }
        let reader = reader(&table.call_method0("__arrow_c_stream__")?)?;
        let schema = reader.schema();
        let place = |name: &String| {
            schema.index_of(name).map_err(|_| {
                let names: Vec<_> = schema.fields().iter().map(|field| field.name()).collect();
                InputError::new_err(format!(
                    "there is no column `{name}` to keep; the table has {names:?}"
                ))
            })
        };
        let kept = keep.iter().map(place).collect::<PyResult<Vec<_>>>()?;
        let varied: Vec<_> = (0..schema.fields().len())
            .filter(|place| !kept.contains(place))
            .collect();
        if let Some(&place) = varied
            .iter()
            .find(|&&place| !is_number(schema.field(place).data_type()))
        {
            let field = schema.field(place);
            return Err(InputError::new_err(format!(
                "the column `{}` of the table holds no numbers, but {}\nhelp: `keep=[…]` names columns that are \
                 carried over",
                field.name(),
                field.data_type()
            )));
        }
        // The stream may be one of Python, which has the lock now.
        let batches = reader.collect::<Result<_, _>>().map_err(arrow)?;
        Ok(Self {
            schema,
            batches,
            varied,
            kept,
        })
    }

    /// The names of the columns of numbers.
    pub(super) fn headings(&self) -> impl Iterator<Item = &str> {
        let fields = self.varied.iter().map(|&place| self.schema.field(place));
        fields.map(|field| field.name().as_str())
    }

    /// The rows of the numbers.
    pub(super) fn rows(&self, head: &TableHead) -> Vec<SweepRow> {
        let mut rows = Vec::new();
        for batch in &self.batches {
            let columns: Vec<_> = { self.varied.iter() }
                .map(|&place| numbers(batch.column(place)))
                .collect();
            for index in 0..batch.num_rows() {
                let name = format!("row {}", rows.len());
                let (values, fault) =
                    head.convert(&name, columns.iter().map(|column| column[index]));
                let fault = fault.map(Box::new);
                rows.push(SweepRow { values, fault });
            }
        }
        rows
    }

    /// The columns that are carried over.
    pub(super) fn kept(&self) -> impl Iterator<Item = &FieldRef> {
        self.kept.iter().map(|&place| &self.schema.fields()[place])
    }

    /// Those of a batch, from a row of it on for some rows.
    pub(super) fn kept_rows(&self, batch: usize, from: usize, count: usize) -> Vec<ArrayRef> {
        let batch = &self.batches[batch];
        let columns = self.kept.iter().map(|&place| batch.column(place));
        columns.map(|column| column.slice(from, count)).collect()
    }
}

/// The stream of a capsule.
fn reader(capsule: &Bound<'_, PyAny>) -> PyResult<RecordBatchStreamReader> {
    let capsule = capsule.cast::<PyCapsule>()?;
    let stream = capsule.pointer_checked(Some(STREAM))?;
    #[expect(unsafe_code, reason = "a capsule is a pointer")]
    // SAFETY: by the PyCapsule interface of Arrow a capsule of this name, which has been checked, points at a stream.
    // It is moved out, and what stays behind is marked as released, so that the capsule does not release it again.
    let stream = unsafe { FFI_ArrowArrayStream::from_raw(stream.cast().as_ptr()) };
    RecordBatchStreamReader::try_new(stream).map_err(arrow)
}

/// What Arrow says.
pub(super) fn arrow(error: ArrowError) -> PyErr {
    InputError::new_err(format!("cannot read the table: {error}"))
}

fn is_number(kind: &DataType) -> bool {
    kind.is_integer() || kind.is_floating() || kind.is_null()
}

/// The numbers of a column, where there are any.
fn numbers(column: &ArrayRef) -> Vec<Option<f64>> {
    match column.data_type() {
        DataType::Float64 => of::<Float64Type>(column, |value| value),
        DataType::Float32 => of::<Float32Type>(column, f64::from),
        DataType::Float16 => of::<Float16Type>(column, f64::from),
        DataType::Int8 => of::<Int8Type>(column, f64::from),
        DataType::Int16 => of::<Int16Type>(column, f64::from),
        DataType::Int32 => of::<Int32Type>(column, f64::from),
        DataType::Int64 => of::<Int64Type>(column, |value| value as f64),
        DataType::UInt8 => of::<UInt8Type>(column, f64::from),
        DataType::UInt16 => of::<UInt16Type>(column, f64::from),
        DataType::UInt32 => of::<UInt32Type>(column, f64::from),
        DataType::UInt64 => of::<UInt64Type>(column, |value| value as f64),
        _ => vec![None; column.len()],
    }
}

fn of<T: ArrowPrimitiveType>(
    column: &ArrayRef,
    number: impl Fn(T::Native) -> f64,
) -> Vec<Option<f64>> {
    let values = column.as_primitive::<T>().iter();
    values.map(|value| value.map(&number)).collect()
}
