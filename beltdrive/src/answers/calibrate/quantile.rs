//! Quantiles of 95 % intervals.

use statrs::distribution::{ChiSquared, ContinuousCDF, Normal, StudentsT};

/// The probabilities below the ends of an interval.
const ENDS: [f64; 2] = [0.025, 0.975];

/// The 97.5 % quantile of the normal distribution.
pub(super) fn normal_quantile() -> f64 {
    Normal::standard().inverse_cdf(ENDS[1])
}

/// The 97.5 % quantile of Student's distribution; not a number without degrees of freedom.
pub(super) fn student_quantile(degrees: usize) -> f64 {
    StudentsT::new(0.0, 1.0, degrees as f64)
        .map_or(f64::NAN, |student| student.inverse_cdf(ENDS[1]))
}

/// The range in which S/(n − m) lies with a probability of 95 % for so many degrees of freedom; no numbers without.
pub(super) fn reduced_range(degrees: f64) -> [f64; 2] {
    ENDS.map(|end| {
        ChiSquared::new(degrees).map_or(f64::NAN, |squares| squares.inverse_cdf(end) / degrees)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        // Abramowitz and Stegun, Handbook of Mathematical Functions, table 26.10.
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
        assert!((normal_quantile() - 1.959_963_984_540_054).abs() < 1e-12);
        assert!((student_quantile(10_000) - normal_quantile()).abs() < 3e-4);
        assert!(student_quantile(0).is_nan());
    }

    #[test]
    fn sums_of_squares_lie_in_the_range_of_tables() {
        // Table 26.8: 2.5 % and 97.5 % points of chi square.
        for (degrees, low, high) in [
            (1.0, 0.000_982, 5.024),
            (3.0, 0.216, 9.348),
            (10.0, 3.247, 20.483),
            (30.0, 16.791, 46.979),
        ] {
            let found = reduced_range(degrees).map(|reduced| reduced * degrees);
            for (found, known) in found.into_iter().zip([low, high]) {
                assert!((found - known).abs() <= 5.1e-4, "{degrees}: {found}");
            }
        }
        assert!(reduced_range(0.0).iter().all(|end| end.is_nan()));
    }
}
