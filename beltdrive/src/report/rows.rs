//! The points or the series of an answer as rows under columns: what CSV and Parquet hold.

use crate::quantity::{self, Answer, Group, Layout, Quantity, Subject, Value};

/// Rows under columns with their units. A field is empty where there is nothing to tell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    /// The columns, each with a name of its own.
    pub columns: Vec<Column>,
    /// The rows, each with a field for every column.
    pub rows: Vec<Vec<Option<Field>>>,
}

/// A column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name, with the unit of its numbers: the key of JSON.
    pub name: String,
    /// What its fields hold.
    pub kind: FieldKind,
}

/// What the fields of a column hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldKind {
    /// Numbers.
    Number,
    /// Whole numbers.
    Count,
    /// Words or names.
    Word,
}

/// What a field holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Field {
    /// A number in the unit of its column.
    Number(f64),
    /// A whole number.
    Count(usize),
    /// A word or a name.
    Word(String),
}

impl Rows {
    /// The rows of an answer: what varies along the belt, one row per point, beside the words of its subject; or,
    /// where nothing does, its points, one each with all numbers and words below it. Names and units are those of
    /// JSON.
    #[must_use]
    pub fn of(answer: &Answer) -> Self {
        let subjects = answer.groups.iter().flat_map(|group| &group.subjects);
        let mut along = subjects.filter(|subject| subject.quantities.iter().any(is_series));
        match along.next() {
            Some(first) => self::along(std::iter::once(first).chain(along)),
            None => {
                let is_row = |group: &&Group| {
                    matches!(group.layout, Layout::Beside | Layout::Rows | Layout::Named)
                };
                let points = answer.groups.iter().find(is_row);
                self::points(points.map_or(&[], |group| &group.subjects))
            }
        }
    }
}

/// Columns of quantities, under which rows of their values stand.
#[derive(Clone, Debug)]
pub struct Head {
    columns: Vec<Column>,
    /// From SI to the unit of each column.
    factors: Vec<f64>,
}

impl Head {
    /// The columns of quantities that are numbers and words, under their keys.
    #[must_use]
    pub fn of(quantities: &[Quantity]) -> Self {
        let columns = quantities.iter().map(|quantity| {
            let kind = match quantity.value {
                Value::Count(_) => FieldKind::Count,
                Value::Word(_) => FieldKind::Word,
                _ => FieldKind::Number,
            };
            let name = format!("{}{}", quantity.key, quantity.measure.stored().0);
            Column { name, kind }
        });
        let factors = quantities
            .iter()
            .map(|quantity| quantity.measure.stored().1);
        Self {
            columns: columns.collect(),
            factors: factors.collect(),
        }
    }

    /// The columns.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The fields of values, SI, in the order of the quantities.
    #[must_use]
    pub fn row(&self, values: Vec<Value>) -> Vec<Option<Field>> {
        let fields = values.into_iter().zip(&self.factors);
        let field = |(value, factor): (Value, &f64)| match value {
            Value::Number(value) => value.map(|value| Field::Number(value * factor)),
            Value::Count(count) => Some(Field::Count(count)),
            Value::Word(word) => word.map(Field::Word),
            _ => None,
        };
        fields.map(field).collect()
    }
}

fn is_series(quantity: &Quantity) -> bool {
    matches!(quantity.value, Value::Series(_))
}

/// A row for each subject, with empty fields for what only others have. What stands twice under a key, as the
/// quantity that varies and as one of the state, stands there once.
fn points(subjects: &[Subject]) -> Rows {
    let rows: Vec<_> = subjects
        .iter()
        .map(|subject| fields("", &subject.quantities))
        .collect();
    let mut columns: Vec<Column> = Vec::new();
    for (column, _) in rows.iter().flatten() {
        if !columns.iter().any(|known| known.name == column.name) {
            columns.push(column.clone());
        }
    }
    let filled = rows.iter().map(|fields| {
        let value = |column: &Column| {
            let mut fields = fields.iter();
            let field = fields.find(|(other, _)| other.name == column.name);
            field.and_then(|(_, value)| value.clone())
        };
        columns.iter().map(value).collect()
    });
    Rows {
        rows: filled.collect(),
        columns,
    }
}

/// Columns and fields of quantities, those of subjects of their own behind the names of these.
fn fields(prefix: &str, quantities: &[Quantity]) -> Vec<(Column, Option<Field>)> {
    let mut fields = Vec::new();
    let quantities = quantity::flat(quantities).into_iter();
    for quantity in quantities.filter(|quantity| !quantity.key.is_empty()) {
        let (suffix, factor) = quantity.measure.stored();
        let key = format!("{prefix}{}{suffix}", quantity.key);
        let number = |value: f64| Field::Number(value * factor);
        let column = |name, kind| Column { name, kind };
        match &quantity.value {
            Value::Number(value) => {
                fields.push((column(key, FieldKind::Number), value.map(number)));
            }
            Value::Count(count) => {
                fields.push((column(key, FieldKind::Count), Some(Field::Count(*count))));
            }
            Value::Word(word) => {
                fields.push((column(key, FieldKind::Word), word.clone().map(Field::Word)));
            }
            Value::Pair(pair) => {
                let parts = ["x", "y"].iter().zip(pair);
                fields.extend(parts.map(|(part, &value)| {
                    let column = column(format!("{key}.{part}"), FieldKind::Number);
                    (column, Some(number(value)))
                }));
            }
            Value::List(subjects) => {
                for (index, subject) in subjects.iter().enumerate() {
                    let name = match subject.head.is_empty() {
                        true => index.to_string(),
                        false => subject.head.clone(),
                    };
                    let prefix = format!("{prefix}{}.{name}.", quantity.key);
                    fields.extend(self::fields(&prefix, &subject.quantities));
                }
            }
            Value::Series(_) | Value::Json(_) | Value::Parts(_) | Value::Object(_) => {}
        }
    }
    fields
}

/// The series of subjects below each other, with the words of these.
fn along<'a>(subjects: impl Iterator<Item = &'a Subject>) -> Rows {
    let mut columns = Vec::new();
    let rows = subjects.flat_map(|subject| {
        let (heads, values): (_, Vec<_>) = series(subject).into_iter().unzip();
        columns = heads;
        let count = values.iter().map(Vec::len).min().unwrap_or(0);
        (0..count).map(move |row| values.iter().map(|column| column[row].clone()).collect())
    });
    Rows {
        rows: rows.collect(),
        columns,
    }
}

/// The series and words of a subject under their keys, in the units of these.
fn series(subject: &Subject) -> Vec<(Column, Vec<Option<Field>>)> {
    let series = subject
        .quantities
        .iter()
        .map(|quantity| match &quantity.value {
            Value::Series(values) => values.len(),
            _ => 0,
        });
    let count = series.max().unwrap_or(0);
    let quantities = subject.quantities.iter();
    let columns = quantities.filter_map(|quantity| {
        let (suffix, factor) = quantity.measure.stored();
        let (kind, fields) = match &quantity.value {
            Value::Series(values) => {
                let fields = values
                    .iter()
                    .map(|value| Some(Field::Number(value * factor)));
                (FieldKind::Number, fields.collect())
            }
            Value::Word(word) => {
                let word = word.clone().map(Field::Word);
                (FieldKind::Word, vec![word; count])
            }
            _ => return None,
        };
        let name = format!("{}{suffix}", quantity.key);
        Some((Column { name, kind }, fields))
    });
    columns.collect()
}
