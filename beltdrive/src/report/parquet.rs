//! Rows as a Parquet file (<https://parquet.apache.org/docs/file-format>).

use super::rows::{Column, Field, FieldKind, Rows};
use crate::quantity::Answer;
use ::parquet::basic::{LogicalType, Repetition, Type as Physical};
use ::parquet::column::writer::ColumnWriter;
use ::parquet::data_type::ByteArray;
use ::parquet::errors::{ParquetError, Result};
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::Type;
use std::io::{self, Write};
use std::sync::Arc;

/// The rows of an answer ([`Rows::of`]) as a Parquet file that holds metadata, keys with values.
///
/// Numbers are `DOUBLE` with the bits that the text of CSV has, whole numbers `INT64`, words `UTF8` strings; an empty
/// field is null. The file has no compression.
///
/// # Panics
/// Never: it is written into memory.
#[must_use]
pub fn parquet(answer: &Answer, metadata: &[(String, String)]) -> Vec<u8> {
    let Rows { columns, rows } = Rows::of(answer);
    let mut writer = ParquetWriter::new(Vec::new(), columns, metadata).expect(INTO_MEMORY);
    writer.write(&rows).expect(INTO_MEMORY);
    writer.finish().expect(INTO_MEMORY)
}

const INTO_MEMORY: &str = "written into memory";

/// Writes a Parquet file as rows come.
#[derive(Debug)]
pub struct ParquetWriter<W: Write + Send> {
    columns: Vec<Column>,
    writer: SerializedFileWriter<W>,
}

impl<W: Write + Send> ParquetWriter<W> {
    /// Begins a file with columns and metadata, keys with values.
    ///
    /// # Errors
    /// What the output says.
    pub fn new(output: W, columns: Vec<Column>, metadata: &[(String, String)]) -> io::Result<Self> {
        let metadata = metadata.iter();
        let metadata = metadata.map(|(key, value)| KeyValue::new(key.clone(), Some(value.clone())));
        let properties = WriterProperties::builder()
            .set_created_by(concat!("beltdrive ", env!("CARGO_PKG_VERSION")).to_owned())
            .set_key_value_metadata(Some(metadata.collect()))
            .build();
        let schema = schema(&columns).map_err(io_error)?;
        let writer = SerializedFileWriter::new(output, schema, Arc::new(properties));
        let writer = writer.map_err(io_error)?;
        Ok(Self { columns, writer })
    }

    /// Writes rows, each with a field for every column, as a group of their own: some thousands at a time.
    ///
    /// # Errors
    /// What the output says.
    pub fn write(&mut self, rows: &[Vec<Option<Field>>]) -> io::Result<()> {
        if rows.is_empty() {
            return Ok(());
        }
        self.write_group(rows).map_err(io_error)
    }

    fn write_group(&mut self, rows: &[Vec<Option<Field>>]) -> Result<()> {
        let mut group = self.writer.next_row_group()?;
        for index in 0..self.columns.len() {
            let Some(mut column) = group.next_column()? else {
                break;
            };
            let fields = rows.iter().map(|row| row[index].as_ref());
            write_column(column.untyped(), fields)?;
            column.close()?;
        }
        group.close()?;
        Ok(())
    }

    /// Ends the file.
    ///
    /// # Errors
    /// What the output says.
    pub fn finish(self) -> io::Result<W> {
        self.writer.into_inner().map_err(io_error)
    }
}

/// What the output says, as it says it.
fn io_error(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(error) => match error.downcast() {
            Ok(error) => *error,
            Err(error) => io::Error::other(error),
        },
        error => error.into(),
    }
}

/// The columns as the fields of a message.
fn schema(columns: &[Column]) -> Result<Arc<Type>> {
    let field = |column: &Column| {
        let (physical, logical) = match column.kind {
            FieldKind::Number => (Physical::DOUBLE, None),
            FieldKind::Count => (Physical::INT64, None),
            FieldKind::Word => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let field = Type::primitive_type_builder(&column.name, physical)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(logical);
        Ok(Arc::new(field.build()?))
    };
    let fields = columns.iter().map(field).collect::<Result<_>>()?;
    let message = Type::group_type_builder("rows").with_fields(fields);
    Ok(Arc::new(message.build()?))
}

/// The fields of a column.
fn write_column<'f>(
    writer: &mut ColumnWriter<'_>,
    fields: impl Iterator<Item = Option<&'f Field>> + Clone,
) -> Result<()> {
    // Whether each field is there.
    let levels: Vec<_> = fields
        .clone()
        .map(|field| i16::from(field.is_some()))
        .collect();
    let given = fields.flatten();
    match writer {
        ColumnWriter::DoubleColumnWriter(writer) => {
            let values = given.filter_map(|field| match field {
                Field::Number(value) => Some(*value),
                Field::Count(_) | Field::Word(_) => None,
            });
            let values: Vec<_> = values.collect();
            writer.write_batch(&values, Some(&levels), None)?;
        }
        ColumnWriter::Int64ColumnWriter(writer) => {
            let values = given.filter_map(|field| match field {
                Field::Count(count) => i64::try_from(*count).ok(),
                Field::Number(_) | Field::Word(_) => None,
            });
            let values: Vec<_> = values.collect();
            writer.write_batch(&values, Some(&levels), None)?;
        }
        ColumnWriter::ByteArrayColumnWriter(writer) => {
            let values = given.filter_map(|field| match field {
                Field::Word(word) => Some(ByteArray::from(word.as_str())),
                Field::Number(_) | Field::Count(_) => None,
            });
            let values: Vec<_> = values.collect();
            writer.write_batch(&values, Some(&levels), None)?;
        }
        _ => unreachable!("the schema has no other types"),
    }
    Ok(())
}
