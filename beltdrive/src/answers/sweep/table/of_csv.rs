//! Tables in CSV.

use super::TableError;
use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;

/// Reads the rows of a file.
pub(super) type Reader = csv::Reader<BufReader<File>>;

/// The rows of a CSV file.
pub(super) fn reader(path: &Path) -> io::Result<Reader> {
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
pub(super) fn shape(path: &Path) -> Result<(Vec<String>, usize), TableError> {
    let cannot_read = |error| TableError::Read(path.to_owned(), error);
    let mut reader = reader(path).map_err(cannot_read)?;
    let headings = reader.byte_headers();
    let headings = headings.map_err(|error| cannot_read(io_error(error)))?;
    // What is no text has control characters or other bytes than UTF-8 in its first line.
    let text = |heading: &[u8]| {
        let heading = std::str::from_utf8(heading).ok();
        let heading = heading.filter(|heading| !heading.contains(char::is_control));
        heading.map(str::to_owned)
    };
    let headings = headings.iter().map(text).collect::<Option<_>>();
    let headings = headings.ok_or_else(|| TableError::NoTable(path.to_owned()))?;
    let mut record = csv::ByteRecord::new();
    let mut count = 0;
    let mut next = || reader.read_byte_record(&mut record).map_err(io_error);
    while next().map_err(cannot_read)? {
        count += 1;
    }
    Ok((headings, count))
}

/// What the file says, as it says it.
pub(super) fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        kind => io::Error::other(format!("{kind:?}")),
    }
}
