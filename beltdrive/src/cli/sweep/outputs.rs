//! Where the rows of a sweep go.

use super::parts::Parts;
use crate::cli::failure::Failure;
use crate::cli::output::is_stream;
use beltdrive::report::{Field, RowWriter, WholeFile};
use std::io::{self, ErrorKind, Write};
use std::path::Path;

/// Files that are written as rows come, or a directory with one for each chunk of them.
pub(super) enum Outputs<'o> {
    Files(Vec<(RowWriter<Output>, &'o Path)>),
    Parts(Parts<'o>),
}

/// Whether more rows are wanted.
#[derive(PartialEq, Eq)]
pub(super) enum Wanted {
    More,
    /// Whoever reads standard output has closed it, and there is no other output.
    Enough,
}

impl Outputs<'_> {
    /// Whether a chunk is already there.
    pub(super) fn stands(&self, chunk: usize) -> bool {
        match self {
            Self::Files(_) => false,
            Self::Parts(parts) => parts.stands(chunk),
        }
    }

    /// Writes the rows of a chunk.
    pub(super) fn write(
        &mut self,
        chunk: usize,
        rows: &[Vec<Option<Field>>],
    ) -> Result<Wanted, Failure> {
        match self {
            Self::Files(files) => {
                let (begun, mut failure) = (files.len(), None);
                files.retain_mut(|(file, path)| match file.write(rows) {
                    Err(error) if is_closed(path, &error) => false,
                    written => {
                        let failed = written.map_err(|error| cannot_write(path, &error));
                        failure = failure.take().or(failed.err());
                        true
                    }
                });
                if let Some(failure) = failure {
                    return Err(failure);
                }
                if begun > 0 && files.is_empty() {
                    return Ok(Wanted::Enough);
                }
            }
            Self::Parts(parts) => parts.write(chunk, rows)?,
        }
        Ok(Wanted::More)
    }

    /// Ends, and calls `note` with each file that was written as a whole.
    pub(super) fn finish(self, chunks: usize, note: impl Fn(&Path)) -> Result<(), Failure> {
        match self {
            Self::Files(files) => {
                for (file, path) in files {
                    match file.finish().and_then(Output::finish) {
                        Err(error) if is_closed(path, &error) => {}
                        finished => {
                            finished.map_err(|error| cannot_write(path, &error))?;
                            note(path);
                        }
                    }
                }
            }
            Self::Parts(parts) => {
                parts.clear(chunks);
                note(parts.directory);
            }
        }
        Ok(())
    }
}

/// Whether an error says that whoever reads standard output has closed it, and has read enough.
pub(super) fn is_closed(path: &Path, error: &io::Error) -> bool {
    is_stream(path) && error.kind() == ErrorKind::BrokenPipe
}

/// Why rows cannot be written.
pub(super) fn cannot_write(path: &Path, error: &io::Error) -> Failure {
    let action = match is_stream(path) {
        true => "write to standard output".to_owned(),
        false => format!("write {}", path.display()),
    };
    Failure::io(&action, error)
}

/// A file or standard output.
pub(super) enum Output {
    Stream(io::Stdout),
    File(WholeFile),
}

impl Output {
    pub(super) fn new(path: &Path) -> io::Result<Self> {
        match is_stream(path) {
            true => Ok(Self::Stream(io::stdout())),
            false => WholeFile::create(path).map(Self::File),
        }
    }

    fn finish(self) -> io::Result<()> {
        match self {
            Self::Stream(mut stream) => stream.flush(),
            Self::File(file) => file.finish(),
        }
    }
}

impl Write for Output {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        match self {
            Self::Stream(stream) => stream.write(buffer),
            Self::File(file) => file.write(buffer),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Stream(stream) => stream.flush(),
            Self::File(file) => file.flush(),
        }
    }
}
