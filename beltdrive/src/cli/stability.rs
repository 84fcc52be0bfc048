//! `beltdrive stability`: whether small axial motions of a flat belt on its pulleys grow.

use super::output::Output;
use super::{failure::Failure, origin::Origin, progress::with_bar, read::read};
use beltdrive::input::DriveFile;
use beltdrive::{plot, quantity};
use clap::{Args, value_parser};
use std::path::{Path, PathBuf};

const HELP: &str = "\
Example:
  beltdrive stability kim2009-flat.toml --set load.tight_tension='2 kN' --plot figures

Every eigenvalue is found by two methods, and all are counted. --csv writes one row per pulley, form
and mode, --json the shapes of the first modes too.";

/// Not [`Common`](super::common::Common): nothing here has a tolerance.
#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Command {
    /// Drive file in TOML; - for standard input
    file: PathBuf,
    #[command(flatten)]
    output: Output,
    /// Override one entry of the drive file by its dotted path, or leave it out (KEY=); repeatable
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<String>,
    /// Number of modes on each pulley, 1 to 60
    #[arg(long, value_name = "N", default_value = "12", value_parser = value_parser!(u8).range(1..=60))]
    modes: u8,
}

impl Command {
    pub(super) fn run(&self) -> Result<(), Failure> {
        self.output.check(&self.file, &[])?;
        let (name, text) = read(&self.file)?;
        let file = DriveFile::read(&name, &text, &self.overrides).map_err(Failure::usage)?;
        let drive = file.drive().map_err(Failure::usage)?;
        let origin = Origin::of_drive(&file, name, text);
        let stability = with_bar(self.output.is_quiet(), |progress| {
            beltdrive::stability(&drive, self.modes.into(), progress)
        })?;
        let answer = &quantity::stability::answer(&stability);
        let draw = |directory: &Path, metadata: &str| {
            plot::write_stability(&stability, directory, Some(metadata))
        };
        self.output.write(answer, &draw, &origin)
    }
}
