//! Values of a traced entry: in text with the digits that are known, in JSON under its own name.

use crate::input::Key;
use crate::quantity::precision::{known, six_digits};
use serde::{Serialize, Serializer};

/// Most digits of a located value.
const DIGITS: f64 = 10.0;

/// Digits of a value without an error in a column.
const CELL_DIGITS: f64 = 6.0;

/// A longer value in a column is shown as a power of ten.
const CELL: usize = 10;

/// A value of an entry in the unit of reports, without the unit.
pub(crate) fn number(key: Key, value: f64, error: Option<f64>) -> String {
    let value = key.reported(value);
    match error {
        Some(error) if error > 0.0 => known(value, key.reported(error), DIGITS),
        _ => six_digits(value),
    }
}

/// A value as [`number`] shows it, for a column: digits that are not known to be wrong stay, even
/// zeros.
pub(super) fn cell(key: Key, value: f64, error: Option<f64>) -> String {
    match error {
        Some(error) if error > 0.0 => number(key, value, Some(error)),
        _ => {
            let value = key.reported(value);
            let text = known(value, 0.0, CELL_DIGITS);
            match text.chars().count() {
                0..=CELL => text,
                _ => format!("{value:.5e}"),
            }
        }
    }
}

/// A value of an entry with its unit.
pub(crate) fn quantity(key: Key, value: f64, error: Option<f64>) -> String {
    with_unit(key, number(key, value, error))
}

/// The error of a value of an entry to one digit, without its unit.
pub(super) fn error(key: Key, error: f64) -> String {
    let error = key.reported(error);
    six_digits(format!("{error:.0e}").parse().unwrap_or(error))
}

/// An entry with its path and unit.
pub(crate) fn name(key: Key) -> String {
    match key.unit() {
        "" => key.name().to_owned(),
        unit => format!("{} in {unit}", key.name()),
    }
}

fn with_unit(key: Key, number: String) -> String {
    match key.unit() {
        "" => number,
        "°" => number + "°",
        unit => format!("{number} {unit}"),
    }
}

/// A value of an entry for JSON: a map with the column of the entry as its only key.
pub(super) struct Named(pub(super) Key, pub(super) f64);

impl Serialize for Named {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(key, value) = self;
        serializer.collect_map([(key.column(), key.reported(*value))])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    #[test]
    fn values_have_unit_and_known_digits() {
        let drive = sample::loaded().drive;
        let find = |path| Key::all(&drive).find(|key| key.path() == path).unwrap();
        let tight = Key::load(&drive);
        assert_eq!(quantity(tight, 8_221.013_42, Some(0.004)), "8221.01 N");
        assert_eq!(quantity(tight, 700.0, None), "700 N");
        assert_eq!(quantity(tight, 700.0, Some(0.0)), "700 N");
        assert_eq!(cell(tight, 700.0, None), "700.000");
        assert_eq!(cell(tight, 6_189_658_189.0, None), "6189660000");
        assert_eq!(cell(tight, 1e10, None), "1.00000e10");
        assert_eq!(error(tight, 0.004_3), "0.004");
        let coefficient = find("friction.coefficient");
        assert_eq!(quantity(coefficient, 0.4, None), "0.4");
        assert_eq!(name(coefficient), "coefficient of friction");
        let angle = find("groove.half_angle");
        assert_eq!(quantity(angle, 18_f64.to_radians(), None), "18°");
        assert_eq!(name(angle), "half groove angle in °");
    }
}
