//! Roots of scalar equations within a bracket, to the last digits of a double.

/// The root of a continuous function between two places at which it has these values; `None` if their
/// signs are equal or a value is not a number.
pub(super) fn bracketed(
    mut function: impl FnMut(f64) -> f64,
    [one, other]: [f64; 2],
    [at_one, at_other]: [f64; 2],
) -> Option<f64> {
    struct NotANumber;
    if at_one.is_nan() || at_other.is_nan() || at_one * at_other > 0.0 {
        return None;
    }
    let number = |place: f64| match function(place) {
        value if value.is_nan() => Err(NotANumber),
        value => Ok(value),
    };
    continuation::root(number, (one, at_one), (other, at_other), 0.0).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_need_a_bracket_and_numbers() {
        let root = bracketed(|x: f64| x.exp() - 3.0, [0.0, 2.0], [-2.0, 4.4]);
        assert!((root.unwrap() - 3.0_f64.ln()).abs() < 3e-16);
        assert!(bracketed(|x| x, [1.0, 2.0], [1.0, 2.0]).is_none());
        assert!(bracketed(|x| x, [1.0, 2.0], [f64::NAN, 2.0]).is_none());
        assert!(bracketed(|_| f64::NAN, [1.0, 2.0], [-1.0, 2.0]).is_none());
    }
}
