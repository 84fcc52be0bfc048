//! The figures of sections, and all of them for programs.

use super::super::{Group, Layout, Measure, Quantity, Subject, Value};
use super::HALF_ANGLE;
use crate::sections::{Family, Figure, Section, Source};
use serde_json::json;
use std::borrow::Cow;

/// A figure of a section: key, label, measure, number.
pub(super) type Named = (&'static str, Cow<'static, str>, Measure, Option<Figure>);

/// The figures of a section; those of a flat belt are per width.
pub(super) fn figures(section: &Section) -> Vec<Named> {
    let is_flat = section.family == Family::Flat;
    let (mass, stiffness) = match is_flat {
        true => (Measure::MassPerArea, Measure::Stiffness),
        false => (Measure::MassPerLength, Measure::Force),
    };
    let datum_width = match section.family {
        Family::PolyV => "distance of ribs",
        Family::NarrowRma => "effective width",
        _ => "datum width",
    };
    let named = |key, label: &'static str, measure, figure| (key, label.into(), measure, figure);
    let length = |key, label, figure| named(key, label, Measure::Length, figure);
    vec![
        length("top_width", "top width", section.top_width),
        length("height", "height", section.height),
        length("datum_width", datum_width, section.datum_width),
        length(
            "pitch_line_depth",
            "pitch line below the back",
            section.pitch_line_depth,
        ),
        length(
            "pitch_line_height",
            "pitch line above the pulley",
            section.pitch_line_height,
        ),
        named(
            "wedge_angle",
            "wedge angle",
            Measure::Angle,
            section.wedge_angle,
        ),
        length(
            "smallest_diameter",
            "smallest diameter",
            section.smallest_diameter,
        ),
        named("mass", "mass", mass, section.mass),
        named(
            "axial_stiffness",
            "axial stiffness EA",
            stiffness,
            section.axial_stiffness,
        ),
        named(
            "transverse_modulus",
            "transverse modulus",
            Measure::ForcePerArea,
            section.transverse_modulus,
        ),
    ]
}

/// Sections, for programs.
pub(super) fn data(sections: &[Section]) -> Group {
    let subject = |section: &Section| {
        let mut quantities = vec![
            Quantity::word("name", "", section.name.to_owned()),
            Quantity::word("also", "", section.also.to_owned()),
            Quantity::word("family", "", section.family.name().to_owned()),
        ];
        let figures = figures(section).into_iter();
        quantities.extend(figures.map(|(key, _, measure, figure)| object(key, measure, figure)));
        quantities.push(object(
            "radial_stiffness_at_18_deg",
            Measure::ForcePerArea,
            section.radial_stiffness(HALF_ANGLE),
        ));
        let rules = section.grooves.iter().map(|rule| {
            let steps = rule.steps.iter().map(|step| {
                json!({ "up_to_diameter_m": step.up_to, "angle_deg": step.angle.to_degrees() })
            });
            json!({
                "standard": rule.standard,
                "sources": citations(rule.sources),
                "steps": steps.collect::<Vec<_>>(),
            })
        });
        quantities.push(Quantity::json("grooves", rules.collect::<Vec<_>>()));
        Subject::new("", quantities)
    };
    Group::new(
        "sections",
        Layout::Rows,
        sections.iter().map(subject).collect(),
    )
}

/// A figure for programs.
fn object(key: &'static str, measure: Measure, figure: Option<Figure>) -> Quantity {
    let number = |key, value| Quantity::number(key, "", measure, value, 0.0);
    let object = figure.map(|figure| {
        let sources = citations(figure.sources).join("; ");
        vec![
            number("value", Some(figure.value)),
            number("low", figure.range.map(|[low, _]| low)),
            number("high", figure.range.map(|[_, high]| high)),
            Quantity::word("kind", "", figure.kind.name().to_owned()),
            Quantity::word("sources", "", sources),
        ]
    });
    Quantity::data(key, Measure::Number, Value::Object(object))
}

pub(super) fn citations(sources: &[Source]) -> Vec<&'static str> {
    sources.iter().map(|source| source.citation()).collect()
}
