//! What there is to tell of the vibrations of a running drive.

use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value, belt_loop};
use crate::belt_loop::LoopState;
use crate::transient::VibrationMode;
use crate::{FrictionLaw, Modes, ModesAtSpeed};
use std::f64::consts::TAU;

/// A span is solved in closed form: so many digits are shown.
const SPAN: f64 = 0.0;

/// Modes over speed that a table has room for.
const SHOWN: usize = 4;

/// The modes with the slip zones held and with friction below its limit, the spans, and the modes over speed if they
/// were asked for.
pub fn answer(modes: &Modes) -> Answer {
    let drive = &modes.drive;
    let mut heading = belt_loop::heading(drive);
    heading.push("Vibrations about the steady state".to_owned());
    let mut groups = vec![Group::single("", belt_loop::statement(drive))];
    if !modes.over_speed.is_empty() {
        let count = modes.over_speed.iter().map(|point| point.modes.len()).max();
        let rows = modes.over_speed.iter();
        let rows = rows.map(|point| at_speed(point, count.unwrap_or(0)));
        groups.push(Group::new("over_speed", Layout::Rows, rows.collect()));
    }
    let of = |key, contact: &str, found: &[VibrationMode]| {
        let rows = { found.iter().enumerate() }
            .map(|(index, found)| row(modes, contact, (index + 1, found)));
        Group::new(key, Layout::Rows, rows.collect())
    };
    groups.push(of("modes", "slip zones held", &modes.slipping));
    let below_its_limit = match drive.law {
        FrictionLaw::CreepRate { .. } => "creeping",
        _ => "sticking",
    };
    groups.push(of("sticking_modes", below_its_limit, &modes.sticking));
    groups.push(Group::new("spans", Layout::Rows, spans(&modes.state)));
    groups.push(Group::single(
        "mesh",
        vec![
            Quantity::count("cells", "cells", modes.faces.len()),
            Quantity::number("length", "", Measure::Length, modes.length, 0.0),
            Quantity::json("face_positions_m", serde_json::json!(modes.faces)),
        ],
    ));
    let mut notes = vec![
        "damping: share of the critical one. error: change from a mesh with half the cells"
            .to_owned(),
    ];
    if modes.slipping.is_empty() {
        notes.push(
            "no mode on which two meshes agree: take more cells (transient.cells)".to_owned(),
        );
    }
    notes.extend(modes.missing.iter().map(|(speed, error)| {
        let speed = Quantity::number("", "", Measure::AngularSpeed, *speed, 0.0).shown(6.0);
        format!("none at {}: {error}", speed.unwrap_or_default())
    }));
    Answer {
        heading,
        groups,
        notes,
        ..Answer::default()
    }
}

/// The word for a mode.
pub(crate) fn kind(mode: &VibrationMode) -> &'static str {
    match mode.is_torsional() {
        true => "torsional",
        false => "axial",
    }
}

/// A mode, by its number from 1.
fn row(modes: &Modes, contact: &str, (number, mode): (usize, &VibrationMode)) -> Subject {
    let frequency = mode.angular_frequency;
    let relative = mode.error / frequency.hypot(mode.growth);
    let mut quantities = vec![
        Quantity::count("number", "mode", number),
        Quantity::word("contact", "belt", contact.to_owned()),
        Quantity::word("kind", "kind", kind(mode).to_owned()),
        Quantity::number(
            "frequency",
            "frequency",
            Measure::Frequency,
            frequency / TAU,
            mode.error / TAU,
        ),
        Quantity::number(
            "angular_frequency",
            "",
            Measure::AngularFrequency,
            frequency,
            mode.error,
        ),
        Quantity::number(
            "growth",
            "growth Re λ",
            Measure::Growth,
            mode.growth,
            mode.error,
        ),
        Quantity::number(
            "damping_ratio",
            "damping",
            Measure::Share,
            mode.damping_ratio(),
            relative,
        ),
        Quantity::error("error", "error", Measure::Growth, mode.error),
    ];
    let pulleys = modes.drive.pulleys.iter().zip(&mode.pulley_shares);
    quantities.extend(pulleys.map(|(pulley, &share)| {
        let key = format!("{}_energy_share", super::transient::stem(&pulley.name));
        let label = format!("kinetic energy {}", pulley.name);
        Quantity {
            digits: 4,
            ..Quantity::number(key, label, Measure::Share, share, 0.0)
        }
    }));
    let list = |pairs: &[[f64; 2]]| serde_json::json!(pairs);
    quantities.push(Quantity::json("pulley_rim_shape", list(&mode.rims)));
    quantities.push(Quantity::json(
        "belt_velocity_shape",
        list(&mode.velocities),
    ));
    Subject::new("mode", quantities)
}

/// The spans, across which the belt vibrates as a moving string.
fn spans(state: &LoopState) -> Vec<Subject> {
    let count = state.pulleys.len();
    let name = |pulley: usize| state.pulleys[pulley % count].name.clone();
    let spans = state.spans.iter().enumerate().map(|(index, span)| {
        let number =
            |key, label, measure, value: f64| Quantity::number(key, label, measure, value, SPAN);
        Subject::new(
            "span",
            vec![
                Quantity::word("from_pulley", "span from", name(index)),
                Quantity::word("to_pulley", "to", name(index + 1)),
                number("length", "length", Measure::Length, span.length),
                number("tension", "tension", Measure::Force, span.tension),
                number(
                    "frequency",
                    "first transverse frequency",
                    Measure::Frequency,
                    span.frequency,
                ),
                number(
                    "rest_frequency",
                    "at rest",
                    Measure::Frequency,
                    span.rest_frequency,
                ),
            ],
        )
    });
    spans.collect()
}

/// The modes at a speed, with room for so many.
fn at_speed(point: &ModesAtSpeed, count: usize) -> Subject {
    let mut quantities = vec![Quantity::number(
        "driver_speed",
        "speed of the driver",
        Measure::AngularSpeed,
        point.speed,
        0.0,
    )];
    for index in 0..count {
        let mode = point.modes.get(index);
        let label = match index < SHOWN {
            true => format!("mode {}", index + 1),
            false => String::new(),
        };
        let error = mode.map_or(0.0, |mode| mode.error);
        quantities.push(Quantity::number(
            format!("mode_{}_frequency", index + 1),
            label,
            Measure::Frequency,
            mode.map(|mode| mode.angular_frequency / TAU),
            error / TAU,
        ));
        quantities.push(Quantity::number(
            format!("mode_{}_growth", index + 1),
            "",
            Measure::Growth,
            mode.map(|mode| mode.growth),
            error,
        ));
        quantities.push(Quantity {
            key: format!("mode_{}_kind", index + 1).into(),
            ..Quantity::data(
                "",
                Measure::Number,
                Value::Word(mode.map(|mode| kind(mode).to_owned())),
            )
        });
    }
    let state = &point.state;
    for (pulley, span) in state.pulleys.iter().zip(&state.spans) {
        let key = format!("{}_span_frequency", super::transient::stem(&pulley.name));
        quantities.push(Quantity::number(
            key,
            "",
            Measure::Frequency,
            span.frequency,
            SPAN,
        ));
    }
    Subject::new("", quantities)
}
