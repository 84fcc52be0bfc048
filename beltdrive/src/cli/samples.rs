//! How many samples of uncertain numbers are drawn.

use super::failure::Failure;
use beltdrive::input::DriveFile;
use clap::Args;

/// Most samples: each takes an answer of its own.
const MOST: usize = 1_000_000;

/// Samples of the numbers that are not known exactly.
#[derive(Args)]
pub(super) struct Samples {
    /// Draw N samples of what [uncertainty] says is not known exactly, and show their bands beside the linearised ones
    #[arg(long, value_name = "N", value_parser = samples)]
    samples: Option<usize>,
}

impl Samples {
    /// How many samples of a drive file are drawn; 0 for none.
    pub(super) fn of(&self, file: &DriveFile) -> Result<usize, Failure> {
        let uncertain = file.uncertainty().map_err(Failure::usage)?;
        match (self.samples, uncertain.is_empty()) {
            (None, _) => Ok(0),
            (Some(_), true) => Err(Failure::usage(
                "error: the drive file has no [uncertainty], so that all samples are the same\nexpected: such as \
                 `friction.coefficient = \"10 %\"` in [uncertainty] of the drive file",
            )),
            (Some(samples), false) => Ok(samples),
        }
    }
}

fn samples(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(samples) if (2..=MOST).contains(&samples) => Ok(samples),
        Ok(_) => Err(format!("must be from 2 to {MOST}")),
        Err(_) => Err("not a whole number".to_owned()),
    }
}
