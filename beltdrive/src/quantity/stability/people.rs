//! What people read of the spectra.

use super::words::{error, form_word, is_neutral, least_stable};
use crate::input::Key;
use crate::quantity::parameter::parameter;
use crate::quantity::{Measure, Quantity, Subject};
use crate::{AxialMode, FormStability, Onset, PulleyStability, Role};
use std::borrow::Cow;
use std::f64::consts::TAU;

/// The modes on a pulley, in all forms beside each other, for people.
pub(super) fn modes(pulley: Role, on: &PulleyStability) -> Vec<Subject> {
    let count = on.forms.iter().map(|form| form.modes.len()).min();
    let row = |index: usize| {
        let first = Quantity {
            label: pulley.name().into(),
            ..Quantity::count("", "", index + 1)
        };
        let eigenvalues = (1..).zip(&on.forms).flat_map(|(number, form)| {
            let mode = &form.modes[index];
            let frequency = |measure, per_radian: f64| {
                let label = format!("Im λ ({number})");
                Quantity::number(
                    "",
                    label,
                    measure,
                    per_radian * mode.frequency,
                    per_radian * error(mode),
                )
            };
            [
                growth(format!("Re λ ({number})"), mode),
                frequency(Measure::AngularFrequency, 1.0),
                frequency(Measure::Frequency, 1.0 / TAU),
            ]
        });
        // None is left out.
        Subject::new("mode", [first].into_iter().chain(eigenvalues).collect())
    };
    (0..count.unwrap_or(0)).map(row).collect()
}

/// The rate of growth of a mode, with the digits that both methods agree on, and 0 where it is rounding.
fn growth(label: impl Into<Cow<'static, str>>, mode: &AxialMode) -> Quantity {
    let value = if is_neutral(mode) { 0.0 } else { mode.growth };
    Quantity::number("", label, Measure::Growth, value, error(mode))
}

/// What the spectrum in a form comes to, for people.
pub(super) fn summary(key: Key, pulley: Role, form: &FormStability) -> Subject {
    let (largest, number) = least_stable(form);
    let word = |label: &'static str, word: &str| Quantity::word("", label, word.to_owned());
    let of_mode = |label, number: Option<usize>, otherwise| match number {
        Some(number) => Quantity::count("", label, number),
        None => word(label, otherwise),
    };
    let [load, first] = match form.onset {
        Some(Onset::At { load, mode }) => [
            parameter(key, load, None).shown_as("grows from"),
            of_mode("  first in mode", mode, "high modes"),
        ],
        never => [
            Quantity {
                measure: key.measure(),
                ..word(
                    "grows from",
                    if never.is_some() {
                        "none found"
                    } else {
                        "never"
                    },
                )
            },
            Quantity::word("", "  first in mode", None),
        ],
    };
    let difference = form
        .modes
        .iter()
        .map(|mode| mode.difference)
        .fold(0.0, f64::max);
    Subject::new(
        "",
        vec![
            Quantity::word("", pulley.name(), form_word(form.form).to_owned()),
            growth("largest Re λ", largest),
            of_mode("  in mode", number, "all"),
            Quantity::number(
                "",
                "limit of Re λ, high modes",
                Measure::Growth,
                form.high_mode_limit,
                0.0,
            ),
            load,
            first,
            Quantity::number(
                "",
                "counted up to |Im λ|",
                Measure::AngularFrequency,
                form.within[1].round(),
                0.0,
            ),
            Quantity::count("", "eigenvalues found there", form.counted),
            Quantity::error("", "methods differ at most by", Measure::Number, difference),
        ],
    )
}
