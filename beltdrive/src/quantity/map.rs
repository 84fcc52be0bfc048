//! What there is to tell of the states over a rectangle of two numbers of a drive file.

use super::{Answer, Group, Layout, Measure, Quantity, Subject, belt_loop};
use crate::belt_loop::{Refusal, Refusals, Varied};
use crate::{MapAxis, MapState, OperatingMap, SlipMargin};

/// A number of every state of a map.
#[derive(Clone, Copy)]
pub(crate) struct Scalar {
    pub(crate) key: &'static str,
    pub(crate) label: &'static str,
    pub(crate) measure: Measure,
    /// The number, SI, if the state has it.
    pub(crate) of: fn(&MapState) -> Option<f64>,
}

const fn scalar(
    key: &'static str,
    label: &'static str,
    measure: Measure,
    of: fn(&MapState) -> Option<f64>,
) -> Scalar {
    Scalar {
        key,
        label,
        measure,
        of,
    }
}

/// The numbers, in the order in which they are told.
pub(crate) const SCALARS: [Scalar; 12] = [
    scalar("speed_loss", "speed loss", Measure::Share, |state| {
        Some(state.speed_loss.value)
    }),
    scalar("efficiency", "efficiency", Measure::Share, |state| {
        state.efficiency
    }),
    scalar(
        "slip_margin",
        "slip margin",
        Measure::Number,
        |state| match state.slip_margin {
            SlipMargin::Factor(margin) => Some(margin.value),
            SlipMargin::NoLoad | SlipMargin::NotFound => None,
        },
    ),
    scalar("hub_load", "largest hub load", Measure::Force, |state| {
        Some(state.hub_load.value)
    }),
    scalar("rest_hub_load", "  at rest", Measure::Force, |state| {
        Some(state.rest_hub_load.value)
    }),
    scalar("largest_tension", "largest T", Measure::Force, |state| {
        Some(state.largest_tension)
    }),
    scalar(
        "smallest_tractive_tension",
        "smallest F",
        Measure::Force,
        |state| Some(state.smallest_tractive_tension),
    ),
    scalar("rest_tension", "T at rest", Measure::Force, |state| {
        Some(state.rest_tension)
    }),
    scalar("power_in", "power in", Measure::Power, |state| {
        Some(state.power_in)
    }),
    scalar("power_out", "power out", Measure::Power, |state| {
        Some(state.power_out)
    }),
    scalar(
        "power_lost_by_speed",
        "lost by speed",
        Measure::Loss,
        |state| Some(state.losses.speed),
    ),
    scalar(
        "power_lost_by_torque",
        "lost by torque",
        Measure::Loss,
        |state| Some(state.losses.torque),
    ),
];

/// The map: where each number is smallest and largest, and all points for programs.
pub fn answer(map: &OperatingMap) -> Answer {
    let solved = map.points.iter().filter(|point| point.is_ok()).count();
    let [x, y] = [&map.x, &map.y].map(|axis| axis.varied.name());
    let [columns, rows] = [&map.x, &map.y].map(|axis| axis.values.len());
    let mut heading = belt_loop::heading(&map.drive);
    heading.push(format!(
        "Map of {columns} × {rows} points over {x} and {y}: {solved} of {} have a steady state",
        columns * rows
    ));
    let points = map.rows().map(|(values, point)| row(map, values, point));
    Answer {
        heading,
        groups: vec![
            Group::single("", belt_loop::statement(&map.drive)),
            Group::single("x", axis(&map.x)),
            Group::single("y", axis(&map.y)),
            Group::new("points", Layout::Rows, points.collect()),
            Group::new("", Layout::Columns, extremes(map)),
        ],
        notes: refusals(map),
        ..Answer::default()
    }
}

/// What varies along an axis, for programs.
fn axis(axis: &MapAxis) -> Vec<Quantity> {
    vec![
        Quantity::word("parameter", "", axis.varied.name()),
        Quantity::count("values", "", axis.values.len()),
    ]
}

/// A value on an axis.
pub(crate) fn place(varied: &Varied, value: f64, label: String) -> Quantity {
    // A chosen number has all its digits.
    let error = f64::EPSILON * value.abs();
    Quantity::number(varied.key(), label, varied.measure(), value, error)
}

/// A number of a state.
fn number(scalar: &Scalar, state: &MapState) -> Quantity {
    let value = (scalar.of)(state);
    let size = match scalar.measure {
        Measure::Share => 1.0,
        Measure::Force => state.largest_tension,
        Measure::Power | Measure::Loss => state.power_in,
        _ => value.unwrap_or(0.0),
    };
    let error = state.error * size;
    Quantity::number(scalar.key, scalar.label, scalar.measure, value, error)
}

/// A point, for programs.
fn row(map: &OperatingMap, values: [f64; 2], point: &Result<MapState, Refusal>) -> Subject {
    let axes = [&map.x, &map.y].into_iter().zip(values);
    let mut quantities: Vec<_> = axes
        .map(|(axis, value)| place(&axis.varied, value, String::new()))
        .collect();
    quantities.extend(SCALARS.iter().map(|scalar| match point {
        Ok(state) => number(scalar, state).unlabelled(),
        Err(_) => Quantity::number(scalar.key, "", scalar.measure, None, 0.0),
    }));
    let refusal = point.as_ref().err();
    let state = point.as_ref().ok();
    let slips = state.and_then(|state| state.slips_first(&map.drive));
    quantities.extend([
        Quantity::word("slips_first", "", slips),
        Quantity::word(
            "reason",
            "",
            refusal.map(|refusal| refusal.kind().to_owned()),
        ),
        Quantity::word("description", "", refusal.map(Refusal::to_string)),
    ]);
    Subject::new("", quantities)
}

/// The smallest and the largest value of each number, with their places.
fn extremes(map: &OperatingMap) -> Vec<Subject> {
    let subjects = [("smallest", 1.0), ("largest", -1.0)].map(|(head, sign)| {
        let quantities = SCALARS.iter().flat_map(|scalar| {
            let known = map.rows().filter_map(|(values, point)| {
                let state = point.as_ref().ok()?;
                let value = (scalar.of)(state)?;
                Some((values, value, state))
            });
            let found = known.min_by(|one, other| (sign * one.1).total_cmp(&(sign * other.1)));
            let at = |axis: &MapAxis, value: Option<f64>| {
                let label = format!("  at {}", axis.varied.name());
                match value {
                    Some(value) => place(&axis.varied, value, label),
                    None => {
                        Quantity::number(axis.varied.key(), label, axis.varied.measure(), None, 0.0)
                    }
                }
            };
            let number = match found {
                Some((_, _, state)) => number(scalar, state),
                None => Quantity::number(scalar.key, scalar.label, scalar.measure, None, 0.0),
            };
            let at_x = at(&map.x, found.map(|(values, ..)| values[0]));
            let at_y = at(&map.y, found.map(|(values, ..)| values[1]));
            [
                number.shown_as(scalar.label.trim_start().to_owned()),
                at_x,
                at_y,
            ]
        });
        Subject::new(head, quantities.collect())
    });
    subjects.to_vec()
}

/// How many points have no steady state for which reason, with the first of them.
fn refusals(map: &OperatingMap) -> Vec<String> {
    let mut refusals = Refusals::default();
    for refusal in map.points.iter().filter_map(|point| point.as_ref().err()) {
        refusals.add(refusal);
    }
    without_state(&refusals, ["point", "points"])
}

/// How many of what a map or a sweep consists of have no answer for which reason, with the first of them.
pub(super) fn without_state(refusals: &Refusals, [one, several]: [&str; 2]) -> Vec<String> {
    let lines = refusals.by_reason().map(|(kind, count, first)| {
        let what = if count == 1 { one } else { several };
        format!("no state at {count} {what}: {kind}, first: {first}")
    });
    lines.collect()
}
