//! The rows of a sweep from a file.

#[cfg(feature = "parquet")]
mod of_parquet;

use super::SweepRow;
use crate::belt_loop::Varied;
use crate::input::{Diagnostic, DriveFile, TableHead};
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

/// A file of values of numbers of a drive file, a column for each number and a row for each drive, in CSV or Parquet.
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
    /// A column of a Parquet file holds something else.
    #[error("the column `{1}` of {path} holds no numbers", path = .0.display())]
    NoNumbers(PathBuf, String),
    /// The file has another form.
    #[error("{path} is a Parquet file, and this program is built without Parquet", path = .0.display())]
    WithoutParquet(PathBuf),
}

/// What a Parquet file begins with.
const PARQUET: &[u8] = b"PAR1";

impl SweepTable {
    /// The table of a file in CSV, where lines that begin with `#` are comments, or in Parquet, which is known by what it
    /// begins with. Headings are those of [`TableHead::new`]. The file is read once from end to end to count its rows.
    ///
    /// # Errors
    /// The file cannot be read, or a heading is at fault. A row that is at fault is none: it says so itself.
    pub fn open(path: &Path, file: &DriveFile) -> Result<Self, TableError> {
        let cannot_read = |error| TableError::Read(path.to_owned(), error);
        let (fingerprint, is_parquet) = fingerprint(path).map_err(cannot_read)?;
        let (headings, count) = match is_parquet {
            #[cfg(feature = "parquet")]
            true => of_parquet::shape(path)?,
            #[cfg(not(feature = "parquet"))]
            true => return Err(TableError::WithoutParquet(path.to_owned())),
            false => csv_shape(path).map_err(cannot_read)?,
        };
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
        let (_, is_parquet) = prefix(&self.path).map_err(cannot_read)?;
        let source = match is_parquet {
            #[cfg(feature = "parquet")]
            true => Source::Parquet(Box::new(of_parquet::rows(&self.path)?)),
            #[cfg(not(feature = "parquet"))]
            true => return Err(TableError::WithoutParquet(self.path.clone())),
            false => Source::Csv(Box::new(csv_reader(&self.path).map_err(cannot_read)?)),
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
    Csv(Box<csv::Reader<BufReader<File>>>),
    #[cfg(feature = "parquet")]
    Parquet(Box<of_parquet::Rows>),
}

impl TableRows<'_> {
    /// Leaves out rows up to the one of an index.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn skip_to(&mut self, index: usize) -> Result<(), TableError> {
        while self.next < index {
            let is_row = match &mut self.source {
                Source::Csv(reader) => reader.read_byte_record(&mut self.record).map_err(io_error),
                #[cfg(feature = "parquet")]
                Source::Parquet(rows) => rows
                    .next()
                    .transpose()
                    .map_err(io::Error::from)
                    .map(|row| row.is_some()),
            };
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
                    .map_err(io_error)?
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
        let row = self.read().transpose()?;
        Some(row.map_err(|error| TableError::Read(self.path.to_owned(), error)))
    }
}

/// A hash of the content of a file, and whether it is in Parquet.
fn fingerprint(path: &Path) -> io::Result<(u64, bool)> {
    let (mut reader, is_parquet) = prefix(path)?;
    // Offset basis and prime of FNV-1a with 64 bits.
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut buffer = [0; 1 << 16];
    loop {
        let read = reader.read(&mut buffer)?;
        if read == 0 {
            return Ok((hash, is_parquet));
        }
        for byte in &buffer[..read] {
            hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

/// The content of a file, and whether it is in Parquet.
fn prefix(path: &Path) -> io::Result<(impl Read, bool)> {
    let mut reader = File::open(path)?;
    let mut begin = Vec::new();
    reader
        .by_ref()
        .take(PARQUET.len() as u64)
        .read_to_end(&mut begin)?;
    let is_parquet = begin == PARQUET;
    Ok((io::Cursor::new(begin).chain(reader), is_parquet))
}

fn csv_reader(path: &Path) -> io::Result<csv::Reader<BufReader<File>>> {
    let file = BufReader::new(File::open(path)?);
    let reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        // A row with more or fewer fields says so itself.
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(file);
    Ok(reader)
}

/// The headings and the number of rows of a CSV file.
fn csv_shape(path: &Path) -> io::Result<(Vec<String>, usize)> {
    let mut reader = csv_reader(path)?;
    let headings = reader.byte_headers().map_err(io_error)?.iter();
    let headings = headings.map(|heading| String::from_utf8_lossy(heading).into_owned());
    let headings = headings.collect();
    let mut record = csv::ByteRecord::new();
    let mut count = 0;
    while reader.read_byte_record(&mut record).map_err(io_error)? {
        count += 1;
    }
    Ok((headings, count))
}

fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        kind => io::Error::other(format!("{kind:?}")),
    }
}
