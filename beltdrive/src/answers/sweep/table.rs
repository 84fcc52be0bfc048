//! The rows of a sweep from a file.

#[cfg(feature = "arrow")]
mod of_arrow;
mod of_csv;
#[cfg(feature = "parquet")]
mod of_parquet;

use super::SweepRow;
use crate::belt_loop::Varied;
use crate::input::{Diagnostic, DriveFile, TableHead};
use std::fs::File;
use std::io::{self, Read};
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};

/// A file of values of numbers of a drive file, a column for each number and a row for each drive, in CSV, Parquet or Arrow IPC.
#[derive(Clone, Debug)]
pub struct SweepTable {
    path: PathBuf,
    head: TableHead,
    count: usize,
    fingerprint: u64,
}

/// Why a table cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// A heading is at fault.
    #[error(transparent)]
    Heading(#[from] Box<Diagnostic>),
    /// The file cannot be read.
    #[error("cannot read {path}: {error}", path = .0.display(), error = .1)]
    Read(PathBuf, io::Error),
    /// A column of a Parquet or an Arrow file holds something else.
    #[error("the column `{1}` of {path} holds no numbers", path = .0.display())]
    NoNumbers(PathBuf, String),
    /// The file holds something else.
    #[error(
        "{path} is no table; expected CSV in UTF-8, Parquet, or Arrow IPC as a file, not as a stream",
        path = .0.display()
    )]
    NoTable(PathBuf),
    /// The file is compressed in another way than those that are read.
    #[error("{path} is compressed as {1}; expected {2}", path = .0.display())]
    Compressed(PathBuf, String, &'static str),
    /// The file has a form that is not read.
    #[error("{path} is in {1}, which this program is built without", path = .0.display())]
    Without(PathBuf, &'static str),
}

/// A form of tables.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Csv,
    Parquet,
    Arrow,
}

/// What files of the other forms than CSV begin with.
const BEGINNINGS: [(&[u8], Form); 2] = [(b"PAR1", Form::Parquet), (b"ARROW1", Form::Arrow)];

impl SweepTable {
    /// The table of a file in CSV, where lines that begin with `#` are comments, or in Parquet or Arrow IPC, which are known
    /// by what they begin with. Headings are those of [`TableHead::new`]. The file is read once from end to end to count
    /// its rows.
    ///
    /// # Errors
    /// The file cannot be read, or a heading is at fault. A row that is at fault is none: it says so itself.
    pub fn open(path: &Path, file: &DriveFile) -> Result<Self, TableError> {
        let cannot_read = |error| TableError::Read(path.to_owned(), error);
        let (fingerprint, form) = fingerprint(path).map_err(cannot_read)?;
        let shape = || match form {
            Form::Csv => of_csv::shape(path),
            #[cfg(feature = "parquet")]
            Form::Parquet => of_parquet::shape(path),
            #[cfg(feature = "arrow")]
            Form::Arrow => of_arrow::shape(path),
            #[cfg(not(all(feature = "parquet", feature = "arrow")))]
            form => Err(TableError::Without(path.to_owned(), form.name())),
        };
        let (headings, count) = undamaged(shape).map_err(cannot_read)??;
        let headings: Vec<_> = headings.iter().map(String::as_str).collect();
        let name = path.display().to_string();
        let head = TableHead::new(&name, &headings, file).map_err(Box::new)?;
        Ok(Self {
            path: path.to_owned(),
            head,
            count,
            fingerprint,
        })
    }

    /// The numbers of its columns.
    #[must_use]
    pub fn varied(&self) -> Vec<Varied> {
        self.head.keys().map(Varied::of).collect()
    }

    /// The number of rows.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// A hash of its content (FNV-1a, 64 bits), which tells it from another version of the file.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// The rows, read as they are asked for.
    ///
    /// # Errors
    /// The file cannot be read any more.
    pub fn rows(&self) -> Result<TableRows<'_>, TableError> {
        let cannot_read = |error| TableError::Read(self.path.clone(), error);
        let (_, form) = beginning(&self.path).map_err(cannot_read)?;
        let source = match form {
            Form::Csv => Source::Csv(Box::new(of_csv::reader(&self.path).map_err(cannot_read)?)),
            #[cfg(feature = "parquet")]
            Form::Parquet => Source::Parquet(Box::new(of_parquet::rows(&self.path)?)),
            #[cfg(feature = "arrow")]
            Form::Arrow => {
                Source::Arrow(Box::new(of_arrow::rows(&self.path).map_err(cannot_read)?))
            }
            #[cfg(not(all(feature = "parquet", feature = "arrow")))]
            form => return Err(TableError::Without(self.path.clone(), form.name())),
        };
        Ok(TableRows {
            head: &self.head,
            path: &self.path,
            source,
            record: csv::ByteRecord::new(),
            next: 0,
        })
    }
}

/// The rows of a table.
pub struct TableRows<'t> {
    head: &'t TableHead,
    path: &'t Path,
    source: Source,
    record: csv::ByteRecord,
    /// The index of the next row.
    next: usize,
}

enum Source {
    Csv(Box<of_csv::Reader>),
    #[cfg(feature = "parquet")]
    Parquet(Box<of_parquet::Rows>),
    #[cfg(feature = "arrow")]
    Arrow(Box<of_arrow::Rows>),
}

impl TableRows<'_> {
    /// Leaves out rows up to the one of an index.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn skip_to(&mut self, index: usize) -> Result<(), TableError> {
        while self.next < index {
            let is_row = undamaged(|| match &mut self.source {
                Source::Csv(reader) => reader
                    .read_byte_record(&mut self.record)
                    .map_err(of_csv::io_error),
                #[cfg(feature = "parquet")]
                Source::Parquet(rows) => rows
                    .next()
                    .transpose()
                    .map_err(io::Error::from)
                    .map(|row| row.is_some()),
                #[cfg(feature = "arrow")]
                Source::Arrow(rows) => rows.next().map(|row| row.is_some()),
            });
            let is_row = is_row.and_then(|read| read);
            let is_row = is_row.map_err(|error| TableError::Read(self.path.to_owned(), error))?;
            if !is_row {
                break;
            }
            self.next += 1;
        }
        Ok(())
    }

    fn read(&mut self) -> io::Result<Option<SweepRow>> {
        let name = format!("row {}", self.next);
        let read = match &mut self.source {
            Source::Csv(reader) => {
                if !reader
                    .read_byte_record(&mut self.record)
                    .map_err(of_csv::io_error)?
                {
                    return Ok(None);
                }
                // What is no text is no number either.
                let fields = self.record.iter();
                let fields = fields.map(|field| std::str::from_utf8(field).unwrap_or("\u{fffd}"));
                self.head.read(&name, fields)
            }
            #[cfg(feature = "parquet")]
            Source::Parquet(rows) => {
                let Some(row) = rows.next().transpose()? else {
                    return Ok(None);
                };
                let numbers = row
                    .get_column_iter()
                    .map(|(_, field)| of_parquet::number(field));
                self.head.convert(&name, numbers)
            }
            #[cfg(feature = "arrow")]
            Source::Arrow(rows) => {
                let Some(numbers) = rows.next()? else {
                    return Ok(None);
                };
                self.head.convert(&name, numbers)
            }
        };
        self.next += 1;
        let (values, fault) = read;
        let fault = fault.map(Box::new);
        Ok(Some(SweepRow { values, fault }))
    }
}

impl Iterator for TableRows<'_> {
    type Item = Result<SweepRow, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        let row = undamaged(|| self.read()).and_then(|read| read);
        let row = row.transpose()?;
        Some(row.map_err(|error| TableError::Read(self.path.to_owned(), error)))
    }
}

#[cfg(not(all(feature = "parquet", feature = "arrow")))]
impl Form {
    fn name(self) -> &'static str {
        match self {
            Self::Csv => "CSV",
            Self::Parquet => "Parquet",
            Self::Arrow => "Arrow IPC",
        }
    }
}

/// What a reader finds. Those of Parquet and of Arrow panic at some damaged files; that is an error like any other.
fn undamaged<T>(read: impl FnOnce() -> T) -> io::Result<T> {
    let found = panic::catch_unwind(AssertUnwindSafe(read));
    found.map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "the file is damaged"))
}

/// A hash of the content of a file, and its form.
fn fingerprint(path: &Path) -> io::Result<(u64, Form)> {
    let (mut reader, form) = beginning(path)?;
    // Offset basis and prime of FNV-1a with 64 bits.
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut buffer = [0; 1 << 16];
    loop {
        let read = reader.read(&mut buffer)?;
        if read == 0 {
            return Ok((hash, form));
        }
        for byte in &buffer[..read] {
            hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

/// The content of a file, and its form.
fn beginning(path: &Path) -> io::Result<(impl Read, Form)> {
    let mut reader = File::open(path)?;
    let mut begin = Vec::new();
    let most = BEGINNINGS.iter().map(|(begin, _)| begin.len()).max();
    let most = most.unwrap_or_default() as u64;
    reader.by_ref().take(most).read_to_end(&mut begin)?;
    let known = { BEGINNINGS.iter() }.find(|(known, _)| begin.starts_with(known));
    let form = known.map_or(Form::Csv, |(_, form)| *form);
    Ok((io::Cursor::new(begin).chain(reader), form))
}
