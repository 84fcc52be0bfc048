//! `beltdrive solve`: the steady state of a drive.

use super::{common::Common, failure::Failure, origin::Origin};
use beltdrive::belt_loop::{self, LoopState};
use beltdrive::input::DriveFile;
use beltdrive::quantity::two_pulleys;
use beltdrive::{Drive, SteadyState, plot, quantity};
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
        let options = self.common.options();
        if drive.two_pulleys().is_some() {
            let state = beltdrive::solve(&drive, &options)?;
            return self.write_drive(&state, None, origin);
        }
        let state = belt_loop::solve_with_margins(&drive, &options)?;
        // A drive with two pulleys is shown as one.
        if let Some(as_drive) = two_pulleys::as_drive(&drive, &state) {
            let as_loop = Some((&drive, &state));
            let state = beltdrive::solve(&as_drive, &options)?;
            return self.write_drive(&state, as_loop, origin);
        }
        let answer = &quantity::belt_loop::answer(&drive, &state);
        let draw = |directory: &Path, metadata: &str| {
            plot::write_state(answer, "loop.svg", directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)
    }

    /// Writes the steady state of a drive with two pulleys, and what there is to tell of it as the loop as which it was
    /// solved.
    fn write_drive(
        &self,
        state: &SteadyState,
        as_loop: Option<(&Drive, &LoopState)>,
        origin: &Origin,
    ) -> Result<(), Failure> {
        let answer = &two_pulleys::answer(state, as_loop);
        let drawn = two_pulleys::drawn(state);
        let draw = |directory: &Path, metadata: &str| {
            plot::write_state(&drawn, "drive.svg", directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)
    }
}
