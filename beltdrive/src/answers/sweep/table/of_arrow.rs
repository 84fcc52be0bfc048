//! Tables in Arrow IPC files.

use super::TableError;
use arrow_array::cast::AsArray;
use arrow_array::types::{
    Float16Type, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type,
    UInt16Type, UInt32Type, UInt64Type,
};
use arrow_array::{Array, ArrayRef, ArrowPrimitiveType};
use arrow_ipc::reader::FileReader;
use arrow_schema::{ArrowError, DataType};
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

/// The rows of a file, of which one batch at a time is in memory.
pub(super) struct Rows {
    reader: FileReader<BufReader<File>>,
    /// The columns of the batch that is read, and which of its rows is the next.
    columns: Vec<Vec<Option<f64>>>,
    next: usize,
    rows: usize,
}

impl Rows {
    /// The numbers of the next row, where they are known.
    pub(super) fn next(&mut self) -> io::Result<Option<Vec<Option<f64>>>> {
        while self.next == self.rows {
            let Some(batch) = self.reader.next().transpose().map_err(io_error)? else {
                return Ok(None);
            };
            self.columns = batch.columns().iter().map(numbers).collect();
            (self.next, self.rows) = (0, batch.num_rows());
        }
        self.next += 1;
        let row = self.columns.iter().map(|column| column[self.next - 1]);
        Ok(Some(row.collect()))
    }
}

fn reader(path: &Path) -> io::Result<FileReader<BufReader<File>>> {
    let mut file = File::open(path)?;
    if !has_its_blocks(&mut file)? {
        return Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "the file is damaged",
        ));
    }
    file.rewind()?;
    FileReader::try_new_buffered(file, None).map_err(io_error)
}

/// Whether all blocks of which the footer tells lie in the file, before memory is asked for as much as it says; also so
/// where there is no footer to be read, which the reader says itself.
fn has_its_blocks(file: &mut File) -> io::Result<bool> {
    // The length of the footer and "ARROW1" end a file.
    const TAIL: usize = 10;
    let size = file.metadata()?.len();
    let Some(before) = size.checked_sub(TAIL as u64) else {
        return Ok(true);
    };
    let mut tail = [0; TAIL];
    file.seek(SeekFrom::Start(before))?;
    file.read_exact(&mut tail)?;
    let length = u32::from_le_bytes([tail[0], tail[1], tail[2], tail[3]]);
    let Some(begin) = before.checked_sub(length.into()) else {
        return Ok(true);
    };
    let mut footer = Vec::new();
    file.seek(SeekFrom::Start(begin))?;
    file.take(length.into()).read_to_end(&mut footer)?;
    let Ok(footer) = arrow_ipc::root_as_footer(&footer) else {
        return Ok(true);
    };
    let lists = [footer.dictionaries(), footer.recordBatches()];
    let mut blocks = lists.into_iter().flatten().flatten();
    let is_within = |block: &arrow_ipc::Block| {
        let lengths = [
            block.offset(),
            block.metaDataLength().into(),
            block.bodyLength(),
        ];
        let end = lengths.into_iter().try_fold(0, |end: u64, length| {
            end.checked_add(u64::try_from(length).ok()?)
        });
        end.is_some_and(|end| end <= size)
    };
    Ok(blocks.all(is_within))
}

/// The headings and the number of rows of an Arrow IPC file.
pub(super) fn shape(path: &Path) -> Result<(Vec<String>, usize), TableError> {
    let cannot_read = |error| TableError::Read(path.to_owned(), error);
    let reader = reader(path).map_err(cannot_read)?;
    let schema = reader.schema();
    let is_number =
        |kind: &DataType| kind.is_integer() || kind.is_floating() || *kind == DataType::Null;
    let mut fields = schema.fields().iter();
    if let Some(other) = fields.find(|field| !is_number(field.data_type())) {
        let name = other.name().to_owned();
        return Err(TableError::NoNumbers(path.to_owned(), name));
    }
    let mut count = 0;
    for batch in reader {
        count += batch
            .map_err(|error| cannot_read(io_error(error)))?
            .num_rows();
    }
    let headings = schema.fields().iter().map(|field| field.name().to_owned());
    Ok((headings.collect(), count))
}

/// The rows of an Arrow IPC file.
pub(super) fn rows(path: &Path) -> io::Result<Rows> {
    Ok(Rows {
        reader: reader(path)?,
        columns: Vec::new(),
        next: 0,
        rows: 0,
    })
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

/// What the file says, as it says it.
fn io_error(error: ArrowError) -> io::Error {
    match error {
        ArrowError::IoError(_, error) => error,
        error => io::Error::new(io::ErrorKind::InvalidData, error),
    }
}
