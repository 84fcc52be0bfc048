//! `beltdrive modes`: vibrations of a running drive.

use super::{common::Common, failure::Failure, origin::Origin};
use beltdrive::input::{Argument, DriveFile};
use beltdrive::{ModesQuestion, modes, plot, quantity};
use clap::{Args, value_parser};
use std::path::Path;

const HELP: &str = "\
Examples:
  beltdrive examples slip-pulse > slip-pulse.toml
  beltdrive modes slip-pulse.toml --json modes.json
  beltdrive modes slip-pulse.toml --from '200 rpm' --to '3000 rpm' --plot figures

The table [transient] of the drive file gives the inertia of the pulleys. --csv writes one row per mode, or with
--to one per speed; --json the shapes too.";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Command {
    #[command(flatten)]
    common: Common,
    /// Number of modes, 1 to 40
    #[arg(long, value_name = "N", default_value = "8", value_parser = value_parser!(u8).range(1..=40))]
    modes: u8,
    /// Speed of the driver at which the Campbell diagram begins, with its unit [default: a tenth of --to]
    #[arg(long, value_name = "A", requires = "to", allow_hyphen_values = true)]
    from: Option<String>,
    /// Speed of the driver at which it ends
    #[arg(long, value_name = "B", allow_hyphen_values = true)]
    to: Option<String>,
}

impl Command {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let (file, origin) = self.common.file()?;
        self.of(&file, &origin).map_err(|failure| failure.of(&file))
    }

    fn of(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        let simulation = file.motion().map_err(Failure::usage)?;
        let speed = |option, value: &Option<String>| {
            let value = value.as_deref();
            let speed = value.map(|value| Argument { option, value }.driver_speed(file));
            speed.transpose().map_err(Failure::usage)
        };
        let (from, to) = (speed("--from", &self.from)?, speed("--to", &self.to)?);
        let question = ModesQuestion::new(self.modes.into(), from, to);
        let found = self
            .common
            .with_progress(|progress| modes(&simulation, question, progress))
            .map_err(|error| Failure::of_simulation(file, &simulation, error))?;
        let answer = &quantity::modes::answer(&found);
        let draw =
            |directory: &Path, metadata: &str| plot::write_modes(&found, directory, Some(metadata));
        self.common.output.write(answer, &draw, origin)
    }
}
