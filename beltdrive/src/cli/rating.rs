//! `beltdrive rating`: the largest torque and power of a drive against speed.

use super::{common::Common, failure::Failure, origin::Origin, samples::Samples};
use beltdrive::input::{Argument, DriveFile};
use beltdrive::{RatingQuestion, plot, quantity, rating, uncertainty};
use clap::Args;
use std::path::Path;

const HELP: &str = "\
Examples:
  beltdrive examples spb-fan > drive.toml
  beltdrive rating drive.toml --plot figures
  beltdrive rating drive.toml --from '500 rpm' --to '3000 rpm' --csv rating.csv

What closes the drive stays as it is, and so does the ratio of all torques. Without --to the range ends where
centrifugal force lifts the belt off its pulleys; a drive that never lifts off is shown up to four times its
speed. --csv writes one row per speed.";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Rating {
    #[command(flatten)]
    common: Common,
    /// Speed of the driver to begin at, with its unit
    #[arg(long, value_name = "A", allow_hyphen_values = true)]
    from: Option<String>,
    /// Speed of the driver to end at
    #[arg(long, value_name = "B", allow_hyphen_values = true)]
    to: Option<String>,
    #[command(flatten)]
    samples: Samples,
}

impl Rating {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let (file, origin) = self.common.file()?;
        self.of(&file, &origin).map_err(|failure| failure.of(&file))
    }

    fn of(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        let drive = file.drive().map_err(Failure::usage)?;
        let speed = |option, value: &Option<String>| {
            let value = value.as_deref();
            let speed = value.map(|value| Argument { option, value }.driver_speed(file));
            speed.transpose().map_err(Failure::usage)
        };
        let question = RatingQuestion {
            from: speed("--from", &self.from)?,
            to: speed("--to", &self.to)?,
        };
        let samples = self.samples.of(file)?;
        let options = self.common.options();
        let found = self
            .common
            .with_progress(|progress| rating(&drive, question, &options, progress))?;
        let spread = self.common.with_progress(|progress| {
            uncertainty::of_rating(file, &found, question, samples, &options, progress)
        });
        let spread = spread.map_err(Failure::usage)?;
        let answer = quantity::rating::answer(&found);
        let answer = &quantity::uncertainty::told_in(answer, &spread, &[]);
        let draw = |directory: &Path, metadata: &str| {
            plot::write_rating(&found, directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)
    }
}
