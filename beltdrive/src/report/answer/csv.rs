//! The points or the series of an answer as comma-separated values.

use crate::quantity::{Answer, Group, Layout, Subject, Value};
use crate::report::rows;

/// The rows of an answer: its points, one each with all numbers and words below it; or, where there are none,
/// what varies along the belt, one row per point, with a first column that names the subject. Keys and units
/// are those of JSON.
pub fn csv(answer: &Answer) -> String {
    let is_row = |group: &&Group| matches!(group.layout, Layout::Rows | Layout::Named);
    match answer.groups.iter().find(is_row) {
        Some(group) => points(&group.subjects),
        None => along(answer),
    }
}

/// A row for each subject. What another subject has more of has empty fields.
fn points(subjects: &[Subject]) -> String {
    let rows: Vec<_> = subjects.iter().map(|subject| fields("", subject)).collect();
    let longest = rows.iter().max_by_key(|fields| fields.len());
    let keys = longest.into_iter().flatten().map(|(key, _)| key.clone());
    let header: Vec<_> = keys.collect();
    let filled = rows.iter().map(|fields| {
        let value = |key: &String| {
            let field = fields.iter().find(|(other, _)| other == key);
            field.map_or_else(String::new, |(_, value)| value.clone())
        };
        header.iter().map(value).collect::<Vec<_>>()
    });
    rows::csv(header.clone(), filled)
}

/// Keys and values of a subject, those of subjects of its own behind the names of these.
fn fields(prefix: &str, subject: &Subject) -> Vec<(String, String)> {
    let mut fields = Vec::new();
    for quantity in &subject.quantities {
        let (suffix, factor) = quantity.measure.stored();
        let key = format!("{prefix}{}{suffix}", quantity.key);
        let text = |value: f64| (value * factor).to_string();
        match &quantity.value {
            Value::Number(value) => fields.push((key, value.map_or_else(String::new, text))),
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
                    fields.extend(self::fields(&prefix, subject));
                }
            }
            Value::Series(_) | Value::Indices(_) => {}
        }
    }
    fields
}

/// The series of all subjects below each other.
fn along(answer: &Answer) -> String {
    let subjects = answer.groups.iter().flat_map(|group| &group.subjects);
    let series: Vec<_> = subjects
        .map(|subject| (subject.head.as_str(), columns(subject)))
        .filter(|(_, columns)| !columns.is_empty())
        .collect();
    let names = series.first().into_iter().flat_map(|(_, columns)| columns);
    let names = names.map(|(name, _)| name.clone());
    let header = std::iter::once("subject".to_owned()).chain(names).collect();
    let rows = series.iter().flat_map(|(subject, columns)| {
        let count = columns.iter().map(|(_, values)| values.len()).min();
        (0..count.unwrap_or(0)).map(move |row| {
            let values = columns.iter().map(|(_, values)| values[row].to_string());
            std::iter::once((*subject).to_owned())
                .chain(values)
                .collect()
        })
    });
    rows::csv(header, rows)
}

/// The series of a subject under their keys, in the units of these.
fn columns(subject: &Subject) -> Vec<(String, Vec<f64>)> {
    let quantities = subject.quantities.iter();
    let series = quantities.filter_map(|quantity| match &quantity.value {
        Value::Series(values) => {
            let (suffix, factor) = quantity.measure.stored();
            let values = values.iter().map(|value| value * factor).collect();
            Some((format!("{}{suffix}", quantity.key), values))
        }
        _ => None,
    });
    series.collect()
}
