//! `beltdrive limits`: the smallest and the largest load that a drive carries.

use super::{common::Common, failure::Failure, origin::Origin, parameter};
use beltdrive::belt_loop::{self, Varied};
use beltdrive::input::{Argument, DriveFile, Key};
use beltdrive::plot;
use beltdrive::quantity::{self, Answer};
use clap::Args;
use std::path::Path;

const HELP: &str = "\
Example:
  beltdrive limits kim2009.toml --set friction.coefficient=0.3 --json limits.json

--csv writes one row per limit, --plot draws the branch between them.";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Limits {
    #[command(flatten)]
    common: Common,
    /// Entry of the drive file to look for the limits of, by its dotted path; unless given the load: the
    /// tight tension or the driven torque, and for a loop of pulleys a factor on all torques
    #[arg(long, value_name = "KEY")]
    parameter: Option<String>,
}

impl Limits {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let (file, origin) = self.common.file()?;
        self.of(&file, &origin).map_err(|failure| failure.of(&file))
    }

    fn of(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        let drive = file.drive().map_err(Failure::usage)?;
        if drive.two_pulleys().is_none() {
            return self.of_loop(file, origin);
        }
        let key = match &self.parameter {
            Some(value) => parameter::key("--parameter", value, &drive)?,
            None => Key::load(&drive),
        };
        let options = self.common.options();
        let limits = self
            .common
            .with_progress(|progress| beltdrive::limits(&drive, &key, &options, progress))?;
        let answer = &quantity::limits::answer(&limits);
        let draw = |directory: &Path, metadata: &str| {
            let branch = quantity::branch::answer(&limits.branch);
            plot::write_rows(&branch, "branch.svg", directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)
    }

    fn of_loop(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        let varied = match &self.parameter {
            Some(value) => {
                let option = "--parameter";
                let key = file.key(Argument { option, value });
                Varied::Key(key.map_err(Failure::usage)?)
            }
            None => Varied::LoadFactor,
        };
        let options = self.common.options();
        let limits = self
            .common
            .with_progress(|progress| belt_loop::limits(file, &varied, &options, progress))?;
        let answer = &quantity::loop_range::limits(&limits);
        // The states between the limits, where they are drawn.
        let chart = match self.common.output.draws() {
            true => {
                let range = [&limits.smallest, &limits.largest].map(|limit| limit.point.value);
                let branch = belt_loop::trace(file, &varied, range, &options, &mut |_, _| {})?;
                quantity::loop_range::branch(&branch)
            }
            false => Answer::default(),
        };
        let draw = |directory: &Path, metadata: &str| {
            plot::write_rows(&chart, "branch.svg", directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)
    }
}
