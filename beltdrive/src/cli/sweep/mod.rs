//! `beltdrive sweep`: one question for many drives.

mod outputs;
mod over;
mod parts;
mod rate;
mod sample;
mod source;

use super::destinations::Destinations;
use super::failure::Failure;
use super::origin::Origin;
use super::output::{is_stream, note, print, write_text};
use super::progress::with_bar;
use super::stated::Stated;
use beltdrive::input::DriveFile;
use beltdrive::quantity::sweep::{Columns, answer};
use beltdrive::report::{self, Head, RowWriter};
use beltdrive::{Sweep, SweepQuestion, SweepSummary};
use clap::{Args, ValueEnum};
use outputs::{Output, Outputs, Wanted, cannot_write, is_closed};
use parts::{PartFormat, Parts, Shard};
use rate::Rate;
use serde_json::{Value, json};
use source::{Source, SourceArgs};
use std::path::{Path, PathBuf};

const HELP: &str = "\
Examples:
  beltdrive sweep drive.toml --over 'load.torque=10 N*m:60 N*m:100' \\
    --over friction.coefficient=0.4,0.5,0.6 --csv rows.csv
  beltdrive sweep drive.toml --over friction.coefficient=0.3:0.6 --over 'load.torque=10 N*m:60 N*m' \\
    --sample lhs:100000 --answer check --out rows --shard 1/4

All combinations are answered, those of the last --over one after another; or the rows of a sample or of a
table. A row without an answer keeps its place, with status and reason. --out writes a file for each chunk of
rows; the same command goes on where it was interrupted.";

/// The most rows of a chunk: all of them are in memory together.
const LARGEST_CHUNK: u64 = 1_000_000;

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Command {
    #[command(flatten)]
    stated: Stated,
    #[command(flatten)]
    source: SourceArgs,
    /// What is asked of every drive
    #[arg(long, value_name = "COMMAND", default_value = "solve")]
    answer: Question,
    /// Write the rows as CSV; - for standard output, in place of the summary
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write the rows as Parquet; - for standard output, in place of the summary
    #[arg(long, value_name = "FILE")]
    parquet: Option<PathBuf>,
    /// Write the rows as an Arrow IPC file; - for standard output, in place of the summary
    #[arg(long, value_name = "FILE")]
    arrow: Option<PathBuf>,
    /// Write the rows into a directory, a file for each chunk, and go on where that was interrupted
    #[arg(long, value_name = "DIR", conflicts_with_all = ["csv", "parquet", "arrow"])]
    out: Option<PathBuf>,
    /// Form of the files of --out
    #[arg(long, value_name = "FORM", default_value = "parquet", requires = "out")]
    format: PartFormat,
    /// Rows of a chunk; 10000 of flat belts and 1000 of V-belts unless given
    #[arg(long, value_name = "ROWS", value_parser = clap::value_parser!(u64).range(1..=LARGEST_CHUNK))]
    chunk: Option<u64>,
    /// Answer every N-th chunk from the I-th on alone
    #[arg(long, value_name = "I/N", value_parser = Shard::read)]
    shard: Option<Shard>,
    /// Write the summary as JSON; - for standard output, in place of the summary
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Print neither the summary nor the names of written files
    #[arg(long)]
    quiet: bool,
}

/// A question by its name.
#[derive(Clone, Copy, ValueEnum)]
enum Question {
    /// The steady state
    Solve,
    /// Slip margin, speed loss, hub loads and losses, in every load case
    Check,
    /// The smallest and the largest load
    Limits,
}

impl From<Question> for SweepQuestion {
    fn from(question: Question) -> Self {
        match question {
            Question::Solve => Self::Solve,
            Question::Check => Self::Check,
            Question::Limits => Self::Limits,
        }
    }
}

impl Command {
    pub(super) fn run(&self) -> Result<(), Failure> {
        self.check()?;
        let (file, origin) = self.stated.read()?;
        self.of(&file, &origin).map_err(|failure| failure.of(&file))
    }

    /// Refuses outputs that there is no place for.
    fn check(&self) -> Result<(), Failure> {
        if self.parquet.is_some() {
            PartFormat::Parquet.rows()?;
        }
        if self.arrow.is_some() {
            PartFormat::Arrow.rows()?;
        }
        if self.out.is_some() {
            self.format.rows()?;
        }
        let csv = self.csv.as_deref().filter(|path| !is_stream(path));
        let beside = csv.map(Origin::beside);
        let table = self.source.table().map(|path| ("the table", path));
        for read in [Some(("the drive file", self.stated.path())), table] {
            Destinations {
                texts: &[
                    ("--csv", self.csv.as_deref()),
                    ("the origin of --csv", beside.as_deref()),
                    ("--parquet", self.parquet.as_deref()),
                    ("--arrow", self.arrow.as_deref()),
                    ("--json", self.json.as_deref()),
                ],
                figures: None,
                read,
            }
            .check()?;
        }
        Ok(())
    }

    fn of(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        // A drive file that is at fault says so itself.
        file.drive().map_err(Failure::usage)?;
        let source = self.source.source(file)?;
        let options = self.stated.options();
        let sweep = Sweep::new(file, source.varied.clone(), self.answer.into(), options);
        let sweep = sweep.map_err(|error| Failure::Usage(format!("error: {error}")))?;
        let summary = with_bar(self.quiet, |progress| {
            self.answered(&sweep, &source, origin, progress)
        })?;
        self.tell(&sweep, &summary, origin)
    }

    /// Answers all rows and writes them.
    fn answered(
        &self,
        sweep: &Sweep,
        source: &Source,
        origin: &Origin,
        progress: &mut (dyn FnMut(f64, &str) + Send),
    ) -> Result<SweepSummary, Failure> {
        let columns = Columns::new(sweep);
        let head = Head::of(&columns.quantities());
        let metadata = origin.entries();
        let size = self.chunk_size(sweep);
        let identity = self.identity(sweep, source, origin, size);
        let mut outputs = self.outputs(&head, &metadata, &identity, origin)?;
        let count = source.count();
        let chunk = |chunk: usize| chunk * size..count.min((chunk + 1) * size);
        let chunks = count.div_ceil(size);
        let shard = self.shard.unwrap_or(Shard::ALL);
        let own = || (0..chunks).filter(|&chunk| shard.has(chunk));
        let rate = Rate::new(own().map(|index| chunk(index).len()).sum(), progress);
        let mut rows = source.reader()?;
        let mut summary = SweepSummary::default();
        for index in own() {
            let range = chunk(index);
            if outputs.stands(index) {
                summary.standing += range.len();
                rate.stood(range.len());
                continue;
            }
            let first = range.start;
            let fields = sweep.answer(&rows.take(range)?, |index, row, answer| {
                let mut counted = SweepSummary::default();
                counted.add(answer);
                rate.answered();
                let values = columns.values(first + index, row, answer);
                (counted, head.row(values))
            });
            let (counted, fields): (Vec<_>, Vec<_>) = fields.into_iter().unzip();
            counted.into_iter().for_each(|row| summary.join(row));
            if outputs.write(index, &fields)? == Wanted::Enough {
                return Ok(summary);
            }
        }
        outputs.finish(chunks, |path| self.note(path))?;
        if let Some(path) = self.csv.as_deref().filter(|path| path.is_file()) {
            write_text(&Origin::beside(path), &origin.json())?;
            self.note(&Origin::beside(path));
        }
        Ok(summary)
    }

    /// Rows of a chunk.
    fn chunk_size(&self, sweep: &Sweep) -> usize {
        let given = self.chunk.and_then(|size| usize::try_from(size).ok());
        given.unwrap_or(sweep.usual_chunk())
    }

    /// What tells this sweep from others.
    fn identity(&self, sweep: &Sweep, source: &Source, origin: &Origin, size: usize) -> Value {
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "drive_file": origin.drive_file().1,
            "set": self.stated.overrides(),
            "tolerance": self.stated.options().tolerance,
            "answer": sweep.question().name(),
            "source": source.identity,
            "rows": source.count(),
            "chunk": size,
            "format": format!("{:?}", self.format).to_lowercase(),
        })
    }

    /// Where the rows go, begun.
    fn outputs<'o>(
        &'o self,
        head: &'o Head,
        metadata: &'o [(String, String)],
        identity: &Value,
        origin: &Origin,
    ) -> Result<Outputs<'o>, Failure> {
        if let Some(directory) = &self.out {
            let parts = Parts {
                directory,
                format: self.format.rows()?,
                columns: head.columns(),
                metadata,
            };
            let origin = serde_json::to_value(origin).expect("texts");
            parts.open(identity, &origin)?;
            return Ok(Outputs::Parts(parts));
        }
        let forms = [
            (&self.csv, PartFormat::Csv),
            (&self.parquet, PartFormat::Parquet),
            (&self.arrow, PartFormat::Arrow),
        ];
        let wanted = { forms.iter() }.filter_map(|(path, form)| Some((path.as_deref()?, form)));
        let begun = wanted.filter_map(|(path, form)| {
            let begin = |format| {
                let output = Output::new(path)?;
                RowWriter::new(format, output, head.columns(), metadata)
            };
            match form.rows().map(begin) {
                Err(failure) => Some(Err(failure)),
                Ok(Err(error)) if is_closed(path, &error) => None,
                Ok(Err(error)) => Some(Err(cannot_write(path, &error))),
                Ok(Ok(writer)) => Some(Ok((writer, path))),
            }
        });
        Ok(Outputs::Files(begun.collect::<Result<_, Failure>>()?))
    }

    /// Prints and writes the summary.
    fn tell(&self, sweep: &Sweep, summary: &SweepSummary, origin: &Origin) -> Result<(), Failure> {
        let answer = answer(sweep, summary);
        let answer = &*origin.told_in(&answer);
        let outputs = [&self.csv, &self.parquet, &self.arrow, &self.json];
        let mut outputs = outputs.into_iter().flatten();
        if !self.quiet && !outputs.any(|path| is_stream(path)) {
            print(&report::table(answer, Default::default()))?;
        }
        if let Some(path) = &self.json
            && let Some(path) = write_text(path, &origin.in_json(&report::json(answer)))?
        {
            self.note(&path);
        }
        match summary.refusals.by_reason().next() {
            Some((_, _, first)) if summary.answered() + summary.standing == 0 => {
                Err(Failure::Unsolved(format!(
                    "error: no row has an answer, the first because of this: {first}"
                )))
            }
            _ => Ok(()),
        }
    }

    /// Names what was written.
    fn note(&self, path: &Path) {
        if !self.quiet && !is_stream(path) {
            note(&format!("wrote {}", path.display()));
        }
    }
}
