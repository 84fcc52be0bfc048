//! `beltdrive verify`: the published results that the program stands on, recomputed.

use super::destinations::Destinations;
use super::failure::Failure;
use super::output::{is_stream, note, print, write_text};
use super::progress::with_bar;
use beltdrive::quantity::{UnitSystem, verification};
use beltdrive::report::{csv, json, markdown, table};
use beltdrive::verify::Verdict;
use beltdrive::{Verification, verify};
use clap::Args;
use std::path::{Path, PathBuf};

const HELP: &str = "\
Example:
  beltdrive verify --markdown verification.md

Every published number is computed anew and set beside the printed one; it takes some seconds.

Exit status:
  0  every number agrees, or differs for a known reason
  1  a difference is unexplained
  2  an output or the command line is at fault";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Verify {
    /// Write everything as JSON; - for standard output, in place of the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write a page in Markdown; - for standard output, in place of the table
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    /// Write one row per number as CSV; - for standard output, in place of the table
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Print neither the table nor the names of written files
    #[arg(long)]
    quiet: bool,
}

/// A form of the result.
type Form = fn(&Verification) -> String;

impl Verify {
    pub(super) fn run(&self) -> Result<(), Failure> {
        Destinations {
            texts: &[
                ("--json", self.json.as_deref()),
                ("--markdown", self.markdown.as_deref()),
                ("--csv", self.csv.as_deref()),
            ],
            figures: None,
            drive_file: None,
        }
        .check()?;
        let on_stdout = self.outputs().any(|(path, _)| is_stream(path));
        let verification = with_bar(self.quiet, verify);
        if !self.quiet && !on_stdout {
            let answer = verification::answer(&verification);
            print(&table(&answer, UnitSystem::default()))?;
        }
        for (path, form) in self.outputs() {
            let written = write_text(path, &form(&verification))?;
            if let Some(path) = written.filter(|_| !self.quiet) {
                note(&format!("wrote {}", path.display()));
            }
        }
        outcome(verification.count(Verdict::Differs))
    }

    /// The outputs asked for.
    fn outputs(&self) -> impl Iterator<Item = (&Path, Form)> {
        let outputs = [
            (&self.json, (|of| json(&verification::answer(of))) as Form),
            (&self.markdown, markdown),
            (&self.csv, |of| csv(&verification::answer(of))),
        ];
        let asked_for = outputs.into_iter();
        asked_for.filter_map(|(path, form)| Some((path.as_deref()?, form)))
    }
}

/// A failure where differences are unexplained.
fn outcome(unexplained: usize) -> Result<(), Failure> {
    match unexplained {
        0 => Ok(()),
        1 => Err(Failure::Unsolved(
            "error: one published number differs, unexplained".to_owned(),
        )),
        number => Err(Failure::Unsolved(format!(
            "error: {number} published numbers differ, unexplained"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unexplained_difference_fails() {
        assert!(outcome(0).is_ok());
        let failed = |number, words: &str| matches!(outcome(number), Err(Failure::Unsolved(text)) if text.contains(words));
        assert!(failed(1, "one published number differs"));
        assert!(failed(3, "3 published numbers differ"));
    }
}
