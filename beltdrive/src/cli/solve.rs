//! `beltdrive solve`: the steady state of a drive.

use super::{common::Common, failure::Failure, output::Report};
use beltdrive::{SteadyState, plot, report};
use clap::Args;
use std::path::{Path, PathBuf};

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
        let (drive, origin) = self.common.drive()?;
        let state = beltdrive::solve(&drive, &self.common.options())?;
        self.common.output.write(&state, &origin)
    }
}

impl Report for SteadyState {
    fn table(&self) -> String {
        report::table(self)
    }

    fn json(&self) -> String {
        report::json(self)
    }

    fn csv(&self) -> String {
        report::csv(self)
    }

    fn plot(&self, directory: &Path, metadata: &str) -> Result<Vec<PathBuf>, plot::Error> {
        plot::write_all(self, directory, Some(metadata))
    }
}
