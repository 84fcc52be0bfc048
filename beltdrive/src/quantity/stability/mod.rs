//! What there is to tell of the stability of the axial motion of a flat belt.

mod meaning;
#[cfg(test)]
pub(crate) mod sample;
mod words;

pub(crate) use words::{complex, form_label, outcome};

use super::parameter::parameter;
use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value, two_pulleys};
use crate::input::Key;
use crate::{
    AxialMode, Drive, FormStability, LinearisedForm, Onset, Pulley, PulleyStability, Stability,
};
use std::f64::consts::TAU;
use words::{error, form_description, form_key, form_word, is_neutral, least_stable, pulleys};

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
        groups.push(Group::new("", Layout::Rows, modes(pulley, on)));
        let forms = on.forms.iter().map(|form| summary(key, pulley, form));
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
fn pulley(drive: &Drive, pulley: Pulley, on: &PulleyStability) -> Vec<Quantity> {
    let radius = match pulley {
        Pulley::Driver => drive.driver_radius,
        Pulley::Driven => drive.driven_radius,
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

/// The modes on a pulley, in all forms beside each other, for people.
fn modes(pulley: Pulley, on: &PulleyStability) -> Vec<Subject> {
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
fn growth(label: impl Into<std::borrow::Cow<'static, str>>, mode: &AxialMode) -> Quantity {
    let value = if is_neutral(mode) { 0.0 } else { mode.growth };
    Quantity::number("", label, Measure::Growth, value, error(mode))
}

/// What the spectrum in a form comes to, for people.
fn summary(key: Key, pulley: Pulley, form: &FormStability) -> Subject {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::UnitSystem;
    use crate::report::{csv, json, table};

    #[test]
    fn the_table_has_modes_a_summary_and_their_meaning() {
        let text = table(&answer(&sample::stability()), UnitSystem::Engineering);
        insta::assert_snapshot!(text, @r#"
        Flat belt, "made up" <&>
        elastic/perfectly-plastic friction, μ = 0.6, k_f = 5e7 N/m², normal force n = (T − G V)/R
        Stability of the axial motion: small displacements f(s) exp(λ t) of the belt about the steady state
        (1) outlet f' = 0 (thesis)  slip friction follows T, f' = 0 at the outlet
        (2) natural outlet          slip friction follows T, D f' = m v λ f at the outlet
        (3) conservative            slip friction follows T − G V, D f' = m v λ f at the outlet

        tight tractive tension                         420.000  N

        critical speed √(EA/m)                         1291.00  m/s

                                                        driver                      driven
        belt speed                                     25.0500                     25.0125  m/s
        contact                                        171.887                     114.592  °
        slip from                                      114.592                     57.2958  °

                                                                        Re
                             Im λ     Im λ     Re λ     Im λ     Im λ    λ     Im λ     Im λ
        driver  Re λ (1)      (1)      (1)      (2)      (2)      (2)  (3)      (3)      (3)
                     1/s    rad/s       Hz      1/s    rad/s       Hz  1/s    rad/s       Hz
             1  −40.0000  10000.0  1591.55  3.25000  10000.0  1591.55    0  10000.0  1591.55
             2  −19.3750  20000.0  3183.10  2.31250  20000.0  3183.10    0  20000.0  3183.10
             3  −15.5556  30000.0  4774.65  2.13889  30000.0  4774.65    0  30000.0  4774.65
             4  −14.2188  40000.0  6366.20  2.07812  40000.0  6366.20    0  40000.0  6366.20

        driver                                    thesis        natural outlet          conservative
        largest Re λ                            −14.2188               3.25000                     0  1/s
          in mode                                      4                     1                   all
        limit of Re λ, high modes               −12.5000               2.00000                     0  1/s
        grows from                               480.000               150.500                 never  N
          first in mode                                2            high modes                     –
        counted up to |Im λ|                     45000.0               45000.0               45000.0  rad/s
        eigenvalues found there                        8                     8                     8
        methods differ at most by                2.0e−12               2.0e−12               2.0e−12

                                                                         Re
        driven               Im λ     Im λ               Im λ     Im λ    λ     Im λ     Im λ
        pulley  Re λ (1)      (1)      (1)  Re λ (2)      (2)      (2)  (3)      (3)      (3)
                     1/s    rad/s       Hz       1/s    rad/s       Hz  1/s    rad/s       Hz
             1  −128.000  10000.0  1591.55  −7.00000  10000.0  1591.55    0  10000.0  1591.55
             2  −51.1250  20000.0  3183.10  −4.00000  20000.0  3183.10    0  20000.0  3183.10
             3  −36.8889  30000.0  4774.65  −3.44444  30000.0  4774.65    0  30000.0  4774.65
             4  −31.9062  40000.0  6366.20  −3.25000  40000.0  6366.20    0  40000.0  6366.20

        driven pulley                             thesis        natural outlet          conservative
        largest Re λ                            −31.9062              −3.25000                     0  1/s
          in mode                                      4                     4                   all
        limit of Re λ, high modes               −25.5000              −3.00000                     0  1/s
        grows from                            none found            none found                 never  N
        counted up to |Im λ|                     45000.0               45000.0               45000.0  rad/s
        eigenvalues found there                        8                     8                     8
        methods differ at most by                2.0e−12               2.0e−12               2.0e−12

        With the thesis's outlet condition every motion found decays at this load, but the belt on the
            driver turns unstable at a tight tractive tension of 480 N (mode 2 first); with the inertia of
            the normal force and the natural outlet condition kept the motion is exactly conservative (Re λ
            = 0), so that this growth, like the decay on the driven pulley, comes from the terms left out
            and not from the drive.
        "#);
    }

    #[test]
    fn a_belt_need_not_slip() {
        let mut stability = sample::stability();
        for on in [&mut stability.driver, &mut stability.driven] {
            on.transition = on.contact_length;
        }
        let text = table(&answer(&stability), UnitSystem::Si);
        assert!(
            text.contains("contact") && !text.contains("slip from"),
            "{text}"
        );
    }

    #[test]
    fn json_is_complete() {
        let stability = sample::stability();
        let text = json(&answer(&stability));
        let report: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(report["load"]["tight_tractive_tension_N"], 420.0);
        let driver = &report["driver"];
        assert_eq!(driver["slips"], true);
        let thesis = &driver["forms"]["thesis"];
        assert_eq!(thesis["modes"].as_array().unwrap().len(), sample::MODES);
        let second = &thesis["modes"][1];
        assert_eq!(second["number"], 2);
        assert_eq!(second["angular_frequency_rad_per_s"], 20_000.0);
        assert_eq!(second["frequency_Hz"], 20_000.0 / TAU);
        assert_eq!(second["grows"], false);
        assert_eq!(thesis["largest_growth"]["mode"], 4);
        assert_eq!(thesis["grows"], false);
        assert!(driver["forms"]["conservative"]["largest_growth"]["mode"].is_null());
        assert_eq!(thesis["onset"]["tight_tractive_tension_N"], 480.0);
        assert_eq!(thesis["onset"]["mode"], 2);
        assert_eq!(thesis["box"]["growth_bound_per_s"], 90.0);
        assert_eq!(thesis["counted"], 8);
        assert!(report["driven"]["forms"]["thesis"]["onset"].is_null());
        assert!(driver["forms"]["conservative"]["onset"].is_null());
        let natural = &driver["forms"]["natural_outlet"];
        assert!(natural["onset"]["mode"].is_null() && natural["grows"] == true);
        assert!(report["meaning"].as_str().unwrap().contains("480 N"));
        let modes = &report["driven"]["forms"]["thesis"]["modes"];
        let shape = &modes[0]["shape"];
        for column in ["arc_length_m", "real", "imaginary"] {
            let values = shape[column].as_array().unwrap();
            assert_eq!(values.len(), stability.driven.forms[0].modes[0].shape.len());
        }
        assert_eq!(shape["arc_length_m"][0], 0.0);
        assert!(modes[3].get("shape").is_none());
    }

    #[test]
    fn csv_has_a_row_for_each_pulley_form_and_mode() {
        let text = csv(&answer(&sample::stability()));
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 1 + 2 * 3 * sample::MODES);
        let header = "pulley,form,mode,growth_per_s,angular_frequency_rad_per_s,frequency_Hz,\
            method_difference,grows,normal_force";
        assert_eq!(lines[0], header);
        assert!(
            lines[1].starts_with("driver,thesis,1,-40,10000,1591.54"),
            "{text}"
        );
        assert!(lines[1].ends_with(",false,inertia"));
        assert!(
            lines[lines.len() - 1].starts_with("driven,conservative,4,"),
            "{text}"
        );
    }
}
