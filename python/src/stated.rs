//! A drive as Python states it.

use crate::answer::Answer;
use crate::failure::Failure;
use beltdrive::SolveOptions;
use beltdrive::input::DriveFile;
use beltdrive::quantity::{self, section};
use pyo3::prelude::*;
use std::collections::HashMap;

/// A drive file: its name, its text, its overrides as `KEY=VALUE`, and the relative tolerance of its states.
#[derive(FromPyObject)]
pub(crate) struct Stated(
    pub(crate) String,
    pub(crate) String,
    pub(crate) Vec<String>,
    f64,
);

impl Stated {
    /// The drive file as it was read.
    pub(crate) fn file(&self) -> Result<DriveFile, Failure> {
        let Self(name, text, overrides, _) = self;
        Ok(DriveFile::read(name, text, overrides)?)
    }

    /// Where a table of answers comes from.
    pub(crate) fn metadata(&self, question: &str) -> HashMap<String, String> {
        let Self(name, text, overrides, tolerance) = self;
        let tolerance = tolerance.to_string();
        let set = overrides.join("\n");
        let entries = [
            ("program", "beltdrive"),
            ("version", env!("CARGO_PKG_VERSION")),
            ("answer", question),
            ("tolerance", &tolerance),
            ("drive_file.name", name),
            ("drive_file.text", text),
            ("set", &set),
        ];
        let entries = entries.into_iter();
        entries
            .map(|(key, value)| (key.to_owned(), value.to_owned()))
            .collect()
    }

    /// How steady states are sought.
    pub(crate) fn options(&self) -> SolveOptions {
        let tolerance = self.3;
        SolveOptions { tolerance }
    }

    /// Asks something of the drive, while other threads of Python run.
    pub(crate) fn ask<T: Send>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&DriveFile, &SolveOptions) -> Result<T, Failure> + Send,
    ) -> PyResult<T> {
        let asked = py.detach(|| {
            let file = self.file()?;
            question(&file, &self.options()).map_err(|failure| failure.of(&file))
        });
        Ok(asked?)
    }

    /// As [`Stated::ask`], with what the drive file takes from a belt section told in the answer.
    pub(crate) fn answer(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&DriveFile, &SolveOptions) -> Result<quantity::Answer, Failure> + Send,
    ) -> PyResult<Answer> {
        let answer = self.ask(py, |file, options| {
            let answer = question(file, options)?;
            Ok(match file.filled_in() {
                Some(filled_in) => section::told_in(answer, filled_in),
                None => answer,
            })
        })?;
        Ok(Answer::new(answer))
    }
}
