//! A root of a function of one variable between two signs.

/// The most evaluations; bisection alone needs as many as there are bits.
const EVALUATIONS: usize = 100;

/// Finds x between two points (x, f(x)) of different sign with f(x) = 0, to `tolerance` or to rounding,
/// by inverse quadratic interpolation where that is safe and bisection elsewhere. T. R. Chandrupatla,
/// "A new hybrid quadratic/bisection algorithm for finding the zero of a nonlinear function without
/// using derivatives", Adv. Eng. Softw. 28 (1997) 145-149. It ends when the interpolation moves no
/// further than that, which spares the evaluation that closes the bracket.
///
/// ```
/// let f = |x: f64| Ok::<f64, ()>(x.exp() - 3.0);
/// let x = continuation::root(f, (0.0, -2.0), (2.0, 2_f64.exp() - 3.0), 0.0).unwrap();
/// assert!((x - 3_f64.ln()).abs() < 1e-15);
/// ```
///
/// # Errors
/// Those of the function.
pub fn root<E>(
    mut f: impl FnMut(f64) -> Result<f64, E>,
    (mut b, mut fb): (f64, f64),
    (mut a, mut fa): (f64, f64),
    tolerance: f64,
) -> Result<f64, E> {
    // The first place is that of linear interpolation, but not too close to an end.
    let mut t = (fa / (fa - fb)).clamp(0.1, 0.9);
    let mut interpolated = false;
    for _ in 0..EVALUATIONS {
        let best = if fa.abs() < fb.abs() { a } else { b };
        let width = (b - a).abs();
        let resolved = 0.5 * tolerance + 2.0 * f64::EPSILON * best.abs();
        if width <= 2.0 * resolved || fa == 0.0 || fb == 0.0 {
            return Ok(best);
        }
        if interpolated && t.abs() * width <= resolved {
            return Ok(a);
        }
        let x = a + t.clamp(resolved / width, 1.0 - resolved / width) * (b - a);
        let fx = f(x)?;
        let (c, fc);
        if (fx > 0.0) == (fa > 0.0) {
            (c, fc) = (a, fa);
        } else {
            (c, fc) = (b, fb);
            (b, fb) = (a, fa);
        }
        (a, fa) = (x, fx);
        // Interpolation is monotone, hence safe, under this condition.
        let (xi, phi) = ((a - b) / (c - b), (fa - fb) / (fc - fb));
        interpolated = phi * phi < xi && (1.0 - phi).powi(2) < 1.0 - xi;
        t = if interpolated {
            fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        } else {
            0.5
        };
    }
    Ok(if fa.abs() < fb.abs() { a } else { b })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solve(f: impl Fn(f64) -> f64, low: f64, high: f64) -> (f64, usize) {
        let mut count = 0;
        let counted = |x: f64| -> Result<f64, ()> {
            count += 1;
            Ok(f(x))
        };
        let found = root(counted, (low, f(low)), (high, f(high)), 0.0).unwrap();
        (found, count)
    }

    #[test]
    fn roots_are_found_to_rounding_in_few_evaluations() {
        let (x, count) = solve(|x| x * x - 2.0, 0.0, 2.0);
        assert!(
            (x - 2f64.sqrt()).abs() < 4.0 * f64::EPSILON && count < 12,
            "{x} {count}"
        );
        let (x, count) = solve(f64::sin, 3.0, 3.3);
        assert!(
            (x - std::f64::consts::PI).abs() < 1e-15 && count < 6,
            "{x} {count}"
        );
        let (x, count) = solve(|x| (x - 0.3).powi(3), -1.0, 1.0);
        assert!((x - 0.3).abs() < 1e-5 && count < 70, "{x} {count}");
        let (x, _) = solve(|x| if x < 0.7 { -1.0 } else { 1.0 }, 0.0, 1.0);
        assert!((x - 0.7).abs() < 1e-15);
    }

    #[test]
    fn a_root_at_an_end_is_returned() {
        assert_eq!(solve(|x| x, 0.0, 1.0), (0.0, 0));
    }
}
