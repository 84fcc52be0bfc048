//! Quantiles of 95 % intervals.

use crate::mechanics::root::bracketed;

/// The probability of an interval.
const PROBABILITY: f64 = 0.95;

/// Beyond 12.71, that of one degree of freedom, no quantile is.
const LARGEST: f64 = 13.0;

/// The 97.5 % quantile of the normal distribution.
pub(super) fn normal_quantile() -> f64 {
    1.959_963_984_540_054
}

/// The 97.5 % quantile of Student's distribution; not a number without degrees of freedom.
pub(super) fn student_quantile(degrees: usize) -> f64 {
    let excess = |t: f64| within(t, degrees) - PROBABILITY;
    let ends = [0.0, LARGEST];
    match degrees {
        0 => f64::NAN,
        _ => bracketed(excess, ends, ends.map(excess)).unwrap_or(f64::NAN),
    }
}

/// The probability that the magnitude of a variable of Student's distribution is below t (Abramowitz and Stegun,
/// Handbook of Mathematical Functions, 26.7.3 and 26.7.4).
fn within(t: f64, degrees: usize) -> f64 {
    let angle = (t / (degrees as f64).sqrt()).atan();
    let (sin, cos) = angle.sin_cos();
    let is_odd = degrees % 2 == 1;
    // Terms with the powers of the cosine from 0 or 1 on, up to that of ν − 2.
    let (mut term, first) = if is_odd { (cos, 2) } else { (1.0, 1) };
    let count = degrees / 2;
    let mut sum = 0.0;
    for index in 0..count {
        sum += term;
        let numerator = (2 * index + first) as f64;
        term *= numerator / (numerator + 1.0) * cos * cos;
    }
    match is_odd {
        true => std::f64::consts::FRAC_2_PI * (angle + sin * sum),
        false => sin * sum,
    }
}

/// The range in which S/(n − m) lies with a probability of 95 % for so many degrees of freedom, by the approximation
/// of Wilson and Hilferty (1931): to 1 % from ten degrees on, to a sixth at three.
pub(super) fn reduced_range(degrees: f64) -> [f64; 2] {
    let spread = 2.0 / (9.0 * degrees);
    [-1.0, 1.0].map(|side| {
        let root = 1.0 - spread + side * normal_quantile() * spread.sqrt();
        root.max(0.0).powi(3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        // Abramowitz and Stegun, table 26.10.
        for (degrees, known) in [
            (1, 12.706),
            (2, 4.303),
            (3, 3.182),
            (4, 2.776),
            (5, 2.571),
            (10, 2.228),
            (29, 2.045),
            (30, 2.042),
            (120, 1.980),
        ] {
            let found = student_quantile(degrees);
            assert!((found - known).abs() <= 5.1e-4, "{degrees}: {found}");
        }
        assert!((student_quantile(1_000_000) - normal_quantile()).abs() < 1e-5);
        assert!(student_quantile(0).is_nan());
    }

    #[test]
    fn sums_of_squares_lie_in_the_range_of_tables() {
        // Table 26.8: 2.5 % and 97.5 % points of chi square.
        for (degrees, low, high, within) in [
            (3.0, 0.216, 9.348, 0.17),
            (10.0, 3.247, 20.483, 0.01),
            (30.0, 16.791, 46.979, 0.01),
        ] {
            let found = reduced_range(degrees).map(|reduced| reduced * degrees);
            for (found, known) in found.into_iter().zip([low, high]) {
                assert!((found / known - 1.0).abs() < within, "{degrees}: {found}");
            }
        }
    }
}
