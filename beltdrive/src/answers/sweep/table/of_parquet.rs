//! Tables in Parquet.

use super::TableError;
use parquet::basic::{Repetition, Type as Physical};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, reader::RowIter};
use parquet::schema::types::Type;
use std::fs::File;
use std::path::Path;

/// The rows of a file.
pub(super) type Rows = RowIter<'static>;

fn reader(path: &Path) -> Result<SerializedFileReader<File>, TableError> {
    let cannot_read = |error| TableError::Read(path.to_owned(), error);
    let file = File::open(path).map_err(cannot_read)?;
    SerializedFileReader::new(file).map_err(|error| cannot_read(error.into()))
}

/// The headings and the number of rows of a Parquet file.
pub(super) fn shape(path: &Path) -> Result<(Vec<String>, usize), TableError> {
    let reader = reader(path)?;
    let metadata = reader.metadata().file_metadata();
    let fields = metadata.schema_descr().root_schema().get_fields();
    let is_number = |field: &Type| {
        let numbers = [
            Physical::DOUBLE,
            Physical::FLOAT,
            Physical::INT32,
            Physical::INT64,
        ];
        field.is_primitive()
            && numbers.contains(&field.get_physical_type())
            && field.get_basic_info().repetition() != Repetition::REPEATED
    };
    if let Some(other) = fields.iter().find(|field| !is_number(field)) {
        return Err(TableError::NoNumbers(
            path.to_owned(),
            other.name().to_owned(),
        ));
    }
    let headings = fields.iter().map(|field| field.name().to_owned()).collect();
    Ok((headings, usize::try_from(metadata.num_rows()).unwrap_or(0)))
}

/// The rows of a Parquet file.
pub(super) fn rows(path: &Path) -> Result<Rows, TableError> {
    let reader = reader(path)?;
    Ok(RowIter::from_file_into(Box::new(reader)))
}

/// The number of a field, if it holds one; NaN for what is no number.
pub(super) fn number(field: &Field) -> Option<f64> {
    match *field {
        Field::Null => None,
        Field::Byte(value) => Some(f64::from(value)),
        Field::Short(value) => Some(f64::from(value)),
        Field::Int(value) => Some(f64::from(value)),
        Field::Long(value) => Some(value as f64),
        Field::Float16(value) => Some(f64::from(value)),
        Field::Float(value) => Some(f64::from(value)),
        Field::Double(value) => Some(value),
        _ => Some(f64::NAN),
    }
}
