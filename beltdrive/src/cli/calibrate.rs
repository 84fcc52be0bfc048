//! `beltdrive calibrate`: numbers of the drive file from measured rows.

use super::{common::Common, failure::Failure, origin::Origin, read};
use beltdrive::calibrate::Error;
use beltdrive::input::{DriveFile, Measurements};
use beltdrive::quantity::{calibration, title};
use beltdrive::{calibrate, plot};
use clap::Args;
use std::path::{Path, PathBuf};

const HELP: &str = "\
Example:
  beltdrive examples flat-bench > flat-bench.toml
  beltdrive examples flat-bench.csv > flat-bench.csv
  beltdrive calibrate flat-bench.toml --data flat-bench.csv --plot figures

The first line of the data names the columns: numbers of the drive file that were set, such as load.torque [N*m],
measured ones, such as driven.angular_speed [rpm], and their standard deviations, driven.angular_speed sd [rpm].
--csv writes one row per reading, --plot draws the residuals.";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Calibrate {
    #[command(flatten)]
    common: Common,
    /// Measured rows in CSV; - for standard input
    #[arg(long, value_name = "CSV")]
    data: PathBuf,
    /// Number of the drive file to find, by its dotted path, in place of those of calibration.free; repeatable
    #[arg(long, value_name = "KEY")]
    free: Vec<String>,
}

impl Calibrate {
    pub(super) fn run(&self) -> Result<(), Failure> {
        self.common.output.check_data(&self.data)?;
        let (file, origin) = self.common.file()?;
        self.of(&file, &origin).map_err(|failure| failure.of(&file))
    }

    fn of(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        let (name, text) = read::text(&self.data, "measured rows")?;
        let drive = file.drive().map_err(Failure::usage)?;
        let keys = file.free_keys(&self.free).map_err(Failure::usage)?;
        let data = Measurements::read(&name, &text, file).map_err(Failure::usage)?;
        let options = self.common.options();
        let found = self
            .common
            .with_progress(|progress| calibrate(&keys, &data, &options, progress));
        let found = found.map_err(|error| match error {
            Error::Set { .. } | Error::TooFew { .. } => Failure::Usage(format!("error: {error}")),
            error => Failure::Unsolved(format!("error: {error}")),
        })?;
        let answer = &calibration::answer(&drive, &found);
        let draw = |directory: &Path, metadata: &str| {
            plot::write_calibration(&title(&drive), &found, directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)
    }
}
