//! What there is to tell of a drive with two pulleys as the loop that it is.
//!
//! The driver stands at the origin, the driven pulley to its right, and the belt runs counter-clockwise: the
//! slack span leaves the driver below.

use super::belt_loop::{self, Scale, list, single};
use super::{Answer, Group, Measure, Quantity, Subject, Value, words};
use crate::belt_loop::{self as loops, BeltLoop, Closure, Duty, LoopPulley, Mount, Sense, Side};
use crate::input::Key;
use crate::{BeltKind, Drive, PulleyState, SteadyState};
use std::f64::consts::PI;

/// The groups `pulleys`, `spans` and `loop` of a steady state. That of a flat belt is solved again as a loop,
/// which also tells of the belt at rest and of margins.
pub fn groups(state: &SteadyState) -> [Group; 3] {
    let as_loop = as_loop(state);
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
pub fn of_loop(belt_loop: &BeltLoop, state: &loops::LoopState) -> [Group; 3] {
    let mut groups = belt_loop::groups(belt_loop, state);
    let names = ["slack span", "tight span"];
    let first = belt_loop.driver();
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
    let mut groups = of_state(state).to_vec();
    let pulleys = groups.iter_mut().filter(|group| group.key == "pulleys");
    let pulleys = pulleys.flat_map(|group| &mut group.subjects);
    for (subject, pulley) in pulleys.zip([&state.driver, &state.driven]) {
        let [entry, exit] = pulley.inclination;
        let angle = |key, value| Quantity::number(key, "", Measure::Angle, value, 0.0);
        let number = |key, measure, value| Quantity::data(key, measure, Value::Number(Some(value)));
        let coefficient = state.drive.friction_coefficient;
        let depth = pulley.max_penetration;
        subject.quantities.extend([
            number("friction_coefficient", Measure::Number, coefficient),
            number("max_penetration", Measure::Length, depth),
            angle("entry_inclination", entry),
            angle("exit_inclination", exit),
            belt_loop::zones(&pulley.zones, 0.0),
        ]);
        subject.quantities.extend(belt_loop::along(&pulley.profile));
    }
    groups.push(single("", belt_loop::statement(&as_loop(state))));
    Answer {
        heading: heading(&state.drive, &[]),
        remarks: state.warnings.iter().map(words::warning).collect(),
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

/// The drive as a loop that is closed by its slack tension.
fn as_loop(state: &SteadyState) -> BeltLoop {
    let drive = &state.drive;
    let pulley = |name: &str, x: f64, radius, duty| LoopPulley {
        name: name.to_owned(),
        mount: Mount::Fixed([x, 0.0]),
        radius,
        side: Side::Inside,
        friction_coefficient: drive.friction_coefficient,
        half_angle: None,
        duty,
    };
    let driver = Duty::Driver(drive.driver_speed);
    let driven = Duty::Torque(state.driven.torque);
    BeltLoop {
        title: drive.title.clone(),
        belt: drive.belt,
        law: drive.law,
        sense: Sense::CounterClockwise,
        turning_number: 1,
        pulleys: vec![
            pulley("driver", 0.0, drive.driver_radius, driver),
            pulley("driven", drive.centre_distance, drive.driven_radius, driven),
        ],
        closure: Closure::SpanTractiveTension {
            span: 0,
            tension: state.slack_tractive_tension,
        },
    }
}

/// The drive with two pulleys that a loop in a known state is, closed by its tractive tensions: if there are
/// no more than two pulleys with the belt round both on the same side and one coefficient of friction, and
/// the second one takes power.
pub fn as_drive(belt_loop: &BeltLoop, state: &loops::LoopState) -> Option<Drive> {
    let [one, other] = &belt_loop.pulleys[..] else {
        return None;
    };
    let driver = belt_loop.driver();
    let [first, second] = if driver == 0 {
        [one, other]
    } else {
        [other, one]
    };
    let (Mount::Fixed(here), Mount::Fixed(there)) = (first.mount, second.mount) else {
        return None;
    };
    let is_plain = one.side == Side::Inside
        && other.side == Side::Inside
        && one.friction_coefficient == other.friction_coefficient
        && one.half_angle.is_none()
        && other.half_angle.is_none();
    let Duty::Driver(driver_speed) = first.duty else {
        return None;
    };
    let [slack, tight] = [driver, 1 - driver].map(|span| state.spans[span].tractive_tension);
    (is_plain && slack <= tight).then(|| Drive {
        title: belt_loop.title.clone(),
        belt: belt_loop.belt,
        friction_coefficient: one.friction_coefficient,
        law: belt_loop.law,
        driver_radius: first.radius,
        driver_speed,
        driven_radius: second.radius,
        centre_distance: (there[0] - here[0]).hypot(there[1] - here[1]),
        load: crate::Load {
            slack: crate::SpanTension::Tractive(slack),
            tight: crate::SpanTension::Tractive(tight),
        },
    })
}

/// The groups as the state itself has them.
fn of_state(state: &SteadyState) -> [Group; 3] {
    let convergence = &state.convergence;
    let error = convergence.error_estimate;
    let scale = Scale {
        error: error.max(convergence.slip_normalisation_effect),
        tension: state.tight_tension,
        speed: state.mass_flow / state.drive.belt.mass_per_length,
    };
    let drive = &state.drive;
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
    let pulley = |name: &str, of: &PulleyState, x: f64, radius: f64, hub_load: [f64; 2]| {
        let torque = scale.tension * radius;
        let power = of.torque * of.angular_speed;
        let [magnitude, direction] = belt_loop::polar(hub_load);
        let (sign, duty) = match name {
            "driver" => (-1.0, "driver"),
            _ => (1.0, "torque"),
        };
        let angle = |key, label, value| scale.against(key, label, Measure::Angle, value, 1.0);
        let speed = scale.relative(
            "angular_speed",
            "speed",
            Measure::AngularSpeed,
            of.angular_speed,
        );
        Subject {
            head: name.to_owned(),
            quantities: vec![
                Quantity::word("name", "", Some(name.to_owned())),
                Quantity::word("duty", "", Some(duty.to_owned())),
                Quantity::data("centre", Measure::Length, Value::Pair([x, 0.0])),
                Quantity::data("radius", Measure::Length, Value::Number(Some(radius))),
                speed,
                scale.against(
                    "torque",
                    "torque",
                    Measure::Torque,
                    sign * of.torque,
                    torque,
                ),
                scale.against(
                    "power",
                    "power",
                    Measure::Power,
                    sign * power,
                    scale.tension * scale.speed,
                ),
                angle("wrap_angle", "wrap angle", of.wrap_angle),
                Quantity::data("hub_load", Measure::Force, Value::Pair(hub_load)),
                scale.against(
                    "hub_load_magnitude",
                    "hub load",
                    Measure::Force,
                    magnitude,
                    scale.tension,
                ),
                angle("hub_load_direction", "  direction from x", direction),
            ],
        }
    };
    let span = |from: &str, to: &str, index: usize, tension: f64, length: f64| {
        let speed = scale.speed * (1.0 + tension / drive.belt.axial_stiffness);
        let wave = (speed / (state.mass_flow * tension)).sqrt();
        let force =
            |key, label, value| scale.against(key, label, Measure::Force, value, scale.tension);
        Subject {
            head: from.to_owned(),
            quantities: vec![
                Quantity::word("from_pulley", "", Some(from.to_owned())),
                Quantity::word("to_pulley", "span from there to", Some(to.to_owned())),
                force("tension", "belt tension T", tension),
                force("tractive_tension", "tractive tension F", tractive[index]),
                scale.relative("length", "length", Measure::Length, length),
                scale.against(
                    "direction",
                    "",
                    Measure::Angle,
                    directions[index].rem_euclid(2.0 * PI),
                    1.0,
                ),
                scale.relative("speed", "", Measure::Velocity, speed),
                scale.relative(
                    "frequency",
                    "first frequency",
                    Measure::Frequency,
                    tractive[index] / (2.0 * length) * wave,
                ),
            ],
        }
    };
    let powers = [&state.driver, &state.driven].map(|of| of.torque * of.angular_speed);
    let power = scale.tension * scale.speed;
    let whole = Subject {
        head: String::new(),
        quantities: vec![
            scale.relative(
                "belt_length_unstretched",
                "belt length, unstretched",
                Measure::Length,
                state.belt_length,
            ),
            scale.relative("mass_flow", "mass flow", Measure::MassFlow, state.mass_flow),
            scale.against("power_in", "power in", Measure::Power, powers[0], power),
            scale.against("power_out", "power out", Measure::Power, powers[1], power),
            scale.against(
                "power_loss",
                "friction loss",
                Measure::Loss,
                state.friction_loss,
                power,
            ),
            scale.against(
                "efficiency",
                "efficiency",
                Measure::Share,
                state.efficiency,
                1.0,
            ),
        ],
    };
    let driver = pulley("driver", &state.driver, 0.0, drive.driver_radius, hub(0));
    let distance = drive.centre_distance;
    let driven = pulley(
        "driven",
        &state.driven,
        distance,
        drive.driven_radius,
        hub(1),
    );
    let mut slack = span("driver", "driven", 0, state.slack_tension, state.slack_span);
    let mut tight = span("driven", "driver", 1, state.tight_tension, state.tight_span);
    slack.head = "slack span".to_owned();
    tight.head = "tight span".to_owned();
    [
        list("pulleys", vec![driver, driven]),
        list("spans", vec![slack, tight]),
        single("loop", whole),
    ]
}

/// Directions of the slack and of the tight span, rad from x: of the tangent to circles of radius R cos θ with
/// the inclinations θ of the belt where it leaves and where it arrives.
fn directions(state: &SteadyState) -> [f64; 2] {
    let drive = &state.drive;
    let radius =
        |radius: f64, pulley: &PulleyState, end: usize| radius * pulley.inclination[end].cos();
    let driver = |end| radius(drive.driver_radius, &state.driver, end);
    let driven = |end| radius(drive.driven_radius, &state.driven, end);
    let turned = |q: f64| (q / drive.centre_distance).asin();
    [
        -turned(driven(0) - driver(1)),
        PI - turned(driver(0) - driven(1)),
    ]
}
