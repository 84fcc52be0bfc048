//! A sweep as a directory of files, one for each chunk of its rows, that may be interrupted at any time.

use crate::cli::failure::Failure;
use crate::cli::{arrow, parquet};
use beltdrive::report::{Column, Field, RowFormat, RowWriter, write_file};
use clap::ValueEnum;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// The file that tells which sweep a directory holds; programs that read all files of a directory as a table pass over
/// names that begin so.
const IDENTITY: &str = "_sweep.json";

/// The form of files of rows.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum PartFormat {
    Parquet,
    Arrow,
    Csv,
}

impl PartFormat {
    /// The form, if the program is built with it.
    pub(super) fn rows(self) -> Result<RowFormat, Failure> {
        match self {
            Self::Csv => Ok(RowFormat::Csv),
            Self::Parquet => parquet::format(),
            Self::Arrow => arrow::format(),
        }
    }
}

/// A directory with a file for each chunk that is finished.
pub(super) struct Parts<'p> {
    pub(super) directory: &'p Path,
    pub(super) format: RowFormat,
    pub(super) columns: &'p [Column],
    pub(super) metadata: &'p [(String, String)],
}

impl Parts<'_> {
    /// Makes the directory, unless it holds the same sweep.
    pub(super) fn open(&self, identity: &Value, origin: &Value) -> Result<(), Failure> {
        let shown = self.directory.display();
        let cannot = |action: &str, error| Failure::io(&format!("{action} {shown}"), &error);
        fs::create_dir_all(self.directory).map_err(|error| cannot("make", error))?;
        let path = self.directory.join(IDENTITY);
        let mut entries = fs::read_dir(self.directory).map_err(|error| cannot("read", error))?;
        let has_others =
            entries.any(|entry| entry.is_ok_and(|entry| !is_unfinished(&entry.path())));
        // Another run of the same sweep may have begun at the same time: its file comes before all others.
        if path.is_file() {
            let text = fs::read_to_string(&path).map_err(|error| cannot("read", error))?;
            let known: Value = serde_json::from_str(&text).unwrap_or_default();
            return match difference(&known["sweep"], identity) {
                None => Ok(()),
                Some(what) => Err(Failure::Usage(format!(
                    "error: {shown} holds another sweep: {what} differs\nhelp: choose another directory, or \
                     remove this one to begin anew"
                ))),
            };
        }
        if has_others {
            return Err(Failure::Usage(format!(
                "error: {shown} holds other files\nexpected: a new or an empty directory, or one of the same sweep"
            )));
        }
        let text = serde_json::json!({ "sweep": identity, "origin": origin });
        let text = serde_json::to_string_pretty(&text).expect("texts and numbers");
        write_file(&path, text).map_err(|error| cannot("write into", error))
    }

    /// The file of a chunk.
    pub(super) fn path(&self, chunk: usize) -> PathBuf {
        let extension = self.format.extension();
        self.directory.join(format!("part-{chunk:06}.{extension}"))
    }

    /// Whether a chunk is finished.
    pub(super) fn stands(&self, chunk: usize) -> bool {
        self.path(chunk).is_file()
    }

    /// Writes the rows of a chunk: all of them, or none.
    pub(super) fn write(&self, chunk: usize, rows: &[Vec<Option<Field>>]) -> Result<(), Failure> {
        let path = self.path(chunk);
        let writer = RowWriter::new(self.format, Vec::new(), self.columns, self.metadata);
        let content = writer.and_then(|mut writer| {
            writer.write(rows)?;
            writer.finish()
        });
        match content.and_then(|content| write_file(&path, content)) {
            // Another run of the same sweep was faster.
            Err(_) if path.is_file() => Ok(()),
            Err(error) => Err(Failure::io(&format!("write {}", path.display()), &error)),
            Ok(()) => Ok(()),
        }
    }

    /// Removes what runs that were ended have left, once all chunks stand and no run writes any more.
    pub(super) fn clear(&self, chunks: usize) {
        if !(0..chunks).all(|chunk| self.stands(chunk)) {
            return;
        }
        for entry in fs::read_dir(self.directory).into_iter().flatten().flatten() {
            if is_unfinished(&entry.path()) {
                // It is in nobody's way.
                let _ = fs::remove_file(entry.path());
            }
        }
    }
}

/// Whether a path is that of a file which a run has not finished.
fn is_unfinished(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with(".beltdrive-") && name.ends_with(".tmp")
}

/// The first key whose value differs between two objects.
fn difference(known: &Value, wanted: &Value) -> Option<String> {
    let (Value::Object(known), Value::Object(wanted)) = (known, wanted) else {
        return (known != wanted).then(|| "what it is".to_owned());
    };
    let mut keys = known.keys().chain(wanted.keys());
    let key = keys.find(|key| known.get(*key) != wanted.get(*key))?;
    Some(format!("`{key}`"))
}

/// Which chunks of a sweep a run answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shard {
    index: usize,
    count: usize,
}

impl Shard {
    /// All chunks.
    pub(super) const ALL: Self = Self { index: 1, count: 1 };

    /// The I-th of N shards, `I/N`.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/');
        let parts =
            parts.and_then(|(index, count)| Some((index.parse().ok()?, count.parse().ok()?)));
        match parts {
            Some((index, count)) if (1..=count).contains(&index) => Ok(Self { index, count }),
            _ => Err("expected I/N with I from 1 to N, such as 3/8".to_owned()),
        }
    }

    /// Whether a chunk is one of them.
    pub(super) fn has(self, chunk: usize) -> bool {
        chunk % self.count == self.index - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_part_all_chunks() {
        assert_eq!(Shard::read("1/1"), Ok(Shard::ALL));
        for text in ["0/3", "4/3", "1", "a/3", "-1/3", "1/0"] {
            assert!(Shard::read(text).is_err(), "{text}");
        }
        let shards: Vec<_> = (1..=3)
            .map(|index| Shard::read(&format!("{index}/3")).unwrap())
            .collect();
        for chunk in 0..20 {
            assert_eq!(shards.iter().filter(|shard| shard.has(chunk)).count(), 1);
        }
    }
}
