//! A drive as the command line states it.

use super::failure::Failure;
use super::origin::Origin;
use super::read::{read, text as text_of};
use beltdrive::SolveOptions;
use beltdrive::input::DriveFile;
use clap::Args;
use std::path::{Path, PathBuf};

/// A drive file, what is changed in it, and how accurately it is solved.
#[derive(Args)]
pub(super) struct Stated {
    /// Drive file in TOML; - for standard input
    file: PathBuf,
    /// Override one entry of the drive file by its dotted path, or leave it out (KEY=); repeatable
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<String>,
    /// Relative tolerance of each steady state, 1e-12 to 1e-2
    #[arg(long, value_name = "X", default_value = "1e-6", value_parser = tolerance)]
    tolerance: f64,
}

impl Stated {
    /// Where the drive file is.
    pub(super) fn path(&self) -> &Path {
        &self.file
    }

    /// What is changed in it.
    pub(super) fn overrides(&self) -> &[String] {
        &self.overrides
    }

    /// The drive file and the origin of what follows from it.
    pub(super) fn read(&self) -> Result<(DriveFile, Origin), Failure> {
        let (name, text) = read(&self.file)?;
        let mut file = DriveFile::read(&name, &text, &self.overrides).map_err(Failure::usage)?;
        for (path, named) in file.points_files() {
            // Beside the drive file; standard input stands in the working directory.
            let beside = self.file.parent().unwrap_or(Path::new("")).join(&named);
            let (name, text) = text_of(&beside, "a table of points")?;
            file = file
                .with_points(&path, &name, &text)
                .map_err(Failure::usage)?;
        }
        let origin = Origin::of_drive(&file, name, text);
        Ok((file, origin))
    }

    /// How steady states are sought.
    pub(super) fn options(&self) -> SolveOptions {
        SolveOptions {
            tolerance: self.tolerance,
        }
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    match (1e-12..=1e-2).contains(&value) {
        true => Ok(value),
        false => Err("must be within 1e-12 and 1e-2".to_owned()),
    }
}
