//! `beltdrive sweep`: one question for many drives.

mod over;
mod rate;

use super::destinations::Destinations;
use super::failure::Failure;
use super::origin::Origin;
use super::output::{is_stream, note, print, write_text};
use super::parquet;
use super::progress::with_bar;
use super::stated::Stated;
use beltdrive::input::DriveFile;
use beltdrive::quantity::sweep::{Columns, answer};
use beltdrive::report::{self, Head, RowFormat, RowWriter, WholeFile};
use beltdrive::{BeltKind, Grid, Sweep, SweepQuestion, SweepRow, SweepSummary};
use clap::{Args, ValueEnum};
use over::Over;
use rate::Rate;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

const HELP: &str = "\
Examples:
  beltdrive sweep drive.toml --over 'load.torque=10 N*m:60 N*m:100' \\
    --over friction.coefficient=0.4,0.5,0.6 --csv rows.csv

All combinations are answered, those of the last --over one after another. A row without an answer keeps its
place, with status and reason.";

/// Rows of a chunk: some tenths of a second of flat belts, some seconds of V-belts.
const CHUNKS: [usize; 2] = [10_000, 1000];

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Command {
    #[command(flatten)]
    stated: Stated,
    /// A number that varies by its dotted path, its ends with their units and how many values it takes, or
    /// its values; repeatable
    #[arg(long, value_name = "KEY=A:B:N|V1,V2,…", required = true)]
    over: Vec<String>,
    /// What is asked of every drive
    #[arg(long, value_name = "COMMAND", default_value = "solve")]
    answer: Question,
    /// Write the rows as CSV; - for standard output, in place of the summary
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write the rows as Parquet; - for standard output, in place of the summary
    #[arg(long, value_name = "FILE")]
    parquet: Option<PathBuf>,
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
            parquet::check()?;
        }
        let csv = self.csv.as_deref().filter(|path| !is_stream(path));
        let beside = csv.map(Origin::beside);
        Destinations {
            texts: &[
                ("--csv", self.csv.as_deref()),
                ("the origin of --csv", beside.as_deref()),
                ("--parquet", self.parquet.as_deref()),
                ("--json", self.json.as_deref()),
            ],
            figures: None,
            read: Some(("the drive file", self.stated.path())),
        }
        .check()
    }

    fn of(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        // A drive file that is at fault says so itself.
        file.drive().map_err(Failure::usage)?;
        let over = Over::all(file, &self.over)?;
        let axes: Vec<_> = over.iter().map(Over::listed).collect();
        if Grid::count_of(&axes).is_none() {
            return Err(Failure::usage("error: there are too many rows to count"));
        }
        let grid = Grid::new(axes);
        let varied = over.into_iter().map(|over| over.varied).collect();
        let options = self.stated.options();
        let sweep = Sweep::new(file, varied, self.answer.into(), options);
        let sweep = sweep.map_err(|error| Failure::Usage(format!("error: {error}")))?;
        let summary = with_bar(self.quiet, |progress| {
            self.answered(&sweep, &grid, origin, progress)
        })?;
        self.tell(&sweep, &summary, origin)
    }

    /// Answers all rows and writes them.
    fn answered(
        &self,
        sweep: &Sweep,
        grid: &Grid,
        origin: &Origin,
        progress: &mut (dyn FnMut(f64, &str) + Send),
    ) -> Result<SweepSummary, Failure> {
        let columns = Columns::new(sweep);
        let head = Head::of(&columns.quantities());
        let mut outputs = self.outputs(&head, origin)?;
        let chunk = match sweep.drive().belt.kind {
            BeltKind::Flat { .. } => CHUNKS[0],
            BeltKind::V(_) => CHUNKS[1],
        };
        let rate = Rate::new(grid.count(), progress);
        let mut rows = grid.rows(0);
        let mut summary = SweepSummary::default();
        for first in (0..grid.count()).step_by(chunk) {
            let rows: Vec<SweepRow> = rows.by_ref().take(chunk).collect();
            let fields = sweep.answer(&rows, |index, row, answer| {
                let mut counted = SweepSummary::default();
                counted.add(answer);
                rate.answered();
                (
                    counted,
                    head.row(columns.values(first + index, row, answer)),
                )
            });
            let (counted, fields): (Vec<_>, Vec<_>) = fields.into_iter().unzip();
            counted.into_iter().for_each(|row| summary.join(row));
            for (output, path) in &mut outputs {
                match output.write(&fields) {
                    // Whoever closes standard output has read enough.
                    Err(error) if is_stream(path) && error.kind() == ErrorKind::BrokenPipe => {
                        return Ok(summary);
                    }
                    written => written.map_err(|error| cannot_write(path, &error))?,
                }
            }
        }
        for (output, path) in outputs {
            let finished = output.finish().and_then(Output::finish);
            finished.map_err(|error| cannot_write(path, &error))?;
            self.note(path);
        }
        if let Some(path) = self.csv.as_deref().filter(|path| path.is_file()) {
            write_text(&Origin::beside(path), &origin.json())?;
            self.note(&Origin::beside(path));
        }
        Ok(summary)
    }

    /// The files of the rows, begun.
    fn outputs(
        &self,
        head: &Head,
        origin: &Origin,
    ) -> Result<Vec<(RowWriter<Output>, &Path)>, Failure> {
        let csv = self.csv.as_deref().map(|path| (path, RowFormat::Csv));
        let parquet = match self.parquet.as_deref() {
            Some(path) => Some((path, parquet::format()?)),
            None => None,
        };
        let begun = [csv, parquet].into_iter().flatten().map(|(path, format)| {
            let output = Output::new(path);
            let writer = output.and_then(|output| {
                RowWriter::new(format, output, head.columns(), &origin.entries())
            });
            let writer = writer.map_err(|error| cannot_write(path, &error))?;
            Ok((writer, path))
        });
        begun.collect()
    }

    /// Prints and writes the summary.
    fn tell(&self, sweep: &Sweep, summary: &SweepSummary, origin: &Origin) -> Result<(), Failure> {
        let answer = answer(sweep, summary);
        let answer = &*origin.told_in(&answer);
        let outputs = [&self.csv, &self.parquet, &self.json];
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
            Some((_, _, first)) if summary.answered() == 0 => Err(Failure::Unsolved(format!(
                "error: no row has an answer, the first because of this: {first}"
            ))),
            _ => Ok(()),
        }
    }

    /// Names a written file.
    fn note(&self, path: &Path) {
        if !self.quiet && !is_stream(path) {
            note(&format!("wrote {}", path.display()));
        }
    }
}

fn cannot_write(path: &Path, error: &io::Error) -> Failure {
    let action = match is_stream(path) {
        true => "write to standard output".to_owned(),
        false => format!("write {}", path.display()),
    };
    Failure::io(&action, error)
}

/// Where rows go.
enum Output {
    Stream(io::Stdout),
    File(WholeFile),
}

impl Output {
    fn new(path: &Path) -> io::Result<Self> {
        match is_stream(path) {
            true => Ok(Self::Stream(io::stdout())),
            false => WholeFile::create(path).map(Self::File),
        }
    }

    fn finish(self) -> io::Result<()> {
        match self {
            Self::Stream(mut stream) => stream.flush(),
            Self::File(file) => file.finish(),
        }
    }
}

impl Write for Output {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        match self {
            Self::Stream(stream) => stream.write(buffer),
            Self::File(file) => file.write(buffer),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Stream(stream) => stream.flush(),
            Self::File(file) => file.flush(),
        }
    }
}
