//! Roots of equations, to the last digits of a double: of one within a bracket, of several near a place.

use nalgebra::{SMatrix, SVector};

/// The root of a continuous function between two places at which it has these values; `None` if their
/// signs are equal or a value is not a number.
pub(crate) fn bracketed(
    function: impl FnMut(f64) -> f64,
    ends: [f64; 2],
    values: [f64; 2],
) -> Option<f64> {
    bracketed_to(0.0, function, ends, values)
}

/// The same to an accuracy, of a function whose values have errors.
pub(crate) fn bracketed_to(
    accuracy: f64,
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
    continuation::root(number, (one, at_one), (other, at_other), accuracy).ok()
}

/// Most steps of [`near`]: functions that are almost straight take three to five.
const STEPS: usize = 12;

/// Each step of [`near`] has to be longer than the next one with the same derivatives by this factor at least; else
/// a bracket is safer.
const CONTRACTION: f64 = 2.0;

/// A first step with estimated derivatives is the last one if it is below `within` times this: its error is about
/// the step times that of the estimate, not times the step before.
const ESTIMATED: f64 = 1e-4;

/// Functions at a place.
pub(crate) struct Local<const N: usize> {
    pub(crate) values: [f64; N],
    /// About the inverse of their derivatives; `None` if steps say more of it.
    pub(crate) inverse: Option<SMatrix<f64, N, N>>,
}

/// The root of functions near a place by Broyden's method (C. G. Broyden, Math. Comp. 19 (1965) 577-593): the secant
/// method if there is one. Steps are measured with `within`, and the last one is below it in each unknown, with an
/// error far below that. `None` if the root is not found at once within a range.
pub(crate) fn near<const N: usize>(
    mut functions: impl FnMut([f64; N]) -> Option<Local<N>>,
    start: [f64; N],
    [from, to]: [[f64; N]; 2],
    within: [f64; N],
) -> Option<[f64; N]> {
    let within = SVector::from(within);
    let Local { values, inverse } = functions(start)?;
    let mut inverse = inverse?;
    let mut place = SVector::from(start);
    let mut step = -(inverse * SVector::from(values));
    let mut last = ESTIMATED;
    for _ in 0..STEPS {
        place += step;
        // Not a number included.
        let is_inside = (0..N).all(|index| from[index] < place[index] && place[index] < to[index]);
        if !is_inside {
            return None;
        }
        let scaled = step.component_div(&within);
        if scaled.amax() <= last {
            return Some(place.into());
        }
        last = 1.0;
        let found = functions(place.into())?;
        let values = SVector::from(found.values);
        let simplified = -(inverse * values);
        let next = simplified.component_div(&within);
        // Rounding errors may be all that is left to step over.
        if scaled.amax() <= 1.0 && next.amax() <= 1.0 {
            return Some(place.into());
        }
        let is_contracting = CONTRACTION * next.norm() < scaled.norm();
        if !is_contracting {
            return None;
        }
        if let Some(estimated) = found.inverse {
            inverse = estimated;
            step = -(inverse * values);
            continue;
        }
        let square = scaled.norm_squared();
        step = simplified / (1.0 - scaled.dot(&next) / square);
        let along = scaled.component_div(&within).transpose() * inverse;
        inverse += step * along / square;
    }
    None
}

/// As [`near`], of one function with about its slope.
pub(crate) fn near_with_slope(
    mut function: impl FnMut(f64) -> Option<f64>,
    start: f64,
    slope: f64,
    range: [f64; 2],
    within: f64,
) -> Option<f64> {
    let mut inverse = Some(SMatrix::from([[slope.recip()]]));
    let local = |[place]: [f64; 1]| {
        let values = [function(place)?];
        let inverse = inverse.take();
        Some(Local { values, inverse })
    };
    let [root] = near(local, [start], range.map(|end| [end]), [within])?;
    Some(root)
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
    fn errors_of_values_are_not_searched_for_roots() {
        let mut count = 0;
        let wrong = |x: f64| {
            count += 1;
            x.exp() - 3.0 + if count % 2 == 0 { 1e-6 } else { -1e-6 }
        };
        let root = bracketed_to(1e-6, wrong, [0.0, 2.0], [-2.0, 4.4]);
        assert!((root.unwrap() - 3.0_f64.ln()).abs() < 2e-6);
        assert!(count <= 12, "{count}");
    }

    #[test]
    fn the_secant_method_stays_within_its_range() {
        let root = |start: f64, slope: f64, to: f64| {
            near_with_slope(|x| Some(x.exp() - 3.0), start, slope, [0.0, to], 1e-9)
        };
        assert!((root(1.0, 2.5, 2.0).unwrap() - 3.0_f64.ln()).abs() < 4e-16);
        assert!(root(1.0, 2.5, 1.05).is_none());
        assert!(root(1.0, -2.5, 2.0).is_none());
        for value in [None, Some(f64::NAN), Some(0.3)] {
            assert!(near_with_slope(|_| value, 1.0, -1.0, [0.0, 2.0], 1e-9).is_none());
        }
    }

    #[test]
    fn two_equations_are_solved_together() {
        // A circle and a line, with derivatives that are off by a tenth, in units far apart.
        let mut count = 0;
        let functions = |[x, y]: [f64; 2]| {
            count += 1;
            let derivatives = SMatrix::<f64, 2, 2>::from([[5.4, 1.1], [9000.0, -700.0]]);
            Some(Local {
                values: [x * x + 1e6 * y * y - 25.0, x - 750.0 * y],
                inverse: (count == 1).then(|| derivatives.try_inverse().unwrap()),
            })
        };
        let range = [[0.0, 0.0], [10.0, 1.0]];
        let [x, y] = near(functions, [3.1, 4.1e-3], range, [1e-9, 1e-12]).unwrap();
        assert!(
            (x - 3.0).abs() < 1e-14 && (y - 4e-3).abs() < 1e-17,
            "{x} {y}"
        );
        assert!(count < 8, "{count}");
    }
}
