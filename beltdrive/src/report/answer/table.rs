//! An answer as a table for a terminal.

use crate::quantity::precision::known;
use crate::quantity::{Answer, Group, Layout, Measure, Quantity, Subject, UnitSystem, Value};
use crate::report::lines::{self, single};

/// Most significant digits shown; fewer where the error does not leave them.
const DIGITS: f64 = 6.0;

/// Columns beside each other, and their width: with labels and units they take 100 characters.
const COLUMNS: usize = 5;
const WIDTH: usize = 12;

/// Width of two columns.
const WIDE: usize = 28;

/// Width of the labels.
const LABEL: usize = 26;

/// An answer on lines of at most 100 columns, in the units of a system.
///
/// Numbers have at most six significant digits, and none below their error.
pub fn table(answer: &Answer, units: UnitSystem) -> String {
    let remarks = answer.remarks.iter();
    let remarks = remarks.map(|remark| lines::wrapped("WARNING: ", remark));
    let groups = answer.groups.iter().flat_map(|group| blocks(group, units));
    let blocks = std::iter::once(answer.heading.clone()).chain(remarks);
    lines::text(blocks.chain(groups).chain([answer.notes.clone()]))
}

/// The blocks of a group: its subjects as columns, a few at a time.
fn blocks(group: &Group, units: UnitSystem) -> Vec<Vec<String>> {
    match group.layout {
        Layout::Single => {
            let subjects = group.subjects.iter();
            let quantities = subjects.flat_map(|subject| &subject.quantities);
            let lines = quantities.filter_map(|quantity| {
                let text = cell(quantity, units)?;
                Some(single(&quantity.label, text, unit(quantity, units)))
            });
            vec![lines.collect()]
        }
        Layout::Columns | Layout::Named => {
            let beside = group.subjects.chunks(COLUMNS);
            beside.map(|subjects| columns(subjects, units)).collect()
        }
        Layout::Rows => vec![rows(&group.subjects, units)],
    }
}

/// Subjects below each other, under the labels and units of their quantities.
fn rows(subjects: &[Subject], units: UnitSystem) -> Vec<String> {
    let line = |cells: Vec<String>| -> String {
        let cells = cells.into_iter().map(|cell| format!("{cell:>WIDTH$}"));
        cells.collect()
    };
    let Some(first) = subjects.first() else {
        return Vec::new();
    };
    let shown = || {
        let quantities = first.quantities.iter();
        quantities.filter(|quantity| cell(quantity, units).is_some())
    };
    let heads: Vec<_> = shown()
        .map(|quantity| lines::folded(&quantity.label, WIDTH - 1, 0))
        .collect();
    let height = heads.iter().map(Vec::len).max().unwrap_or(0);
    // The last lines stand above the units.
    let head = |row: usize| {
        let place = |head: &Vec<String>| (row + head.len()).checked_sub(height);
        let of = heads
            .iter()
            .map(|head| place(head).map_or("", |place| &head[place]));
        line(of.map(str::to_owned).collect())
    };
    let symbols = shown().map(|quantity| unit(quantity, units).to_owned());
    let symbols = line(symbols.collect());
    let rows = subjects.iter().map(|subject| {
        let quantities = subject.quantities.iter();
        let cells = quantities.filter_map(|quantity| cell(quantity, units));
        line(cells.collect())
    });
    (0..height).map(head).chain([symbols]).chain(rows).collect()
}

/// Subjects beside each other.
fn columns(subjects: &[Subject], units: UnitSystem) -> Vec<String> {
    let heads = subjects.iter().map(|subject| short(&subject.head));
    let mut lines = vec![row("", heads, "")];
    let [first, ..] = subjects else {
        return Vec::new();
    };
    let is_empty = |quantity: &Quantity| cell(quantity, units).is_none();
    if first.quantities.iter().all(is_empty) {
        return Vec::new();
    }
    for (place, quantity) in first.quantities.iter().enumerate() {
        let of_all = subjects.iter().map(|subject| &subject.quantities[place]);
        let cells: Vec<_> = of_all.map(|quantity| cell(quantity, units)).collect();
        // What no subject has is left out.
        if cells
            .iter()
            .any(|cell| cell.as_ref().is_some_and(|cell| cell != NONE))
        {
            let cells = cells.into_iter().map(Option::unwrap_or_default);
            lines.push(row(&quantity.label, cells, unit(quantity, units)));
        }
    }
    lines
}

fn row(label: &str, cells: impl Iterator<Item = String>, unit: &str) -> String {
    let cells: Vec<_> = cells.collect();
    // Two columns take the room of more.
    let width = if cells.len() == 2 { WIDE } else { WIDTH };
    let cells: String = cells.iter().map(|cell| format!("{cell:>width$}")).collect();
    format!("{label:<LABEL$}{cells}  {unit}")
}

/// Stands for a value that there is not.
const NONE: &str = "–";

/// A value as a cell; nothing for what only programs read.
fn cell(quantity: &Quantity, units: UnitSystem) -> Option<String> {
    let shown = quantity.measure.shown(units);
    if quantity.label.is_empty() {
        return None;
    }
    Some(match &quantity.value {
        Value::Number(Some(value)) if quantity.measure == Measure::Error => {
            minus(&lines::small(*value))
        }
        Value::Number(Some(value)) => {
            let error = quantity.error * shown.factor.abs();
            minus(&known(value * shown.factor, error, DIGITS))
        }
        Value::Word(Some(word)) => short(word),
        Value::Number(None) | Value::Word(None) => NONE.to_owned(),
        Value::Pair(_) | Value::Series(_) | Value::Indices(_) | Value::List(_) => return None,
    })
}

/// A number with a minus sign in place of the hyphen.
fn minus(number: &str) -> String {
    number.replace('-', "−")
}

fn unit(quantity: &Quantity, units: UnitSystem) -> &'static str {
    quantity.measure.shown(units).symbol
}

/// A word that fits a column.
fn short(word: &str) -> String {
    match word.chars().count() < WIDTH {
        true => word.to_owned(),
        false => word.chars().take(WIDTH - 2).chain(['…']).collect(),
    }
}
