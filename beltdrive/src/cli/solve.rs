//! `beltdrive solve`: the steady state of a drive.

use super::{common::Common, failure::Failure, origin::Origin};
use beltdrive::input::DriveFile;
use beltdrive::quantity::{solved, two_pulleys};
use beltdrive::{Solved, plot, solve_any};
use clap::Args;
use std::path::Path;

const HELP: &str = "\
Example:
  beltdrive solve kim2009.toml --set friction.law=epp --json kim2009.json --plot figures

--csv writes the profiles along the pulleys, one row per point of the belt.";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Solve {
    #[command(flatten)]
    common: Common,
}

impl Solve {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let (file, origin) = self.common.file()?;
        self.of(&file, &origin).map_err(|failure| failure.of(&file))
    }

    fn of(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        let drive = file.drive().map_err(Failure::usage)?;
        let solved = solve_any(&drive, &self.common.options())?;
        let answer = &solved::answer(&solved);
        let (drawn, name) = match &solved {
            Solved::Drive { state, .. } => (&two_pulleys::drawn(state), "drive.svg"),
            Solved::Loop { .. } => (answer, "loop.svg"),
        };
        let draw = |directory: &Path, metadata: &str| {
            plot::write_state(drawn, name, directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)
    }
}
