//! Tables of values of numbers of a drive file, a column each.

use super::{
    Diagnostic, DriveFile, FileKey, check,
    diagnostic::Finding,
    heading::{factor, parted},
    quantity::{self, Fault},
    source::Source,
    spelling,
};
use crate::quantity::Measure;
use std::ops::Range;

/// What the column of the factor on all torques and powers is called.
const LOAD_FACTOR: &str = "load_factor";

/// The columns of a table of values of numbers of a drive file.
#[derive(Clone, Debug)]
pub struct TableHead {
    /// What messages call the table.
    name: String,
    columns: Vec<Column>,
}

#[derive(Clone, Debug)]
struct Column {
    heading: String,
    /// None is the load factor.
    key: Option<FileKey>,
    /// From the unit of the column to SI.
    factor: f64,
}

impl TableHead {
    /// The columns under headings, of a table that messages call `name`.
    ///
    /// A heading is the dotted path of a number of the drive file, with its unit in brackets where it is not SI,
    /// `load.power [kW]`, or its name with the SI unit in CSV and Parquet, `load_power_W`; or `load_factor`.
    ///
    /// # Errors
    /// A heading is unknown, stands twice or has a wrong unit; there is none.
    pub fn new(name: &str, headings: &[&str], file: &DriveFile) -> Result<Self, Diagnostic> {
        let text = headings.join(",");
        let source = Source::new(name, &text, &[]);
        let columns = columns(&text, headings, file);
        let columns = columns.map_err(|finding| Diagnostic::new(finding, &source))?;
        let name = name.to_owned();
        Ok(Self { name, columns })
    }

    /// The number of each column; none is a factor on all torques and powers.
    pub fn keys(&self) -> impl Iterator<Item = Option<&FileKey>> {
        self.columns.iter().map(|column| column.key.as_ref())
    }

    /// The values, SI, of the fields of a row; NaN for one that is at fault, and what is wrong with the first of these.
    /// Messages call the row `row`.
    pub fn read<'f>(
        &self,
        row: &str,
        fields: impl IntoIterator<Item = &'f str>,
    ) -> (Vec<f64>, Option<Diagnostic>) {
        let fields: Vec<_> = fields.into_iter().collect();
        if fields.len() != self.columns.len() {
            let message = format!(
                "{} fields under {} headings",
                fields.len(),
                self.columns.len()
            );
            let values = vec![f64::NAN; self.columns.len()];
            return (values, Some(self.fault(row, &message)));
        }
        let numbers = fields
            .into_iter()
            .map(|field| match quantity::parse(field) {
                Ok(found) if found.unit.is_none() => Ok(found.value),
                _ if field.is_empty() => Err("missing number".to_owned()),
                Err((Fault::NotFinite, _)) => Err(format!("`{field}` is not a finite number")),
                _ => Err(format!("malformed number `{field}`")),
            });
        self.values(row, numbers)
    }

    /// As [`TableHead::read`], of numbers in the units of the columns; none is missing.
    pub fn convert(
        &self,
        row: &str,
        numbers: impl IntoIterator<Item = Option<f64>>,
    ) -> (Vec<f64>, Option<Diagnostic>) {
        let numbers = numbers.into_iter().map(|number| match number {
            Some(number) if number.is_finite() => Ok(number),
            Some(number) => Err(format!("`{number}` is not a finite number")),
            None => Err("missing number".to_owned()),
        });
        self.values(row, numbers)
    }

    fn values(
        &self,
        row: &str,
        numbers: impl Iterator<Item = Result<f64, String>>,
    ) -> (Vec<f64>, Option<Diagnostic>) {
        let mut fault = None;
        let values = self.columns.iter().zip(numbers).map(|(column, number)| {
            let number = number.and_then(|number| match column.key {
                None if number < 0.0 => Err("a load factor must not be negative".to_owned()),
                _ => Ok(number * column.factor),
            });
            number.unwrap_or_else(|problem| {
                let message = format!("{problem} under `{}`", column.heading);
                fault.get_or_insert_with(|| self.fault(row, &message));
                f64::NAN
            })
        });
        (values.collect(), fault)
    }

    /// What is wrong with a row.
    fn fault(&self, row: &str, problem: &str) -> Diagnostic {
        let finding = Finding::new(0..row.len(), format!("{row} of {}: {problem}", self.name));
        Diagnostic::new(finding, &Source::new(&self.name, row, &[]))
    }
}

/// The columns under headings, which stand in a text with a comma between each other.
fn columns(text: &str, headings: &[&str], file: &DriveFile) -> Result<Vec<Column>, Finding> {
    let keys = file.keys();
    let mut columns: Vec<Column> = Vec::new();
    let mut start = 0;
    for heading in headings {
        let place = start..start + heading.len();
        start = place.end + 1;
        let column = column(text, place.clone(), &keys)?;
        if columns.iter().any(|other| other.key == column.key) {
            let message = format!("a second column of `{heading}`");
            return Err(Finding::new(place, message).expected("one column for each number"));
        }
        columns.push(column);
    }
    match columns.is_empty() {
        true => Err(Finding::new(0..0, "the table has no columns")),
        false => Ok(columns),
    }
}

fn column(text: &str, place: Range<usize>, keys: &[FileKey]) -> Result<Column, Finding> {
    let heading = text[place.clone()].to_owned();
    let ((name, at_name), unit) = parted(text, place)?;
    if name == LOAD_FACTOR {
        let factor = factor(unit, Measure::Number)?;
        return Ok(Column {
            heading,
            key: None,
            factor,
        });
    }
    let stored = |key: &FileKey| {
        (
            key.stem() + key.measure().stored().0,
            key.measure().stored().1,
        )
    };
    let key = keys.iter().find(|key| match unit {
        Some(_) => key.path() == name,
        None => key.path() == name || stored(key).0 == name,
    });
    let Some(key) = key else {
        let known = || keys.iter().map(FileKey::path).chain([LOAD_FACTOR]);
        let named = keys.iter().map(|key| (stored(key).0, key.path()));
        let near = spelling::nearest_key(name, known).or_else(|| spelling::nearest(name, named));
        let paths: Vec<_> = known().collect();
        return Err(Finding::new(at_name, format!("unknown column `{name}`"))
            .expected(check::one_of(&paths))
            .did_you_mean(near));
    };
    let factor = match key.path() == name {
        true => factor(unit, key.measure())?,
        false => stored(key).1.recip(),
    };
    Ok(Column {
        heading,
        key: Some(key.clone()),
        factor,
    })
}
