//! Results as files, each written whole or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Writes a text to a file. What stood there before stays until all of the text is on the disk: the text
/// is written to a new file in the same directory, which then takes the name. A device or a pipe is
/// written to directly; of a symbolic link, the file that it leads to is replaced.
///
/// # Errors
/// What the system says. The directory has no new file then, and the old one is as it was.
pub fn write_file(path: &Path, text: &str) -> io::Result<()> {
    let Ok(path) = fs::canonicalize(path) else {
        return replace(path, text, None);
    };
    // Opened without truncation, so that a file that may not be written is refused.
    let mut standing = OpenOptions::new().write(true).open(&path)?;
    let metadata = standing.metadata()?;
    match metadata.is_file() {
        true => replace(&path, text, Some(metadata.permissions())),
        false => standing.write_all(text.as_bytes()),
    }
}

/// Writes a text to a new file, which takes the name and the permissions of the one that stood there.
fn replace(path: &Path, text: &str, permissions: Option<fs::Permissions>) -> io::Result<()> {
    let (mut file, beside) = new_file(path.parent().unwrap_or(Path::new("")))?;
    let outcome = file
        .write_all(text.as_bytes())
        .and_then(|()| permissions.map_or(Ok(()), |permissions| file.set_permissions(permissions)))
        // Some file systems say only now that the disk is full.
        .and_then(|()| file.sync_all());
    drop(file);
    let outcome = outcome.and_then(|()| fs::rename(&beside, path));
    if outcome.is_err() {
        // The first failure is the one to report.
        let _ = fs::remove_file(&beside);
    }
    outcome
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
