//! An answer as a table for a terminal.

use super::cells::{NONE, cell, shown, unit};
use super::lines;
use crate::quantity::{Answer, Group, Layout, Quantity, UnitSystem, Value};
use std::iter;

/// Columns beside each other, and their smallest width: with labels and units they take 100 characters.
const COLUMNS: usize = 5;
const WIDTH: usize = 12;

/// What all columns beside each other take at most, and a single one.
const BESIDE: usize = 66;
const WIDEST: usize = 28;

/// Least width of the labels.
const LABEL: usize = 26;

/// Of more rows than these about this many are shown.
const ROWS: usize = 26;

/// An answer on lines of at most 100 columns, in the units of a system.
///
/// Numbers have at most the digits of their quantity, and none below their error.
pub fn table(answer: &Answer, units: UnitSystem) -> String {
    let remarks = answer.remarks.iter();
    let remarks = remarks.map(|remark| lines::wrapped("WARNING: ", remark));
    let groups = answer.groups.iter().flat_map(|group| blocks(group, units));
    let blocks = iter::once(answer.heading.clone()).chain(remarks);
    lines::text(blocks.chain(groups).chain([answer.notes.clone()]))
}

/// The blocks of a group: its subjects as columns, a few at a time, or as rows.
fn blocks(group: &Group, units: UnitSystem) -> Vec<Vec<String>> {
    let subjects: Vec<_> = group.subjects.iter().map(shown).collect();
    match group.layout {
        Layout::Single => {
            let lines = subjects.iter().flat_map(|(_, quantities)| quantities);
            let lines = lines.map(|quantity| {
                let cell = cell(quantity, units);
                line(
                    &quantity.label,
                    &[cell],
                    [LABEL, WIDEST],
                    unit(quantity, units),
                )
            });
            vec![lines.collect()]
        }
        Layout::Columns | Layout::Beside | Layout::Named => {
            let beside = subjects.chunks(COLUMNS);
            beside.map(|subjects| columns(subjects, units)).collect()
        }
        Layout::Rows => vec![rows(&subjects, units)],
    }
}

/// Subjects beside each other. What none of them has is left out.
fn columns(subjects: &[(&str, Vec<Quantity>)], units: UnitSystem) -> Vec<String> {
    let labels = subjects.iter().flat_map(|(_, quantities)| quantities);
    let longest = labels.map(|quantity| quantity.label.chars().count()).max();
    let label = LABEL.max(longest.map_or(0, |longest| longest + 1));
    let widths = [label, (BESIDE / subjects.len()).clamp(WIDTH, WIDEST)];
    let heads: Vec<_> = subjects
        .iter()
        .map(|(head, _)| (*head).to_owned())
        .collect();
    let first = subjects.first().into_iter().flat_map(|(_, first)| first);
    let mut lines: Vec<_> = first
        .enumerate()
        .filter_map(|(place, quantity)| {
            let of_all = subjects.iter().map(|(_, quantities)| &quantities[place]);
            let cells: Vec<_> = of_all.map(|quantity| cell(quantity, units)).collect();
            let is_known = cells.iter().any(|cell| cell != NONE);
            is_known.then(|| line(&quantity.label, &cells, widths, unit(quantity, units)))
        })
        .collect();
    if !lines.is_empty() && heads.iter().any(|head| !head.is_empty()) {
        lines.insert(0, line("", &heads, widths, ""));
    }
    lines
}

/// A label and cells of given widths, and a unit.
fn line(text: &str, cells: &[String], [label, width]: [usize; 2], unit: &str) -> String {
    let cells = cells
        .iter()
        .map(|cell| format!("{:>width$}", short(cell, width)));
    format!("{text:<label$}{}  {unit}", cells.collect::<String>())
}

/// Subjects below each other, under the labels and units of their quantities.
fn rows(subjects: &[(&str, Vec<Quantity>)], units: UnitSystem) -> Vec<String> {
    let stride = subjects.len().div_ceil(ROWS).max(1);
    let last = subjects.len().saturating_sub(1);
    let kept = subjects
        .iter()
        .enumerate()
        .filter(|(place, (head, _))| place % stride == 0 || *place == last || !head.is_empty());
    let kept: Vec<_> = kept.map(|(_, (_, quantities))| quantities).collect();
    let Some(first) = kept.first().filter(|first| !first.is_empty()) else {
        return Vec::new();
    };
    let columns: Vec<_> = (0..first.len())
        .map(|place| Column::of(kept.iter().map(|row| &row[place]), units))
        .collect();
    let height = columns.iter().map(|column| column.head.len()).max();
    let height = height.unwrap_or(0);
    let together: usize = columns.iter().map(|column| column.width).sum();
    let gap = if together + 2 * columns.len() <= lines::WIDTH {
        "  "
    } else {
        " "
    };
    let head = (0..height).map(|row| {
        let cells = columns.iter().map(|column| {
            let place = (row + column.head.len()).checked_sub(height);
            column.aligned(place.map_or("", |place| &column.head[place]))
        });
        cells.collect::<Vec<_>>().join(gap)
    });
    let rows = (0..kept.len()).map(|row| {
        let cells = columns
            .iter()
            .map(|column| column.aligned(&column.cells[row]));
        cells.collect::<Vec<_>>().join(gap)
    });
    // Only where there are any.
    let units = columns.iter().map(|column| column.aligned(column.unit));
    let units = units.collect::<Vec<_>>().join(gap);
    let units = (!units.trim().is_empty()).then_some(units);
    head.chain(units).chain(rows).collect()
}

/// A quantity of all rows.
struct Column {
    /// Its label on lines.
    head: Vec<String>,
    unit: &'static str,
    cells: Vec<String>,
    width: usize,
    is_word: bool,
}

impl Column {
    fn of<'a>(quantities: impl Iterator<Item = &'a Quantity> + Clone, units: UnitSystem) -> Self {
        let first = quantities.clone().next();
        let is_word = quantities.clone().any(|quantity| match &quantity.value {
            Value::Word(Some(word)) => word.starts_with(char::is_alphabetic),
            _ => false,
        });
        let cells: Vec<_> = quantities.map(|quantity| cell(quantity, units)).collect();
        let length = |text: &String| text.chars().count();
        let widest = cells.iter().map(length).max().unwrap_or(0);
        let head = first.map_or_else(Vec::new, |quantity| {
            let words = quantity.label.split(' ');
            let longest = words
                .map(|word| word.chars().count())
                .fold(widest, usize::max);
            lines::folded(&quantity.label, longest, 0)
        });
        let unit = first.map_or("", |quantity| unit(quantity, units));
        let width = head.iter().map(length).fold(widest, usize::max);
        let width = width.max(unit.chars().count());
        Self {
            head,
            unit,
            cells,
            width,
            is_word,
        }
    }

    /// A text in the column: words to the left; numbers, also those that are texts, to the right.
    fn aligned(&self, text: &str) -> String {
        let width = self.width;
        match self.is_word {
            true => format!("{text:<width$}"),
            false => format!("{text:>width$}"),
        }
    }
}

/// A text that fits a column and leaves a space before it.
fn short(text: &str, width: usize) -> String {
    match text.chars().count() < width {
        true => text.to_owned(),
        false => text.chars().take(width - 2).chain(['…']).collect(),
    }
}
