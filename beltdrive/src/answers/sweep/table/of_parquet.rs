//! Tables in Parquet.

use super::TableError;
use parquet::basic::{Compression, ConvertedType, LogicalType, Repetition, Type as Physical};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, reader::RowIter};
use parquet::schema::types::Type;
use std::fs::File;
use std::path::Path;

/// What columns of whole numbers are said to hold.
const WHOLE_NUMBERS: [ConvertedType; 8] = [
    ConvertedType::INT_8,
    ConvertedType::INT_16,
    ConvertedType::INT_32,
    ConvertedType::INT_64,
    ConvertedType::UINT_8,
    ConvertedType::UINT_16,
    ConvertedType::UINT_32,
    ConvertedType::UINT_64,
];

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
        let info = field.get_basic_info();
        // Dates, times and decimals are stored as whole numbers, too.
        let is_plain = match info.converted_type() {
            ConvertedType::NONE => !matches!(
                info.logical_type_ref(),
                Some(LogicalType::Timestamp { .. } | LogicalType::Time { .. } | LogicalType::Date)
            ),
            kind => WHOLE_NUMBERS.contains(&kind),
        };
        field.is_primitive()
            && is_plain
            && numbers.contains(&field.get_physical_type())
            && info.repetition() != Repetition::REPEATED
    };
    if let Some(other) = fields.iter().find(|field| !is_number(field)) {
        return Err(TableError::NoNumbers(
            path.to_owned(),
            other.name().to_owned(),
        ));
    }
    let groups = reader.metadata().row_groups().iter();
    let mut columns = groups.flat_map(|group| group.columns());
    let known = [Compression::UNCOMPRESSED, Compression::SNAPPY];
    if let Some(other) = columns.find(|column| !known.contains(&column.compression())) {
        let name = other.compression().to_string();
        return Err(TableError::Compressed(
            path.to_owned(),
            name,
            "SNAPPY or UNCOMPRESSED",
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
        Field::UByte(value) => Some(f64::from(value)),
        Field::UShort(value) => Some(f64::from(value)),
        Field::UInt(value) => Some(f64::from(value)),
        Field::ULong(value) => Some(value as f64),
        Field::Float16(value) => Some(f64::from(value)),
        Field::Float(value) => Some(f64::from(value)),
        Field::Double(value) => Some(value),
        _ => Some(f64::NAN),
    }
}
