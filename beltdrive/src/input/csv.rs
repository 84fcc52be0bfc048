//! The parts of a CSV text: lines, fields, numbers.

use super::diagnostic::Finding;
use super::quantity::{self, Fault};
use std::ops::Range;

/// The lines of a text that hold something but comments, with their numbers from 1 and their places.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, Range<usize>)> {
    let mut start = 0;
    let lines = text.split_inclusive('\n').enumerate();
    lines.filter_map(move |(index, whole)| {
        let line = whole.trim_end_matches(['\n', '\r']);
        // The mark that spreadsheets put before the first line.
        let mark = match line.strip_prefix('\u{feff}') {
            Some(rest) => line.len() - rest.len(),
            None => 0,
        };
        let range = start + mark..start + line.len();
        let line = &line[mark..];
        start += whole.len();
        let is_blank = line.trim().is_empty() || line.trim_start().starts_with('#');
        (!is_blank).then_some((index + 1, range))
    })
}

/// The places of the fields of a line, without the blanks and quotes round them.
pub(super) fn fields(text: &str, line: Range<usize>) -> impl Iterator<Item = Range<usize>> {
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

/// The number of a field.
pub(super) fn number_of(field: &str, place: Range<usize>) -> Result<f64, Finding> {
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
