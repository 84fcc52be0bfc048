//! What there is to tell of the states of a loop over a number of its drive file.

use super::belt_loop;
use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value, warning};
use crate::belt_loop::{
    LoopBranch, LoopEnd, LoopLimit, LoopLimitCurve, LoopLimits, LoopPoint, Varied,
};

/// A branch of states: a row for each.
pub fn branch(branch: &LoopBranch) -> Answer {
    let Some(first) = branch.points.first() else {
        return Answer::default();
    };
    let points = branch.points.iter();
    let points = points.map(|point| row(vec![parameter(&branch.varied, point)], point));
    Answer {
        heading: heading(first, &format!("States over {}", branch.varied.name())),
        groups: vec![
            Group::single("", statement(first, &branch.varied)),
            Group::new("points", Layout::Rows, points.collect()),
            Group::single("end", end(branch.end.as_ref())),
        ],
        notes: vec![ended("branch", branch.end.as_ref())],
        ..Answer::default()
    }
}

/// Both ends of a range beside each other.
pub fn limits(limits: &LoopLimits) -> Answer {
    let ends = [("smallest", &limits.smallest), ("largest", &limits.largest)];
    let asked = format!("Limits of {}", limits.varied.name());
    let mut heading = heading(&limits.smallest.point, &asked);
    heading.extend(ends.map(|(word, limit)| format!("{word}: {}", limit.end)));
    let remarks = ends.iter().flat_map(|(word, limit)| {
        let LoopPoint { drive, state, .. } = &limit.point;
        let remarks = warning::messages(&state.warnings(drive)).into_iter();
        remarks.map(move |remark| format!("{word}: {remark}"))
    });
    let subjects = ends.map(|(word, limit)| Subject {
        head: word.to_owned(),
        ..row(limited(&limits.varied, limit), &limit.point)
    });
    Answer {
        heading,
        remarks: remarks.collect(),
        groups: vec![
            Group::single("", statement(&limits.smallest.point, &limits.varied)),
            Group::new("", Layout::Named, subjects.to_vec()),
        ],
        ..Answer::default()
    }
}

/// A curve of limits: a row for each.
pub fn limit_curve(curve: &LoopLimitCurve) -> Answer {
    let Some(first) = curve.points.first() else {
        return Answer::default();
    };
    let second = Varied::Key(curve.second.clone());
    let points = curve.points.iter().map(|point| {
        let over = number(&second, point.second, 0.0);
        let limit = limited(&curve.varied, &point.limit);
        row([vec![over], limit].concat(), &point.limit.point)
    });
    let asked = format!("Limit of {} over {}", curve.varied.name(), second.name());
    let mut statement = statement(&first.limit.point, &curve.varied);
    statement.push(Quantity::word("curve", "", second.name()));
    Answer {
        heading: heading(&first.limit.point, &asked),
        groups: vec![
            Group::single("", statement),
            Group::new("points", Layout::Rows, points.collect()),
            Group::single("end", end(curve.end.as_ref())),
        ],
        notes: vec![ended("curve", curve.end.as_ref())],
        ..Answer::default()
    }
}

/// What the loop is, and what is asked of it.
fn heading(point: &LoopPoint, asked: &str) -> Vec<String> {
    let mut lines = belt_loop::heading(&point.drive);
    lines.push(asked.to_owned());
    lines
}

/// What was asked, for programs.
fn statement(point: &LoopPoint, varied: &Varied) -> Vec<Quantity> {
    let mut statement = belt_loop::statement(&point.drive);
    statement.push(Quantity::word("parameter", "", varied.name()));
    statement
}

/// What varies.
fn parameter(varied: &Varied, point: &LoopPoint) -> Quantity {
    number(varied, point.value, point.value_error)
}

fn number(varied: &Varied, value: f64, error: f64) -> Quantity {
    let name = varied.name().replace(['.', '_'], " ");
    // A chosen number has all its digits.
    let error = error.max(f64::EPSILON * value.abs());
    Quantity::number(varied.key(), name, varied.measure(), value, error)
}

/// A limit and why it is one.
fn limited(varied: &Varied, limit: &LoopLimit) -> Vec<Quantity> {
    let error = limit.point.value_error;
    vec![
        parameter(varied, &limit.point),
        Quantity::number("value_error", "", varied.measure(), error, 0.0),
        Quantity::word("reason", "reason", limit.end.kind().to_owned()),
        Quantity::word("description", "", limit.end.to_string()),
    ]
}

/// Why a branch or a curve ends, for people.
fn ended(what: &str, end: Option<&LoopEnd>) -> String {
    match end {
        None => format!("end of the {what}: the end of the range"),
        Some(end) => format!("end of the {what}: {end}"),
    }
}

/// Why a branch or a curve ends, for programs.
fn end(end: Option<&LoopEnd>) -> Vec<Quantity> {
    let reason = end.map_or("target", LoopEnd::kind);
    let description = end.map_or("the end of the range".to_owned(), LoopEnd::to_string);
    vec![
        Quantity::word("reason", "", reason.to_owned()),
        Quantity::word("description", "", description),
    ]
}

/// A state in a row: first what varies, then what of the state is shown, then the rest of it for programs.
fn row(first: Vec<Quantity>, point: &LoopPoint) -> Subject {
    let answer = belt_loop::answer(&point.drive, &point.state);
    let groups = answer.groups.into_iter();
    let mut groups: Vec<_> = groups
        .filter(|group| !["", "checks", "convergence"].contains(&group.key))
        .collect();
    for subject in groups.iter_mut().flat_map(|group| &mut group.subjects) {
        let is_series = |quantity: &Quantity| matches!(quantity.value, Value::Series(_));
        subject.quantities.retain(|quantity| !is_series(quantity));
    }
    let mut quantities = first;
    quantities.extend(shown(point));
    quantities.extend(groups.into_iter().map(|group| {
        let subjects = Value::List(group.subjects);
        Quantity::data(group.key, Measure::Number, subjects)
    }));
    Subject::new("", quantities)
}

/// What of a state is shown in a row.
fn shown(point: &LoopPoint) -> [Quantity; 5] {
    let state = &point.state;
    let scale = belt_loop::scale(state);
    let tractive = state.spans.iter().map(|span| span.tractive_tension);
    let smallest = tractive.fold(f64::INFINITY, f64::min);
    let limit = state.load_limit.as_ref();
    let limit_scale = scale.with(limit.map_or(0.0, |limit| limit.error));
    let slips = limit.map(|limit| state.pulleys[limit.pulley].name.clone());
    [
        scale.force("largest_tension", "largest T", scale.tension),
        scale.force("smallest_tractive_tension", "smallest F", smallest),
        scale.against(
            "efficiency",
            "efficiency",
            Measure::Share,
            state.efficiency,
            1.0,
        ),
        limit_scale.relative(
            "load_factor_limit",
            "load factor limit",
            Measure::Number,
            limit.map(|limit| limit.factor),
        ),
        Quantity::word("limiting_pulley", "slips first", slips),
    ]
}
