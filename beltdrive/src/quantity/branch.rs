//! What there is to tell of a branch of steady states of a drive with two pulleys.

use super::parameter::{self, parameter};
use super::scalars::Scalars;
use super::two_pulleys::{self, is_v};
use super::{Answer, Group, Layout, Measure, Quantity, Subject, events, limits, words};
use crate::{Branch, BranchEvent, TracePoint};

/// What is shown of a state of a V-belt and of a flat belt in a row.
const OF_V_BELT: &[(&str, &str)] = &[
    ("driven_angular_speed", "driven speed"),
    ("speed_loss", "speed loss"),
    ("driver_wrap_angle", "wrap driver"),
    ("driven_wrap_angle", "wrap driven"),
    ("driven_torque", "driven torque"),
    ("efficiency", "efficiency"),
    ("driver_exit_inclination", "exit of driver"),
];
const OF_FLAT_BELT: &[(&str, &str)] = &[
    ("driven_angular_speed", "driven speed"),
    ("speed_loss", "speed loss"),
    ("driver_wrap_angle", "wrap driver"),
    ("driven_wrap_angle", "wrap driven"),
    ("driver_slip_arc", "slip driver"),
    ("driven_slip_arc", "slip driven"),
    ("driven_torque", "driven torque"),
    ("efficiency", "efficiency"),
];

/// The branch: a row for each state, also those of events, then the events, why it ends and what it took.
pub fn answer(branch: &Branch) -> Answer {
    let key = branch.key;
    let count = branch.points.len();
    let mut heading = words::title(&branch.drive, &[key]);
    heading.push(format!("Branch over {}: {count} states", key.path()));
    let mut statement = two_pulleys::statement(&branch.drive);
    statement.extend(parameter::statement(key));
    let rows = branch.rows().into_iter();
    let rows = rows
        .map(|(point, event)| row(branch, point, event))
        .collect();
    let points = branch.points.iter();
    let points = points.map(|point| Subject::new("", self::point(branch, point)));
    let events = branch.events.iter().map(|event| self::event(branch, event));
    let convergence = parameter::convergence(&branch.drive, &branch.convergence);
    Answer {
        heading,
        groups: vec![
            Group::single("", statement),
            Group::new("", Layout::Rows, rows),
            Group::new("points", Layout::Columns, points.collect()),
            Group::new("events", Layout::Rows, events.collect()),
            Group::single("end", parameter::end(&branch.end)),
            Group::single("convergence", convergence),
        ],
        notes: vec![format!("end of the branch: {}", branch.end)]
            .into_iter()
            .chain(words::speed_loss(branch.drive.belt.kind).1)
            .collect(),
        ..Answer::default()
    }
}

/// A state in a row, with the event that happens there.
fn row(branch: &Branch, point: &TracePoint, event: Option<&BranchEvent>) -> Subject {
    let kind = event.map(|event| event.kind);
    let label = kind.map(events::event_label).unwrap_or_default();
    let pulley = kind.and_then(events::event_pulley).map(words::pulley);
    let kind = kind.map(events::event_kind);
    let shown = match is_v(&branch.drive) {
        true => OF_V_BELT,
        false => OF_FLAT_BELT,
    };
    let mut quantities = vec![
        parameter(branch.key, point.value, None),
        Quantity::number("arclength", "", Measure::Number, point.arclength, 0.0),
        Quantity::word("event", "", kind.map(str::to_owned)),
        Quantity::word("pulley", "", pulley.map(str::to_owned)),
    ];
    quantities.extend(scalars(branch, point, shown));
    quantities.extend(two_pulleys::convention(&branch.drive));
    quantities.push(Quantity::word("", "event", label.clone()));
    Subject::new(label, quantities)
}

/// The scalars of a state of the branch.
fn scalars(branch: &Branch, point: &TracePoint, shown: &[(&str, &'static str)]) -> Vec<Quantity> {
    let mut drive = branch.drive.clone();
    branch.key.set(&mut drive, point.value);
    let tolerance = branch.convergence.tolerance;
    Scalars::of(&drive, &point.state, tolerance, None).row(shown)
}

/// A state, for programs.
fn point(branch: &Branch, point: &TracePoint) -> Vec<Quantity> {
    let key = branch.key;
    let number = |key, value| Quantity::number(key, "", Measure::Number, value, 0.0);
    let mut quantities = vec![
        parameter(key, point.value, None).unlabelled(),
        number("value", Some(key.reported(point.value))),
        number("arclength", Some(point.arclength)),
    ];
    quantities.extend(scalars(branch, point, &[]));
    quantities.push(number("error_estimate", point.state.error_estimate));
    quantities
}

/// An event: where it is, and what happens.
fn event(branch: &Branch, event: &BranchEvent) -> Subject {
    let key = branch.key;
    let what = events::event(event.kind, key, &branch.drive);
    let word = |key, word: Option<&str>| Quantity::word(key, "", word.map(str::to_owned));
    let place = parameter(key, event.point.value, event.value_error);
    let mut quantities = vec![place.shown_as(key.name())];
    quantities.extend(parameter::error(key, event.value_error));
    quantities.extend([
        word("kind", Some(events::event_kind(event.kind))),
        word(
            "pulley",
            events::event_pulley(event.kind).map(words::pulley),
        ),
        word(
            "zone",
            events::event_zone(event.kind).map(|zone| zone.name()),
        ),
        Quantity::word("description", "event", what.clone()),
    ]);
    quantities.extend(point(branch, &event.point));
    quantities.push(limits::errors(event.errors.as_ref()));
    Subject::new(what, quantities)
}
