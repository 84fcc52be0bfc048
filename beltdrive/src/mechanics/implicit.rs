//! Roots in any scalar: found by the values of a function, and differentiated as what its equation makes of them.
//!
//! The root z of f(z, p) = 0 changes with p so that f does not: ∂f/∂z dz + ∂f/∂p dp = 0.

use super::root;
use bvp::{Dual, Real};

/// A scalar that may stand for the root of an equation.
pub(crate) trait Implicit: Real {
    /// The root of a function that is `root` by its value; `None` where the function has none.
    fn implicit(root: f64, function: impl FnMut(Self) -> Option<Self>) -> Option<Self>;
}

impl Implicit for f64 {
    fn implicit(root: f64, _: impl FnMut(Self) -> Option<Self>) -> Option<Self> {
        Some(root)
    }
}

impl Implicit for Dual<1> {
    /// The derivative of f is linear in that of z, so that a step of the secant method is the last one but for rounding,
    /// which a second one takes off.
    fn implicit(root: f64, mut function: impl FnMut(Self) -> Option<Self>) -> Option<Self> {
        let mut place = Self::constant(root);
        let at_constant = function(place)?.gradient[0];
        if at_constant == 0.0 {
            return Some(place);
        }
        place.gradient[0] = if root == 0.0 { 1.0 } else { root };
        for _ in 0..2 {
            let slope = (function(place)?.gradient[0] - at_constant) / place.gradient[0];
            place.gradient[0] = -at_constant / slope;
        }
        Some(place)
    }
}

/// As [`root::bracketed`].
pub(crate) fn bracketed<S: Implicit>(
    mut function: impl FnMut(S) -> S,
    ends: [S; 2],
    at_ends: [S; 2],
) -> Option<S> {
    let values = |place| function(S::from_f64(place)).value();
    let root = root::bracketed(values, ends.map(S::value), at_ends.map(S::value))?;
    S::implicit(root, |place| Some(function(place)))
}

/// As [`root::near_with_slope`].
pub(crate) fn near_with_slope<S: Implicit>(
    mut function: impl FnMut(S) -> Option<S>,
    start: S,
    slope: S,
    range: [f64; 2],
    within: f64,
) -> Option<S> {
    let values = |place| function(S::from_f64(place)).map(S::value);
    let root = root::near_with_slope(values, start.value(), slope.value(), range, within)?;
    S::implicit(root, function)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_changes_as_its_equation_says() {
        // z eᶻ = p at z = 1, in units far apart.
        for unit in [1e-9, 1.0, 1e9] {
            let p = Dual {
                value: 1_f64.exp(),
                gradient: [unit],
            };
            let function = |z: Dual<1>| z * z.exp() - p;
            let ends = [0.5, 2.0].map(Dual::constant);
            let within = bracketed(function, ends, ends.map(function)).unwrap();
            let slope = Dual::constant(5.0);
            let range = [0.5, 2.0];
            let start = Dual::constant(1.2);
            let near = near_with_slope(|z| Some(function(z)), start, slope, range, 1e-9).unwrap();
            for z in [within, near] {
                let known = unit / (2.0 * 1_f64.exp());
                assert!((z.value - 1.0).abs() < 1e-15);
                assert!((z.gradient[0] / known - 1.0).abs() < 1e-15);
            }
        }
        let constant = bracketed(|z: Dual<1>| z - 1.0, [0.0, 3.0].map(Dual::constant), {
            [-1.0, 2.0].map(Dual::constant)
        });
        assert_eq!(constant.unwrap().gradient, [0.0]);
    }
}
