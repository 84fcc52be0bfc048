//! What there is to tell of a drive in its load cases.

use super::precision::six_digits;
use super::scale::Scale;
use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value};
use super::{belt_loop, warning, words};
use crate::belt_loop::LoopState;
use crate::{
    CaseState, CheckedCase, CheckedService, Drive, Failing, LoadCase, OnPulley, Requirements,
    SlipMargin,
};

/// A load case with what was found in it.
type Case<'c> = (&'c LoadCase, &'c CheckedCase);

/// The load cases of a drive with their verdicts.
pub fn answer(checked: &CheckedService) -> Answer {
    let cases = || checked.service.cases.iter().zip(&checked.cases);
    let first = &checked.service.cases[0].drive;
    let mut heading = belt_loop::heading(first);
    heading.extend(required(&checked.service.requirements));
    heading.push(String::new());
    heading.extend(verdicts(checked));
    let remarks = cases().flat_map(|(stated, found)| {
        let warnings = found
            .outcome
            .as_ref()
            .map(|found| found.state.warnings(&stated.drive));
        let messages = warning::messages(&warnings.unwrap_or_default()).into_iter();
        let name = &stated.name;
        messages.map(move |message| format!("{name}: {message}"))
    });
    // The heading says them.
    let required = limits(&checked.service.requirements).into_iter();
    let mut groups = vec![
        Group::single("", belt_loop::statement(first)),
        Group::single("requirements", required.map(Quantity::unlabelled).collect()),
        Group::new("cases", Layout::Beside, cases().map(subject).collect()),
    ];
    groups.extend(over_time(checked));
    groups.push(rows(cases(), 0, &OF_PULLEY));
    groups.push(rows(cases(), 1, &OF_SPAN));
    let (_, of_speed) = words::speed_loss(first.belt.kind);
    Answer {
        heading,
        remarks: remarks.collect(),
        groups,
        notes: of_speed.into_iter().collect(),
    }
}

/// What there is to draw of each load case that has a state, and the number of the case from 1.
pub fn drawn(checked: &CheckedService) -> Vec<(usize, Answer)> {
    let cases = checked.service.cases.iter().zip(&checked.cases);
    let drawn = cases.enumerate().filter_map(|(index, (stated, found))| {
        let found = found.outcome.as_ref().ok()?;
        let mut answer = belt_loop::answer(&stated.drive, &found.state);
        if let Some(title) = answer.heading.first_mut() {
            *title = format!("{title}: {}", stated.name);
        }
        Some((index + 1, answer))
    });
    drawn.collect()
}

/// What is required, in a line.
fn required(requirements: &Requirements) -> Option<String> {
    let limits = limits(requirements);
    let limits = limits.iter().filter_map(|limit| {
        let word = if limit.key.starts_with("smallest") {
            "at least"
        } else {
            "at most"
        };
        let what = limit.label.split_once(' ').map_or("", |(_, what)| what);
        Some(format!("{what} {word} {}", limit.shown(6.0)?))
    });
    let limits: Vec<_> = limits.collect();
    (!limits.is_empty()).then(|| format!("required: {}", limits.join(", ")))
}

/// The requirements.
fn limits(requirements: &Requirements) -> Vec<Quantity> {
    let limit =
        |key, label, measure, value: Option<f64>| Quantity::number(key, label, measure, value, 0.0);
    let Requirements {
        smallest_slip_margin,
        largest_speed_loss,
        largest_hub_load,
        largest_tension,
    } = *requirements;
    vec![
        limit(
            "smallest_slip_margin",
            "smallest slip margin",
            Measure::Number,
            smallest_slip_margin,
        ),
        limit(
            "largest_speed_loss",
            "largest speed loss",
            Measure::Share,
            largest_speed_loss,
        ),
        limit(
            "largest_hub_load",
            "largest hub load",
            Measure::Force,
            largest_hub_load,
        ),
        limit(
            "largest_tension",
            "largest belt tension",
            Measure::Force,
            largest_tension,
        ),
    ]
}

/// The verdicts on all cases, in lines.
pub(super) fn verdicts(checked: &CheckedService) -> Vec<String> {
    let cases = checked.service.cases.iter().zip(&checked.cases);
    let count = checked.cases.len();
    cases.flat_map(|case| verdict(case, count)).collect()
}

/// Where the first pulley slips, if one does.
pub(super) fn slips_at(found: &CaseState) -> Option<OnPulley> {
    match found.slip_margin {
        SlipMargin::Factor(margin) => Some(margin),
        SlipMargin::NoLoad | SlipMargin::NotFound => None,
    }
}

/// The verdict on a case, one of so many, in lines.
fn verdict((stated, found): Case<'_>, count: usize) -> Vec<String> {
    let name = match count {
        1 => String::new(),
        _ => format!("{}: ", stated.name),
    };
    match reasons((stated, found)) {
        reasons if reasons.is_empty() => vec![format!("{name}holds")],
        reasons => { reasons.into_iter() }
            .map(|reason| format!("{name}FAILS, {reason}"))
            .collect(),
    }
}

/// Why a case does not hold, in words.
fn reasons((stated, found): Case<'_>) -> Vec<String> {
    match &found.outcome {
        Err(error) => vec![error.sentence()],
        Ok(state) => {
            let failures = found.failures.iter();
            failures
                .map(|failing| reason(failing, &stated.drive, state))
                .collect()
        }
    }
}

/// Why a requirement is not met, in words.
fn reason(failing: &Failing, drive: &Drive, state: &CaseState) -> String {
    let scale = belt_loop::scale(&state.state);
    let shown = |measure, value: f64, error: f64| {
        let quantity = Quantity::number("", "", measure, value, error);
        quantity.shown(6.0).unwrap_or_default()
    };
    let name = |found: OnPulley| &drive.pulleys[found.pulley].name;
    match *failing {
        Failing::SlipMargin { found, required } => match found {
            SlipMargin::Factor(found) => format!(
                "pulley `{}` slips at {} times the load, at least {} is required",
                name(found),
                shown(
                    Measure::Number,
                    found.value,
                    margin_error(&state.state) * found.value
                ),
                six_digits(required)
            ),
            SlipMargin::NoLoad | SlipMargin::NotFound => format!(
                "the load at which a pulley slips was not found, at least {} times the load is required",
                six_digits(required)
            ),
        },
        Failing::SpeedLoss { found, required } => format!(
            "pulley `{}` loses {} of its speed, at most {} is allowed",
            name(found),
            shown(Measure::Share, found.value, scale.error),
            shown(Measure::Share, required, 0.0)
        ),
        Failing::HubLoad {
            found,
            required,
            at_rest,
        } => format!(
            "the hub load of pulley `{}` {} is {}, at most {} is allowed",
            name(found),
            if at_rest { "at rest" } else { "in motion" },
            shown(Measure::Force, found.value, scale.error * scale.tension),
            shown(Measure::Force, required, 0.0)
        ),
        Failing::Tension {
            found,
            required,
            span,
        } => format!(
            "the belt tension {} is {}, at most {} is allowed",
            span.map_or_else(
                || "at rest".to_owned(),
                |span| format!("behind pulley `{}`", drive.pulleys[span].name)
            ),
            shown(Measure::Force, found, scale.error * scale.tension),
            shown(Measure::Force, required, 0.0)
        ),
    }
}

/// Relative error of a slip margin.
pub(super) fn margin_error(state: &LoopState) -> f64 {
    let error = state.load_limit.as_ref().map_or(0.0, |limit| limit.error);
    error.max(state.relative_error())
}

/// A load case as a column of the table.
fn subject((stated, found): Case<'_>) -> Subject {
    let state = found.outcome.as_deref().ok();
    let drive = &stated.drive;
    let name =
        |found: Option<OnPulley>| found.map(|found| drive.pulleys[found.pulley].name.clone());
    let scale = state.map_or_else(Scale::default, |found| belt_loop::scale(&found.state));
    let margin = state.and_then(slips_at);
    let is_margin_known = state.map(|found| match found.slip_margin {
        SlipMargin::Factor(_) => "found",
        SlipMargin::NoLoad => "no load",
        SlipMargin::NotFound => "not found",
    });
    let of = |value: fn(&CaseState) -> f64| state.map(value);
    let on = |place: fn(&CaseState) -> OnPulley| state.map(place);
    let (speed_loss, hub, rest) = (
        on(|found| found.speed_loss),
        on(|found| found.hub_load),
        on(|found| found.rest_hub_load),
    );
    // What is exactly 0 is not known to this belt or law.
    let loss = |key, label, value: Option<f64>| {
        scale.loss(key, label, value.filter(|&value| value != 0.0))
    };
    let lost = |value: fn(&crate::Losses) -> f64| state.map(|found| value(&found.losses));
    let given = state.and_then(|found| found.losses.given());
    let power_in = of(|found| found.state.power_in);
    let with_given = state.zip(given).and_then(|(found, given)| {
        let power_in = found.state.power_in + given;
        (power_in > 0.0).then(|| found.state.power_out / power_in)
    });
    let word = |key, label: &'static str, word: Option<String>| Quantity::word(key, label, word);
    let mut quantities = vec![
        word("name", "", Some(stated.name.clone())),
        word(
            "verdict",
            "verdict",
            Some(if found.holds() { "holds" } else { "FAILS" }.to_owned()),
        ),
        Quantity::number(
            "share",
            "share of the time",
            Measure::Share,
            stated.share,
            0.0,
        ),
        scale.relative(
            "driver_speed",
            "speed of the driver",
            Measure::AngularSpeed,
            drive.rim_speed() / drive.pulleys[drive.driver()].radius,
        ),
        scale.relative("power_in", "power in", Measure::Power, power_in),
        scale.relative(
            "power_out",
            "power out",
            Measure::Power,
            of(|found| found.state.power_out),
        ),
        scale.against(
            "efficiency",
            "efficiency",
            Measure::Share,
            state.and_then(|found| found.state.efficiency),
            1.0,
        ),
        scale.loss("power_loss", "power lost", lost(|losses| losses.total)),
        loss(
            "speed_power_loss",
            "  as speed",
            lost(|losses| losses.speed),
        ),
        loss(
            "torque_power_loss",
            "  as torque",
            lost(|losses| losses.torque),
        ),
        loss(
            "sliding_loss",
            "  in slip along the rims",
            lost(|losses| losses.sliding),
        ),
        loss(
            "wedging_loss",
            "  in slip in and out",
            lost(|losses| losses.wedging),
        ),
        loss(
            "elastic_loss",
            "  in elastic friction",
            lost(|losses| losses.elastic),
        ),
        loss(
            "compression_loss",
            "  in compression",
            lost(|losses| losses.compression),
        ),
        loss(
            "bending_loss",
            "bending, as given",
            state.and_then(|found| found.losses.bending),
        ),
        loss(
            "bearing_loss",
            "bearings, as given",
            state.and_then(|found| found.losses.bearings),
        ),
        scale.against(
            "efficiency_with_given_losses",
            "efficiency with these",
            Measure::Share,
            with_given,
            1.0,
        ),
        Quantity::number(
            "slip_margin",
            "slip margin",
            Measure::Number,
            margin.map(|margin| margin.value),
            state.zip(margin).map_or(0.0, |(found, margin)| {
                margin_error(&found.state) * margin.value
            }),
        ),
        word("slip_margin_status", "", is_margin_known.map(str::to_owned)),
        word("slips_first", "  slips first", name(margin)),
        scale.against(
            "speed_loss",
            words::speed_loss(drive.belt.kind).0,
            Measure::Share,
            speed_loss.map(|found| found.value),
            1.0,
        ),
        word("speed_loss_pulley", "  at", name(speed_loss)),
        scale.force(
            "largest_hub_load",
            "largest hub load",
            hub.map(|found| found.value),
        ),
        word("largest_hub_load_pulley", "  of", name(hub)),
        scale.force(
            "largest_hub_load_rest",
            "largest hub load at rest",
            rest.map(|found| found.value),
        ),
        word("largest_hub_load_rest_pulley", "  of", name(rest)),
    ];
    quantities.push(Quantity::json("failures", reasons((stated, found))));
    quantities.push(Quantity::word(
        "error",
        "",
        found
            .outcome
            .as_ref()
            .err()
            .map(|error| error.kind().to_owned()),
    ));
    if let Some(found) = state {
        quantities.extend(whole(drive, found));
    }
    Subject::new(&*stated.name, quantities)
}

/// The pulleys, the spans and the loop of a load case, for programs.
fn whole(drive: &Drive, found: &CaseState) -> [Quantity; 3] {
    belt_loop::groups(drive, &found.state).map(|group| {
        let mut subjects = group.subjects;
        for subject in &mut subjects {
            let is_along = |quantity: &Quantity| matches!(quantity.value, Value::Series(_));
            subject.quantities.retain(|quantity| !is_along(quantity));
        }
        let value = match (group.layout, &mut subjects[..]) {
            (Layout::Single, [one]) => Value::Object(Some(std::mem::take(&mut one.quantities))),
            _ => Value::List(subjects),
        };
        Quantity::data(group.key, Measure::Number, value)
    })
}

/// The pulleys of all load cases, or their spans, below each other, with these of their quantities.
fn rows<'c>(
    cases: impl Iterator<Item = Case<'c>>,
    of: usize,
    shown: &[(&str, &'static str)],
) -> Group {
    let rows = cases.flat_map(|(stated, found)| {
        let state = found.outcome.as_deref().ok();
        let groups = state.map(|found| belt_loop::groups(&stated.drive, &found.state));
        let subjects = groups.map_or_else(Vec::new, |groups| {
            let mut groups = groups.to_vec();
            groups.swap_remove(of).subjects
        });
        subjects.into_iter().map(|subject| {
            let case = Quantity::word("", "load case", stated.name.clone());
            let of_subject = shown
                .iter()
                .filter_map(|&(key, label)| Some(subject.quantity(key)?.clone().shown_as(label)));
            Subject::new(
                subject.head.clone(),
                [case].into_iter().chain(of_subject).collect(),
            )
        })
    });
    Group::new("", Layout::Rows, rows.collect())
}

/// The quantities of a pulley in a row, and those of a span.
const OF_PULLEY: [(&str, &str); 9] = [
    ("name", "pulley"),
    ("angular_speed", "speed"),
    ("torque", "torque"),
    ("power", "power"),
    ("wrap_angle", "wrap"),
    ("torque_margin", "torque margin"),
    ("speed_loss", "speed loss"),
    ("hub_load_magnitude", "hub load"),
    ("hub_load_rest_magnitude", "at rest"),
];
const OF_SPAN: [(&str, &str); 7] = [
    ("from_pulley", "from"),
    ("to_pulley", "to"),
    ("tension", "belt tension T"),
    ("tractive_tension", "tractive tension F"),
    ("length", "length"),
    ("frequency", "first frequency"),
    ("rest_frequency", "at rest"),
];

/// What the load cases make together, by their shares of the time.
fn over_time(checked: &CheckedService) -> Option<Group> {
    let cases = checked.over_time()?;
    let mean = |of: fn(&CaseState) -> f64| {
        cases
            .iter()
            .map(|&(share, found)| share * of(found))
            .sum::<f64>()
    };
    let [power_in, power_out, given] = [
        mean(|found| found.state.power_in),
        mean(|found| found.state.power_out),
        mean(|found| found.losses.given().unwrap_or(0.0)),
    ];
    let scales = cases
        .iter()
        .map(|(_, found)| belt_loop::scale(&found.state));
    let scale = scales.fold(Scale::default(), |one, other| Scale {
        error: one.error.max(other.error),
        tension: one.tension.max(other.tension),
        power: one.power.max(other.power),
    });
    let share = |key, label, input: f64| {
        let share = (input > 0.0).then(|| power_out / input);
        scale.against(key, label, Measure::Share, share, 1.0)
    };
    let mut quantities = vec![
        scale.power("power_in", "power in, over the time", power_in),
        scale.power("power_out", "power out", power_out),
        share("efficiency", "efficiency", power_in),
    ];
    if given > 0.0 {
        quantities.push(share(
            "efficiency_with_given_losses",
            "efficiency with given losses",
            power_in + given,
        ));
    }
    Some(Group::single("over_time", quantities))
}
