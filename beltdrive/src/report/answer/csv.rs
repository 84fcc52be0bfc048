//! The series of an answer as comma-separated values.

use crate::quantity::{Answer, Subject, Value};
use crate::report::rows;

/// What varies along the belt, one row per point, with a first column that names the subject; keys and units
/// as in JSON.
pub fn csv(answer: &Answer) -> String {
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
