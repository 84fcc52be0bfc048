//! `beltdrive design`: the numbers and choices that make a drive best within its limits.

use super::{common::Common, failure::Failure, origin::Origin, output::write_text};
use beltdrive::input::DriveFile;
use beltdrive::{DesignError, design, plot, quantity};
use clap::Args;
use std::path::{Path, PathBuf};

const HELP: &str = "\
Example:
  beltdrive examples fan-design > drive.toml
  beltdrive design drive.toml --out best.toml
  beltdrive check best.toml

The table [design] of the file says what is to be small, which numbers are free within bounds, and which keys
take one of several values; limits are those of [requirements], in every load case. --csv writes one row per
limit that decides, --plot draws the layout of each load case of the best drive.

Exit status:
  0  the best drive was found
  1  no drive that was tried has a steady state
  2  an input, an output or the command line is at fault
  3  no drive meets all limits: the limits in conflict are named";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Design {
    #[command(flatten)]
    common: Common,
    /// Write the drive file with the values found; - for standard output, in place of the table
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl Design {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let out = ("--out", self.out.as_deref());
        let (file, origin) = self.common.file_beside(&[out])?;
        self.of(&file, origin).map_err(|failure| failure.of(&file))
    }

    fn of(&self, file: &DriveFile, origin: Origin) -> Result<(), Failure> {
        let question = file.design().map_err(Failure::usage)?;
        // Whether it can be written back is known before.
        file.rewritten().map_err(Failure::usage)?;
        let options = self.common.options();
        let found = self
            .common
            .with_progress(|progress| design(file, &question, &options, progress));
        let found = found.map_err(|error| match error {
            DesignError::Input(error) => Failure::usage(error),
            error => Failure::Unsolved(format!("error: {error}")),
        })?;
        let answer = &quantity::design::answer(&found).map_err(Failure::usage)?;
        let origin = &origin.with_filled_in(found.file.filled_in());
        let draw = |directory: &Path, metadata: &str| {
            let drawn = quantity::check::drawn(&found.checked);
            plot::write_layouts(&drawn, directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)?;
        if !found.is_feasible {
            return Err(Failure::Unmet(
                "error: no drive meets all limits".to_owned(),
            ));
        }
        if let Some(path) = &self.out {
            let text = found.file.rewritten().map_err(Failure::usage)?;
            let written = write_text(path, &text)?;
            self.common.output.name(written.as_slice());
        }
        Ok(())
    }
}
