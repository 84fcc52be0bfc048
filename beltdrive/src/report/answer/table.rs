//! An answer as a table for a terminal.

use crate::quantity::precision::known;
use crate::quantity::{Answer, Group, Quantity, Subject, UnitSystem, Value};
use crate::report::lines::{self, single};

/// Most significant digits shown; fewer where the error does not leave them.
const DIGITS: f64 = 6.0;

/// Columns beside each other, and their width: with labels and units they take 100 characters.
const COLUMNS: usize = 5;
const WIDTH: usize = 12;

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
    if !group.is_list {
        let quantities = group
            .subjects
            .iter()
            .flat_map(|subject| &subject.quantities);
        let lines = quantities.filter_map(|quantity| {
            let text = cell(quantity, units)?;
            Some(single(quantity.label, text, unit(quantity, units)))
        });
        return vec![lines.collect()];
    }
    let beside = group.subjects.chunks(COLUMNS);
    beside.map(|subjects| block(subjects, units)).collect()
}

/// Subjects beside each other.
fn block(subjects: &[Subject], units: UnitSystem) -> Vec<String> {
    let heads = subjects.iter().map(|subject| short(&subject.head));
    let mut lines = vec![row("", heads, "")];
    let [first, ..] = subjects else {
        return Vec::new();
    };
    for (place, quantity) in first.quantities.iter().enumerate() {
        let of_all = subjects.iter().map(|subject| &subject.quantities[place]);
        let cells: Vec<_> = of_all.map(|quantity| cell(quantity, units)).collect();
        // What no subject has is left out.
        if cells
            .iter()
            .any(|cell| cell.as_ref().is_some_and(|cell| cell != NONE))
        {
            let cells = cells.into_iter().map(Option::unwrap_or_default);
            lines.push(row(quantity.label, cells, unit(quantity, units)));
        }
    }
    lines
}

fn row(label: &str, cells: impl Iterator<Item = String>, unit: &str) -> String {
    let cells: String = cells.map(|cell| format!("{cell:>WIDTH$}")).collect();
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
