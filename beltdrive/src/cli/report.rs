//! `beltdrive report`: a page to hand in.

use super::check::outcome;
use super::destinations::Destinations;
use super::failure::Failure;
use super::output::{Units, note, write_text};
use super::progress::with_bar;
use super::samples::Samples;
use super::stated::Stated;
use beltdrive::page::{self, Made};
use beltdrive::uncertainty;
use clap::Args;
use std::path::PathBuf;

const HELP: &str = "\
Example:
  beltdrive examples serpentine-cases > drive.toml
  beltdrive report drive.toml --html report.html

The page holds the verdict on each load case, its numbers and figures, the checks of its state, the drive file and
how to make the page again; it needs nothing besides and prints to A4.

Exit status: that of check";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Report {
    #[command(flatten)]
    stated: Stated,
    /// Where the page goes; - for standard output [default: the name of the drive file with .html, here]
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Units of the numbers
    #[arg(long, value_name = "SYSTEM", default_value = "engineering")]
    units: Units,
    #[command(flatten)]
    samples: Samples,
    /// Do not print the name of the written file
    #[arg(long)]
    quiet: bool,
}

impl Report {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let to = self.html.clone().unwrap_or_else(|| self.beside());
        Destinations {
            texts: &[("--html", Some(&to))],
            figures: None,
            read: Some(("the drive file", self.stated.path())),
        }
        .check()?;
        let (file, origin) = self.stated.read()?;
        let service = file.service().map_err(Failure::usage)?;
        let samples = self.samples.of(&file)?;
        let options = self.stated.options();
        let checked = with_bar(self.quiet, |progress| {
            beltdrive::check(&service, &options, progress)
        })?;
        let spread = with_bar(self.quiet, |progress| {
            uncertainty::of_check(&file, &checked, samples, &options, progress)
        });
        let spread = spread.map_err(Failure::usage)?;
        let (name, text) = origin.drive_file();
        let made = Made {
            name,
            text,
            overrides: self.stated.overrides(),
            filled_in: file.filled_in(),
            command_line: &origin.command_line(),
        };
        let page = page::report(&checked, &spread, &made, self.units.into());
        if let Some(path) = write_text(&to, &page)?
            && !self.quiet
        {
            note(&format!("wrote {}", path.display()));
        }
        outcome(&checked)
    }

    /// The page of a drive file, here.
    fn beside(&self) -> PathBuf {
        let path = self.stated.path();
        let name = path.file_stem().filter(|_| path.as_os_str() != "-");
        PathBuf::from(name.unwrap_or("report".as_ref())).with_extension("html")
    }
}
