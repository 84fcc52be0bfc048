//! The rows of an answer as comma-separated values.

use super::rows::{Column, Field, Rows};
use crate::quantity::Answer;

/// The rows of an answer ([`Rows::of`]) below a line of their columns.
pub fn csv(answer: &Answer) -> String {
    let Rows { columns, rows } = Rows::of(answer);
    csv_header(&columns) + &csv_rows(&rows)
}

/// The line of the names of columns; none without columns.
pub fn csv_header(columns: &[Column]) -> String {
    match columns {
        [] => String::new(),
        _ => text([columns.iter().map(|column| column.name.as_str())]),
    }
}

/// The lines of rows; numbers have all their digits, an empty field is empty.
pub fn csv_rows(rows: &[Vec<Option<Field>>]) -> String {
    text(rows.iter().map(|row| row.iter().map(field)))
}

/// A field as text.
fn field(field: &Option<Field>) -> String {
    match field {
        Some(Field::Number(value)) => value.to_string(),
        Some(Field::Count(count)) => count.to_string(),
        Some(Field::Word(word)) => word.clone(),
        None => String::new(),
    }
}

/// Lines as CSV.
///
/// # Panics
/// Never: rows of one length are written into memory.
fn text<Line>(lines: impl IntoIterator<Item = Line>) -> String
where
    Line: IntoIterator<Item: AsRef<[u8]>>,
{
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    for line in lines {
        writer.write_record(line).expect("rows of one length");
    }
    let bytes = writer.into_inner().expect("written into memory");
    String::from_utf8(bytes).expect("made of texts")
}
