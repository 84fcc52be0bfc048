//! What there is to tell of the steady state of a drive with two pulleys.

pub(crate) use super::as_loop::heading;
pub use super::as_loop::{as_drive, drawn};
use super::as_loop::{groups, of_loop};
use super::scalars::Scalars;
use super::{
    Answer, Group, Layout, Measure, Quantity, Subject, Value, belt_loop, errors, warning, words,
};
use crate::belt_loop::LoopState;
use crate::{BeltKind, Convergence, Drive, PulleyState, StateSummary, SteadyState};
use std::borrow::Cow;

/// The steady state of a drive with two pulleys, and what there is to tell of it as a loop: as `as_loop` where it was
/// solved as that.
pub fn answer(state: &SteadyState, as_loop: Option<(&Drive, &LoopState)>) -> Answer {
    let mut told = Told::of(state, as_loop);
    let mut errors = vec![];
    if let Some(sharper) = state.sharper() {
        errors.push(told.known_by_difference(&Told::of(&sharper, as_loop)));
    }
    let Told {
        pulleys,
        whole,
        as_loop,
    } = told;
    let [mut of_pulleys, of_spans, mut of_loop] = as_loop;
    hide(&mut of_pulleys, &pulleys);
    hide(&mut of_loop, &whole);
    let checks = state.checks.iter().map(belt_loop::check).collect();
    let convergence = convergence(&state.drive, &state.convergence);
    let (_, of_speed) = words::speed_loss(state.drive.belt.kind);
    let checked = state.checks.iter().map(words::check);
    let mut groups = vec![
        Group::single("", statement(&state.drive)),
        pulleys,
        of_pulleys,
        of_spans,
        whole,
        of_loop,
    ];
    groups.extend(errors);
    groups.extend([
        Group::new("profiles", Layout::Named, profiles(state)),
        warning::group(&state.warnings),
        Group::new("checks", Layout::Columns, checks),
        Group::single("convergence", convergence),
    ]);
    Answer {
        heading: words::title(&state.drive, &[]),
        remarks: warning::messages(&state.warnings),
        groups,
        notes: of_speed.into_iter().chain(checked).collect(),
    }
}

/// The numbers of a state.
struct Told {
    /// Of the driver and of the driven pulley.
    pulleys: Group,
    /// Of the drive.
    whole: Group,
    /// As of any loop of pulleys.
    as_loop: [Group; 3],
}

impl Told {
    fn of(state: &SteadyState, as_loop: Option<(&Drive, &LoopState)>) -> Self {
        let summary = StateSummary::from(state);
        let scalars = Scalars::of(&state.drive, &summary, 0.0, None);
        let [mut driver, mut driven] = scalars.pulleys();
        let zones = [&state.driver.zones, &state.driven.zones];
        let longest = zones.map(Vec::len).into_iter().max().unwrap_or(0);
        for (pulley, zones) in [&mut driver, &mut driven].into_iter().zip(zones) {
            pulley.extend((0..longest).map(|place| scalars.extent(place, zones.get(place))));
        }
        // Those of the spans are shown with the spans.
        let of_spans = ["slack_span", "tight_span", "tension", "tractive_tension"];
        let whole = scalars.whole().into_iter().chain(scalars.tensions());
        let whole = whole.map(|quantity| match of_spans.contains(&&*quantity.key) {
            true => quantity.unlabelled(),
            false => quantity,
        });
        let pulleys = vec![
            Subject::new("driver", driver),
            Subject::new("driven", driven),
        ];
        Self {
            pulleys: Group::new("", Layout::Named, pulleys),
            whole: Group::single("", whole.collect()),
            as_loop: match as_loop {
                Some((drive, state)) => of_loop(drive, state),
                None => groups(state),
            },
        }
    }

    /// Gives each number its difference from that of the sharper state as its error; returns the errors for programs.
    fn known_by_difference(&mut self, sharper: &Self) -> Group {
        let of = |group: &Group, sharper: &Group, subject: usize| {
            let [of, sharper] = [group, sharper].map(|group| &group.subjects[subject]);
            errors::errors(&of.quantities, &sharper.quantities)
        };
        let mut all = of(&self.whole, &sharper.whole, 0);
        for (subject, name) in ["driver", "driven"].into_iter().enumerate() {
            let pulley = of(&self.pulleys, &sharper.pulleys, subject);
            all.push(Quantity::data(
                name,
                Measure::Number,
                Value::Object(Some(pulley)),
            ));
        }
        errors::by_difference(
            [&mut self.pulleys, &mut self.whole],
            [&sharper.pulleys, &sharper.whole],
        );
        errors::by_difference(&mut self.as_loop, &sharper.as_loop);
        Group::single("errors", all)
    }
}

/// Leaves what another group shows under the same label to programs.
fn hide(group: &mut Group, shown: &Group) {
    let shown = shown
        .subjects
        .iter()
        .flat_map(|subject| &subject.quantities);
    let labels: Vec<_> = shown.map(|quantity| &quantity.label).collect();
    for quantity in group
        .subjects
        .iter_mut()
        .flat_map(|subject| &mut subject.quantities)
    {
        if labels.contains(&&quantity.label) {
            quantity.label = Cow::Borrowed("");
        }
    }
}

/// What was asked, for programs.
pub(super) fn statement(drive: &Drive) -> Vec<Quantity> {
    let word = |key, word: &str| Quantity::word(key, "", word.to_owned());
    let mut statement = vec![Quantity::word("title", "", drive.title.clone())];
    match drive.belt.kind {
        BeltKind::V(_) => statement.push(word("belt_type", "v")),
        BeltKind::Flat { normal_force } => {
            statement.extend([
                word("belt_type", "flat"),
                word("normal_force", normal_force.name()),
            ]);
        }
    }
    statement.push(word("friction_law", drive.law.name()));
    statement.extend(drive.law.kind().map(|kind| word("friction_kind", kind)));
    statement
}

/// How the normal force of a flat belt follows from its tension, in a row.
pub(super) fn convention(drive: &Drive) -> Option<Quantity> {
    match drive.belt.kind {
        BeltKind::V(_) => None,
        BeltKind::Flat { normal_force } => {
            let name = normal_force.name().to_owned();
            Some(Quantity::word("normal_force", "", name))
        }
    }
}

/// The belt along both pulleys.
fn profiles(state: &SteadyState) -> Vec<Subject> {
    let profile = |name: &str, pulley: &PulleyState| {
        let mut quantities = vec![Quantity::word("pulley", "", name.to_owned())];
        quantities.extend(belt_loop::along(&pulley.profile));
        quantities.extend(convention(&state.drive));
        Subject::new(name, quantities)
    };
    vec![
        profile("driver", &state.driver),
        profile("driven", &state.driven),
    ]
}

/// How a state was found and how accurate it is.
fn convergence(drive: &Drive, found: &Convergence) -> Vec<Quantity> {
    let is_v = is_v(drive);
    let of_v = |label: &'static str| if is_v { label } else { "" };
    let error = |key, label, value: f64| Quantity::error(key, label, Measure::Number, value);
    let is_regularised = found.slip_normalisation > 0.0;
    let effect = words::effect_of_smoothing(found.slip_normalisation);
    let meshes = ["mesh intervals, driver", "  driven"]
        .into_iter()
        .zip(found.mesh_intervals);
    let mut quantities = Vec::from_iter(closed_form(drive));
    quantities.extend([
        error("tolerance", of_v("relative tolerance"), found.tolerance),
        error("error_estimate", "estimated error", found.error_estimate),
        error("defect", of_v("largest defect"), found.defect),
        error("slip_normalisation", "", found.slip_normalisation),
        Quantity::error(
            "slip_normalisation_effect",
            if is_regularised {
                effect
            } else {
                String::new()
            },
            Measure::Number,
            found.slip_normalisation_effect,
        ),
        Quantity::json("mesh_intervals", found.mesh_intervals.to_vec()),
    ]);
    quantities.extend(meshes.map(|(label, count)| Quantity::count("", of_v(label), count)));
    quantities.extend([
        Quantity::count(
            "newton_iterations",
            of_v("Newton steps"),
            found.newton_iterations,
        ),
        Quantity::count("rhs_evaluations", "", found.rhs_evaluations),
        Quantity::count("factorisations", "", found.factorisations),
        Quantity::count("continuation_steps", "", found.continuation_steps),
    ]);
    quantities.extend(time(found.seconds));
    quantities
}

/// Says of a flat belt how it is solved.
pub(super) fn closed_form(drive: &Drive) -> Option<Quantity> {
    let method = || Quantity::word("", "method", "closed form".to_owned());
    (!is_v(drive)).then(method)
}

/// A time by the clock.
pub(super) fn time(seconds: f64) -> [Quantity; 2] {
    let shown = Quantity {
        digits: TIME_DIGITS,
        ..Quantity::number("", "time", Measure::Time, seconds, 0.0)
    };
    [
        Quantity::number("seconds", "", Measure::Number, seconds, 0.0),
        shown,
    ]
}

/// Digits of a time: it varies from run to run.
const TIME_DIGITS: u8 = 3;

/// Whether the belt is a V-belt.
pub(super) fn is_v(drive: &Drive) -> bool {
    matches!(drive.belt.kind, BeltKind::V(_))
}
