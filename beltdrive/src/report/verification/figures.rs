//! The numbers of a comparison as text.

use crate::report::six_digits;
use crate::verify::Comparison;

/// What stands in place of a number that there is not.
const NONE: &str = "–";

/// The computed number.
pub(super) fn computed(comparison: &Comparison) -> String {
    comparison
        .computed
        .as_ref()
        .map_or_else(|_| NONE.to_owned(), |number| six_digits(*number))
}

/// Computed less published, to two digits.
pub(super) fn deviation(comparison: &Comparison) -> String {
    signed(comparison.deviation(), |deviation| {
        let sign = if deviation < 0.0 { '-' } else { '+' };
        let rounded = format!("{:.1e}", deviation.abs()).parse();
        format!("{sign}{}", six_digits(rounded.unwrap_or(deviation.abs())))
    })
}

/// The relative deviation in per cent.
pub(super) fn relative(comparison: &Comparison) -> String {
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
        assert_eq!(texts(row("0", Ok(-1e-9))), ["-1e-9", "-1e-9", "–"]);
        assert_eq!(texts(row("1", Err(String::new()))), ["–"; 3]);
    }
}
