//! Where results go: a table on standard output, files, figures.

use super::destinations::Destinations;
use super::failure::Failure;
use super::origin::Origin;
use super::parquet;
use beltdrive::plot;
use beltdrive::quantity::{Answer, UnitSystem};
use beltdrive::report::{self, write_file};
use clap::{Args, ValueEnum};
use std::{
    io::{self, ErrorKind, Write},
    path::{Path, PathBuf},
};

/// Where the results of a drive go.
#[derive(Args)]
pub(super) struct Output {
    #[command(flatten)]
    texts: Texts,
    /// Draw figures into a directory
    #[arg(long, value_name = "DIR")]
    plot: Option<PathBuf>,
    /// Units of the table
    #[arg(long, value_name = "SYSTEM", default_value = "engineering")]
    units: Units,
}

/// Where results go as text.
#[derive(Args)]
pub(super) struct Texts {
    /// Write everything as JSON; - for standard output, in place of the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write rows as CSV; - for standard output, in place of the table
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write the rows of --csv as Parquet
    #[arg(long, value_name = "FILE")]
    parquet: Option<PathBuf>,
    /// Print neither the table nor the names of written files
    #[arg(long)]
    quiet: bool,
}

/// A system of units by its name.
#[derive(Clone, Copy, ValueEnum)]
pub(super) enum Units {
    /// m, N, W, rad/s
    Si,
    /// mm, N, kW, rpm
    Engineering,
    /// in, lbf, hp, rpm
    Us,
}

impl From<Units> for UnitSystem {
    fn from(units: Units) -> Self {
        match units {
            Units::Si => Self::Si,
            Units::Engineering => Self::Engineering,
            Units::Us => Self::Us,
        }
    }
}

/// Writes the figures of an answer with metadata into a directory and lists the files.
pub(super) type Draw<'a> = &'a dyn Fn(&Path, &str) -> Result<Vec<PathBuf>, plot::Error>;

impl Output {
    /// Whether figures are asked for.
    pub(super) fn draws(&self) -> bool {
        self.plot.is_some()
    }

    /// Whether only results are to be written.
    pub(super) fn is_quiet(&self) -> bool {
        self.texts.quiet
    }

    /// Refuses outputs that would overwrite a file that is read beside the drive file.
    pub(super) fn check_data(&self, data: &Path) -> Result<(), Failure> {
        let plot = self.plot.as_deref();
        self.texts.check_beside(plot, Some(("the data", data)), &[])
    }

    /// Refuses outputs, also those of other options, that would overwrite each other or the drive file.
    pub(super) fn check(
        &self,
        drive_file: &Path,
        others: &[(&'static str, Option<&Path>)],
    ) -> Result<(), Failure> {
        let read = Some(("the drive file", drive_file));
        self.texts.check_beside(self.plot.as_deref(), read, others)
    }

    /// Names files that another option has written.
    pub(super) fn name(&self, written: &[PathBuf]) {
        self.texts.note(written);
    }

    /// Prints and writes an answer in the forms asked for, with what its drive file takes from a belt section.
    pub(super) fn write(
        &self,
        answer: &Answer,
        draw: Draw<'_>,
        origin: &Origin,
    ) -> Result<(), Failure> {
        let answer = &origin.told_in(answer);
        self.texts.write(answer, self.units, origin)?;
        let Some(directory) = &self.plot else {
            return Ok(());
        };
        let action = format!("draw figures into {}", directory.display());
        let figures = draw(directory, &origin.json());
        let figures = figures.map_err(|error| Failure::io(&action, &error))?;
        self.texts.note(&figures);
        Ok(())
    }
}

impl Texts {
    /// Refuses outputs that would overwrite each other.
    pub(super) fn check(&self) -> Result<(), Failure> {
        self.check_beside(None, None, &[])
    }

    fn check_beside(
        &self,
        figures: Option<&Path>,
        read: Option<(&'static str, &Path)>,
        others: &[(&'static str, Option<&Path>)],
    ) -> Result<(), Failure> {
        if self.parquet.is_some() {
            parquet::check()?;
        }
        let csv = self.csv.as_deref().filter(|path| !is_stream(path));
        let origin = csv.map(Origin::beside);
        let own = [
            ("--json", self.json.as_deref()),
            ("--csv", self.csv.as_deref()),
            ("the origin of --csv", origin.as_deref()),
            ("--parquet", self.parquet.as_deref()),
        ];
        Destinations {
            texts: &[&own, others].concat(),
            figures,
            read,
        }
        .check()
    }

    /// Prints and writes an answer in the forms asked for.
    pub(super) fn write(
        &self,
        answer: &Answer,
        units: Units,
        origin: &Origin,
    ) -> Result<(), Failure> {
        let outputs = [&self.json, &self.csv, &self.parquet].map(Option::as_deref);
        if !self.quiet && !outputs.into_iter().any(is_stdout) {
            print(&report::table(answer, units.into()))?;
        }
        let mut written = Vec::new();
        if let Some(path) = &self.json {
            written.extend(write_text(path, &origin.in_json(&report::json(answer)))?);
        }
        if let Some(path) = &self.csv {
            written.extend(write_csv(path, &report::csv(answer), origin)?);
        }
        if let Some(path) = &self.parquet {
            written.extend(write_content(path, &parquet::bytes(answer, origin)?)?);
        }
        self.note(&written);
        Ok(())
    }

    /// Names the files that were written.
    fn note(&self, written: &[PathBuf]) {
        if !self.quiet {
            for path in written {
                note(&format!("wrote {}", path.display()));
            }
        }
    }
}

/// Writes a text to a file, which it returns, or to standard output.
pub(super) fn write_text(path: &Path, text: &str) -> Result<Option<PathBuf>, Failure> {
    write_content(path, text.as_bytes())
}

/// As [`write_text`], of bytes.
fn write_content(path: &Path, content: &[u8]) -> Result<Option<PathBuf>, Failure> {
    if is_stream(path) {
        print_bytes(content)?;
        return Ok(None);
    }
    let action = format!("write {}", path.display());
    write_file(path, content).map_err(|error| Failure::io(&action, &error))?;
    Ok(Some(path.to_owned()))
}

/// Writes a CSV text and, if it goes to a file, its origin to another one beside it. Lists the files.
pub(super) fn write_csv(path: &Path, text: &str, origin: &Origin) -> Result<Vec<PathBuf>, Failure> {
    let mut written: Vec<_> = write_text(path, text)?.into_iter().collect();
    if path.is_file() {
        written.extend(write_text(&Origin::beside(path), &origin.json())?);
    }
    Ok(written)
}

/// Whether a path stands for a standard stream.
pub(super) fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn is_stdout(output: Option<&Path>) -> bool {
    output.is_some_and(is_stream)
}

/// Writes to standard output. Whoever closes it has read enough: that is no failure.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    print_bytes(text.as_bytes())
}

/// As [`print()`], of a text that another crate writes.
pub(super) fn print_bytes(text: &[u8]) -> Result<(), Failure> {
    let mut output = io::stdout().lock();
    match output.write_all(text).and_then(|()| output.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::io("write to standard output", &error))
        }
        _ => Ok(()),
    }
}

/// Writes a line to standard error, which is the last place to complain: a failure is ignored.
pub(super) fn note(message: &str) {
    let _ = writeln!(io::stderr(), "{message}");
}
