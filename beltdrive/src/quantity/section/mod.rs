//! What there is to tell of belt sections, and of what a drive file takes from one.

mod data;
mod sources;

use super::{Answer, Group, Layout, Measure, Quantity, Subject, UnitSystem};
use crate::input::{FilledIn, FilledValue};
use crate::quantity::precision::six_digits;
use crate::sections::{Family, GrooveRule, Section};
use data::{citations, data, figures};
use serde_json::json;
use sources::{Sources, columns};
use std::borrow::Cow;

/// The half groove angle at which lists show radial stiffnesses, rad: 18°, within those of all grooves.
const HALF_ANGLE: f64 = 18.0 * std::f64::consts::PI / 180.0;

/// Digits of estimates in tables.
const OF_ESTIMATE: u8 = 3;

/// All sections, a line each, by what their numbers are for.
pub fn list(sections: &[Section]) -> Answer {
    let table = |title: &'static str, is_of: fn(Family) -> bool| {
        let of_table = sections.iter().filter(|section| is_of(section.family));
        let rows = of_table.map(|section| Subject::new(section.name, line(title, section)));
        Group::new("", Layout::Rows, rows.collect())
    };
    Answer {
        heading: vec!["Belt sections".to_owned()],
        remarks: Vec::new(),
        groups: vec![
            data(sections),
            table("V-belt", Family::is_v),
            table("one rib", |family| family == Family::PolyV),
            table("per width", |family| family == Family::Flat),
        ],
        notes: vec![
            "EA and k of V-belts and EA of ribs are estimates: measure them where they matter."
                .to_owned(),
            "k at a half groove angle of 18°; `beltdrive sections NAME` shows scatter and sources."
                .to_owned(),
        ],
    }
}

/// One section in full.
pub fn one(section: &Section) -> Answer {
    let mut notes = Sources::default();
    let also = match section.also {
        "" => String::new(),
        also => format!(", also {also}"),
    };
    let of = match section.family {
        Family::PolyV => "mass and stiffness of one rib",
        Family::Flat => "mass and stiffness per width",
        _ => "mass and stiffness of one belt",
    };
    let figures: Vec<_> = figures(section)
        .into_iter()
        .filter_map(|(key, label, measure, figure)| Some((key, label, measure, figure?)))
        .collect();
    let rows = figures
        .into_iter()
        .map(|(_, label, measure, figure)| (label, measure, Some(figure)));
    let stiffness = half_angles(section).into_iter().map(|angle| {
        let label = format!("radial stiffness k, β = {}°", angle.to_degrees().round());
        let figure = section.radial_stiffness(angle);
        (label.into(), Measure::ForcePerArea, figure)
    });
    let figures = columns(rows.chain(stiffness), &mut notes);
    let grooves = section.grooves.iter().map(|rule| grooves(rule, &mut notes));
    let grooves: Vec<_> = grooves.collect();
    let mut groups = vec![data(std::slice::from_ref(section)), figures];
    groups.extend(grooves);
    Answer {
        heading: vec![
            format!("Section {}, {}{also}", section.name, section.family.name()),
            of.to_owned(),
        ],
        remarks: Vec::new(),
        groups,
        notes: notes.lines(),
    }
}

/// An answer for a drive, with what its file takes from a section: for programs under `section`, for people with
/// numbered sources below all else.
pub fn told_in(mut answer: Answer, filled: &FilledIn) -> Answer {
    let mut notes = Sources::default();
    let section = filled.section;
    let entries = filled.entries.iter().map(|entry| match entry.value {
        FilledValue::Word(word) => json!({ "key": entry.path, "value": word }),
        FilledValue::Number(measure, figure) => {
            let (_, factor) = measure.stored();
            json!({
                "key": entry.path,
                "value": figure.value * factor,
                "unit": measure.shown(UnitSystem::Si).symbol,
                "low": figure.range.map(|[low, _]| low * factor),
                "high": figure.range.map(|[_, high]| high * factor),
                "kind": figure.kind.name(),
                "sources": citations(figure.sources),
            })
        }
    });
    let entries: Vec<_> = entries.collect();
    let of_programs = vec![
        Quantity::word("name", "", section.name.to_owned()),
        Quantity::word("family", "", section.family.name().to_owned()),
        Quantity::json("filled_in", entries),
        Quantity::json("too_small", small_pulleys(filled)),
    ];
    let words = filled.entries.iter().filter_map(|entry| match entry.value {
        FilledValue::Word(word) => Some(format!("{} = {word}", entry.path)),
        FilledValue::Number(..) => None,
    });
    let words: String = words.map(|word| format!(", {word}")).collect();
    let title = Quantity::word(
        "",
        "filled in from section",
        format!("{}{words}", section.name),
    );
    let numbers = filled.entries.iter().filter_map(|entry| match entry.value {
        FilledValue::Number(measure, figure) => {
            Some((Cow::Owned(entry.path.clone()), measure, Some(figure)))
        }
        FilledValue::Word(_) => None,
    });
    let numbers = columns(numbers, &mut notes);
    let shown = Group::new("", Layout::Columns, vec![Subject::new("", vec![title])]);
    answer
        .groups
        .extend([Group::single("section", of_programs), shown, numbers]);
    let millimetres = |length: f64| format!("{} mm", six_digits(1e3 * length));
    let smallest = section.smallest_diameter.map_or(0.0, |figure| figure.value);
    let small = filled.too_small.iter().map(|(name, diameter)| {
        format!(
            "pulley `{name}` has a diameter of {}, the smallest for section {} is {}: the belt will not last",
            millimetres(*diameter),
            section.name,
            millimetres(smallest)
        )
    });
    answer.remarks.extend(small);
    if !answer.notes.is_empty() {
        answer.notes.push(String::new());
    }
    answer.notes.extend(notes.lines());
    answer
}

/// A section on a line of a list.
fn line(title: &'static str, section: &Section) -> Vec<Quantity> {
    let mut quantities = vec![Quantity::word("", title, section.name.to_owned())];
    if section.family.is_v() {
        quantities.push(Quantity::word(
            "",
            "family",
            section.family.name().to_owned(),
        ));
    }
    let is_shown = |key: &str| match section.family {
        Family::PolyV => !matches!(
            key,
            "top_width" | "pitch_line_depth" | "wedge_angle" | "transverse_modulus"
        ),
        Family::Flat => matches!(
            key,
            "height" | "smallest_diameter" | "mass" | "axial_stiffness"
        ),
        _ => !matches!(
            key,
            "pitch_line_depth" | "pitch_line_height" | "wedge_angle" | "transverse_modulus"
        ),
    };
    let figures = figures(section)
        .into_iter()
        .filter(|(key, ..)| is_shown(key));
    quantities.extend(figures.map(|(key, label, measure, figure)| {
        let label = match key {
            "axial_stiffness" => "EA".into(),
            // That of the first of the sections stands above all.
            "datum_width" if section.family.is_v() => "datum width".into(),
            _ => label,
        };
        shown(label, measure, figure.map(|figure| figure.value))
    }));
    if section.family.is_v() {
        let k = section.radial_stiffness(HALF_ANGLE);
        quantities.push(shown("k".into(), Measure::ForcePerArea, k.map(|k| k.value)));
    }
    quantities
}

/// A number for people.
fn shown(label: Cow<'static, str>, measure: Measure, value: Option<f64>) -> Quantity {
    Quantity {
        digits: OF_ESTIMATE,
        ..Quantity::number("", label, measure, value, 0.0)
    }
}

/// The groove angles by a rule.
fn grooves(rule: &GrooveRule, notes: &mut Sources) -> Group {
    // Not to be folded.
    let title =
        format!("{}: {}", rule.standard, notes.numbers(rule.sources)).replace(' ', "\u{a0}");
    let rows = rule.steps.iter().map(|step| {
        let standard = match step.up_to {
            Some(_) => "up to",
            None => "above",
        };
        let quantities = vec![
            Quantity::word("", title.clone(), standard.to_owned()),
            shown("pitch diameter".into(), Measure::Length, step.up_to),
            shown("groove angle".into(), Measure::Angle, Some(step.angle)),
        ];
        Subject::new("", quantities)
    });
    Group::new("", Layout::Rows, rows.collect())
}

/// The pulleys that are too small, for programs.
fn small_pulleys(filled: &FilledIn) -> Vec<serde_json::Value> {
    let pulleys = filled.too_small.iter();
    pulleys
        .map(|(name, diameter)| json!({ "pulley": name, "diameter_m": diameter }))
        .collect()
}

/// The half angles of the grooves of a section by its first rule, rad.
fn half_angles(section: &Section) -> Vec<f64> {
    let steps = section.grooves.first().map_or(&[][..], |rule| rule.steps);
    steps.iter().map(|step| 0.5 * step.angle).collect()
}
