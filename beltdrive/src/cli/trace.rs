//! `beltdrive trace`: a branch of steady states, or of limits, over one entry of the drive file.

use super::{common::Common, failure::Failure, origin::Origin, parameter};
use beltdrive::belt_loop::{self, Refusal, Varied};
use beltdrive::input::{Argument, DriveFile, FileKey, Key};
use beltdrive::quantity;
use beltdrive::{BranchEnd, Drive, plot};
use clap::Args;
use std::path::Path;

const HELP: &str = "\
Example:
  beltdrive trace kim2009.toml --parameter load.tight_tractive_tension --from '200 N' --to '9 kN'

The branch starts at A and goes on through limit points, where the parameter turns back, until it
reaches B, has come back by a quarter of its way, or the driven pulley stands still. --csv writes one
row per state.

A design chart, the largest tight tension for every coefficient of friction from 0.2 to 0.6:
  beltdrive trace kim2009.toml --parameter load.tight_tractive_tension \
    --curve friction.coefficient --from 0.2 --to 0.6 --plot figures";

const SAME: &str = "error: --parameter and --curve are the same entry";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Trace {
    #[command(flatten)]
    common: Common,
    /// Entry of the drive file to trace over, by its dotted path
    #[arg(long, value_name = "KEY")]
    parameter: String,
    /// Value of --parameter to start at, with its unit; of --curve where that is given
    #[arg(long, value_name = "A", allow_hyphen_values = true)]
    from: String,
    /// Value to end at
    #[arg(long, value_name = "B", allow_hyphen_values = true)]
    to: String,
    /// Follow the limit of --parameter over this second entry, from A to B
    #[arg(long, value_name = "KEY")]
    curve: Option<String>,
}

impl Trace {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let (file, origin) = self.common.file()?;
        self.of(&file, &origin).map_err(|failure| failure.of(&file))
    }

    fn of(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        let drive = file.drive().map_err(Failure::usage)?;
        if drive.two_pulleys().is_none() {
            return self.of_loop(file, origin);
        }
        let key = parameter::key("--parameter", &self.parameter, &drive)?;
        match &self.curve {
            None => self.branch(&drive, key, origin),
            Some(curve) => {
                let second = parameter::key("--curve", curve, &drive)?;
                self.limit_curve(&drive, key, second, origin)
            }
        }
    }

    fn branch(&self, drive: &Drive, key: Key, origin: &Origin) -> Result<(), Failure> {
        let range = self.range(key, None, drive)?;
        let options = self.common.options();
        let branch = self
            .common
            .with_progress(|progress| beltdrive::trace(drive, &key, range, &options, progress))?;
        let answer = &quantity::branch::answer(&branch);
        let draw = |directory: &Path, metadata: &str| {
            plot::write_rows(answer, "branch.svg", directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)?;
        finished(&branch.end)
    }

    fn limit_curve(
        &self,
        drive: &Drive,
        key: Key,
        second: Key,
        origin: &Origin,
    ) -> Result<(), Failure> {
        if second == key {
            return Err(Failure::usage(SAME));
        }
        let range = self.range(second, Some(key), drive)?;
        let options = self.common.options();
        let curve = self.common.with_progress(|progress| {
            beltdrive::limit_curve(drive, &key, &second, range, &options, progress)
        })?;
        let answer = &quantity::limit_curve::answer(&curve);
        let draw = |directory: &Path, metadata: &str| {
            plot::write_rows(answer, "limit_curve.svg", directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)?;
        finished(&curve.end)
    }

    fn of_loop(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        let key = |option, value| {
            let key = file.key(Argument { option, value });
            key.map_err(Failure::usage)
        };
        let parameter = key("--parameter", &self.parameter)?;
        let varied = Varied::Key(parameter.clone());
        let options = self.common.options();
        let beginning = |refusal: Refusal| {
            let help = |text: String| {
                let from = &self.from;
                format!("{text}\nhelp: that is at --from {from}; begin where the loop has a state")
            };
            match Failure::from(refusal) {
                Failure::Unsolved(text) => Failure::Unsolved(help(text)),
                // The file itself was read.
                Failure::Usage(text) => Failure::Usage(help(text)),
                other @ (Failure::Unmet(_) | Failure::Interrupted(_)) => other,
            }
        };
        let (name, answer) = match &self.curve {
            None => {
                let range = self.range_of(&parameter)?;
                let branch = self.common.with_progress(|progress| {
                    belt_loop::trace(file, &varied, range, &options, progress)
                });
                let branch = branch.map_err(beginning)?;
                ("branch.svg", quantity::loop_range::branch(&branch))
            }
            Some(path) => {
                let second = key("--curve", path)?;
                if second == parameter {
                    return Err(Failure::usage(SAME));
                }
                let range = self.range_of(&second)?;
                let curve = self.common.with_progress(|progress| {
                    belt_loop::limit_curve(file, &varied, &second, range, &options, progress)
                });
                let curve = curve.map_err(beginning)?;
                ("limit_curve.svg", quantity::loop_range::limit_curve(&curve))
            }
        };
        let answer = &answer;
        let draw = |directory: &Path, metadata: &str| {
            plot::write_rows(answer, name, directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)
    }

    /// The range of a number of a loop to be traced over.
    fn range_of(&self, key: &FileKey) -> Result<[f64; 2], Failure> {
        let value = |option, value| {
            let value = Argument { option, value }.number(key);
            value.map_err(Failure::usage)
        };
        let range = [value("--from", &self.from)?, value("--to", &self.to)?];
        parameter::distinct(["--from", "--to"], range)
    }

    /// The range of an entry to be traced over, where another one may be free.
    fn range(&self, key: Key, free: Option<Key>, drive: &Drive) -> Result<[f64; 2], Failure> {
        let options = [("--from", &*self.from), ("--to", &*self.to)];
        parameter::range(options, key, free, drive)
    }
}

/// A failure where the next state was not found.
fn finished(end: &BranchEnd) -> Result<(), Failure> {
    match end {
        BranchEnd::NotConverged { .. } => Err(Failure::Unsolved(format!("error: {end}"))),
        _ => Ok(()),
    }
}
