//! Where the rows of a sweep come from.

use super::over::Over;
use super::sample::Sample;
use crate::cli::failure::Failure;
use beltdrive::belt_loop::Varied;
use beltdrive::input::DriveFile;
use beltdrive::{Grid, SweepRow, SweepTable, TableError, TableRows};
use clap::Args;
use serde_json::{Value, json};
use std::ops::Range;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub(super) struct SourceArgs {
    /// A number that varies by its dotted path, its ends with their units and how many values it takes, or
    /// its values; repeatable. With --sample its ends alone, KEY=A:B
    #[arg(
        long,
        value_name = "KEY=A:B:N|V1,V2,…",
        required_unless_present = "table"
    )]
    over: Vec<String>,
    /// Draw N rows from the ranges of --over, as a Latin hypercube or as points of the scrambled Sobol' sequence
    #[arg(long, value_name = "lhs:N|sobol:N", requires = "over")]
    sample: Option<String>,
    /// Another sample for every whole number
    #[arg(long, value_name = "SEED", default_value = "1", requires = "sample")]
    seed: u64,
    /// Take the rows from a table in CSV, Parquet or Arrow IPC with a column for each number that varies
    #[arg(long, value_name = "FILE", conflicts_with_all = ["over", "sample"])]
    table: Option<PathBuf>,
}

/// The rows, and what varies in them.
pub(super) struct Source {
    rows: Rows,
    pub(super) varied: Vec<Varied>,
    /// What tells them from other rows.
    pub(super) identity: Value,
}

enum Rows {
    Grid(Grid),
    Sample(Sample),
    Table(SweepTable),
}

/// Reads rows in their order.
pub(super) enum Reader<'s> {
    Grid(&'s Grid),
    Sample(&'s Sample),
    Table(TableRows<'s>),
}

impl SourceArgs {
    /// The table, if there is one.
    pub(super) fn table(&self) -> Option<&Path> {
        self.table.as_deref()
    }

    /// The rows for a drive file.
    pub(super) fn source(&self, file: &DriveFile) -> Result<Source, Failure> {
        if let Some(path) = &self.table {
            let table = SweepTable::open(path, file).map_err(of_table)?;
            return Ok(Source {
                varied: table.varied(),
                identity: json!({ "table": {
                    "rows": table.count(),
                    "fingerprint": format!("{:016x}", table.fingerprint()),
                }}),
                rows: Rows::Table(table),
            });
        }
        let over = Over::all(file, &self.over)?;
        let (rows, identity) = match &self.sample {
            None => {
                let axes = over.iter().map(Over::listed);
                let axes = axes.collect::<Result<Vec<_>, _>>()?;
                if Grid::count_of(&axes).is_none() {
                    return Err(Failure::usage("error: there are too many rows to count"));
                }
                let identity = json!({ "over": self.over });
                (Rows::Grid(Grid::new(axes)), identity)
            }
            Some(sample) => {
                let ranges = over.iter().map(Over::range).collect::<Result<_, _>>()?;
                let rows = Sample::new(sample, ranges, self.seed)?;
                let identity = json!({ "over": self.over, "sample": sample, "seed": self.seed });
                (Rows::Sample(rows), identity)
            }
        };
        Ok(Source {
            rows,
            varied: over.into_iter().map(|over| over.varied).collect(),
            identity,
        })
    }
}

impl Source {
    /// The number of rows.
    pub(super) fn count(&self) -> usize {
        match &self.rows {
            Rows::Grid(grid) => grid.count(),
            Rows::Sample(sample) => sample.count(),
            Rows::Table(table) => table.count(),
        }
    }

    pub(super) fn reader(&self) -> Result<Reader<'_>, Failure> {
        Ok(match &self.rows {
            Rows::Grid(grid) => Reader::Grid(grid),
            Rows::Sample(sample) => Reader::Sample(sample),
            Rows::Table(table) => Reader::Table(table.rows().map_err(of_table)?),
        })
    }
}

impl Reader<'_> {
    /// The rows of a range, which begins behind those that were read before.
    pub(super) fn take(&mut self, range: Range<usize>) -> Result<Vec<SweepRow>, Failure> {
        match self {
            Self::Grid(grid) => Ok(grid.rows(range.start).take(range.len()).collect()),
            Self::Sample(sample) => Ok(sample.take(range)),
            Self::Table(rows) => {
                rows.skip_to(range.start).map_err(of_table)?;
                let rows = rows.take(range.len());
                rows.collect::<Result<_, _>>().map_err(of_table)
            }
        }
    }
}

fn of_table(error: TableError) -> Failure {
    match error {
        TableError::Heading(diagnostic) => Failure::usage(diagnostic),
        error => Failure::Usage(format!("error: --table: {error}")),
    }
}
