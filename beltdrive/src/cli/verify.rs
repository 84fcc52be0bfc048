//! `beltdrive verify`: the published results that the program stands on, recomputed.

use super::destinations::Destinations;
use super::failure::Failure;
use super::origin::Origin;
use super::output::{is_stream, note, print, write_csv, write_text};
use super::progress::with_bar;
use beltdrive::quantity::{Answer, UnitSystem, verification};
use beltdrive::report::{csv, json, markdown, table};
use beltdrive::verify::Verdict;
use beltdrive::{Verification, verify};
use clap::Args;
use std::path::PathBuf;

const HELP: &str = "\
Example:
  beltdrive verify --markdown verification.md

Every published number is computed anew and set beside the printed one, in the unit and to the digits
of its source; it takes some seconds.

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

impl Verify {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let csv_file = self.csv.as_deref().filter(|path| !is_stream(path));
        let beside = csv_file.map(Origin::beside);
        Destinations {
            texts: &[
                ("--json", self.json.as_deref()),
                ("--markdown", self.markdown.as_deref()),
                ("--csv", self.csv.as_deref()),
                ("the origin of --csv", beside.as_deref()),
            ],
            figures: None,
            read: None,
        }
        .check()?;
        let outputs = [&self.json, &self.markdown, &self.csv];
        let on_stdout = outputs.into_iter().flatten().any(|path| is_stream(path));
        let verification = with_bar(self.quiet, |progress| verify(progress));
        let answer = verification::answer(&verification);
        if !self.quiet && !on_stdout {
            print(&table(&answer, UnitSystem::default()))?;
        }
        for path in self.write_files(&verification, &answer)? {
            if !self.quiet {
                note(&format!("wrote {}", path.display()));
            }
        }
        outcome(verification.count(Verdict::Differs))
    }

    /// Writes the outputs asked for and lists the files among them.
    fn write_files(
        &self,
        verification: &Verification,
        answer: &Answer,
    ) -> Result<Vec<PathBuf>, Failure> {
        let origin = Origin::new();
        let mut written = Vec::new();
        if let Some(path) = &self.json {
            written.extend(write_text(path, &origin.in_json(&json(answer)))?);
        }
        if let Some(path) = &self.markdown {
            written.extend(write_text(path, &markdown(verification))?);
        }
        if let Some(path) = &self.csv {
            written.extend(write_csv(path, &csv(answer), &origin)?);
        }
        Ok(written)
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
