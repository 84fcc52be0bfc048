//! Second derivatives of a system along a line.

/// A central difference for the second derivative: its step in the arclength norm, and (multiple of
/// the step, weight) of every pair of places.
pub(crate) struct Rule {
    step: f64,
    weights: &'static [(f64, f64)],
}

/// Of second order: accurate to about 1e-7, enough for Newton's method.
pub(crate) const ROUGH: Rule = Rule {
    step: 2e-4,
    weights: &[(1.0, 1.0)],
};
/// Of sixth order: accurate to about 1e-10.
pub(crate) const FINE: Rule = Rule {
    step: 5e-3,
    weights: &[(1.0, 1.5), (2.0, -0.15), (3.0, 1.0 / 90.0)],
};
/// Where a step leaves the domain of the system, one shorter by this may not.
const SHORTER: f64 = 0.02;

/// d²G/ds² at s = 0, where `residual` evaluates G at s.
pub(crate) fn bending(
    mut residual: impl FnMut(f64, &mut [f64]),
    equations: usize,
    rule: &Rule,
) -> Vec<f64> {
    let mut at = |s: f64| {
        let mut g = vec![f64::NAN; equations];
        residual(s, &mut g);
        g
    };
    let centre = at(0.0);
    let mut second = vec![f64::NAN; equations];
    for h in [rule.step, SHORTER * rule.step] {
        second.fill(0.0);
        for (multiple, weight) in rule.weights {
            let (ahead, behind) = (at(multiple * h), at(-multiple * h));
            for (i, second) in second.iter_mut().enumerate() {
                *second += weight * (ahead[i] - centre[i] + behind[i] - centre[i]) / (h * h);
            }
        }
        if second.iter().all(|g| g.is_finite()) {
            break;
        }
    }
    second
}

/// The mixed derivative ∂²G(a, b) from those along a + b, a and b.
pub(crate) fn mixed(both: &[f64], a: &[f64], b: &[f64]) -> Vec<f64> {
    let triples = both.iter().zip(a).zip(b);
    triples.map(|((both, a), b)| 0.5 * (both - a - b)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_derivatives_are_as_accurate_as_they_say() {
        let curve = |s: f64, g: &mut [f64]| g[0] = (2.0 * s).exp();
        assert!((bending(curve, 1, &ROUGH)[0] - 4.0).abs() < 4e-7);
        assert!((bending(curve, 1, &FINE)[0] - 4.0).abs() < 4e-10);
        // Defined for s > −1e-3 only.
        let edge = |s: f64, g: &mut [f64]| g[0] = (s + 1e-3).powf(2.5);
        let exact = 3.75 * 1e-3f64.sqrt();
        assert!((bending(edge, 1, &FINE)[0] / exact - 1.0).abs() < 1e-6);
    }
}
