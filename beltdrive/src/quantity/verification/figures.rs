//! The numbers of a comparison as text.

use crate::quantity::precision::six_digits;
use crate::verify::Comparison;

/// What stands in place of a number that there is not.
const NONE: &str = "–";

/// A deviation that is a smaller share of the published number is one of rounding.
const ROUNDING: f64 = 1e-12;

/// The computed number, to six digits; beside a published zero, its magnitude.
pub(crate) fn computed(comparison: &Comparison) -> String {
    let text = |number: &f64| match comparison.published.value() == 0.0 && *number != 0.0 {
        true => format!("{number:.0e}"),
        false => six_digits(*number),
    };
    let computed = comparison.computed.as_ref();
    computed.map_or_else(|_| NONE.to_owned(), text)
}

/// Computed less published, to two digits.
pub(crate) fn deviation(comparison: &Comparison) -> String {
    let rounding = ROUNDING * comparison.published.value().abs();
    signed(comparison.deviation(), |deviation| {
        let two_digits = format!("{deviation:+.1e}");
        match deviation.abs() {
            size if size <= rounding => "0".to_owned(),
            1e-3..1e4 => format!("{:+}", two_digits.parse().unwrap_or(deviation)),
            _ => two_digits,
        }
    })
}

/// The relative deviation in per cent.
pub(crate) fn relative(comparison: &Comparison) -> String {
    signed(comparison.relative_deviation(), |share| {
        format!("{:+.3} %", 100.0 * share)
    })
}

fn signed(number: Option<f64>, text: impl Fn(f64) -> String) -> String {
    number.map_or_else(|| NONE.to_owned(), text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::{Criterion, Published};

    #[test]
    fn numbers_as_text() {
        let row = |text, computed| {
            Comparison::new("", "", Published::new(text), Criterion::Digits, computed)
        };
        let texts = |row: Comparison| [computed(&row), deviation(&row), relative(&row)];
        let found = row("2.34", Ok(2.343_494_6));
        assert_eq!(texts(found), ["2.34349", "+0.0035", "+0.149 %"]);
        assert_eq!(texts(row("0", Ok(-1e-9))), ["-1e-9", "-1.0e-9", "–"]);
        assert_eq!(texts(row("2.8e7", Ok(2.768e7)))[1], "-3.2e5");
        assert_eq!(texts(row("1", Ok(1.0 + 1e-15)))[1..], ["0", "+0.000 %"]);
        assert_eq!(texts(row("1", Err(String::new()))), ["–"; 3]);
    }
}
