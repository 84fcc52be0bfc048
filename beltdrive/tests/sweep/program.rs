//! The command, run in a directory of its own.

use beltdrive::examples;
#[cfg(any(feature = "arrow", feature = "parquet"))]
use beltdrive::{SweepTable, input::DriveFile};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A fresh directory of this test run with an example.
pub(crate) fn directory(name: &str, example: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("sweep")
        .join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    let text = examples::find(example).unwrap().text;
    fs::write(path.join("drive.toml"), text).unwrap();
    path
}

pub(crate) fn run(directory: &Path, args: &[&str]) -> Output {
    command(directory, args).output().unwrap()
}

#[track_caller]
pub(crate) fn answered(output: &Output) {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
}

#[track_caller]
pub(crate) fn refused(output: &Output, message: &str) {
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(text.contains(message), "{text}");
}

/// The command, not yet run.
pub(crate) fn command(directory: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_beltdrive"));
    command
        .args(["sweep", "drive.toml"])
        .args(args)
        .current_dir(directory);
    command
}

/// The rows of a CSV file by the names of their columns.
pub(crate) fn rows(path: &Path) -> Vec<std::collections::HashMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

/// Reads a table of numbers for `kim2009-flat` with one byte after another turned over, every seventh; tells how often that
/// was an error.
#[cfg(any(feature = "arrow", feature = "parquet"))]
pub(crate) fn faults_of_damaged(path: &Path) -> usize {
    let example = examples::find("kim2009-flat").unwrap();
    let file = DriveFile::read(example.name, example.text, &[]).unwrap();
    let whole = fs::read(path).unwrap();
    let is_fault = |place: &usize| {
        let mut damaged = whole.clone();
        damaged[*place] ^= 0xff;
        fs::write(path, damaged).unwrap();
        match SweepTable::open(path, &file) {
            Ok(table) => {
                let mut rows = table.rows().unwrap();
                rows.any(|row| row.is_err())
            }
            Err(_) => true,
        }
    };
    (0..whole.len()).step_by(7).filter(is_fault).count()
}
