//! Values of a traced entry in text, with the digits that are known.

use super::precision::{known, six_digits};
use crate::input::Key;

/// Most digits of a located value.
const DIGITS: f64 = 10.0;

/// A value of an entry in the unit of reports, without the unit.
pub(crate) fn number(key: Key, value: f64, error: Option<f64>) -> String {
    let value = key.reported(value);
    match error {
        Some(error) if error > 0.0 => known(value, key.reported(error), DIGITS),
        _ => six_digits(value),
    }
}

/// A value of an entry with its unit.
pub(crate) fn quantity(key: Key, value: f64, error: Option<f64>) -> String {
    with_unit(key, number(key, value, error))
}

fn with_unit(key: Key, number: String) -> String {
    match key.unit() {
        "" => number,
        "°" => number + "°",
        unit => format!("{number} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::samples::v_belt;

    #[test]
    fn values_have_unit_and_known_digits() {
        let drive = v_belt::loaded().drive;
        let find = |path| Key::all(&drive).find(|key| key.path() == path).unwrap();
        let tight = Key::load(&drive);
        assert_eq!(quantity(tight, 8_221.013_42, Some(0.004)), "8221.01 N");
        assert_eq!(quantity(tight, 700.0, None), "700 N");
        assert_eq!(quantity(tight, 700.0, Some(0.0)), "700 N");
        let coefficient = find("friction.coefficient");
        assert_eq!(quantity(coefficient, 0.4, None), "0.4");
        let angle = find("groove.half_angle");
        assert_eq!(quantity(angle, 18_f64.to_radians(), None), "18°");
    }
}
