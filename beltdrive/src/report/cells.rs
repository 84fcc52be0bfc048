//! What people read of quantities: heads, numbers to the digits that are known, and units.

use crate::quantity::precision::known;
use crate::quantity::{self, Quantity, Subject, UnitSystem, Value};

/// Stands for a value that there is not.
pub(super) const NONE: &str = "–";

/// The head of a subject and its quantities with a label.
pub(super) fn shown(subject: &Subject) -> (&str, Vec<Quantity>) {
    let mut quantities = quantity::flat(&subject.quantities);
    quantities.retain(|quantity| !quantity.label.is_empty());
    (&subject.head, quantities)
}

/// A value as a cell.
pub(super) fn cell(quantity: &Quantity, units: UnitSystem) -> String {
    let factor = quantity.measure.shown(units).factor;
    match &quantity.value {
        Value::Number(Some(value)) => minus(&number(value * factor, quantity, factor)),
        Value::Count(count) => count.to_string(),
        Value::Word(Some(word)) => word.clone(),
        _ => NONE.to_owned(),
    }
}

/// A number in the unit that is a factor from SI.
fn number(value: f64, quantity: &Quantity, factor: f64) -> String {
    let digits = quantity.digits;
    match digits {
        0..=2 if value == 0.0 => "0".to_owned(),
        0..=2 => format!("{value:.*e}", usize::from(digits.saturating_sub(1))),
        _ => known(value, quantity.error * factor.abs(), digits.into()),
    }
}

/// A number with a minus sign in place of the hyphen.
fn minus(number: &str) -> String {
    number.replace('-', "−")
}

/// The symbol of its unit.
pub(super) fn unit(quantity: &Quantity, units: UnitSystem) -> &'static str {
    quantity.measure.shown(units).symbol
}
