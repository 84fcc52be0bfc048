//! Quantities: a number and, unless it is in SI units, its unit.
//!
//! `"120 kN"`, `"18deg"`, `"8.1e6 N/m²"`, `"1620/m"`, `"0.4"`.

use super::{dimension::Dimension, unit};
use std::ops::Range;

/// A quantity in SI units.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Quantity {
    /// The number in SI units; finite.
    pub(super) value: f64,
    /// The dimension of its unit and where in the text the unit stands; `None` for a bare number,
    /// which fits any dimension.
    pub(super) unit: Option<(Dimension, Range<usize>)>,
}

/// Why a text is no quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// It does not begin with a number.
    Number,
    /// The number is infinite, not a number, or beyond the range of double precision.
    NotFinite,
    /// What follows the number is no unit.
    Unit,
}

/// Reads a quantity; the error says which part of the text is at fault.
pub(super) fn parse(text: &str) -> Result<Quantity, (Fault, Range<usize>)> {
    let start = text.len() - text.trim_start().len();
    let whole = start..text.trim_end().len().max(start);
    let text = &text[whole.clone()];
    let (number, symbols) = text.split_at(number_length(text));
    let symbols = symbols.trim_start();
    let Ok(value) = number.parse::<f64>() else {
        let fault = match text.split_whitespace().next().map(str::parse::<f64>) {
            Some(Ok(_)) => Fault::NotFinite,
            _ => Fault::Number,
        };
        let range = match number.len() {
            0 => whole,
            length => start..start + length,
        };
        return Err((fault, range));
    };
    // A second number: a space between the digits, not a unit.
    if symbols.starts_with(|c: char| c.is_ascii_digit())
        && !symbols[1..].trim_start().starts_with('/')
    {
        return Err((Fault::Number, whole));
    }
    if symbols.is_empty() {
        return finite(value, None, whole);
    }
    let from = whole.end - symbols.len();
    let unit =
        unit::parse(symbols).map_err(|part| (Fault::Unit, from + part.start..from + part.end))?;
    finite(
        value * unit.scale,
        Some((unit.dimension, from..whole.end)),
        whole,
    )
}

fn finite(
    value: f64,
    unit: Option<(Dimension, Range<usize>)>,
    whole: Range<usize>,
) -> Result<Quantity, (Fault, Range<usize>)> {
    match value.is_finite() {
        true => Ok(Quantity { value, unit }),
        false => Err((Fault::NotFinite, whole)),
    }
}

/// Length of the leading part that is meant as a number: digits, signs, points and commas, and an
/// `e` that has an exponent.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let is_part = |i: usize| match bytes[i] {
        b'0'..=b'9' | b'.' | b',' | b'_' => true,
        b'+' | b'-' => i == 0 || matches!(bytes[i - 1], b'e' | b'E' | b'+' | b'-'),
        b'e' | b'E' => {
            let exponent = text[i + 1..].trim_start_matches(['+', '-']);
            i > 0 && exponent.starts_with(|c: char| c.is_ascii_digit())
        }
        _ => false,
    };
    (0..bytes.len())
        .find(|&i| !is_part(i))
        .unwrap_or(bytes.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_units_are_read() {
        let read = |text| {
            let quantity = parse(text)?;
            Ok::<_, (Fault, Range<usize>)>((
                quantity.value,
                quantity.unit.map(|(dimension, _)| dimension),
            ))
        };
        assert_eq!(read("120 kN"), Ok((120e3, Some(Dimension::FORCE))));
        assert_eq!(
            read(" 8.1e6N/m² "),
            Ok((8.1e6, Some(Dimension::FORCE_PER_AREA)))
        );
        assert_eq!(read("-1.5e-3 m"), Ok((-1.5e-3, Some(Dimension::LENGTH))));
        assert_eq!(
            read("1620 1/m"),
            Ok((1620.0, Some(Dimension::INVERSE_LENGTH)))
        );
        assert_eq!(
            read("1620/m"),
            Ok((1620.0, Some(Dimension::INVERSE_LENGTH)))
        );
        assert_eq!(read("0.4"), Ok((0.4, None)));
        let unit = parse(" 120 kN ").unwrap().unit;
        assert_eq!(unit, Some((Dimension::FORCE, 5..7)));
    }

    #[test]
    fn faults_are_pointed_at() {
        assert_eq!(parse("1,5 kN"), Err((Fault::Number, 0..3)));
        assert_eq!(parse("1.2.3 N"), Err((Fault::Number, 0..5)));
        assert_eq!(parse("1 000 N"), Err((Fault::Number, 0..7)));
        assert_eq!(parse("kN"), Err((Fault::Number, 0..2)));
        assert_eq!(parse(""), Err((Fault::Number, 0..0)));
        assert_eq!(parse("  "), Err((Fault::Number, 2..2)));
        assert_eq!(parse("--5 N"), Err((Fault::Number, 0..3)));
        assert_eq!(parse("inf N"), Err((Fault::NotFinite, 0..5)));
        assert_eq!(parse("nan"), Err((Fault::NotFinite, 0..3)));
        assert_eq!(parse("1e999 N"), Err((Fault::NotFinite, 0..7)));
        assert_eq!(parse("1e300 GN^9"), Err((Fault::NotFinite, 0..10)));
        assert_eq!(parse("5 kNn"), Err((Fault::Unit, 2..5)));
        assert_eq!(parse("5 N/xx"), Err((Fault::Unit, 4..6)));
    }
}
