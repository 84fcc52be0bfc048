//! What there is to tell of the stability of the axial motion of a flat belt.

mod meaning;
mod people;
#[cfg(test)]
pub(crate) mod sample;
#[cfg(test)]
mod tests;
mod words;

pub(crate) use words::{complex, form_label, outcome};

use super::parameter::parameter;
use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value, two_pulleys};
use crate::input::Key;
use crate::{
    AxialMode, Drive, FormStability, LinearisedForm, Onset, PulleyStability, Role, Stability,
};
use std::f64::consts::TAU;
use words::{form_description, form_key, form_word, least_stable, pulleys};

/// The eigenvalues on both pulleys, in every form of the linearised problem, and what they mean; for programs
/// also the shapes of the first modes.
pub fn answer(stability: &Stability) -> Answer {
    let drive = &stability.drive;
    let key = Key::load(drive);
    let meaning = meaning::meaning(stability);
    let mut heading = super::words::title(drive, &[]);
    heading.push(
        "Stability of the axial motion: small displacements f(s) exp(λ t) of the belt about the \
         steady state"
            .to_owned(),
    );
    heading.extend((1..).zip(LinearisedForm::ALL).map(|(number, form)| {
        format!(
            "({number}) {:<22}  {}",
            form_label(form),
            form_description(form)
        )
    }));
    let both = pulleys(stability);
    let named = both.map(|(pulley, on)| {
        Subject::new(
            super::words::pulley(pulley),
            self::pulley(drive, pulley, on),
        )
    });
    let mut groups = vec![
        Group::single("", two_pulleys::statement(drive)),
        Group::new("", Layout::Rows, rows(stability)),
        Group::single("load", vec![parameter(key, key.get(drive), None)]),
        Group::single(
            "",
            vec![Quantity::number(
                "critical_speed",
                "critical speed √(EA/m)",
                Measure::Velocity,
                stability.critical_speed,
                0.0,
            )],
        ),
        Group::new("", Layout::Named, named.to_vec()),
    ];
    for (pulley, on) in both {
        groups.push(Group::new("", Layout::Rows, people::modes(pulley, on)));
        let forms = on
            .forms
            .iter()
            .map(|form| people::summary(key, pulley, form));
        groups.push(Group::new("", Layout::Columns, forms.collect()));
    }
    groups.push(Group::single(
        "",
        vec![
            Quantity::word("meaning", "", meaning.clone()),
            Quantity::number("seconds", "", Measure::Number, stability.seconds, 0.0),
        ],
    ));
    Answer {
        heading,
        groups,
        notes: vec![meaning],
        ..Answer::default()
    }
}

/// The motion on a pulley.
fn pulley(drive: &Drive, pulley: Role, on: &PulleyStability) -> Vec<Quantity> {
    let radius = match pulley {
        Role::Driver => drive.pair().driver_radius,
        Role::Driven => drive.pair().driven_radius,
    };
    let slips = on.transition < on.contact_length;
    let length = |key, value| Quantity::number(key, "", Measure::Length, value, 0.0);
    let angle = |label, length: Option<f64>| {
        Quantity::number(
            "",
            label,
            Measure::Angle,
            length.map(|length| length / radius),
            0.0,
        )
    };
    let forms = on
        .forms
        .iter()
        .map(|form| object(form_key(form.form), self::form(drive, form)));
    vec![
        Quantity::number(
            "belt_speed",
            "belt speed",
            Measure::Velocity,
            on.belt_speed,
            0.0,
        ),
        length("contact_length", on.contact_length),
        angle("contact", Some(on.contact_length)),
        length("transition", on.transition),
        angle("slip from", slips.then_some(on.transition)),
        Quantity::json("slips", slips),
        object("forms", forms.collect()),
    ]
}

fn object(key: &'static str, quantities: Vec<Quantity>) -> Quantity {
    Quantity::data(key, Measure::Number, Value::Object(Some(quantities)))
}

/// The spectrum in a form, for programs.
fn form(drive: &Drive, form: &FormStability) -> Vec<Quantity> {
    let growth = |key, value| Quantity::number(key, "", Measure::Growth, value, 0.0);
    let frequency = |key, value| Quantity::number(key, "", Measure::AngularFrequency, value, 0.0);
    let [growth_bound, frequency_bound] = form.within;
    let modes = (1..).zip(&form.modes);
    let modes = modes.map(|(number, mode)| Subject::new("", self::mode(number, mode)));
    let key = Key::load(drive);
    let onset = match form.onset {
        Some(Onset::At { load, mode }) => Some(vec![
            parameter(key, load, None),
            Quantity::json("mode", mode),
        ]),
        Some(Onset::Never) | None => None,
    };
    vec![
        Quantity::word("description", "", form_description(form.form).to_owned()),
        Quantity::data("modes", Measure::Number, Value::List(modes.collect())),
        object(
            "largest_growth",
            vec![
                growth("growth", form.largest_growth()),
                Quantity::json("mode", least_stable(form).1),
            ],
        ),
        growth("high_mode_limit", form.high_mode_limit),
        Quantity::json("grows", form.is_unstable()),
        Quantity::count("counted", "", form.counted),
        object(
            "box",
            vec![
                growth("growth_bound", growth_bound),
                frequency("angular_frequency_bound", frequency_bound),
            ],
        ),
        Quantity::data("onset", Measure::Number, Value::Object(onset)),
    ]
}

/// A mode, by its number from 1.
fn mode(number: usize, mode: &AxialMode) -> Vec<Quantity> {
    let series = |key, measure, of: &dyn Fn(usize) -> f64| {
        let values = (0..mode.shape.len()).map(of).collect();
        Quantity::data(key, measure, Value::Series(values))
    };
    let mut quantities = vec![
        Quantity::count("number", "", number),
        Quantity::number("growth", "", Measure::Growth, mode.growth, 0.0),
        Quantity::number(
            "angular_frequency",
            "",
            Measure::AngularFrequency,
            mode.frequency,
            0.0,
        ),
        Quantity::number(
            "frequency",
            "",
            Measure::Frequency,
            mode.frequency / TAU,
            0.0,
        ),
        Quantity::number(
            "method_difference",
            "",
            Measure::Number,
            mode.difference,
            0.0,
        ),
        Quantity::json("grows", mode.grows()),
    ];
    if !mode.shape.is_empty() {
        quantities.push(object(
            "shape",
            vec![
                series("arc_length", Measure::Length, &|place| {
                    mode.shape[place].arc_length
                }),
                series("real", Measure::Number, &|place| mode.shape[place].value[0]),
                series("imaginary", Measure::Number, &|place| {
                    mode.shape[place].value[1]
                }),
            ],
        ));
    }
    quantities
}

/// A row for each pulley, form and mode, for programs.
fn rows(stability: &Stability) -> Vec<Subject> {
    let forms = pulleys(stability).into_iter();
    let forms = forms.flat_map(|(pulley, on)| on.forms.iter().map(move |form| (pulley, form)));
    let row = |pulley, form: &FormStability, number, mode: &AxialMode| {
        let mut quantities = vec![
            Quantity::word("pulley", "", super::words::pulley(pulley).to_owned()),
            Quantity::word("form", "", form_word(form.form).to_owned()),
            Quantity::count("mode", "", number),
        ];
        let of_mode = self::mode(number, mode).into_iter();
        quantities
            .extend(of_mode.filter(|quantity| !["number", "shape"].contains(&&*quantity.key)));
        quantities.push(Quantity::word("grows", "", mode.grows().to_string()));
        quantities.extend(two_pulleys::convention(&stability.drive));
        Subject::new("", quantities)
    };
    let rows = forms.flat_map(|(pulley, form)| {
        let modes = (1..).zip(&form.modes);
        modes.map(move |(number, mode)| row(pulley, form, number, mode))
    });
    rows.collect()
}
