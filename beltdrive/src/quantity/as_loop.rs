//! What there is to tell of a drive with two pulleys as the loop that it is.

use super::belt_loop;
use super::scale::{HUB_LOAD, Scale};
use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value, warning, words};
use crate::belt_loop as loops;
use crate::input::Key;
use crate::{BeltKind, Closure, Drive, FrictionLaw, Load, PulleyState, SpanTension, SteadyState};
use std::f64::consts::PI;

/// The groups `pulleys`, `spans` and `loop` of a steady state. That of a flat belt is solved again as a loop,
/// which also tells of the belt at rest and of margins.
pub(super) fn groups(state: &SteadyState) -> [Group; 3] {
    let as_loop = state.as_loop();
    let solved = match state.drive.belt.kind {
        BeltKind::Flat { .. } => loops::solve(&as_loop).ok(),
        BeltKind::V(_) => None,
    };
    match solved {
        Some(found) => of_loop(&as_loop, &found),
        None => of_state(state),
    }
}

/// The groups `pulleys`, `spans` and `loop` of a drive with two pulleys that was solved as a loop.
pub(super) fn of_loop(drive: &Drive, state: &loops::LoopState) -> [Group; 3] {
    let mut groups = belt_loop::groups(drive, state);
    let names = ["slack span", "tight span"];
    let first = drive.driver();
    for (place, subject) in groups[1].subjects.iter_mut().enumerate() {
        subject.head = names[usize::from(place != first)].to_owned();
    }
    // The profiles have a place of their own.
    for subject in groups.iter_mut().flat_map(|group| &mut group.subjects) {
        let is_series = |quantity: &Quantity| matches!(quantity.value, Value::Series(_));
        subject.quantities.retain(|quantity| !is_series(quantity));
    }
    groups
}

/// What there is to draw of a steady state: the groups as the state itself has them, with the zones and profiles
/// of both pulleys.
pub fn drawn(state: &SteadyState) -> Answer {
    let scale = scale(state);
    let mut groups = of_state(state).to_vec();
    let pulleys = groups.iter_mut().filter(|group| group.key == "pulleys");
    let pulleys = pulleys.flat_map(|group| &mut group.subjects);
    for (subject, pulley) in pulleys.zip([&state.driver, &state.driven]) {
        let [entry, exit] = pulley.inclination;
        let number = |key, measure, value| Quantity::data(key, measure, Value::Number(Some(value)));
        let coefficient = state.drive.pair().friction_coefficient;
        let depth = pulley.max_penetration;
        subject.quantities.extend([
            number("friction_coefficient", Measure::Number, coefficient),
            number("max_penetration", Measure::Length, depth),
            number("entry_inclination", Measure::Angle, entry),
            number("exit_inclination", Measure::Angle, exit),
            scale.zones(&pulley.zones),
        ]);
        let locked = scale.locked(pulley.least_slip.as_ref());
        subject.quantities.extend(locked);
        subject.quantities.extend(belt_loop::along(&pulley.profile));
    }
    groups.push(Group::single("", belt_loop::statement(&state.as_loop())));
    Answer {
        heading: heading(&state.drive, &[]),
        remarks: warning::messages(&state.warnings),
        groups,
        ..Answer::default()
    }
}

/// What the drive is, some keys of which vary.
pub(crate) fn heading(drive: &Drive, varied: &[Key]) -> Vec<String> {
    let mut lines = vec![words::heading(drive), words::law_of(drive, varied)];
    lines.extend(words::convention(drive.belt.kind).map(str::to_owned));
    lines
}

/// A drive with another closure in a known state as one that is closed by the tensions of both spans: if it is
/// such a drive ([`Drive::two_pulleys`]) but for that, and the second pulley takes power.
pub fn as_drive(drive: &Drive, state: &loops::LoopState) -> Option<Drive> {
    let [_, _] = &drive.pulleys[..] else {
        return None;
    };
    let driver = drive.driver();
    let spans = [driver, 1 - driver].map(|span| &state.spans[span]);
    // In a groove the displacement of scalar EPP friction grows from the slack tension as it is stated.
    let is_tractive = match (drive.law, drive.belt.kind, drive.closure) {
        (FrictionLaw::Epp { .. }, BeltKind::V(_), closure) => {
            matches!(closure, Closure::SpanTractiveTension { .. })
        }
        _ => true,
    };
    let [slack, tight] = spans.map(|span| match is_tractive {
        true => SpanTension::Tractive(span.tractive_tension),
        false => SpanTension::Belt(span.tension),
    });
    drive.closed_by(Load { slack, tight })
}

/// How accurate the numbers of a state are.
fn scale(state: &SteadyState) -> Scale {
    let convergence = &state.convergence;
    let error = convergence.error_estimate;
    let speed = state.mass_flow / state.drive.belt.mass_per_length;
    Scale {
        error: error.max(convergence.slip_normalisation_effect),
        tension: state.tight_tension,
        power: state.tight_tension * speed,
    }
}

/// The groups as the state itself has them.
fn of_state(state: &SteadyState) -> [Group; 3] {
    let (pair, scale) = (state.drive.pair(), scale(state));
    let directions = directions(state);
    let tractive = [state.slack_tractive_tension, state.tight_tractive_tension];
    // Of the force with which the belt pulls, from its exit span and against its entry span.
    let hub = |leaving: usize| {
        let arriving = 1 - leaving;
        let part = |of: fn(f64) -> f64| {
            tractive[leaving] * of(directions[leaving])
                - tractive[arriving] * of(directions[arriving])
        };
        [part(f64::cos), part(f64::sin)]
    };
    // In the signs of loops, where a torque is what the pulley takes.
    let pulley = |index: usize, x: f64, radius: f64| {
        let (name, duty, sign, of) = match index {
            0 => ("driver", "driver", -1.0, &state.driver),
            _ => ("driven", "torque", 1.0, &state.driven),
        };
        let torque = sign * of.torque;
        let word = |key, word: &str| Quantity::word(key, "", word.to_owned());
        let speed = of.angular_speed;
        let mut quantities = vec![
            word("name", name),
            word("duty", duty),
            Quantity::data("centre", Measure::Length, Value::Pair([x, 0.0])),
            Quantity::data("radius", Measure::Length, Value::Number(Some(radius))),
            scale.relative("angular_speed", "speed", Measure::AngularSpeed, speed),
            scale.against(
                "torque",
                "torque",
                Measure::Torque,
                torque,
                scale.tension * radius,
            ),
            scale.power("power", "power", torque * speed),
            scale.angle("wrap_angle", "wrap angle", of.wrap_angle),
        ];
        quantities.extend(scale.hub_load(HUB_LOAD, "hub load", hub(index)));
        Subject::new(name, quantities)
    };
    let span = |index: usize, tension: f64, length: f64| {
        let (head, [from, to]) = match index {
            0 => ("slack span", ["driver", "driven"]),
            _ => ("tight span", ["driven", "driver"]),
        };
        let speed = state.mass_flow / pair.belt.mass_per_length
            * (1.0 + tension / pair.belt.axial_stiffness);
        let wave = (speed / (state.mass_flow * tension)).sqrt();
        let frequency = tractive[index] / (2.0 * length) * wave;
        let direction = directions[index].rem_euclid(2.0 * PI);
        let quantities = vec![
            Quantity::word("from_pulley", "", from.to_owned()),
            Quantity::word("to_pulley", "span from there to", to.to_owned()),
            scale.force("tension", "belt tension T", tension),
            scale.force("tractive_tension", "tractive tension F", tractive[index]),
            scale.relative("length", "length", Measure::Length, length),
            scale.angle("direction", "", direction),
            scale.relative("speed", "", Measure::Velocity, speed),
            scale.relative(
                "frequency",
                "first frequency",
                Measure::Frequency,
                frequency,
            ),
        ];
        Subject::new(head, quantities)
    };
    let [power_in, power_out] =
        [&state.driver, &state.driven].map(|of| of.torque * of.angular_speed);
    let whole = vec![
        scale.relative(
            "belt_length_unstretched",
            "belt length, unstretched",
            Measure::Length,
            state.belt_length,
        ),
        scale.relative("mass_flow", "mass flow", Measure::MassFlow, state.mass_flow),
        scale.power("power_in", "power in", power_in),
        scale.power("power_out", "power out", power_out),
        scale.loss("power_loss", "friction loss", state.friction_loss),
        scale.against(
            "efficiency",
            "efficiency",
            Measure::Share,
            state.efficiency,
            1.0,
        ),
    ];
    let pulleys = vec![
        pulley(0, 0.0, pair.driver_radius),
        pulley(1, pair.centre_distance, pair.driven_radius),
    ];
    let spans = vec![
        span(0, state.slack_tension, state.slack_span),
        span(1, state.tight_tension, state.tight_span),
    ];
    [
        Group::new("pulleys", Layout::Columns, pulleys),
        Group::new("spans", Layout::Columns, spans),
        Group::single("loop", whole),
    ]
}

/// Directions of the slack and of the tight span, rad from x: of the tangent to circles of radius R cos θ with
/// the inclinations θ of the belt where it leaves and where it arrives.
fn directions(state: &SteadyState) -> [f64; 2] {
    let pair = state.drive.pair();
    let radius =
        |radius: f64, pulley: &PulleyState, end: usize| radius * pulley.inclination[end].cos();
    let driver = |end| radius(pair.driver_radius, &state.driver, end);
    let driven = |end| radius(pair.driven_radius, &state.driven, end);
    let turned = |q: f64| (q / pair.centre_distance).asin();
    [
        -turned(driven(0) - driver(1)),
        PI - turned(driver(0) - driven(1)),
    ]
}
