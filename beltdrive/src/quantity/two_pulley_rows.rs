//! What there is to draw of branches of a drive with two pulleys, and of its limits: a row for each state.

use super::as_loop::heading;
use super::events as words;
use super::words::slip_arc;
use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value};
use crate::input::Key;
use crate::{
    BeltKind, Branch, Drive, EventKind, LimitCurve, LimitCurvePoint, PulleySummary, StateSummary,
};

/// A branch of states with what happens along it.
pub fn branch(branch: &Branch) -> Answer {
    let rows = branch.rows().into_iter().map(|(point, event)| {
        let error = event.and_then(|event| event.value_error);
        let mut row = vec![number(branch.key, point.value, error)];
        row.extend(scalars(&branch.drive, &point.state));
        row.extend(event.into_iter().flat_map(|event| {
            let kind = match event.kind {
                EventKind::LimitPoint => "fold",
                _ => "event",
            };
            let words = words::event(event.kind, branch.key, &branch.drive);
            [("event", kind.to_owned()), ("description", words)]
                .map(|(key, word)| Quantity::word(key, "", Some(word)))
        }));
        row
    });
    let caption = format!("Branch over the {}", branch.key.name());
    answer(&branch.drive, &[branch.key], caption, rows.collect())
}

/// A curve of limits, and its cusps.
pub fn limit_curve(curve: &LimitCurve) -> Answer {
    let LimitCurve { key, second, .. } = *curve;
    let row = |point: &LimitCurvePoint, kind, word: &str| {
        vec![
            number(second, point.second, None),
            number(key, point.value, point.value_error),
            Quantity::word(kind, "", Some(word.to_owned())),
        ]
    };
    let points = curve.points.iter();
    let points = points.map(|point| row(point, "reason", words::limit_label(point.reason)));
    let cusps = curve.cusps.iter().map(|cusp| {
        let mut row = row(cusp, "event", "cusp");
        let words = "cusp: two limit points meet and vanish".to_owned();
        row.push(Quantity::word("description", "", Some(words)));
        row
    });
    let caption = format!("Limit of the {} over the {}", key.name(), second.name());
    let rows = points.chain(cusps).collect();
    answer(&curve.drive, &[key, second], caption, rows)
}

fn answer(drive: &Drive, varied: &[Key], caption: String, rows: Vec<Vec<Quantity>>) -> Answer {
    let mut heading = heading(drive, varied);
    heading.insert(1, caption);
    let subjects = rows.into_iter().map(|quantities| Subject {
        head: String::new(),
        quantities,
    });
    Answer {
        heading,
        groups: vec![Group {
            key: "points",
            layout: Layout::Rows,
            subjects: subjects.collect(),
        }],
        ..Answer::default()
    }
}

/// The value of an entry.
fn number(key: Key, value: f64, error: Option<f64>) -> Quantity {
    Quantity::number(
        key.path(),
        key.name(),
        key.measure(),
        value,
        error.unwrap_or(0.0),
    )
}

/// What varies along a branch.
fn scalars(drive: &Drive, state: &StateSummary) -> [Quantity; 3] {
    let number = |key, label, measure, value| Quantity::number(key, label, measure, value, 0.0);
    let pulley = |name: &str, pulley: &PulleySummary| {
        let mut quantities = vec![
            number(
                "wrap_angle",
                "wrap angle",
                Measure::Angle,
                pulley.wrap_angle,
            ),
            number("torque", "torque", Measure::Torque, pulley.torque),
            number(
                "slip_arc",
                "slip arc",
                Measure::Angle,
                slip_arc(&pulley.zones),
            ),
        ];
        if let BeltKind::V(_) = drive.belt.kind {
            let label = "inclination at exit";
            let exit = pulley.inclination[1];
            quantities.push(number("exit_inclination", label, Measure::Angle, exit));
        }
        Subject {
            head: name.to_owned(),
            quantities,
        }
    };
    let pulleys = vec![
        pulley("driver", &state.driver),
        pulley("driven pulley", &state.driven),
    ];
    [
        number(
            "driven_speed",
            "speed of the driven pulley",
            Measure::AngularSpeed,
            state.driven.angular_speed,
        ),
        number("efficiency", "efficiency", Measure::Share, state.efficiency),
        Quantity::data("pulleys", Measure::Number, Value::List(pulleys)),
    ]
}
