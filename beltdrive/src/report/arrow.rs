//! Rows as an Arrow IPC file (<https://arrow.apache.org/docs/format/Columnar.html#ipc-file-format>).

use super::rows::{Column, Field, FieldKind};
use arrow_array::{
    ArrayRef, Float64Array, Int64Array, RecordBatch, RecordBatchOptions, StringArray,
};
use arrow_ipc::writer::FileWriter;
use arrow_schema::{ArrowError, DataType, Schema, SchemaRef};
use std::io::{self, Write};
use std::sync::Arc;

/// Writes an Arrow IPC file as rows come.
///
/// Numbers are `Float64` with the bits that the text of CSV has, whole numbers `Int64`, words `Utf8`; an empty field is
/// null. The metadata are those of the schema. The file has no compression.
pub struct ArrowWriter<W: Write> {
    columns: Vec<Column>,
    schema: SchemaRef,
    writer: FileWriter<W>,
}

impl<W: Write> ArrowWriter<W> {
    /// Begins a file with columns and metadata, keys with values.
    ///
    /// # Errors
    /// What the output says.
    pub fn new(output: W, columns: Vec<Column>, metadata: &[(String, String)]) -> io::Result<Self> {
        let fields: Vec<_> = { columns.iter() }
            .map(|column| arrow_schema::Field::new(&column.name, kind(column.kind), true))
            .collect();
        let metadata: std::collections::BTreeMap<_, _> = metadata.iter().cloned().collect();
        let schema = Arc::new(Schema::new_with_metadata(fields, metadata));
        let writer = FileWriter::try_new(output, &schema).map_err(io_error)?;
        Ok(Self {
            columns,
            schema,
            writer,
        })
    }

    /// Writes rows, each with a field for every column, as a batch of their own: some thousands at a time.
    ///
    /// # Errors
    /// What the output says.
    pub fn write(&mut self, rows: &[Vec<Option<Field>>]) -> io::Result<()> {
        if rows.is_empty() {
            return Ok(());
        }
        let columns = self.columns.iter().enumerate();
        let arrays = columns.map(|(place, column)| array(column.kind, rows, place));
        let options = RecordBatchOptions::new().with_row_count(Some(rows.len()));
        let batch =
            RecordBatch::try_new_with_options(self.schema.clone(), arrays.collect(), &options);
        let written = batch.and_then(|batch| self.writer.write(&batch));
        written.map_err(io_error)
    }

    /// Ends the file.
    ///
    /// # Errors
    /// What the output says.
    pub fn finish(self) -> io::Result<W> {
        self.writer.into_inner().map_err(io_error)
    }
}

impl<W: Write> std::fmt::Debug for ArrowWriter<W> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut shown = formatter.debug_struct("ArrowWriter");
        shown
            .field("columns", &self.columns)
            .finish_non_exhaustive()
    }
}

fn kind(kind: FieldKind) -> DataType {
    match kind {
        FieldKind::Number => DataType::Float64,
        FieldKind::Count => DataType::Int64,
        FieldKind::Word => DataType::Utf8,
    }
}

/// The fields of a column.
fn array(kind: FieldKind, rows: &[Vec<Option<Field>>], place: usize) -> ArrayRef {
    let fields = rows.iter().map(|row| row[place].as_ref());
    match kind {
        FieldKind::Number => Arc::new(Float64Array::from_iter(fields.map(|field| match field {
            Some(Field::Number(value)) => Some(*value),
            _ => None,
        }))),
        FieldKind::Count => Arc::new(Int64Array::from_iter(fields.map(|field| match field {
            Some(Field::Count(count)) => i64::try_from(*count).ok(),
            _ => None,
        }))),
        FieldKind::Word => Arc::new(StringArray::from_iter(fields.map(|field| match field {
            Some(Field::Word(word)) => Some(word.as_str()),
            _ => None,
        }))),
    }
}

/// What the output says, as it says it.
fn io_error(error: ArrowError) -> io::Error {
    match error {
        ArrowError::IoError(_, error) => error,
        error => io::Error::other(error),
    }
}
