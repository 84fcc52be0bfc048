//! Words and numbers that the reports and figures of stability share.

use crate::quantity::precision::known;
use crate::results::stability::ROUNDING;
use crate::{AxialMode, FormStability, LinearisedForm, PulleyStability, Role, Stability};

/// Significant digits of an eigenvalue in text.
const DIGITS: f64 = 6.0;

/// A form of the linearised problem in few words.
pub(crate) fn form_label(form: LinearisedForm) -> &'static str {
    match form {
        LinearisedForm::Thesis => "outlet f' = 0 (thesis)",
        LinearisedForm::NaturalOutlet => "natural outlet",
        LinearisedForm::Conservative => "conservative",
    }
}

/// The word for a form in CSV.
pub(super) fn form_word(form: LinearisedForm) -> &'static str {
    match form {
        LinearisedForm::Thesis => "thesis",
        LinearisedForm::NaturalOutlet => "natural outlet",
        LinearisedForm::Conservative => "conservative",
    }
}

/// The key of a form in JSON.
pub(super) fn form_key(form: LinearisedForm) -> &'static str {
    match form {
        LinearisedForm::Thesis => "thesis",
        LinearisedForm::NaturalOutlet => "natural_outlet",
        LinearisedForm::Conservative => "conservative",
    }
}

/// What tells a form from the others, in words.
pub(super) fn form_description(form: LinearisedForm) -> &'static str {
    match form {
        LinearisedForm::Thesis => "slip friction follows T, f' = 0 at the outlet",
        LinearisedForm::NaturalOutlet => "slip friction follows T, D f' = m v λ f at the outlet",
        LinearisedForm::Conservative => {
            "slip friction follows T − G V, D f' = m v λ f at the outlet"
        }
    }
}

/// Both pulleys.
pub(super) fn pulleys(stability: &Stability) -> [(Role, &PulleyStability); 2] {
    [
        (Role::Driver, &stability.driver),
        (Role::Driven, &stability.driven),
    ]
}

/// The magnitude of an eigenvalue, 1/s.
pub(super) fn magnitude(mode: &AxialMode) -> f64 {
    mode.growth.hypot(mode.frequency)
}

/// Whether the motion neither grows nor decays, to rounding.
pub(super) fn is_neutral(mode: &AxialMode) -> bool {
    mode.growth.abs() <= ROUNDING * magnitude(mode)
}

/// The mode that grows most or decays least, and its number from 1; no number where all modes do so
/// alike.
pub(super) fn least_stable(form: &FormStability) -> (&AxialMode, Option<usize>) {
    let largest = &form.modes[form.least_stable];
    let alike = |mode: &AxialMode| {
        (mode.growth - largest.growth).abs() <= ROUNDING * magnitude(mode).max(magnitude(largest))
    };
    let number = (form.modes.iter().position(alike)).map(|first| first + 1);
    let differ = !form.modes.iter().all(alike);
    (largest, number.filter(|_| differ))
}

/// What becomes of a motion.
pub(crate) fn outcome(mode: &AxialMode) -> &'static str {
    if is_neutral(mode) {
        "is neutral"
    } else if mode.grows() {
        "grows"
    } else {
        "decays"
    }
}

/// The rate of growth of a mode in 1/s, with the digits that both methods agree on, and 0 where it
/// is rounding.
fn growth(mode: &AxialMode) -> String {
    if is_neutral(mode) {
        return "0".to_owned();
    }
    let text = known(mode.growth, error(mode).max(1e-4), DIGITS);
    // Nothing else is told as zero.
    match text == "0" {
        true => format!("{:.1e}", mode.growth),
        false => text,
    }
}

/// The eigenvalue of a mode, without its unit.
pub(crate) fn complex(mode: &AxialMode) -> String {
    let growth = growth(mode).replace('-', "−");
    format!(
        "{growth} + {} i",
        known(mode.frequency, error(mode), DIGITS)
    )
}

/// The error of an eigenvalue, 1/s: the difference of the two methods, of which the better one is
/// far more accurate.
pub(super) fn error(mode: &AxialMode) -> f64 {
    mode.difference.max(1e-12) * magnitude(mode)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mode(growth: f64, frequency: f64) -> AxialMode {
        AxialMode {
            growth,
            frequency,
            difference: 1e-12,
            shape: Vec::new(),
        }
    }

    #[test]
    fn rounding_is_no_growth() {
        let neutral = mode(3e-8, 18_740.234);
        assert_eq!(
            [growth(&neutral), complex(&neutral)],
            ["0", "0 + 18740.2 i"]
        );
        assert_eq!(outcome(&neutral), "is neutral");
        let slow = mode(-3e-5, 18_740.234);
        assert_eq!([&*growth(&slow), outcome(&slow)], ["-3.0e-5", "decays"]);
        let grows = mode(128.176_44, 18_740.234);
        assert_eq!([&*growth(&grows), outcome(&grows)], ["128.176", "grows"]);
        assert_eq!(complex(&mode(-12.5, 2.0)), "−12.5000 + 2.00000 i");
    }

    #[test]
    fn modes_that_grow_alike_are_told() {
        let stability = super::super::sample::stability();
        let numbers = stability
            .driver
            .forms
            .each_ref()
            .map(|form| least_stable(form).1);
        assert_eq!(numbers, [Some(4), Some(1), None]);
    }

    #[test]
    fn forms_are_told_apart() {
        for name in [form_label, form_word, form_key, form_description] {
            let [one, two, three] = LinearisedForm::ALL.map(name);
            assert!(one != two && two != three && three != one);
        }
    }
}
