//! What the commands that solve a drive have in common on the command line.

use super::failure::Failure;
use super::origin::Origin;
use super::output::Output;
use super::progress::with_bar;
use super::stated::Stated;
use beltdrive::SolveOptions;
use beltdrive::input::DriveFile;
use clap::Args;
use std::path::Path;

/// A drive, and where the results go.
#[derive(Args)]
pub(super) struct Common {
    #[command(flatten)]
    stated: Stated,
    #[command(flatten)]
    pub(super) output: Output,
}

impl Common {
    /// The drive file, once it is clear that its results have somewhere to go, and their origin.
    pub(super) fn file(&self) -> Result<(DriveFile, Origin), Failure> {
        self.file_beside(&[])
    }

    /// As [`Common::file`], of a command with other options that write files.
    pub(super) fn file_beside(
        &self,
        others: &[(&'static str, Option<&Path>)],
    ) -> Result<(DriveFile, Origin), Failure> {
        self.output.check(self.stated.path(), others)?;
        self.stated.read()
    }

    /// How steady states are sought.
    pub(super) fn options(&self) -> SolveOptions {
        self.stated.options()
    }

    /// Does long work that shows its progress.
    pub(super) fn with_progress<T>(
        &self,
        work: impl FnOnce(&mut (dyn FnMut(f64, &str) + Send)) -> T,
    ) -> T {
        with_bar(self.output.is_quiet(), work)
    }
}
