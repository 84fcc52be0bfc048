//! Measured rows in CSV: what was set in each, and what was found.

mod heading;

use super::{
    Diagnostic, DriveFile, FileKey, check,
    csv::{fields, lines, number_of},
    diagnostic::Finding,
    source::Source,
};
use crate::Drive;
use crate::results::measured::Measured;
use heading::{Column, column, without_deviation};
use std::ops::Range;

/// Measured rows: in each a drive file with what was set, and what was found.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Measurements {
    /// The numbers of the drive file that are set in every row.
    pub set: Vec<FileKey>,
    /// What was measured, in the order of the columns.
    pub measured: Vec<Measured>,
    /// Whether the columns of measured quantities have standard deviations.
    pub has_deviations: bool,
    /// The rows.
    pub rows: Vec<MeasuredRow>,
}

/// A measured row.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct MeasuredRow {
    /// Its line in the file.
    pub line: usize,
    /// The drive file with the entries of this row.
    pub file: DriveFile,
    /// What was found for each measured quantity; `None` where the field is empty.
    pub readings: Vec<Option<Reading>>,
}

/// A number that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Its value, SI.
    pub value: f64,
    /// Its standard deviation, SI; positive.
    pub deviation: Option<f64>,
}

impl Measurements {
    /// Measured rows from a CSV text, called `name` in messages, on the drive of a file.
    ///
    /// The first line has a heading for each column: the dotted path of a number of the drive file, for what was
    /// set, the name of a [`Measured`] quantity, or that name and `sd` for its standard deviation; each with its
    /// unit in brackets where it is not SI, `driven.angular_speed [rpm]`. Fields of measured quantities may be
    /// empty. Lines that begin with `#` are comments.
    ///
    /// # Errors
    /// The first finding: the drive file is at fault, a heading is unknown, stands twice or has a wrong unit, a row has
    /// another number of fields, a field is no number or out of its range, nothing is measured.
    pub fn read(name: &str, text: &str, file: &DriveFile) -> Result<Self, Diagnostic> {
        let drive = file.drive()?;
        let source = Source::new(name, text, &[]);
        Self::found(text, file, &drive).map_err(|finding| Diagnostic::new(finding, &source))
    }

    fn found(text: &str, file: &DriveFile, drive: &Drive) -> Result<Self, Finding> {
        let end = text.trim_end().len();
        let mut lines = lines(text);
        let Some((_, headings)) = lines.next() else {
            return Err(
                Finding::new(end..end, "there is no line with headings").expected(
                    "a heading for each column, e.g. load.torque,driven.angular_speed [rpm]",
                ),
            );
        };
        let mut measured = Vec::new();
        let mut columns = Vec::new();
        let headings: Vec<_> = fields(text, headings).collect();
        for range in &headings {
            let column = column(text, range.clone(), file, drive, &mut measured)?;
            columns.push(column);
        }
        let deviations = columns
            .iter()
            .filter(|column| matches!(column, Column::Deviation(..)));
        let deviations = deviations.count();
        if measured.is_empty() {
            let all = Measured::all(drive);
            let names: Vec<_> = all.iter().map(Measured::name).collect();
            let range = headings.first().map_or(end..end, Clone::clone);
            return Err(Finding::new(range, "no column holds a measured quantity")
                .expected(check::one_of(&names)));
        }
        if deviations != measured.len() && (deviations > 0 || measured.len() > 1) {
            return Err(without_deviation(text, &headings, &columns, &measured));
        }
        let rows = lines.map(|(number, line)| row(text, number, line, &columns, &measured, file));
        let rows: Vec<_> = rows.collect::<Result<_, _>>()?;
        if rows.is_empty() {
            return Err(Finding::new(
                end..end,
                "there are no rows below the headings",
            ));
        }
        let set = columns.iter().filter_map(|column| match column {
            Column::Key(key, _) => Some(key.clone()),
            _ => None,
        });
        Ok(Self {
            set: set.collect(),
            measured,
            has_deviations: deviations > 0,
            rows,
        })
    }
}

/// A row of the file.
fn row(
    text: &str,
    number: usize,
    line: Range<usize>,
    columns: &[Column],
    measured: &[Measured],
    file: &DriveFile,
) -> Result<MeasuredRow, Finding> {
    let places: Vec<_> = fields(text, line.clone()).collect();
    if places.len() != columns.len() {
        let message = format!("{} fields under {} headings", places.len(), columns.len());
        let finding = Finding::new(line, message).expected("a field for each heading");
        return Err(finding.help("a decimal point is a point; a comma parts fields"));
    }
    let mut file = file.clone();
    let mut readings: Vec<Option<Reading>> = vec![None; measured.len()];
    for (column, place) in columns.iter().zip(places) {
        let field = &text[place.clone()];
        match column {
            Column::Key(key, factor) => {
                let value = number_of(field, place.clone())? * factor;
                if !key.allows(value) {
                    let message = format!("`{}` is out of its range", key.path());
                    return Err(Finding::new(place, message));
                }
                file = file.with(key, value);
            }
            Column::Measured(index, factor) if !field.is_empty() => {
                readings[*index] = Some(Reading {
                    value: number_of(field, place)? * factor,
                    deviation: None,
                });
            }
            Column::Deviation(index, factor) => {
                let Some(reading) = &mut readings[*index] else {
                    continue;
                };
                let value = number_of(field, place.clone())? * factor;
                if value <= 0.0 {
                    let message = "a standard deviation must be positive";
                    return Err(Finding::new(place, message));
                }
                reading.deviation = Some(value);
            }
            Column::Measured(..) => {}
        }
    }
    Ok(MeasuredRow {
        line: number,
        file,
        readings,
    })
}
