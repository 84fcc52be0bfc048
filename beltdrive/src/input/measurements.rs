//! Measured rows in CSV: what was set in each, and what was found.

use super::{
    Diagnostic, DriveFile, FileKey, check,
    diagnostic::Finding,
    dimension::Dimension,
    quantity::{self, Fault},
    source::Source,
    spelling, unit,
};
use crate::Drive;
use crate::quantity::Measure;
use crate::results::measured::Measured;
use std::ops::Range;

/// What follows the name of a measured quantity in the heading of its standard deviation.
const DEVIATION: &str = " sd";

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

/// What a column holds, with the factor from its unit to SI.
enum Column {
    /// An entry of the drive file.
    Key(FileKey, f64),
    /// A measured quantity, by its index.
    Measured(usize, f64),
    /// The standard deviation of one, by its index.
    Deviation(usize, f64),
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

/// The lines of a text that hold something but comments, with their numbers from 1 and their places.
fn lines(text: &str) -> impl Iterator<Item = (usize, Range<usize>)> {
    let mut start = 0;
    let lines = text.split_inclusive('\n').enumerate();
    lines.filter_map(move |(index, whole)| {
        let line = whole.trim_end_matches(['\n', '\r']);
        let range = start..start + line.len();
        start += whole.len();
        let is_blank = line.trim().is_empty() || line.trim_start().starts_with('#');
        (!is_blank).then_some((index + 1, range))
    })
}

/// The places of the fields of a line, without the blanks and quotes round them.
fn fields(text: &str, line: Range<usize>) -> impl Iterator<Item = Range<usize>> {
    let mut start = line.start;
    text[line].split(',').map(move |field| {
        let trimmed = field.trim();
        let inside = trimmed
            .strip_prefix('"')
            .and_then(|field| field.strip_suffix('"'));
        let inside = inside.unwrap_or(trimmed);
        let from = start + (inside.as_ptr() as usize - field.as_ptr() as usize);
        start += field.len() + 1;
        from..from + inside.len()
    })
}

/// What the column of a heading holds.
fn column(
    text: &str,
    range: Range<usize>,
    file: &DriveFile,
    drive: &Drive,
    measured: &mut Vec<Measured>,
) -> Result<Column, Finding> {
    let heading = &text[range.clone()];
    let (whole, unit) = match heading.split_once('[') {
        Some((name, unit)) => {
            let start = range.start + name.len() + 1;
            let unit = unit.strip_suffix(']').ok_or_else(|| {
                Finding::new(range.clone(), format!("the unit of `{heading}` has no end"))
                    .expected("the unit in brackets, e.g. load.torque [N*m]")
            })?;
            (name.trim_end(), Some((unit, start..start + unit.len())))
        }
        None => (heading, None),
    };
    let (name, is_deviation) = match whole.strip_suffix(DEVIATION) {
        Some(name) => (name.trim_end(), true),
        None => (whole, false),
    };
    let at_name = range.start..range.start + name.len();
    let keys = file.keys();
    if let Some(key) = keys.iter().find(|key| key.path() == name && !is_deviation) {
        let factor = factor(unit, key.measure())?;
        return Ok(Column::Key(key.clone(), factor));
    }
    let all = Measured::all(drive);
    let Some(found) = all.iter().find(|measured| measured.name() == name) else {
        let known = || {
            let names = all.iter().map(Measured::name);
            names.chain(keys.iter().map(FileKey::path))
        };
        let nearest = spelling::nearest(name, known().map(|name| (name, name)));
        let nearest = nearest.or_else(|| spelling::nearest_key(name, known));
        let finding = Finding::new(at_name, format!("unknown column `{name}`"))
            .expected("a number of the drive file, a measured quantity, or one with ` sd` for its standard deviation");
        return Err(match nearest {
            Some(_) => finding.did_you_mean(nearest),
            None => finding.help(format!(
                "what can be measured: `{}`",
                all.iter()
                    .map(Measured::name)
                    .collect::<Vec<_>>()
                    .join("`, `")
            )),
        });
    };
    let factor = factor(unit, found.measure())?;
    let index = measured.iter().position(|known| known.name() == name);
    match (index, is_deviation) {
        (Some(_), false) => Err(
            Finding::new(at_name, format!("the column `{name}` stands twice")).expected("it once"),
        ),
        (None, false) => {
            measured.push(found.clone());
            Ok(Column::Measured(measured.len() - 1, factor))
        }
        (Some(index), true) => Ok(Column::Deviation(index, factor)),
        (None, true) => {
            let message = format!("a standard deviation before its column `{name}`");
            Err(Finding::new(range, message).expected(format!("`{name}` to the left of it")))
        }
    }
}

/// The factor from a unit to SI for a measure; SI without a unit.
fn factor(unit: Option<(&str, Range<usize>)>, measure: Measure) -> Result<f64, Finding> {
    let Some((symbols, range)) = unit else {
        return Ok(1.0);
    };
    let trimmed = symbols.trim();
    // Of vibration, not of turning.
    if measure == Measure::Frequency {
        return match trimmed {
            "Hz" => Ok(1.0),
            _ => Err(
                Finding::new(range, format!("`{trimmed}` is no unit of a frequency"))
                    .expected("Hz"),
            ),
        };
    }
    let dimension = match measure {
        Measure::Share => Dimension::NUMBER,
        Measure::Loss => Dimension::POWER,
        measure => Dimension::of(measure).unwrap_or(Dimension::NUMBER),
    };
    let found = unit::parse(trimmed).map_err(|_| {
        Finding::new(range.clone(), format!("unknown unit `{trimmed}`"))
            .expected(format!("{dimension}"))
            .did_you_mean(unit::nearest(trimmed))
    })?;
    match found.dimension == dimension {
        true => Ok(found.scale),
        false => {
            let message = format!(
                "wrong dimension: expected {dimension}, got {}",
                found.dimension
            );
            Err(Finding::new(range, message))
        }
    }
}

/// The finding for measured quantities some or all of which have no standard deviation.
fn without_deviation(
    text: &str,
    headings: &[Range<usize>],
    columns: &[Column],
    measured: &[Measured],
) -> Finding {
    let has = |index: usize| {
        let is_of = |column: &Column| matches!(column, Column::Deviation(of, _) if *of == index);
        columns.iter().any(is_of)
    };
    let lacking = (0..measured.len()).find(|&index| !has(index)).unwrap_or(0);
    let is_it = |column: &Column| matches!(column, Column::Measured(of, _) if *of == lacking);
    let place = columns.iter().position(is_it);
    let range = place.map_or(0..0, |place| headings[place].clone());
    let name = measured[lacking].name();
    let heading = &text[range.clone()];
    Finding::new(range, format!("`{name}` has no standard deviation"))
        .expected(format!("a column `{}`", heading.replacen(name, &format!("{name}{DEVIATION}"), 1)))
        .help("several measured quantities are weighed by their standard deviations; a single one needs none")
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

/// The number of a field.
fn number_of(field: &str, place: Range<usize>) -> Result<f64, Finding> {
    let with_unit = "a number; its unit stands in the heading";
    match quantity::parse(field) {
        Ok(found) if found.unit.is_none() => Ok(found.value),
        Err((Fault::NotFinite, _)) => Err(Finding::new(
            place,
            format!("`{field}` is not a finite number"),
        )),
        _ if field.is_empty() => Err(Finding::new(place, "missing number").expected(with_unit)),
        _ => Err(Finding::new(place, format!("malformed number `{field}`")).expected(with_unit)),
    }
}
