//! Where a file of results comes from, so that it can be traced to its drive.

use beltdrive::input::{DriveFile, FilledIn};
use beltdrive::quantity::{Answer, section};
use serde::Serialize;
use std::borrow::Cow;
use std::env;
use std::path::{Path, PathBuf};

/// What a run was started with.
#[derive(Serialize)]
pub(super) struct Origin {
    program: &'static str,
    version: &'static str,
    /// The command line, with the overrides of the drive file.
    command_line: Vec<String>,
    /// The drive file as it was read, without the overrides.
    #[serde(skip_serializing_if = "Option::is_none")]
    drive_file: Option<Read>,
    /// What the drive file takes from a belt section.
    #[serde(skip)]
    filled_in: Option<FilledIn>,
}

#[derive(Serialize)]
struct Read {
    name: String,
    text: String,
}

impl Origin {
    /// The origin of the files of this run, which has read no drive file.
    pub(super) fn new() -> Self {
        let arguments = env::args_os().skip(1);
        let arguments = arguments.map(|argument| argument.to_string_lossy().into_owned());
        let program = env!("CARGO_PKG_NAME");
        Self {
            program,
            version: env!("CARGO_PKG_VERSION"),
            command_line: [program.to_owned()].into_iter().chain(arguments).collect(),
            drive_file: None,
            filled_in: None,
        }
    }

    /// The origin of the files of this run, which has read a drive file from a text.
    pub(super) fn of_drive(file: &DriveFile, name: String, text: String) -> Self {
        Self {
            drive_file: Some(Read { name, text }),
            filled_in: file.filled_in().cloned(),
            ..Self::new()
        }
    }

    /// The origin of what is told of another drive than that of the file.
    pub(super) fn with_filled_in(self, filled_in: Option<&FilledIn>) -> Self {
        Self {
            filled_in: filled_in.cloned(),
            ..self
        }
    }

    /// An answer that tells what its drive file takes from a belt section, if it does.
    pub(super) fn told_in<'a>(&self, answer: &'a Answer) -> Cow<'a, Answer> {
        match &self.filled_in {
            Some(filled_in) => Cow::Owned(section::told_in(answer.clone(), filled_in)),
            None => Cow::Borrowed(answer),
        }
    }

    /// The name and the text of the drive file; empty where none was read.
    pub(super) fn drive_file(&self) -> (&str, &str) {
        let read = self.drive_file.as_ref();
        read.map_or(("", ""), |file| (&file.name, &file.text))
    }

    /// The command line, with quotes round what a shell would take apart.
    pub(super) fn command_line(&self) -> String {
        let quoted = self.command_line.iter().map(|argument| {
            let is_plain = |letter: char| letter.is_alphanumeric() || "-_./=+:,@%".contains(letter);
            match !argument.is_empty() && argument.chars().all(is_plain) {
                true => argument.clone(),
                false => format!("'{}'", argument.replace('\'', r"'\''")),
            }
        });
        quoted.collect::<Vec<_>>().join(" ")
    }

    /// The origin as JSON.
    pub(super) fn json(&self) -> String {
        serde_json::to_string_pretty(self).expect("texts")
    }

    /// The origin as keys with values, for the metadata of Parquet.
    pub(super) fn entries(&self) -> Vec<(String, String)> {
        let (name, text) = self.drive_file();
        let entries = [
            ("program", self.program),
            ("version", self.version),
            ("command_line", &self.command_line()),
            ("drive_file.name", name),
            ("drive_file.text", text),
        ];
        let given = entries.into_iter().filter(|(_, value)| !value.is_empty());
        given
            .map(|(key, value)| (key.to_owned(), value.to_owned()))
            .collect()
    }

    /// A JSON object with the origin as its last key, `origin`. Nothing else in its text changes.
    pub(super) fn in_json(&self, object: &str) -> String {
        match object.strip_suffix("\n}") {
            Some(rest) => {
                let origin = self.json().replace('\n', "\n  ");
                format!("{rest},\n  \"origin\": {origin}\n}}")
            }
            None => object.to_owned(),
        }
    }

    /// The file beside a CSV file that holds its origin: CSV has no place for it.
    pub(super) fn beside(csv: &Path) -> PathBuf {
        let mut path = csv.as_os_str().to_owned();
        path.push(".origin.json");
        PathBuf::from(path)
    }
}
