//! `beltdrive check`: whether a drive holds in each of its load cases.

use super::{common::Common, failure::Failure, samples::Samples};
use beltdrive::{CheckedService, plot, quantity, uncertainty};
use clap::Args;
use std::path::Path;

const HELP: &str = "\
Example:
  beltdrive examples serpentine-cases > drive.toml
  beltdrive check drive.toml

The file states load cases in [[case]] tables and limits in [requirements]; without cases the drive is
judged as it stands. What [uncertainty] says is not known exactly becomes bands of 95 %. --csv writes one row per case, --plot draws the layout of each.

Exit status:
  0  every case meets the requirements
  2  an input, an output or the command line is at fault
  3  a case does not meet a requirement, or has no steady state";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Check {
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    samples: Samples,
}

impl Check {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let (file, origin) = self.common.file()?;
        let service = file.service().map_err(Failure::usage)?;
        let samples = self.samples.of(&file)?;
        let options = self.common.options();
        let checked = self
            .common
            .with_progress(|progress| beltdrive::check(&service, &options, progress))?;
        let spread = self.common.with_progress(|progress| {
            uncertainty::of_check(&file, &checked, samples, &options, progress)
        });
        let answer = quantity::check::answer(&checked);
        let spread = spread.map_err(Failure::usage)?;
        let answer = &quantity::uncertainty::told_in(answer, &spread, &service.cases);
        let draw = |directory: &Path, metadata: &str| {
            let drawn = quantity::check::drawn(&checked);
            plot::write_layouts(&drawn, directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, &origin)?;
        outcome(&checked)
    }
}

/// A failure where a case does not hold.
pub(super) fn outcome(checked: &CheckedService) -> Result<(), Failure> {
    let failing = match (checked.failing(), checked.cases.len()) {
        (0, _) => return Ok(()),
        (_, 1) => "the drive fails".to_owned(),
        (1, count) => format!("1 of {count} load cases fails"),
        (failing, count) => format!("{failing} of {count} load cases fail"),
    };
    Err(Failure::Unmet(format!("error: {failing}")))
}
