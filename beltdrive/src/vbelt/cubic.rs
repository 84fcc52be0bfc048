//! The cubic between two points of a branch.

/// The lowest value between two points of the cubic with the values, rates and arclengths there,
/// if it is lower than at both; else infinity.
pub(super) fn lowest_between([a, da, s]: [f64; 3], [b, db, t]: [f64; 3]) -> f64 {
    let length = t - s;
    if !(da < 0.0 && db > 0.0 && length > 0.0) {
        return f64::INFINITY;
    }
    // a + a' u + c₂ u² + c₃ u³ with u from 0 to the length.
    let slope = (b - a) / length;
    let c3 = (da + db - 2.0 * slope) / (length * length);
    let c2 = (slope - da) / length - c3 * length;
    let root = (c2 * c2 - 3.0 * c3 * da).max(0.0).sqrt();
    let u = (-da / (c2 + root)).clamp(0.0, length);
    a + u * (da + u * (c2 + u * c3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_value_of_a_cubic_is_found() {
        let cubic = |u: f64| 1.0 - 2.0 * u + u.powi(3);
        let rate = |u: f64| -2.0 + 3.0 * u * u;
        let at = |u: f64| [cubic(u), rate(u), 5.0 + u];
        let lowest = cubic((2.0f64 / 3.0).sqrt());
        assert!((lowest_between(at(0.1), at(1.5)) - lowest).abs() < 1e-12);
        assert_eq!(lowest_between(at(0.1), at(0.5)), f64::INFINITY);
    }
}
