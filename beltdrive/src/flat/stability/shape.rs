//! The shape of a mode along the belt.

use super::scaled::Scaled;
use super::spectrum::check;
use super::transfer::Transfer;
use super::{AxialMotion, LinearisedForm, StabilityError};
use faer::c64;

/// The eigenfunction f at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sample {
    /// Place s from where the belt enters, m.
    pub(crate) s: f64,
    /// f, of which the largest is 1.
    pub(crate) value: c64,
    /// f', 1/m.
    pub(crate) derivative: c64,
}

/// The eigenfunction of the eigenvalue `value`, 1/s, at the places `at`, m, on the pulley, scaled
/// so that the largest sample is 1. It is zero where rigid friction holds the belt.
///
/// # Errors
/// [`StabilityError`] where the motion is no belt on a pulley.
pub(crate) fn mode_shape(
    motion: &AxialMotion,
    form: LinearisedForm,
    value: c64,
    at: &[f64],
) -> Result<Vec<Sample>, StabilityError> {
    check(motion)?;
    let scaled = Scaled::new(motion, form);
    let (fixed, unit) = (motion.fixed_end(), motion.length - motion.fixed_end());
    let sigma = value / scaled.rate;
    let states: Vec<_> = at
        .iter()
        .map(|s| scaled.state((s - fixed) / unit, sigma))
        .collect();
    // The logarithms bound what could overflow; only their differences count.
    let size = |state: &State| state.exponent.re + state.state[0].norm().ln();
    let largest = states.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
    let Some(&largest) = largest.filter(|state| size(state).is_finite()) else {
        let nothing = |&s: &f64| Sample {
            s,
            value: c64::ZERO,
            derivative: c64::ZERO,
        };
        return Ok(at.iter().map(nothing).collect());
    };
    let sample = |(&s, state): (&f64, &State)| {
        let factor = (state.exponent - largest.exponent).exp() / largest.state[0];
        Sample {
            s,
            value: state.state[0] * factor,
            derivative: state.state[1] * factor / unit,
        }
    };
    Ok(at.iter().zip(&states).map(sample).collect())
}

/// f and f' without the factor exp(`exponent`).
#[derive(Clone, Copy, Debug)]
struct State {
    state: [c64; 2],
    exponent: c64,
}

impl Scaled {
    /// The solution that starts with f = 0, f' = 1, at the scaled place x; zero before the start.
    fn state(&self, x: f64, sigma: c64) -> State {
        let mut here = State {
            state: [c64::ZERO, if x < 0.0 { c64::ZERO } else { c64::ONE }],
            exponent: c64::ZERO,
        };
        for (index, zone) in self.zones.iter().enumerate() {
            let last = index + 1 == self.zones.len();
            let way = if last {
                x - zone.start
            } else {
                zone.length.min(x - zone.start)
            };
            if way <= 0.0 {
                break;
            }
            let transfer = Transfer::new(&self.coefficients(zone, sigma), way);
            here.state = transfer.apply(here.state);
            here.exponent += transfer.drift + transfer.log;
        }
        here
    }
}

#[cfg(test)]
mod tests {
    use super::super::examples::{FORMS, driven};
    use super::super::spectrum;
    use super::*;

    /// The residuals of the differential equation relative to its terms, f' and f'' by central
    /// differences, and of the outlet condition.
    fn residuals(motion: &AxialMotion, form: LinearisedForm, lambda: c64) -> (f64, f64) {
        let h = 1e-4 * motion.length;
        let (m, v, d) = (
            motion.mass_per_length,
            motion.speed,
            motion.moving_stiffness(),
        );
        let mut places = vec![motion.length];
        let inside = (1..60).map(|i| f64::from(i) / 60.0 * motion.length);
        let slip_starts = motion.transition;
        let inside = inside.filter(|s| (s - slip_starts).abs() > 2.0 * h);
        let inside: Vec<f64> = inside.filter(|&s| s > motion.fixed_end()).collect();
        inside
            .iter()
            .for_each(|s| places.extend([s - h, *s, s + h]));
        let samples = mode_shape(motion, form, lambda, &places).expect("a belt");
        let mut worst: f64 = 0.0;
        for three in samples[1..].chunks_exact(3) {
            let [before, here, after] = [three[0], three[1], three[2]];
            let (f, df) = (here.value, (after.value - before.value) / (2.0 * h));
            let ddf = (after.derivative - before.derivative) / (2.0 * h);
            assert!((df - here.derivative).norm() < 1e-3 * (1.0 + lambda.norm() / 200.0));
            let slips = here.s > slip_starts;
            let (eta, k) = if slips {
                (motion.slip_rate, 0.0)
            } else {
                (0.0, motion.elastic.unwrap_or(0.0))
            };
            let inertia = lambda * lambda * f * m + lambda * df * (2.0 * m * v);
            let friction = match form {
                LinearisedForm::Thesis | LinearisedForm::NaturalOutlet => {
                    df * (motion.axial_stiffness * eta)
                }
                LinearisedForm::Conservative => (df * d - lambda * f * (m * v)) * eta,
            };
            let residual = inertia - ddf * d + f * k + friction;
            worst = worst.max(residual.norm() / (m * lambda.norm_sqr() + k));
        }
        let (f, df) = (samples[0].value, samples[0].derivative);
        let outlet = match form {
            LinearisedForm::Thesis => df * d,
            LinearisedForm::NaturalOutlet | LinearisedForm::Conservative => {
                df * d - lambda * f * (m * v)
            }
        };
        (
            worst,
            outlet.norm() / (d * lambda.norm() / motion.critical_speed()),
        )
    }

    #[test]
    fn shapes_satisfy_the_equations() {
        let belt = AxialMotion {
            speed: 200.0,
            ..driven(800.0)
        };
        for elastic in [None, Some(8.1e7), Some(1e10)] {
            let motion = AxialMotion { elastic, ..belt };
            for form in FORMS {
                for mode in spectrum(&motion, form, 4).expect("a spectrum").modes {
                    let (inside, outlet) = residuals(&motion, form, mode.value);
                    assert!(inside < 1e-4, "{form:?} {elastic:?} {mode:?} {inside:e}");
                    assert!(outlet < 1e-11, "{form:?} {elastic:?} {mode:?} {outlet:e}");
                }
            }
        }
    }

    #[test]
    fn shapes_are_held_at_the_start_and_have_size_one() {
        let places: Vec<f64> = (0..=100).map(|i| 0.01 * f64::from(i)).collect();
        for elastic in [None, Some(8.1e7), Some(1e14)] {
            let motion = AxialMotion {
                elastic,
                ..driven(800.0)
            };
            let places: Vec<f64> = places.iter().map(|s| s * motion.length).collect();
            let mode = spectrum(&motion, LinearisedForm::Thesis, 2)
                .expect("a spectrum")
                .modes[1];
            let shape =
                mode_shape(&motion, LinearisedForm::Thesis, mode.value, &places).expect("a belt");
            let largest = shape
                .iter()
                .map(|sample| sample.value.norm())
                .fold(0.0, f64::max);
            assert_eq!(shape[0].value, c64::ZERO);
            assert!((largest - 1.0).abs() < 1e-14);
            let one = shape
                .iter()
                .find(|sample| (sample.value - 1.0).norm() < 1e-14);
            assert!(one.is_some());
        }
    }
}
