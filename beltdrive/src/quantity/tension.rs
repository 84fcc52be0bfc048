//! What there is to tell of the setup of a drive.

mod bands;

use super::check::{margin_error, slips_at, verdicts};
use super::precision::six_digits;
use super::{Answer, Group, Layout, Measure, Quantity, Subject};
use super::{belt_loop, warning};
use crate::belt_loop::LoopState;
use crate::{CaseState, Drive, Set, Setup};

/// A margin that is larger than the asked one by more than this share has not been met by more tension: it jumps there.
const JUMPS: f64 = 1e-4;

/// A load case of a drive that is set up: its name, the drive and its state.
type Case<'s> = (&'s str, &'s Drive, &'s CaseState);

/// The setup of a drive.
pub fn answer(found: &Setup) -> Answer {
    let service = &found.checked.service;
    let first = &service.cases[0].drive;
    let cases: Vec<Case<'_>> = { service.cases.iter().zip(&found.checked.cases) }
        .filter_map(|(stated, judged)| {
            let state = judged.outcome.as_deref().ok()?;
            Some((&*stated.name, &stated.drive, state))
        })
        .collect();
    let mut heading = belt_loop::heading(first);
    heading.push(String::new());
    heading.push(decided(found, first));
    heading.extend(
        verdicts(&found.checked)
            .into_iter()
            .filter(|line| line.contains("FAILS")),
    );
    let remarks = cases.iter().flat_map(|(name, drive, found)| {
        let messages = warning::messages(&found.state.warnings(drive)).into_iter();
        messages.map(move |message| format!("{name}: {message}"))
    });
    let mut groups = vec![
        Group::single("", belt_loop::statement(first)),
        Group::single("setup", setup(found, first, &cases)),
    ];
    groups.extend(travel(found, first));
    groups.push(Group::new(
        "cases",
        Layout::Beside,
        cases.iter().map(|&case| of_case(case)).collect(),
    ));
    groups.push(Group::new(
        "spans",
        Layout::Rows,
        spans(found, first, &cases),
    ));
    groups.push(Group::new(
        "friction",
        Layout::Columns,
        bands::friction(found),
    ));
    groups.push(Group::single("elongation", bands::elongation(found)));
    Answer {
        heading,
        remarks: remarks.collect(),
        groups,
        notes: Vec::new(),
    }
}

/// What decides, in a sentence.
fn decided(found: &Setup, drive: &Drive) -> String {
    let cases = &found.checked.service.cases;
    let of_case = match cases.len() {
        1 => String::new(),
        _ => format!(" in the load case `{}`", cases[found.deciding_case].name),
    };
    if let Some(error) = &found.ends_below {
        return format!("with less tension{of_case} {error}");
    }
    let pulley = slips_first(found).map_or_else(String::new, |pulley| {
        format!("pulley `{}`", drive.pulleys[pulley].name)
    });
    let asked = six_digits(found.question.slip_margin);
    let margin = deciding(found).and_then(slips_at);
    if margin.is_some_and(|margin| margin.value > found.question.slip_margin * (1.0 + JUMPS)) {
        return format!(
            "{pulley} decides{of_case}: with less tension it slips below {asked} times the load"
        );
    }
    format!("{pulley} decides{of_case}: it slips at {asked} times the load")
}

/// The case that decides.
fn deciding(found: &Setup) -> Option<&CaseState> {
    let outcome = &found.checked.cases[found.deciding_case].outcome;
    outcome.as_deref().ok()
}

/// The pulley that slips first in the case that decides.
fn slips_first(found: &Setup) -> Option<usize> {
    Some(slips_at(deciding(found)?)?.pulley)
}

/// A tension of the belt at rest and its share of a rib.
fn tension(found: &Setup, drive: &Drive) -> [Quantity; 2] {
    let error = found.accuracy * found.tension;
    let ribs = drive.belt.ribs;
    let per_rib = if ribs > 1 { "  per rib" } else { "" };
    [
        Quantity::number(
            "tension",
            "belt tension at rest, each strand",
            Measure::Force,
            found.tension,
            error,
        ),
        Quantity::number(
            "tension_per_rib",
            per_rib,
            Measure::Force,
            found.tension / f64::from(ribs),
            error / f64::from(ribs),
        ),
    ]
}

/// What has to be set, and what it costs.
fn setup(found: &Setup, drive: &Drive, cases: &[Case<'_>]) -> Vec<Quantity> {
    let relative = |key, label, measure, value: f64| {
        Quantity::number(key, label, measure, value, found.accuracy * value.abs())
    };
    let mut quantities = tension(found, drive).to_vec();
    quantities.push(relative(
        "belt_length_unstretched",
        "belt length, unstretched",
        Measure::Length,
        found.unstretched_length,
    ));
    quantities.extend(match found.setting {
        Set::FreeCoordinate {
            coordinate,
            is_angle: true,
        } => Some(relative(
            "free_angle",
            "free angle of the spring",
            Measure::Angle,
            coordinate,
        )),
        Set::FreeCoordinate {
            coordinate,
            is_angle: false,
        } => Some(relative(
            "free_position",
            "free position of the spring",
            Measure::Length,
            coordinate,
        )),
        Set::Weight(weight) => Some(relative(
            "weight",
            "weight of the tensioner",
            Measure::Force,
            weight,
        )),
        Set::Tension(_) => None,
    });
    let worst = |at_rest: bool| {
        let loads = cases.iter().map(|case| match at_rest {
            true => (case, case.2.rest_hub_load),
            false => (case, case.2.hub_load),
        });
        loads.max_by(|(_, one), (_, other)| one.value.total_cmp(&other.value))
    };
    let name = |pulley: usize| drive.pulleys[pulley].name.clone();
    let (rest, running) = (worst(true), worst(false));
    let load = |key, label, value: Option<f64>| {
        let error = found.accuracy * value.unwrap_or(0.0);
        Quantity::number(key, label, Measure::Force, value, error)
    };
    quantities.extend([
        Quantity::number(
            "slip_margin",
            "",
            Measure::Number,
            found.question.slip_margin,
            0.0,
        ),
        Quantity::word(
            "deciding_case",
            "",
            found.checked.service.cases[found.deciding_case]
                .name
                .clone(),
        ),
        Quantity::word("slips_first", "", slips_first(found).map(name)),
        Quantity::word(
            "ends_below",
            "",
            found
                .ends_below
                .as_ref()
                .map(|error| error.kind().to_owned()),
        ),
        load(
            "largest_hub_load_rest",
            "largest hub load at rest",
            rest.map(|(_, load)| load.value),
        ),
        Quantity::word(
            "largest_hub_load_rest_pulley",
            "  of",
            rest.map(|(_, load)| name(load.pulley)),
        ),
        load(
            "largest_hub_load",
            "largest hub load in motion",
            running.map(|(_, load)| load.value),
        ),
        Quantity::word(
            "largest_hub_load_pulley",
            "  of",
            running.map(|(_, load)| name(load.pulley)),
        ),
        Quantity::word(
            "largest_hub_load_case",
            "  in",
            running.map(|(case, _)| case.0.to_owned()),
        ),
    ]);
    quantities
}

/// How far the centre is moved.
fn travel(found: &Setup, drive: &Drive) -> Option<Group> {
    let travel = found.travel?;
    let name = &drive.pulleys[travel.pulley].name;
    let distance = |key, label: String, value: Option<f64>| {
        let error = found.accuracy * value.unwrap_or(0.0).abs();
        Quantity::number(key, label, Measure::Length, value, error)
    };
    let [x, y] = travel.direction;
    Some(Group::single(
        "travel",
        vec![
            Quantity::word("pulley", "", name.clone()),
            Quantity::number("direction", "", Measure::Angle, y.atan2(x), 0.0),
            distance(
                "from_free_belt",
                format!("travel of `{name}` from the free belt"),
                travel.from_free,
            ),
            distance(
                "for_elongation",
                format!(
                    "  farther, for {} of elongation",
                    Quantity::number("", "", Measure::Share, found.question.elongation, 0.0)
                        .shown(6.0)
                        .unwrap_or_default()
                ),
                travel.for_elongation,
            ),
        ],
    ))
}

/// What a tension gauge measures on each span.
fn spans(found: &Setup, drive: &Drive, cases: &[Case<'_>]) -> Vec<Subject> {
    let Some((_, _, first)) = cases.first() else {
        return Vec::new();
    };
    let state: &LoopState = &first.state;
    let count = drive.pulleys.len();
    let relative = |key, label, measure, value: Option<f64>| {
        let error = found.accuracy * value.unwrap_or(0.0).abs();
        Quantity::number(key, label, measure, value, error)
    };
    let rows = state.spans.iter().enumerate().map(|(index, span)| {
        let running = || cases.iter().map(|case| case.2.state.spans[index].frequency);
        let name = |pulley: usize| drive.pulleys[pulley % count].name.clone();
        Subject::new(
            "",
            vec![
                Quantity::word("from_pulley", "from", name(index)),
                Quantity::word("to_pulley", "to", name(index + 1)),
                relative(
                    "rest_length",
                    "length at rest",
                    Measure::Length,
                    Some(span.rest_length),
                ),
                relative(
                    "rest_frequency",
                    "frequency at rest",
                    Measure::Frequency,
                    Some(span.rest_frequency),
                ),
                relative(
                    "deflection",
                    "deflection",
                    Measure::Length,
                    Some(span.deflection),
                ),
                relative(
                    "deflection_force",
                    "under a force",
                    Measure::Force,
                    span.deflection_force,
                ),
                relative(
                    "lowest_frequency",
                    "running, lowest",
                    Measure::Frequency,
                    Some(running().fold(f64::INFINITY, f64::min)),
                ),
                relative(
                    "highest_frequency",
                    "highest",
                    Measure::Frequency,
                    Some(running().fold(0.0, f64::max)),
                ),
            ],
        )
    });
    rows.collect()
}

/// A load case of the drive so set up.
fn of_case((name, drive, found): Case<'_>) -> Subject {
    let scale = belt_loop::scale(&found.state);
    let pulley = |pulley: usize| drive.pulleys[pulley].name.clone();
    let margin = slips_at(found);
    let hub = found.hub_load;
    Subject::new(
        name,
        vec![
            Quantity::word("name", "", name.to_owned()),
            Quantity::number(
                "slip_margin",
                "slip margin",
                Measure::Number,
                margin.map(|margin| margin.value),
                margin.map_or(0.0, |margin| margin_error(&found.state) * margin.value),
            ),
            Quantity::word(
                "slips_first",
                "  slips first",
                margin.map(|margin| pulley(margin.pulley)),
            ),
            scale.force("largest_hub_load", "largest hub load", hub.value),
            Quantity::word("largest_hub_load_pulley", "  of", pulley(hub.pulley)),
        ],
    )
}
