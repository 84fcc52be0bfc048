//! The characteristic function χ(σ), whose zeros are the eigenvalues.
//!
//! The solution that starts with f = 0, f' = 1 is carried through all zones; χ is what it leaves
//! of the outlet condition. The factors exp(a x) of all zones have no zeros and are left out.

use super::LinearisedForm;
use super::scaled::Scaled;
use super::transfer::Transfer;
use faer::c64;

/// Newton's method has converged where its relative step is below this,
const CONVERGED: f64 = 1e-14;
/// or below this and no longer falling: rounding.
const ROUNDING: f64 = 1e-11;
/// The most steps of Newton's method.
const STEPS: usize = 40;

/// χ and its derivative at a point, both without a positive factor that keeps them within bounds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Characteristic {
    /// χ.
    pub(super) value: c64,
    /// dχ/dσ.
    pub(super) slope: c64,
}

impl Scaled {
    /// χ and its derivative, exact but for rounding.
    pub(super) fn characteristic(&self, sigma: c64) -> Characteristic {
        self.characteristic_and_log(sigma).0
    }

    /// The same with the logarithm of the positive factor.
    fn characteristic_and_log(&self, sigma: c64) -> (Characteristic, f64) {
        let [zero, one] = [0.0, 1.0].map(|re| c64::new(re, 0.0));
        let (mut state, mut slope, mut log) = ([zero, one], [zero, zero], 0.0);
        for zone in &self.zones {
            let transfer = Transfer::new(&self.coefficients(zone, sigma), zone.length);
            slope = transfer.apply_slope(state, slope);
            state = transfer.apply(state);
            log += transfer.log;
        }
        let (value, slope) = match self.form {
            LinearisedForm::Thesis => (state[1], slope[1]),
            LinearisedForm::NaturalOutlet | LinearisedForm::Conservative => {
                let outlet = |state: [c64; 2]| state[1] * self.delta - sigma * state[0] * self.mach;
                (outlet(state), outlet(slope) - state[0] * self.mach)
            }
        };
        (Characteristic { value, slope }, log)
    }

    /// The zero of χ to which Newton's method converges; none where it does not.
    pub(super) fn root_near(&self, start: c64) -> Option<c64> {
        let (mut sigma, mut last) = (start, f64::INFINITY);
        for _ in 0..STEPS {
            let at = self.characteristic(sigma);
            let step = at.value / at.slope;
            sigma -= step;
            let relative = step.norm() / sigma.norm();
            if !relative.is_finite() {
                return None;
            }
            if relative < CONVERGED || relative < ROUNDING && relative >= 0.5 * last {
                return Some(sigma);
            }
            last = relative;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::AxialMotion;
    use super::super::examples::{FORMS, driven};
    use super::*;

    #[test]
    fn the_derivative_is_that_of_central_differences() {
        for form in FORMS {
            for elastic in [None, Some(1e5), Some(8.1e7), Some(1e10), Some(1e14)] {
                let motion = AxialMotion {
                    speed: 300.0,
                    elastic,
                    ..driven(800.0)
                };
                let scaled = Scaled::new(&motion, form);
                for sigma in [
                    (0.1, 0.2),
                    (-0.3, 2.0),
                    (0.5, 9.0),
                    (-4.0, 30.0),
                    (2.0, 0.0),
                ] {
                    let sigma = c64::new(sigma.0, sigma.1);
                    let (at, log) = scaled.characteristic_and_log(sigma);
                    let relative = |step: f64| {
                        let (moved, moved_log) = scaled.characteristic_and_log(sigma + step);
                        moved.value * (moved_log - log).exp()
                    };
                    let h = 1e-2;
                    let difference = ((relative(h) - relative(-h)) * 45.0
                        - (relative(2.0 * h) - relative(-2.0 * h)) * 9.0
                        + (relative(3.0 * h) - relative(-3.0 * h)))
                        / (60.0 * h);
                    let error = (difference - at.slope).norm();
                    // The logarithm of a large factor is rounded.
                    let size = at.slope.norm() + at.value.norm();
                    let tolerance = (1e-10 + 1e-13 * log) * size;
                    assert!(error < tolerance, "{form:?} {elastic:?} {sigma} {error:e}");
                }
            }
        }
    }

    #[test]
    fn newton_converges_from_afar() {
        let scaled = Scaled::new(&driven(800.0), LinearisedForm::Thesis);
        let root = scaled.root_near(c64::new(0.0, 18_000.0) / scaled.rate);
        let root = root.expect("convergence") * scaled.rate;
        assert!((root - c64::new(-128.17, 18_740.2)).norm() < 0.06, "{root}");
    }
}
