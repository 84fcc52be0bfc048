//! What the commands that solve a drive have in common on the command line.

use super::failure::Failure;
use super::origin::Origin;
use super::output::Output;
use super::progress::with_bar;
use super::read::read;
use beltdrive::SolveOptions;
use beltdrive::input::DriveFile;
use clap::Args;
use std::path::PathBuf;

/// A drive, where the results go, and how accurate they are.
#[derive(Args)]
pub(super) struct Common {
    /// Drive file in TOML; - for standard input
    file: PathBuf,
    #[command(flatten)]
    pub(super) output: Output,
    /// Override one entry of the drive file by its dotted path, or leave it out (KEY=); repeatable
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<String>,
    /// Relative tolerance of each steady state, 1e-12 to 1e-2
    #[arg(long, value_name = "X", default_value = "1e-6", value_parser = tolerance)]
    tolerance: f64,
}

impl Common {
    /// The drive file, once it is clear that its results have somewhere to go, and their origin.
    pub(super) fn file(&self) -> Result<(DriveFile, Origin), Failure> {
        self.output.check(&self.file)?;
        let (name, text) = read(&self.file)?;
        let file = DriveFile::read(&name, &text, &self.overrides).map_err(Failure::usage)?;
        let origin = Origin::of_drive(&file, name, text);
        Ok((file, origin))
    }

    /// How steady states are sought.
    pub(super) fn options(&self) -> SolveOptions {
        SolveOptions {
            tolerance: self.tolerance,
        }
    }

    /// Does long work that shows its progress.
    pub(super) fn with_progress<T>(&self, work: impl FnOnce(&mut dyn FnMut(f64, &str)) -> T) -> T {
        with_bar(self.output.is_quiet(), work)
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    match (1e-12..=1e-2).contains(&value) {
        true => Ok(value),
        false => Err("must be within 1e-12 and 1e-2".to_owned()),
    }
}
