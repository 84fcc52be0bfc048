//! Numbers in messages.

use std::fmt;

/// A number in positional notation where that is short, else with an exponent: λ may be 1e-59.
pub(crate) struct Number(pub(crate) f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || (1e-4..1e7).contains(&size) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Number;

    #[test]
    fn extreme_numbers_have_an_exponent() {
        for (value, text) in [
            (0.0, "0"),
            (-0.25, "-0.25"),
            (1e-59, "1e-59"),
            (-3.5e300, "-3.5e300"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(Number(value).to_string(), text);
        }
    }
}
