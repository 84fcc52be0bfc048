//! The points or the series of an answer as comma-separated values.

use crate::quantity::{self, Answer, Group, Layout, Quantity, Subject, Value};

/// The rows of an answer: what varies along the belt, one row per point, beside the words of its subject; or,
/// where nothing does, its points, one each with all numbers and words below it. Keys and units are those of
/// JSON.
pub fn csv(answer: &Answer) -> String {
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

fn is_series(quantity: &Quantity) -> bool {
    matches!(quantity.value, Value::Series(_))
}

/// A row for each subject, with empty fields for what only others have. What stands twice under a key, as the
/// quantity that varies and as one of the state, stands there once.
fn points(subjects: &[Subject]) -> String {
    let rows: Vec<_> = subjects
        .iter()
        .map(|subject| fields("", &subject.quantities))
        .collect();
    let mut header: Vec<String> = Vec::new();
    for (key, _) in rows.iter().flatten() {
        if !header.contains(key) {
            header.push(key.clone());
        }
    }
    let filled = rows.iter().map(|fields| {
        let value = |key: &String| {
            let field = fields.iter().find(|(other, _)| other == key);
            field.map_or_else(String::new, |(_, value)| value.clone())
        };
        header.iter().map(value).collect::<Vec<_>>()
    });
    text(header.clone(), filled)
}

/// Keys and values of quantities, those of subjects of their own behind the names of these.
fn fields(prefix: &str, quantities: &[Quantity]) -> Vec<(String, String)> {
    let mut fields = Vec::new();
    let quantities = quantity::flat(quantities).into_iter();
    for quantity in quantities.filter(|quantity| !quantity.key.is_empty()) {
        let (suffix, factor) = quantity.measure.stored();
        let key = format!("{prefix}{}{suffix}", quantity.key);
        let text = |value: f64| (value * factor).to_string();
        match &quantity.value {
            Value::Number(value) => fields.push((key, value.map_or_else(String::new, text))),
            Value::Count(count) => fields.push((key, count.to_string())),
            Value::Word(word) => fields.push((key, word.clone().unwrap_or_default())),
            Value::Pair(pair) => {
                let parts = ["x", "y"].iter().zip(pair);
                fields.extend(parts.map(|(part, &value)| (format!("{key}.{part}"), text(value))));
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
fn along<'a>(subjects: impl Iterator<Item = &'a Subject>) -> String {
    let mut header = Vec::new();
    let rows: Vec<_> = subjects
        .flat_map(|subject| {
            let (keys, columns): (Vec<_>, Vec<_>) = columns(subject).into_iter().unzip();
            header = keys;
            let count = columns.iter().map(Vec::len).min().unwrap_or(0);
            (0..count).map(move |row| columns.iter().map(|column| column[row].clone()).collect())
        })
        .collect();
    text(header, rows)
}

/// The series and words of a subject under their keys, in the units of these.
fn columns(subject: &Subject) -> Vec<(String, Vec<String>)> {
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
        let values = match &quantity.value {
            Value::Series(values) => values
                .iter()
                .map(|value| (value * factor).to_string())
                .collect(),
            Value::Word(word) => vec![word.clone().unwrap_or_default(); count],
            _ => return None,
        };
        Some((format!("{}{suffix}", quantity.key), values))
    });
    columns.collect()
}

/// A header and rows as CSV.
///
/// # Panics
/// Never: rows of one length are written into memory.
fn text(header: Vec<String>, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    if header.is_empty() {
        return String::new();
    }
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    for row in std::iter::once(header).chain(rows) {
        writer.write_record(row).expect("rows of one length");
    }
    let bytes = writer.into_inner().expect("written into memory");
    String::from_utf8(bytes).expect("made of texts")
}
