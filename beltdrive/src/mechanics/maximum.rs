//! The maximum of a function of one number.

/// Share of the larger part of the interval at which golden-section search looks next.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// Most steps: golden-section search alone takes 40 to 1e-8.
const STEPS: usize = 100;

/// The place of a maximum between two places, to a share of their distance, by the method of Brent (Algorithms for
/// Minimization without Derivatives, 1973, chapter 5): golden-section search, with parabolas where they help. A function
/// with one maximum there has it found; of several it is one of them, or an end.
///
/// A maximum is flat: its place is known no better than to the square root of rounding.
pub(crate) fn between(
    mut function: impl FnMut(f64) -> f64,
    [mut from, mut to]: [f64; 2],
    accuracy: f64,
) -> f64 {
    let within = accuracy * (to - from);
    let mut best = from + GOLDEN * (to - from);
    let (mut second, mut third) = (best, best);
    let mut at_best = function(best);
    let (mut at_second, mut at_third) = (at_best, at_best);
    let (mut step, mut before) = (0.0_f64, 0.0_f64);
    for _ in 0..STEPS {
        let middle = f64::midpoint(from, to);
        if (best - middle).abs() + 0.5 * (to - from) <= 2.0 * within {
            break;
        }
        let r = (best - second) * (at_third - at_best);
        let q = (best - third) * (at_second - at_best);
        let p = (best - third) * q - (best - second) * r;
        let q = 2.0 * (q - r);
        let parabolic = -p / q;
        let is_inside =
            from + 2.0 * within < best + parabolic && best + parabolic < to - 2.0 * within;
        let is_usable = parabolic.is_finite() && parabolic.abs() < 0.5 * before.abs() && is_inside;
        before = step;
        if is_usable {
            step = parabolic;
        } else {
            before = if best < middle {
                to - best
            } else {
                from - best
            };
            step = GOLDEN * before;
        }
        let next = match step.abs() < within {
            true => best + within.copysign(step),
            false => best + step,
        };
        let at_next = function(next);
        if at_next >= at_best {
            if next < best {
                to = best;
            } else {
                from = best;
            }
            (third, at_third) = (second, at_second);
            (second, at_second) = (best, at_best);
            (best, at_best) = (next, at_next);
        } else {
            if next < best {
                from = next;
            } else {
                to = next;
            }
            if at_next >= at_second || second == best {
                (third, at_third) = (second, at_second);
                (second, at_second) = (next, at_next);
            } else if at_next >= at_third || third == best || third == second {
                (third, at_third) = (next, at_next);
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_maxima_take_few_steps() {
        let mut count = 0;
        let power = |x: f64| {
            count += 1;
            x * (1.0 - x * x)
        };
        let place = between(power, [0.0, 1.0], 1e-7);
        assert!((place - 3_f64.sqrt().recip()).abs() < 2e-7, "{place}");
        assert!(count < 20, "{count}");
    }

    #[test]
    fn maxima_at_kinks_and_ends_are_found() {
        let kink = between(|x: f64| -(x - 0.3).abs(), [-1.0, 2.0], 1e-9);
        assert!((kink - 0.3).abs() < 1e-8, "{kink}");
        let end = between(|x: f64| x, [0.0, 5.0], 1e-9);
        assert!((end - 5.0).abs() < 2e-8, "{end}");
        let steep = between(|x: f64| if x < 1.7 { x } else { 0.0 }, [1.0, 2.0], 1e-9);
        assert!((steep - 1.7).abs() < 1e-8, "{steep}");
    }
}
