//! Results as files, each written whole or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Writes a text, or the bytes of another format, to a file. What stood there before stays until all of it is on the
/// disk: it is written to a new file in the same directory, which then takes the name. A device or a pipe is
/// written to directly; of a symbolic link, the file that it leads to is replaced.
///
/// # Errors
/// What the system says. The directory has no new file then, and the old one is as it was.
pub fn write_file(path: &Path, content: impl AsRef<[u8]>) -> io::Result<()> {
    let mut file = WholeFile::create(path)?;
    file.write_all(content.as_ref())?;
    file.finish()
}

/// A file that is written as its content comes, and takes its name once all of it is on the disk: what stood there
/// before stays until then, and for good if it is not finished. A device or a pipe is written to directly; of a symbolic
/// link, the file that it leads to is replaced.
#[derive(Debug)]
pub struct WholeFile {
    output: BufWriter<File>,
    /// The new file and the name that it is to take; none for a device or a pipe.
    names: Option<[PathBuf; 2]>,
}

impl WholeFile {
    /// Begins a file at a path.
    ///
    /// # Errors
    /// What the system says, also of a file there that may not be written.
    pub fn create(path: &Path) -> io::Result<Self> {
        let (path, permissions) = match fs::canonicalize(path) {
            Err(_) => (path.to_owned(), None),
            Ok(path) => {
                // Opened without truncation, so that a file that may not be written is refused.
                let standing = OpenOptions::new().write(true).open(&path)?;
                let metadata = standing.metadata()?;
                if !metadata.is_file() {
                    return Ok(Self {
                        output: BufWriter::new(standing),
                        names: None,
                    });
                }
                (path, Some(metadata.permissions()))
            }
        };
        let (file, beside) = new_file(path.parent().unwrap_or(Path::new("")))?;
        let file = Self {
            output: BufWriter::new(file),
            names: Some([beside, path]),
        };
        if let Some(permissions) = permissions {
            file.output.get_ref().set_permissions(permissions)?;
        }
        Ok(file)
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// What the system says. The directory has no new file then, and the old one is as it was.
    pub fn finish(mut self) -> io::Result<()> {
        self.output.flush()?;
        if let Some([beside, path]) = &self.names {
            // Some file systems say only now that the disk is full.
            self.output.get_ref().sync_all()?;
            fs::rename(beside, path)?;
            self.names = None;
        }
        Ok(())
    }
}

impl Write for WholeFile {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        self.output.write(buffer)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.output.flush()
    }
}

impl Drop for WholeFile {
    fn drop(&mut self) {
        if let Some([beside, _]) = &self.names {
            // What made the file stay unfinished is reported elsewhere.
            let _ = fs::remove_file(beside);
        }
    }
}

/// A file in a directory with a name that no other has.
fn new_file(directory: &Path) -> io::Result<(File, PathBuf)> {
    let process = std::process::id();
    let mut number = 0;
    loop {
        let path = directory.join(format!(".beltdrive-{process}-{number}.tmp"));
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => number += 1,
            outcome => return outcome.map(|file| (file, path)),
        }
    }
}
