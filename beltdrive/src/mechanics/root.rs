//! Roots of scalar equations within a bracket, to the last digits of a double.

/// The root of a continuous function between two places at which it has these values; `None` if their
/// signs are equal or a value is not a number.
pub(crate) fn bracketed(
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

/// Most steps of [`near`]: functions that are almost straight take three or four.
const STEPS: usize = 12;

/// Each step of [`near`] has to divide the value of the function by this at least; else a bracket is safer.
const CONTRACTION: f64 = 2.0;

/// A first step with an estimated slope is the last one if it is below `within` times this: its error is about
/// the step times that of the estimate, not times the step before.
pub(crate) const ESTIMATED: f64 = 1e-4;

/// The root near a place, with the value there and an estimate of the slope, by the secant method: the last
/// step is below `within`, and the error far below that. `None` if it is not found at once within a range.
pub(crate) fn near(
    function: impl FnMut(f64) -> f64,
    start: [f64; 2],
    slope: f64,
    range: [f64; 2],
    within: f64,
) -> Option<f64> {
    let within = [ESTIMATED * within, within];
    let [root, _] = near_with_slope(function, start, slope, range, within)?;
    Some(root)
}

/// As [`near`], with the last slope. The first step is the last one below the first number of `within`, which may
/// be the second if the slope is known.
pub(crate) fn near_with_slope(
    mut function: impl FnMut(f64) -> f64,
    [mut place, mut value]: [f64; 2],
    mut slope: f64,
    [from, to]: [f64; 2],
    [mut last, within]: [f64; 2],
) -> Option<[f64; 2]> {
    for _ in 0..STEPS {
        let step = match value == 0.0 {
            true => 0.0,
            false => -value / slope,
        };
        let next = place + step;
        // Not a number included.
        let is_inside = from < next && next < to;
        if !is_inside {
            return None;
        }
        if step.abs() <= last {
            return Some([next, slope]);
        }
        last = within;
        let found = function(next);
        let is_contracting = CONTRACTION * found.abs() < value.abs();
        if !is_contracting {
            return None;
        }
        slope = (found - value) / (next - place);
        (place, value) = (next, found);
    }
    None
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

    #[test]
    fn the_secant_method_stays_within_its_range() {
        let function = |x: f64| x.exp() - 3.0;
        let root = |start: f64, slope: f64, to: f64| {
            near(function, [start, function(start)], slope, [0.0, to], 1e-9)
        };
        assert!((root(1.0, 2.5, 2.0).unwrap() - 3.0_f64.ln()).abs() < 4e-16);
        assert!(root(1.0, 2.5, 1.05).is_none());
        assert!(root(1.0, -2.5, 2.0).is_none());
        assert!(near(|_| f64::NAN, [1.0, 0.3], -1.0, [0.0, 2.0], 1e-9).is_none());
        assert!(near(|_| 0.3, [1.0, 0.3], -1.0, [0.0, 2.0], 1e-9).is_none());
    }
}
