//! How many digits of a number to show.

/// A value with the digits that an absolute error leaves, and no more than so many.
pub(crate) fn known(value: f64, error: f64, digits: f64) -> String {
    let known = (-error.log10()).floor();
    let power = value.abs().log10().floor();
    let decimals = known.min(digits - 1.0 - power);
    if value != 0.0 && value.abs() < SMALL && decimals > PLACES && decimals + power >= 0.0 {
        #[expect(clippy::cast_possible_truncation, reason = "below the digits")]
        let places = (decimals + power) as usize;
        format!("{value:.places$e}")
    } else {
        rounded(value, decimals)
    }
}

/// A smaller number that needs more decimals is shown as a power of ten.
const SMALL: f64 = 1e-3;
const PLACES: f64 = 9.0;

/// The value rounded to a number of decimals, or of tens when this is negative: `0` if no digit is left, whatever
/// its sign.
pub(crate) fn rounded(value: f64, decimals: f64) -> String {
    if !value.is_finite() {
        return "not known".to_owned();
    }
    #[expect(clippy::cast_possible_truncation, reason = "clamped to 0 … 9")]
    let places = decimals.clamp(0.0, PLACES) as usize;
    let unit = 10_f64.powf((-decimals).max(0.0));
    let value = if unit > 1.0 {
        (value / unit).round() * unit
    } else {
        value
    };
    let text = format!("{value:.places$}");
    if text.contains(|digit| matches!(digit, '1'..='9')) {
        text
    } else {
        "0".to_owned()
    }
}

/// A number from a drive file, at most six digits, none of them a trailing zero.
pub(crate) fn six_digits(value: f64) -> String {
    // A negative zero has no sign either.
    let value = format!("{value:.5e}").parse().unwrap_or(value) + 0.0;
    if (1e-3..1e6).contains(&value.abs()) || value == 0.0 {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shows_no_digit_beyond_the_error() {
        let value = 102.699_362;
        let errors = [1e-9, 1e-5, 1e-4, 1e-3, 1e-2, 0.1];
        let shown = errors.map(|error| known(value, error * value, 6.0));
        assert_eq!(shown, ["102.699", "102.70", "102.7", "103", "100", "100"]);
    }

    #[test]
    fn a_difference_carries_the_error_of_its_terms() {
        assert_eq!(known(0.123_456, 2e-5 * 100.0, 6.0), "0.12");
        assert_eq!(known(-1e-12, 1e-9 * 100.0, 6.0), "0");
    }

    #[test]
    fn an_absolute_error_leaves_its_digits() {
        assert_eq!(known(8_221.013_4, 0.004, 10.0), "8221.01");
        assert_eq!(known(8_221.013_4, 0.004, 5.0), "8221.0");
        assert_eq!(known(8_221.013_4, 2.0, 10.0), "8220");
    }

    #[test]
    fn unusual_values_have_a_display() {
        assert_eq!(known(0.0, 0.0, 6.0), "0");
        assert_eq!(known(1.5, f64::NAN, 6.0), "1.50000");
        assert_eq!(known(f64::NAN, 0.0, 6.0), "not known");
    }

    #[test]
    fn small_numbers_are_powers_of_ten() {
        let shown = [2.5e-4, -1.234_567_8e-7, 3.77e-26].map(|value| known(value, 0.0, 6.0));
        assert_eq!(shown, ["0.000250000", "-1.23457e-7", "3.77000e-26"]);
        assert_eq!(known(3.77e-26, 1e-27, 6.0), "3.8e-26");
        assert_eq!(known(3.77e-26, 1e-24, 6.0), "0");
    }

    #[test]
    fn given_numbers_stay_as_given() {
        let shown = [0.4, 1620.0, 8.1e6, 0.1 + 0.2, 0.0, -0.0, 2e-4].map(six_digits);
        assert_eq!(shown, ["0.4", "1620", "8.1e6", "0.3", "0", "0", "2e-4"]);
    }

    #[test]
    fn nothing_has_no_sign() {
        let shown = [-0.0, -4e-5, 4e-5, -6e-5].map(|value| rounded(value, 4.0));
        assert_eq!(shown, ["0", "0", "0", "-0.0001"]);
    }
}
