//! Answers as record batches.

use super::input::{Input, arrow};
use crate::failure::InputError;
use arrow_array::builder::{Float64Builder, Int64Builder, StringBuilder};
use arrow_array::{ArrayRef, RecordBatch};
use arrow_schema::{DataType, Field as ArrowField, FieldRef, Schema, SchemaRef};
use beltdrive::report::{Column, Field, FieldKind, Head};
use pyo3::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

/// Record batches of rows, each within a batch of the input, so that columns are carried over as they are.
pub(super) struct Output<'i> {
    columns: Vec<Column>,
    input: &'i Input,
    schema: SchemaRef,
    batches: Vec<RecordBatch>,
    /// The batch of the input that holds the next row, and the place of that in it.
    at: (usize, usize),
}

impl<'i> Output<'i> {
    /// Columns that are carried over, and behind them those of the answers.
    pub(super) fn new(
        head: &Head,
        input: &'i Input,
        metadata: HashMap<String, String>,
    ) -> PyResult<Self> {
        let columns = head.columns().to_vec();
        let twice = input
            .kept()
            .find(|kept| columns.iter().any(|column| column.name == *kept.name()));
        if let Some(twice) = twice {
            return Err(InputError::new_err(format!(
                "the column `{}` cannot be kept: a column of the answers has that name",
                twice.name()
            )));
        }
        let answered = columns.iter().map(|column| {
            let kind = match column.kind {
                FieldKind::Number => DataType::Float64,
                FieldKind::Count => DataType::Int64,
                FieldKind::Word => DataType::Utf8,
            };
            FieldRef::new(ArrowField::new(&column.name, kind, true))
        });
        let fields: Vec<_> = input.kept().cloned().chain(answered).collect();
        let schema = Arc::new(Schema::new_with_metadata(fields, metadata));
        Ok(Self {
            columns,
            input,
            schema,
            batches: Vec::new(),
            at: (0, 0),
        })
    }

    /// Takes the fields of rows that follow those before.
    pub(super) fn write(&mut self, mut rows: &[Vec<Option<Field>>]) -> PyResult<()> {
        while !rows.is_empty() {
            let (batch, from) = self.at;
            let left = self.input.batches[batch].num_rows() - from;
            let count = left.min(rows.len());
            self.at = if count < left {
                (batch, from + count)
            } else {
                (batch + 1, 0)
            };
            if count == 0 {
                continue;
            }
            let (now, later) = rows.split_at(count);
            rows = later;
            let mut arrays = self.input.kept_rows(batch, from, count);
            let columns = self.columns.iter().enumerate();
            arrays.extend(columns.map(|(place, column)| array(column.kind, place, now)));
            let batch = RecordBatch::try_new(self.schema.clone(), arrays).map_err(arrow)?;
            self.batches.push(batch);
        }
        Ok(())
    }

    pub(super) fn finish(self) -> (SchemaRef, Vec<RecordBatch>) {
        (self.schema, self.batches)
    }
}

/// The fields of a column; one that is empty is null.
fn array(kind: FieldKind, place: usize, rows: &[Vec<Option<Field>>]) -> ArrayRef {
    let fields = rows.iter().map(|row| row[place].as_ref());
    match kind {
        FieldKind::Number => {
            let mut builder = Float64Builder::with_capacity(rows.len());
            fields.for_each(|field| {
                builder.append_option(match field {
                    Some(Field::Number(value)) => Some(*value),
                    _ => None,
                });
            });
            Arc::new(builder.finish())
        }
        FieldKind::Count => {
            let mut builder = Int64Builder::with_capacity(rows.len());
            fields.for_each(|field| {
                builder.append_option(match field {
                    Some(Field::Count(count)) => i64::try_from(*count).ok(),
                    _ => None,
                });
            });
            Arc::new(builder.finish())
        }
        FieldKind::Word => {
            let mut builder = StringBuilder::new();
            fields.for_each(|field| {
                builder.append_option(match field {
                    Some(Field::Word(word)) => Some(word),
                    _ => None,
                });
            });
            Arc::new(builder.finish())
        }
    }
}
