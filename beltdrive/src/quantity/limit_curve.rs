//! What there is to tell of a limit of a drive with two pulleys over a second number of its drive file.

use super::events as reasons;
use super::parameter::{self, parameter};
use super::scalars::Scalars;
use super::two_pulleys::{self, is_v};
use super::{Answer, Group, Layout, Measure, Quantity, Subject, words};
use crate::{LimitCurve, LimitCurvePoint};

/// What is shown of a state of a V-belt and of a flat belt in a row.
const OF_V_BELT: &[(&str, &str)] = &[
    ("driven_angular_speed", "driven speed"),
    ("driven_torque", "driven torque"),
    ("efficiency", "efficiency"),
    ("driver_exit_inclination", "exit of driver"),
];
const OF_FLAT_BELT: &[(&str, &str)] = &[
    ("driven_angular_speed", "driven speed"),
    ("driven_torque", "driven torque"),
    ("efficiency", "efficiency"),
    ("driver_slip_arc", "slip driver"),
    ("driven_slip_arc", "slip driven"),
];

/// The curve: a row for each limit, its cusps, why it ends and what it took.
pub fn answer(curve: &LimitCurve) -> Answer {
    let LimitCurve { key, second, .. } = *curve;
    let (paths, count) = ([key, second].map(|key| key.path()), curve.points.len());
    let mut heading = words::title(&curve.drive, &[key, second]);
    heading.push(format!(
        "Limit of {} over {}: {count} limits",
        paths[0], paths[1]
    ));
    let mut statement = two_pulleys::statement(&curve.drive);
    statement.extend(parameter::statement(key));
    statement.extend([
        Quantity::word("second_parameter", "", second.path().to_owned()),
        Quantity::word("second_unit", "", second.unit().to_owned()),
    ]);
    let points = curve.points.iter();
    let points = points.map(|point| Subject::new("", self::point(curve, point)));
    let cusps = curve.cusps.iter().map(|cusp| {
        let what = "two limit points meet and vanish".to_owned();
        let cusp = point(curve, cusp).into_iter().enumerate();
        let mut quantities: Vec<_> = cusp
            .map(|(place, quantity)| match place < 2 {
                true => quantity,
                false => quantity.unlabelled(),
            })
            .collect();
        quantities.push(Quantity::word("", "cusp", what.clone()));
        Subject::new(format!("cusp: {what}"), quantities)
    });
    let convergence = parameter::convergence(&curve.drive, &curve.convergence);
    Answer {
        heading,
        groups: vec![
            Group::single("", statement),
            Group::new("points", Layout::Rows, points.collect()),
            Group::new("cusps", Layout::Rows, cusps.collect()),
            Group::single("end", parameter::end(&curve.end)),
            Group::single("convergence", convergence),
        ],
        notes: vec![format!("end of the curve: {}", curve.end)],
        ..Answer::default()
    }
}

/// A limit.
fn point(curve: &LimitCurve, point: &LimitCurvePoint) -> Vec<Quantity> {
    let LimitCurve { key, second, .. } = *curve;
    let mut drive = curve.drive.clone();
    key.set(&mut drive, point.value);
    second.set(&mut drive, point.second);
    let pulley = reasons::limit_pulley(point.reason).map(words::pulley);
    let word = |key, label, word: &str| Quantity::word(key, label, word.to_owned());
    let [error, _] = parameter::error(key, point.value_error);
    let shown = match is_v(&drive) {
        true => OF_V_BELT,
        false => OF_FLAT_BELT,
    };
    let mut quantities = vec![
        parameter(second, point.second, None),
        parameter(key, point.value, point.value_error),
        error,
        word("reason", "", reasons::limit_kind(point.reason)),
        Quantity::word("pulley", "", pulley.map(str::to_owned)),
        word("description", "", &point.reason.to_string()),
        Quantity::json("second_value", second.reported(point.second)),
        Quantity::json("value", key.reported(point.value)),
    ];
    let tolerance = curve.convergence.tolerance;
    let scalars = Scalars::of(&drive, &point.state, tolerance, None);
    quantities.extend(scalars.row(shown));
    quantities.extend([
        Quantity::number(
            "error_estimate",
            "",
            Measure::Number,
            point.state.error_estimate,
            0.0,
        ),
        word("", "reason", reasons::limit_label(point.reason)),
    ]);
    quantities.extend(two_pulleys::convention(&drive));
    quantities
}
