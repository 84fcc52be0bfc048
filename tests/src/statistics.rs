//! Summaries of a list of numbers.

/// The smallest of the values that at least the share `q` of them does not exceed; NaN of none.
///
/// `q` = 0 gives the least, 1 the largest value. A value that is not a number counts as the largest.
pub fn quantile(values: &[f64], q: f64) -> f64 {
    let mut sorted = values.to_vec();
    // Not f64::total_cmp alone: the sign of a NaN is arbitrary.
    sorted.sort_by(|a, b| a.is_nan().cmp(&b.is_nan()).then(a.total_cmp(b)));
    let below = (1..=sorted.len()).find(|&count| count as f64 >= q * sorted.len() as f64);
    below.map_or(f64::NAN, |count| sorted[count - 1])
}

/// exp of the mean logarithm; NaN of none.
pub fn geometric_mean(values: &[f64]) -> f64 {
    let logarithms: f64 = values.iter().map(|v| v.ln()).sum();
    (logarithms / values.len() as f64).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_values_of_the_list() {
        let values = [4.0, 1.0, 3.0, 2.0, 5.0];
        assert_eq!(quantile(&values, 0.0), 1.0);
        assert_eq!(quantile(&values, 0.5), 3.0);
        assert_eq!(quantile(&values, 0.9), 5.0);
        assert_eq!(quantile(&values, 1.0), 5.0);
        assert_eq!(quantile(&values[..2], 0.5), 1.0);
        assert!(quantile(&[], 0.5).is_nan());
    }

    #[test]
    fn not_a_number_is_the_largest() {
        let values = [1.0, -f64::NAN, 2.0];
        assert_eq!(quantile(&values, 0.5), 2.0);
        assert!(quantile(&values, 1.0).is_nan());
    }

    #[test]
    fn a_geometric_mean_is_that_of_the_reciprocals() {
        assert!((geometric_mean(&[2.0, 8.0]) - 4.0).abs() < 1e-15);
        assert!((geometric_mean(&[0.5, 0.125]) - 0.25).abs() < 1e-16);
        assert!(geometric_mean(&[]).is_nan());
    }
}
