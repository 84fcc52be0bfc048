//! The lowest modes, found twice and counted.

use super::scaled::Scaled;
use super::{AxialMotion, LinearisedForm};
use faer::c64;

/// Modes found beyond those asked for, to end the box in the widest of the gaps above them.
const BEYOND: usize = 3;
/// The largest relative difference of the two methods at which they agree.
const AGREEMENT: f64 = 1e-7;
/// Eigenvalues that differ by less than this, relatively, are one.
const SAME: f64 = 1e-12;

/// A mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mode {
    /// Eigenvalue λ, 1/s: its real part is the rate of growth, its imaginary part, which is not
    /// negative, the angular frequency. A complex one stands for itself and its conjugate.
    pub(crate) value: c64,
    /// Relative difference of the eigenvalue found by spectral elements.
    pub(crate) difference: f64,
}

/// The lowest modes of a belt on a pulley.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Spectrum {
    /// The modes in order of frequency.
    pub(crate) modes: Vec<Mode>,
    /// Number of eigenvalues in a box about zero, conjugates included, by the argument principle;
    /// equal to that of the modes found there.
    pub(crate) counted: usize,
    /// The box: |Re λ| and |Im λ| are below these, 1/s.
    pub(crate) within: [f64; 2],
    /// Index of the mode with the largest real part among `modes`.
    pub(crate) least_stable: usize,
}

/// Why there is no spectrum.
#[derive(Debug, PartialEq, thiserror::Error)]
pub(crate) enum StabilityError {
    /// The input makes no sense.
    #[error("axial motion: {0}")]
    Invalid(&'static str),
    /// The belt is not slower than its axial waves.
    #[error("belt speed {speed:.2} m/s is not below the critical speed {critical:.2} m/s")]
    Supercritical {
        /// Belt speed, m/s.
        speed: f64,
        /// Critical speed, m/s.
        critical: f64,
    },
    /// The modes are too short for spectral elements of tolerable size, or have no eigenvalues in
    /// finite arithmetic.
    #[error("the spectral elements do not resolve mode {0}")]
    Unresolved(usize),
    /// Newton's method did not converge.
    #[error("newton's method does not converge from {from:.6} 1/s to mode {number}")]
    NoConvergence {
        /// Number of the mode, from 1.
        number: usize,
        /// Where it started, 1/s.
        from: c64,
    },
    /// The methods do not agree.
    #[error(
        "mode {number}: {spectral:.6} 1/s by spectral elements, {exact:.6} 1/s by newton's method"
    )]
    Disagreement {
        /// Number of the mode, from 1.
        number: usize,
        /// Eigenvalue by spectral elements, 1/s.
        spectral: c64,
        /// Eigenvalue by Newton's method, 1/s.
        exact: c64,
    },
    /// Two modes are one.
    #[error("mode {number}, {value:.6} 1/s, is a mode found before")]
    Duplicate {
        /// Number of the second one, from 1.
        number: usize,
        /// Eigenvalue, 1/s.
        value: c64,
    },
    /// An eigenvalue lies on the border of the box.
    #[error("the eigenvalues within {re:.1} + {im:.1} i 1/s cannot be counted")]
    Uncountable {
        /// Bound of |Re λ|, 1/s.
        re: f64,
        /// Bound of |Im λ|, 1/s.
        im: f64,
    },
    /// Eigenvalues are missing.
    #[error("{found} eigenvalues found where there are {counted}")]
    Missing {
        /// Number of eigenvalues by the argument principle.
        counted: usize,
        /// Number of those found.
        found: usize,
    },
}

/// The first `count` modes of a motion.
///
/// An eigenvalue is as ill-conditioned as the tension changes much in the slip zone: rounding is
/// amplified by about exp(|η| EA `l_s`/D), which matters near the critical speed only. Where it
/// exceeds the tolerance, the methods disagree.
///
/// # Errors
/// [`StabilityError`]; every spectrum returned has passed all comparisons.
pub(crate) fn spectrum(
    motion: &AxialMotion,
    form: LinearisedForm,
    count: usize,
) -> Result<Spectrum, StabilityError> {
    check(motion)?;
    if count == 0 {
        return Err(StabilityError::Invalid("no modes are asked for"));
    }
    let scaled = Scaled::new(motion, form);
    let enough = count + BEYOND;
    let spectral = scaled.spectral_eigenvalues(enough).unwrap_or_default();
    if spectral.len() < enough {
        return Err(StabilityError::Unresolved(spectral.len() + 1));
    }
    let mut modes = polished(&scaled, &spectral[..enough])?;

    let inside = (count..enough)
        .max_by(|&i, &j| gap(&modes, i).total_cmp(&gap(&modes, j)))
        .unwrap_or(count);
    let im = 0.5 * (modes[inside - 1].value.im + modes[inside].value.im);
    let largest = modes.iter().map(|mode| mode.value.re.abs());
    let re = 2.0 * largest.fold(0.0, f64::max) + 3.0 * scaled.delta;
    let within = [re, im].map(|bound| bound * scaled.rate);
    let [re_bound, im_bound] = within;
    let counted = scaled
        .zeros_within(re, im)
        .ok_or(StabilityError::Uncountable {
            re: re_bound,
            im: im_bound,
        })?;
    let multiplicity = |mode: &Mode| if mode.value.im > 0.0 { 2 } else { 1 };
    let found = modes[..inside].iter().map(multiplicity).sum();
    if found != counted {
        return Err(StabilityError::Missing { counted, found });
    }

    modes.truncate(count);
    for mode in &mut modes {
        mode.value *= scaled.rate;
    }
    let least_stable = (0..count)
        .max_by(|&i, &j| modes[i].value.re.total_cmp(&modes[j].value.re))
        .unwrap_or(0);
    Ok(Spectrum {
        modes,
        counted,
        within,
        least_stable,
    })
}

/// The distance in frequency of a mode from the one before.
fn gap(modes: &[Mode], index: usize) -> f64 {
    modes[index].value.im - modes[index - 1].value.im
}

/// The scaled eigenvalues by Newton's method from those by spectral elements, all different.
fn polished(scaled: &Scaled, spectral: &[c64]) -> Result<Vec<Mode>, StabilityError> {
    let mut modes: Vec<Mode> = Vec::with_capacity(spectral.len());
    for (index, &from) in spectral.iter().enumerate() {
        let number = index + 1;
        let mut value = scaled
            .root_near(from)
            .ok_or(StabilityError::NoConvergence {
                number,
                from: from * scaled.rate,
            })?;
        if from.im == 0.0 {
            value.im = 0.0;
        }
        let difference = (value - from).norm() / value.norm();
        if difference.is_nan() || difference > AGREEMENT {
            return Err(StabilityError::Disagreement {
                number,
                spectral: from * scaled.rate,
                exact: value * scaled.rate,
            });
        }
        let same = |mode: &Mode| (mode.value - value).norm() <= SAME * value.norm();
        if modes.iter().any(same) {
            return Err(StabilityError::Duplicate {
                number,
                value: value * scaled.rate,
            });
        }
        modes.push(Mode { value, difference });
    }
    Ok(modes)
}

/// Refuses motions that are no belt on a pulley.
pub(super) fn check(motion: &AxialMotion) -> Result<(), StabilityError> {
    let invalid = |what| Err(StabilityError::Invalid(what));
    let positive = [
        motion.mass_per_length,
        motion.axial_stiffness,
        motion.length,
    ];
    if !positive.iter().all(|&x| x > 0.0 && x.is_finite()) {
        return invalid("mass, stiffness and length must be positive");
    }
    if !motion.slip_rate.is_finite() || !(0.0..=motion.length).contains(&motion.transition) {
        return invalid("the transition must be on the pulley, the slip rate finite");
    }
    if motion.elastic.is_some_and(|k| !(k > 0.0 && k.is_finite())) {
        return invalid("the friction stiffness must be positive");
    }
    if motion.fixed_end() >= motion.length {
        return invalid("nothing moves under rigid friction without slip");
    }
    if motion.speed.is_nan() || motion.speed < 0.0 {
        return invalid("the belt speed must not be negative");
    }
    let critical = motion.critical_speed();
    if motion.speed >= critical {
        let speed = motion.speed;
        return Err(StabilityError::Supercritical { speed, critical });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::examples::driven;
    use super::*;

    #[test]
    fn what_makes_no_sense_is_refused() {
        let good = driven(800.0);
        let refused = |motion: AxialMotion| spectrum(&motion, LinearisedForm::Thesis, 3).is_err();
        assert!(!refused(good));
        assert!(refused(AxialMotion {
            speed: 880.0,
            ..good
        }));
        assert!(refused(AxialMotion {
            speed: f64::NAN,
            ..good
        }));
        assert!(refused(AxialMotion {
            elastic: Some(-1.0),
            ..good
        }));
        assert!(refused(AxialMotion {
            transition: 2.0 * good.length,
            ..good
        }));
        let rigid = AxialMotion {
            elastic: None,
            transition: good.length,
            ..good
        };
        assert!(refused(rigid));
        assert!(spectrum(&good, LinearisedForm::Thesis, 0).is_err());
    }

    #[test]
    fn two_starts_at_one_mode_are_noticed() {
        let scaled = Scaled::new(&driven(800.0), LinearisedForm::Thesis);
        let values = scaled.spectral_eigenvalues(2).expect("eigenvalues");
        let outcome = polished(&scaled, &[values[0], values[0]]);
        assert!(matches!(
            outcome,
            Err(StabilityError::Duplicate { number: 2, .. })
        ));
    }
}
