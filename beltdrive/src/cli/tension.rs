//! `beltdrive tension`: how tight to set up a drive.

use super::{common::Common, failure::Failure, origin::Origin, samples::Samples};
use beltdrive::input::{Argument, DriveFile};
use beltdrive::{SetupQuestion, plot, quantity, tension, uncertainty};
use clap::Args;
use std::path::Path;

const HELP: &str = "\
Examples:
  beltdrive examples spb-fan > drive.toml
  beltdrive tension drive.toml --margin 1.5

  beltdrive examples serpentine-cases > drive.toml
  beltdrive tension drive.toml

The margin is that of every load case ([[case]]) of the file. Between fixed centres the belt tension at rest is
found, with the belt length that has it; with a tensioner the preload of its spring or its weight. --csv writes one
row per case, --plot draws the layout of each.

Exit status:
  0  the drive so set up meets all requirements
  1  no tension was found
  2  an input, an output or the command line is at fault
  3  the drive so set up does not meet another requirement of its file";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Tension {
    #[command(flatten)]
    common: Common,
    /// Smallest factor on all torques at which a pulley may slip, at least 1, in place of that of the file
    #[arg(long, value_name = "X", value_parser = margin)]
    margin: Option<f64>,
    /// Share of its length by which the belt grows in service
    #[arg(long, value_name = "SHARE", default_value = "0.5 %", value_parser = share)]
    elongation: f64,
    /// Pulley whose centre is moved to tension the belt; the driver of two pulleys unless given
    #[arg(long = "move", value_name = "PULLEY")]
    moved: Option<String>,
    #[command(flatten)]
    samples: Samples,
}

impl Tension {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let (file, origin) = self.common.file()?;
        self.of(&file, &origin).map_err(|failure| failure.of(&file))
    }

    fn of(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        let service = file.service().map_err(Failure::usage)?;
        let samples = self.samples.of(file)?;
        let stated = service.requirements.smallest_slip_margin;
        let Some(slip_margin) = self.margin.or(stated) else {
            return Err(Failure::usage(
                "error: no slip margin is asked for\nexpected: `--margin 1.5`, or `smallest_slip_margin` in \
                 [requirements] of the drive file",
            ));
        };
        let moved = self.moved.as_ref().map(|value| {
            let option = "--move";
            Argument { option, value }.pulley(&service.cases[0].drive)
        });
        let question = SetupQuestion {
            slip_margin,
            elongation: self.elongation,
            moved: moved.transpose().map_err(Failure::usage)?,
        };
        let options = self.common.options();
        let found = self
            .common
            .with_progress(|progress| tension(&service, question, &options, progress))?;
        let spread = self.common.with_progress(|progress| {
            uncertainty::of_tension(file, &found, samples, &options, progress)
        });
        let answer = quantity::tension::answer(&found);
        let spread = spread.map_err(Failure::usage)?;
        let answer = &quantity::uncertainty::told_in(answer, &spread, &service.cases);
        let draw = |directory: &Path, metadata: &str| {
            let drawn = quantity::check::drawn(&found.checked);
            plot::write_layouts(&drawn, directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)?;
        super::check::outcome(&found.checked)
    }
}

fn margin(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    match value >= 1.0 && value.is_finite() {
        true => Ok(value),
        false => Err("must be at least 1".to_owned()),
    }
}

/// A share, in per cent or as a number.
fn share(text: &str) -> Result<f64, String> {
    let (number, unit) = match text.trim().strip_suffix('%') {
        Some(number) => (number.trim(), 1e-2),
        None => (text.trim(), 1.0),
    };
    let value: f64 = { number.parse() }
        .map_err(|_| "not a share; expected one such as \"0.5 %\" or 0.005".to_owned())?;
    match (0.0..1.0).contains(&(value * unit)) {
        true => Ok(value * unit),
        false => Err("must be at least 0 and below 100 %".to_owned()),
    }
}
