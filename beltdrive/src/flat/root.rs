//! Roots of scalar equations within a bracket.

/// Most evaluations: bisection alone needs fewer between two doubles of one sign.
const MAX_EVALUATIONS: usize = 200;

/// The root of a continuous function between two places at which its values have opposite signs, to
/// the last digits of a double; `None` if the signs are equal or a value is not a number.
///
/// First the secant, then inverse quadratic interpolation where the last three values make it safe, bisection elsewhere
/// (T. R. Chandrupatla, Advances in Engineering Software 28, 1997).
pub(super) fn bracketed(
    mut function: impl FnMut(f64) -> f64,
    [one, other]: [f64; 2],
    [at_one, at_other]: [f64; 2],
) -> Option<f64> {
    let (mut a, mut fa) = (other, at_other);
    let (mut b, mut fb) = (one, at_one);
    if fa.is_nan() || fb.is_nan() || fa * fb > 0.0 {
        return None;
    }
    // Most functions here are nearly straight.
    let mut t = (fa / (fa - fb)).clamp(0.01, 0.99);
    for _ in 0..MAX_EVALUATIONS {
        let x = a + t * (b - a);
        let fx = function(x);
        if fx.is_nan() {
            return None;
        }
        let (c, fc);
        if (fx > 0.0) == (fa > 0.0) {
            (c, fc) = (a, fa);
        } else {
            (c, fc) = (b, fb);
            (b, fb) = (a, fa);
        }
        (a, fa) = (x, fx);
        let best = if fa.abs() < fb.abs() { a } else { b };
        let tolerance = f64::EPSILON * best.abs();
        let share = tolerance / (b - a).abs();
        if share > 0.5 || fa == 0.0 || fb == 0.0 || a == b {
            return Some(best);
        }
        let xi = (a - b) / (c - b);
        let phi = (fa - fb) / (fc - fb);
        let interpolates = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
        t = if interpolates {
            let step = fa / (fb - fa) * fc / (fb - fc)
                + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
            step.clamp(share, 1.0 - share)
        } else {
            0.5
        };
    }
    Some(if fa.abs() < fb.abs() { a } else { b })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_found_to_the_last_digits_in_few_evaluations() {
        let mut count = 0;
        let root = bracketed(
            |x: f64| {
                count += 1;
                x.exp() - 3.0
            },
            [0.0, 5.0],
            [-2.0, 5.0_f64.exp() - 3.0],
        );
        assert!((root.unwrap() - 3.0_f64.ln()).abs() < 3e-16);
        assert!(count < 15, "{count}");
    }

    #[test]
    fn steep_and_flat_functions_end() {
        let root = bracketed(|x: f64| (x - 0.3).powi(9), [0.0, 1.0], [-1.0, 1.0]);
        assert!((root.unwrap() - 0.3).abs() < 1e-3);
        let root = bracketed(
            |x| if x > 0.7 { 1e300 } else { -1e-300 },
            [0.0, 1.0],
            [-1.0, 1.0],
        );
        assert!((root.unwrap() - 0.7).abs() < 1e-15);
    }

    #[test]
    fn equal_signs_have_no_root() {
        assert!(bracketed(|x| x, [1.0, 2.0], [1.0, 2.0]).is_none());
        assert!(bracketed(|x| x, [1.0, 2.0], [f64::NAN, 2.0]).is_none());
    }
}
