//! What there is to tell of the steady state of a belt loop.

mod pulley;
mod statement;
mod tensioner;

pub(crate) use pulley::along;
pub(crate) use statement::{heading, statement};

use super::scale::Scale;
use super::{Answer, Group, Layout, Measure, Quantity, Subject, warning, words};
use crate::belt_loop::{LoopConvergence, LoopState, SpanState};
use crate::{Check, Drive};

/// The steady state of a loop.
pub fn answer(drive: &Drive, state: &LoopState) -> Answer {
    let mut groups = vec![Group::single("", statement(drive))];
    groups.extend(self::groups(drive, state));
    if let (Some((_, tensioner)), Some(found)) = (drive.tensioner(), &state.tensioner) {
        let name = &state.pulleys[found.pulley].name;
        let quantities = tensioner::quantities(name, &tensioner.guide, found, &scale(state));
        groups.push(Group::single("tensioner", quantities));
    }
    let warnings = state.warnings(drive);
    let (_, of_speed) = words::speed_loss(drive.belt.kind);
    groups.push(warning::group(&warnings));
    let checks = state.checks.iter().map(check).collect();
    groups.push(Group::new("checks", Layout::Columns, checks));
    if let Some(found) = &state.convergence {
        groups.push(Group::single("convergence", convergence(found)));
    }
    Answer {
        heading: heading(drive),
        remarks: warning::messages(&warnings),
        groups,
        notes: of_speed
            .into_iter()
            .chain(state.checks.iter().map(words::check))
            .collect(),
    }
}

/// The groups `pulleys`, `spans` and `loop`.
pub(super) fn groups(drive: &Drive, state: &LoopState) -> [Group; 3] {
    let scale = scale(state);
    let count = state.pulleys.len();
    let pulleys = (0..count).map(|index| pulley::subject(drive, state, index, &scale));
    let spans = state.spans.iter().enumerate().map(|(index, span)| {
        let names = [index, (index + 1) % count].map(|pulley| &*state.pulleys[pulley].name);
        self::span(drive, names, span, &scale)
    });
    [
        Group::new("pulleys", Layout::Columns, pulleys.collect()),
        Group::new("spans", Layout::Columns, spans.collect()),
        Group::single("loop", whole(drive, state, &scale)),
    ]
}

/// A verified invariant, for programs.
pub(super) fn check(check: &Check) -> Subject {
    let number = |key, value| Quantity::number(key, "", Measure::Number, value, 0.0);
    let name = Quantity::word("name", "", check.name.to_owned());
    let numbers = [
        number("deviation", check.deviation),
        number("limit", check.limit),
    ];
    Subject::new("", [name].into_iter().chain(numbers).collect())
}

/// How a state was found and how accurate it is.
fn convergence(found: &LoopConvergence) -> Vec<Quantity> {
    let error = |key, label, value: f64| Quantity::error(key, label, Measure::Number, value);
    let count = Quantity::count;
    let is_regularised = found.slip_normalisation > 0.0;
    let effect = match is_regularised {
        true => words::effect_of_smoothing(found.slip_normalisation),
        false => String::new(),
    };
    vec![
        error("tolerance", "relative tolerance", found.tolerance),
        error("error_estimate", "estimated error", found.error_estimate),
        error("defect", "largest defect", found.defect),
        error("slip_normalisation", "", found.slip_normalisation),
        Quantity::error(
            "slip_normalisation_effect",
            effect,
            Measure::Number,
            found.slip_normalisation_effect,
        ),
        count("mesh_intervals", "mesh intervals", found.mesh_intervals),
        count("newton_steps", "Newton steps", found.newton_steps),
        count("problems", "", found.problems),
    ]
}

/// How accurate the numbers of a state are.
pub(super) fn scale(state: &LoopState) -> Scale {
    let tensions = state.spans.iter().map(|span| span.tension);
    let tension = tensions.fold(0.0, f64::max);
    Scale {
        error: state.relative_error(),
        tension,
        power: tension * state.unstretched_speed,
    }
}

fn span(drive: &Drive, [from, to]: [&str; 2], span: &SpanState, scale: &Scale) -> Subject {
    let ribs = f64::from(drive.belt.ribs);
    let length = |key, label, value| scale.relative(key, label, Measure::Length, value);
    let frequency = |key, label, value| scale.relative(key, label, Measure::Frequency, value);
    Subject::new(
        from,
        vec![
            Quantity::word("from_pulley", "", from.to_owned()),
            Quantity::word("to_pulley", "span from there to", to.to_owned()),
            scale.force("tension", "belt tension T", span.tension),
            scale.force(
                "tension_per_rib",
                if drive.belt.ribs > 1 { "T per rib" } else { "" },
                span.tension / ribs,
            ),
            scale.force(
                "tractive_tension",
                "tractive tension F",
                span.tractive_tension,
            ),
            length("length", "length", span.length),
            scale.angle("direction", "", span.direction),
            scale.relative("speed", "", Measure::Velocity, span.speed),
            frequency("frequency", "first frequency", span.frequency),
            length("rest_length", "", span.rest_length),
            frequency("rest_frequency", "  at rest", span.rest_frequency),
            length("deflection", "deflection at rest", span.deflection),
            scale.relative(
                "deflection_force",
                "  under a force of",
                Measure::Force,
                span.deflection_force,
            ),
        ],
    )
}

fn whole(drive: &Drive, state: &LoopState, scale: &Scale) -> Vec<Quantity> {
    let length = |key, label, value| scale.relative(key, label, Measure::Length, value);
    let limit = state.load_limit.as_ref();
    let limit_scale = scale.with(limit.map_or(0.0, |limit| limit.error));
    vec![
        length(
            "belt_length_unstretched",
            "belt length, unstretched",
            state.unstretched_length,
        ),
        length("belt_length_running", "belt length, running", state.length),
        scale.relative("mass_flow", "mass flow", Measure::MassFlow, state.mass_flow),
        scale.relative(
            "unstretched_speed",
            "speed of unstretched belt",
            Measure::Velocity,
            state.unstretched_speed,
        ),
        scale.force("rest_tension", "belt tension at rest", state.rest_tension),
        scale.relative("power_in", "power in", Measure::Power, state.power_in),
        scale.relative("power_out", "power out", Measure::Power, state.power_out),
        scale.loss("power_loss", "friction loss", state.power_loss),
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
        Quantity::word(
            "limiting_pulley",
            "  where slips first",
            limit.map(|limit| state.pulleys[limit.pulley].name.clone()),
        ),
        scale.relative("ribs", "", Measure::Number, f64::from(drive.belt.ribs)),
        scale.relative(
            "turning_number",
            "",
            Measure::Number,
            f64::from(drive.turning_number),
        ),
        Quantity::json(
            "crossing_spans",
            serde_json::json!(state.layout.crossing_spans()),
        ),
    ]
}
