//! A number as it is printed.

/// A number as it is printed, whose last digit says how much of it is meant to be known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Published {
    text: &'static str,
    place: i32,
}

impl Published {
    /// A number such as `2.34`, `380` or `2.8e7`. Every digit counts, also zeros at the end.
    pub const fn new(text: &'static str) -> Self {
        let bytes = text.as_bytes();
        let [mut decimals, mut exponent, mut sign] = [0, 0, 1];
        let [mut after_point, mut after_e] = [false; 2];
        let mut at = 0;
        while at < bytes.len() {
            match bytes[at] {
                b'.' => after_point = true,
                b'e' => after_e = true,
                b'-' if after_e => sign = -1,
                digit @ b'0'..=b'9' if after_e => exponent = 10 * exponent + (digit - b'0') as i32,
                b'0'..=b'9' if after_point => decimals += 1,
                _ => {}
            }
            at += 1;
        }
        Self {
            text,
            place: sign * exponent - decimals,
        }
    }

    /// A number whose last known digit is in the place 10^`place`, such as a bare `0` in a row of
    /// numbers with decimals.
    pub const fn with_place(text: &'static str, place: i32) -> Self {
        Self { text, place }
    }

    /// As it is printed.
    pub fn text(&self) -> &'static str {
        self.text
    }

    /// Its value; not a number if the text is none.
    pub fn value(&self) -> f64 {
        self.text.parse().unwrap_or(f64::NAN)
    }

    /// Half a unit of the last known digit.
    pub fn half_unit(&self) -> f64 {
        0.5 * 10_f64.powi(self.place)
    }

    /// Whether a number rounds to what is printed; either way if it lies between.
    pub fn agrees(&self, computed: f64) -> bool {
        let value = self.value();
        // Neither a printed number nor half a unit is exact in binary.
        let rounding = 4.0 * f64::EPSILON * value.abs();
        (computed - value).abs() <= self.half_unit() + rounding
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_digit_is_half_a_unit_wide() {
        for (text, value, half) in [
            ("2.34", 2.34, 0.005),
            ("380", 380.0, 0.5),
            ("7781.2", 7781.2, 0.05),
            ("2.8e7", 2.8e7, 5e5),
            ("2.5e-7", 2.5e-7, 5e-9),
            ("1.20", 1.2, 0.005),
        ] {
            let published = Published::new(text);
            assert_eq!(published.value(), value);
            assert!((published.half_unit() / half - 1.0).abs() < 1e-12, "{text}");
        }
        assert_eq!(Published::with_place("0", -2).half_unit(), 0.005);
    }

    #[test]
    fn numbers_agree_up_to_half_a_digit() {
        let published = Published::new("2.34");
        for agreeing in [2.335, 2.34, 2.3449, 2.345] {
            assert!(published.agrees(agreeing), "{agreeing}");
        }
        for differing in [2.3349, 2.3451, -2.34, f64::NAN, f64::INFINITY] {
            assert!(!published.agrees(differing), "{differing}");
        }
        assert!(!Published::new("none").agrees(0.0));
    }

    #[test]
    fn a_truncated_print_does_not_agree() {
        assert!(!Published::new("1.24").agrees(1.2472));
        assert!(!Published::new("194.8").agrees(194.8897));
    }
}
