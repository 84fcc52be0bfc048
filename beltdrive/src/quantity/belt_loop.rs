//! What there is to tell of the steady state of a belt loop.

use super::precision::six_digits;
use super::words;
use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value};
use crate::belt_loop::{
    BeltLoop, Closure, Duty, Guide, LoopConvergence, LoopState, Sense, Side, SpanState,
    TensionerState,
};
use crate::{BeltKind, Check, NormalForce, Profile, Zone};

/// The steady state of a loop.
pub fn answer(belt_loop: &BeltLoop, state: &LoopState) -> Answer {
    let mut groups = vec![single("", statement(belt_loop))];
    groups.extend(self::groups(belt_loop, state));
    if let (Some((_, tensioner)), Some(found)) = (belt_loop.tensioner(), &state.tensioner) {
        let name = &state.pulleys[found.pulley].name;
        let subject = self::tensioner(name, &tensioner.guide, found, &Scale::of(state));
        groups.push(single("tensioner", subject));
    }
    let checks = state.checks.iter().map(check);
    groups.push(Group {
        key: "checks",
        layout: Layout::Columns,
        subjects: checks.collect(),
    });
    if let Some(found) = &state.convergence {
        groups.push(single("convergence", convergence(found)));
    }
    Answer {
        heading: heading(belt_loop),
        groups,
        notes: state.checks.iter().map(words::check).collect(),
        ..Answer::default()
    }
}

/// The groups `pulleys`, `spans` and `loop`.
pub(super) fn groups(belt_loop: &BeltLoop, state: &LoopState) -> [Group; 3] {
    let scale = Scale::of(state);
    let count = state.pulleys.len();
    let pulleys = (0..count).map(|index| pulley(belt_loop, state, index, &scale));
    let spans = state.spans.iter().enumerate().map(|(index, span)| {
        let names = [index, (index + 1) % count].map(|pulley| &*state.pulleys[pulley].name);
        self::span(belt_loop, names, span, &scale)
    });
    [
        list("pulleys", pulleys.collect()),
        list("spans", spans.collect()),
        single("loop", whole(belt_loop, state, &scale)),
    ]
}

/// A verified invariant, for programs.
pub(super) fn check(check: &Check) -> Subject {
    let number = |key, value| Quantity::number(key, "", Measure::Number, value, 0.0);
    Subject {
        head: String::new(),
        quantities: vec![
            Quantity::word("name", "", Some(check.name.to_owned())),
            number("deviation", check.deviation),
            number("limit", check.limit),
        ],
    }
}

/// How a state was found and how accurate it is.
fn convergence(found: &LoopConvergence) -> Subject {
    let error = |key, label, value: f64| Quantity::error(key, label, Measure::Number, value);
    let count = Quantity::count;
    let is_regularised = found.slip_normalisation > 0.0;
    let effect = if is_regularised { "effect of ε" } else { "" };
    Subject {
        head: String::new(),
        quantities: vec![
            error("tolerance", "relative tolerance", found.tolerance),
            error("error_estimate", "estimated error", found.error_estimate),
            error("defect", "largest defect", found.defect),
            error("slip_normalisation", "", found.slip_normalisation),
            error(
                "slip_normalisation_effect",
                effect,
                found.slip_normalisation_effect,
            ),
            count("mesh_intervals", "mesh intervals", found.mesh_intervals),
            count("newton_steps", "Newton steps", found.newton_steps),
            count("problems", "", found.problems),
        ],
    }
}

/// The title, and what the loop is.
pub(crate) fn heading(belt_loop: &BeltLoop) -> Vec<String> {
    let count = belt_loop.pulleys.len();
    let belt = match (belt_loop.belt.kind, belt_loop.belt.ribs) {
        (BeltKind::V(_), 1) => "V-belt".to_owned(),
        (BeltKind::V(_), ribs) => format!("V-belt with {ribs} ribs"),
        (BeltKind::Flat { .. }, 1) => "Flat belt".to_owned(),
        (BeltKind::Flat { .. }, ribs) => format!("Flat belt with {ribs} ribs"),
    };
    let law = words::law(belt_loop.law, coefficient(belt_loop), &[]);
    let force = |tension: f64| format!("{} N", six_digits(tension));
    let behind = |span: usize| &belt_loop.pulleys[span].name;
    let closed = match belt_loop.closure {
        Closure::UnstretchedLength(length) => {
            format!("unstretched length {} m", six_digits(length))
        }
        Closure::SetupTension(tension) => format!("setup tension {}", force(tension)),
        Closure::SpanTension { span, tension } => {
            format!("tension {} behind {}", force(tension), behind(span))
        }
        Closure::SpanTractiveTension { span, tension } => {
            format!(
                "tractive tension {} behind {}",
                force(tension),
                behind(span)
            )
        }
        Closure::RestCoordinate(_) => "closed by the tensioner at rest".to_owned(),
    };
    // That of a V-belt is no choice, and the usual one goes without saying.
    let usual = BeltKind::Flat {
        normal_force: NormalForce::default(),
    };
    let kind = belt_loop.belt.kind;
    let convention = words::convention(kind).filter(|_| kind != usual);
    let convention = convention.map_or_else(String::new, |words| format!(", {words}"));
    let what = format!("{belt} round {count} pulleys, {law}{convention}, {closed}");
    let words = belt_loop.title.iter();
    let title: Vec<_> = words.flat_map(|title| title.split_whitespace()).collect();
    match title.is_empty() {
        true => vec![what],
        false => vec![title.join(" "), what],
    }
}

/// The coefficient of friction, if it is the same on all pulleys.
fn coefficient(belt_loop: &BeltLoop) -> Option<f64> {
    let mut pulleys = belt_loop.pulleys.iter();
    let first = pulleys.next()?.friction_coefficient;
    let is_same = pulleys.all(|pulley| pulley.friction_coefficient == first);
    is_same.then_some(first)
}

/// Relative error of a loop that was solved in closed form: cases that were solved with 40 digits agree to
/// 1.6e-13.
const ROUNDING: f64 = 1e-12;

/// Relative error of a state.
pub(crate) fn relative_error(state: &LoopState) -> f64 {
    state.convergence.as_ref().map_or(ROUNDING, |convergence| {
        let estimate = convergence.error_estimate;
        estimate.max(convergence.slip_normalisation_effect)
    })
}

/// What the errors of the numbers of a state are relative to.
pub(super) struct Scale {
    /// Relative error of the state.
    pub(super) error: f64,
    /// Largest belt tension, N.
    pub(super) tension: f64,
    /// Speed of the belt, m/s.
    pub(super) speed: f64,
}

impl Scale {
    fn of(state: &LoopState) -> Self {
        let tensions = state.spans.iter().map(|span| span.tension);
        Self {
            error: relative_error(state),
            tension: tensions.fold(0.0, f64::max),
            speed: state.unstretched_speed,
        }
    }

    /// A number whose error is relative to itself.
    pub(super) fn relative(
        &self,
        key: &'static str,
        label: &'static str,
        measure: Measure,
        value: impl Into<Option<f64>>,
    ) -> Quantity {
        let value = value.into();
        let error = self.error * value.map_or(0.0, f64::abs);
        Quantity::number(key, label, measure, value, error)
    }

    /// A number whose error is relative to a scale of its own unit, as of a difference.
    pub(super) fn against(
        &self,
        key: &'static str,
        label: &'static str,
        measure: Measure,
        value: f64,
        scale: f64,
    ) -> Quantity {
        Quantity::number(key, label, measure, value, self.error * scale)
    }
}

pub(super) fn single(key: &'static str, subject: Subject) -> Group {
    Group {
        key,
        layout: Layout::Single,
        subjects: vec![subject],
    }
}

pub(super) fn list(key: &'static str, subjects: Vec<Subject>) -> Group {
    Group {
        key,
        layout: Layout::Columns,
        subjects,
    }
}

/// What was asked, for programs.
pub(super) fn statement(belt_loop: &BeltLoop) -> Subject {
    let (belt, normal_force) = match belt_loop.belt.kind {
        BeltKind::V(_) => ("v", None),
        BeltKind::Flat { normal_force } => ("flat", Some(normal_force.name().to_owned())),
    };
    let sense = match belt_loop.sense {
        Sense::Clockwise => "clockwise",
        Sense::CounterClockwise => "counter-clockwise",
    };
    let law = belt_loop.law.name().to_owned();
    let word = |key, word| Quantity::word(key, "", word);
    Subject {
        head: String::new(),
        quantities: vec![
            word("title", belt_loop.title.clone()),
            word("belt_type", Some(belt.to_owned())),
            word("normal_force", normal_force),
            word("friction_law", Some(law)),
            word("sense", Some(sense.to_owned())),
        ],
    }
}

fn pulley(belt_loop: &BeltLoop, state: &LoopState, index: usize, scale: &Scale) -> Subject {
    let (stated, pulley) = (&belt_loop.pulleys[index], &state.pulleys[index]);
    let profile = &state.profile(index);
    let radius = stated.radius;
    let ribs = f64::from(belt_loop.belt.ribs);
    // A torque is a difference of tensions, a power that of two powers.
    let torque = scale.tension * radius;
    let power = scale.tension * scale.speed;
    let [magnitude, direction] = polar(pulley.hub_load);
    let [rest_magnitude, rest_direction] = polar(pulley.rest_hub_load);
    let is_ribbed = belt_loop.belt.ribs > 1;
    let side = match stated.side {
        Side::Inside => "inside",
        Side::Outside => "outside",
    };
    let duty = match stated.duty {
        Duty::Driver(_) => "driver",
        Duty::Torque(_) => "torque",
        Duty::Power(_) => "power",
    };
    let angle = |key, label, value| scale.against(key, label, Measure::Angle, value, 1.0);
    let mut quantities = vec![
        Quantity::word("name", "", Some(pulley.name.clone())),
        Quantity::word("side", "", Some(side.to_owned())),
        Quantity::word("duty", "", Some(duty.to_owned())),
        Quantity::data("centre", Measure::Length, Value::Pair(pulley.centre)),
        Quantity::data("radius", Measure::Length, Value::Number(Some(radius))),
        scale.relative(
            "friction_coefficient",
            match coefficient(belt_loop) {
                Some(_) => "",
                None => "coefficient of friction",
            },
            Measure::Number,
            stated.friction_coefficient,
        ),
        scale.relative(
            "angular_speed",
            "speed",
            Measure::AngularSpeed,
            pulley.angular_speed,
        ),
        scale.against("torque", "torque", Measure::Torque, pulley.torque, torque),
        scale.against(
            "torque_per_rib",
            if is_ribbed { "torque per rib" } else { "" },
            Measure::Torque,
            pulley.torque / ribs,
            torque,
        ),
        scale.against("power", "power", Measure::Power, pulley.power, power),
        angle("wrap_angle", "wrap angle", pulley.wrap),
        angle("rest_wrap_angle", "", pulley.rest_wrap),
        angle("no_slip_arc", "", pulley.no_slip_arc),
        angle("slip_arc", "slip arc", pulley.slip_arc),
        scale.relative(
            "friction_utilisation",
            "friction utilisation",
            Measure::Share,
            pulley.friction_utilisation,
        ),
        scale.relative(
            "torque_capacity",
            "torque capacity",
            Measure::Torque,
            pulley.torque_capacity,
        ),
        scale.relative(
            "torque_margin",
            "torque margin",
            Measure::Number,
            pulley.torque_margin,
        ),
        scale.against(
            "speed_loss",
            "speed loss",
            Measure::Share,
            pulley.speed_loss,
            1.0,
        ),
        scale.against(
            "friction_loss",
            "friction loss",
            Measure::Loss,
            pulley.friction_loss,
            power,
        ),
        scale.relative(
            "reference_tension",
            "",
            Measure::Force,
            pulley.reference_tension,
        ),
        scale.relative("entry_strain", "", Measure::Number, pulley.entry_strain),
        Quantity::data("hub_load", Measure::Force, Value::Pair(pulley.hub_load)),
        scale.against(
            "hub_load_magnitude",
            "hub load",
            Measure::Force,
            magnitude,
            scale.tension,
        ),
        angle("hub_load_direction", "  direction from x", direction),
        Quantity::data(
            "hub_load_rest",
            Measure::Force,
            Value::Pair(pulley.rest_hub_load),
        ),
        scale.against(
            "hub_load_rest_magnitude",
            "hub load at rest",
            Measure::Force,
            rest_magnitude,
            scale.tension,
        ),
        angle(
            "hub_load_rest_direction",
            "  direction from x",
            rest_direction,
        ),
        zones(&pulley.zones, scale.error),
    ];
    if let BeltKind::V(_) = belt_loop.belt.kind {
        let groove = pulley.groove.as_ref();
        let inclination = |end: usize| groove.map(|groove| groove.inclination[end]);
        let angle =
            |key, label, value| Quantity::number(key, label, Measure::Angle, value, scale.error);
        quantities.extend([
            scale.relative(
                "max_penetration",
                "largest penetration",
                Measure::Length,
                groove.map(|groove| groove.max_penetration),
            ),
            angle("entry_inclination", "inclination at entry", inclination(0)),
            angle("exit_inclination", "inclination at exit", inclination(1)),
            scale.relative(
                "transverse_loss",
                "",
                Measure::Loss,
                groove.map(|groove| groove.transverse_loss),
            ),
        ]);
    }
    quantities.extend(along(profile));
    Subject {
        head: pulley.name.clone(),
        quantities,
    }
}

/// Friction zones, whose angles have an error in rad.
pub(super) fn zones(zones: &[Zone], error: f64) -> Quantity {
    let angle = |key, value| Quantity::number(key, "", Measure::Angle, value, error);
    let zones = zones.iter().map(|zone| Subject {
        head: String::new(),
        quantities: vec![
            Quantity::word("kind", "", Some(zone.kind.name().to_owned())),
            angle("from", zone.from),
            angle("to", zone.to),
        ],
    });
    Quantity::data("zones", Measure::Number, Value::List(zones.collect()))
}

/// The belt along a pulley.
pub(super) fn along(profile: &Profile) -> [Quantity; 10] {
    let series = |key, measure, values: &Vec<f64>| {
        Quantity::data(key, measure, Value::Series(values.clone()))
    };
    [
        series("angle", Measure::Angle, &profile.angle),
        series("arc_length", Measure::Length, &profile.arc_length),
        series("tension", Measure::Force, &profile.tension),
        series(
            "tractive_tension",
            Measure::Force,
            &profile.tractive_tension,
        ),
        series("inclination", Measure::Angle, &profile.inclination),
        series("penetration", Measure::Length, &profile.penetration),
        series("displacement", Measure::Length, &profile.displacement),
        series("sliding_angle", Measure::Angle, &profile.sliding_angle),
        series("normal_force", Measure::LineLoad, &profile.normal_force),
        series("friction_force", Measure::LineLoad, &profile.friction_force),
    ]
}

/// Magnitude and direction from x of a force.
pub(super) fn polar([x, y]: [f64; 2]) -> [f64; 2] {
    [x.hypot(y), y.atan2(x)]
}

fn span(belt_loop: &BeltLoop, [from, to]: [&str; 2], span: &SpanState, scale: &Scale) -> Subject {
    let ribs = f64::from(belt_loop.belt.ribs);
    let force = |key, label, value| scale.against(key, label, Measure::Force, value, scale.tension);
    let length = |key, label, value| scale.relative(key, label, Measure::Length, value);
    let frequency = |key, label, value| scale.relative(key, label, Measure::Frequency, value);
    Subject {
        head: from.to_owned(),
        quantities: vec![
            Quantity::word("from_pulley", "", Some(from.to_owned())),
            Quantity::word("to_pulley", "span from there to", Some(to.to_owned())),
            force("tension", "belt tension T", span.tension),
            force(
                "tension_per_rib",
                if belt_loop.belt.ribs > 1 {
                    "T per rib"
                } else {
                    ""
                },
                span.tension / ribs,
            ),
            force(
                "tractive_tension",
                "tractive tension F",
                span.tractive_tension,
            ),
            length("length", "length", span.length),
            scale.against("direction", "", Measure::Angle, span.direction, 1.0),
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
    }
}

fn whole(belt_loop: &BeltLoop, state: &LoopState, scale: &Scale) -> Subject {
    let power = scale.tension * scale.speed;
    let length = |key, label, value| scale.relative(key, label, Measure::Length, value);
    let limit = state.load_limit.as_ref();
    Subject {
        head: String::new(),
        quantities: vec![
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
            scale.against(
                "rest_tension",
                "belt tension at rest",
                Measure::Force,
                state.rest_tension,
                scale.tension,
            ),
            scale.relative("power_in", "power in", Measure::Power, state.power_in),
            scale.relative("power_out", "power out", Measure::Power, state.power_out),
            scale.against(
                "power_loss",
                "friction loss",
                Measure::Loss,
                state.power_loss,
                power,
            ),
            Quantity::number(
                "efficiency",
                "efficiency",
                Measure::Share,
                state.efficiency,
                scale.error,
            ),
            scale.relative(
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
            scale.relative("ribs", "", Measure::Number, f64::from(belt_loop.belt.ribs)),
            scale.relative(
                "turning_number",
                "",
                Measure::Number,
                f64::from(belt_loop.turning_number),
            ),
            Quantity::json(
                "crossing_spans",
                serde_json::json!(state.layout.crossing_spans()),
            ),
        ],
    }
}

fn tensioner(name: &str, guide: &Guide, found: &TensionerState, scale: &Scale) -> Subject {
    let (measure, stiffness, load, keys, place) = match *guide {
        Guide::Rotary { pivot, .. } => (
            Measure::Angle,
            Measure::AngularStiffness,
            Measure::Torque,
            ["angle", "rest_angle", "arm angle"],
            Quantity::data("pivot", Measure::Length, Value::Pair(pivot)),
        ),
        Guide::Translating { direction, .. } => (
            Measure::Length,
            Measure::Stiffness,
            Measure::Force,
            ["position", "rest_position", "slide position"],
            Quantity::data("direction", Measure::Number, Value::Pair(direction)),
        ),
    };
    let [rest, ..] = guide.centre(found.rest_coordinate);
    let [key, rest_key, label] = keys;
    let constant = |key, label, value| scale.against(key, label, Measure::Number, value, 1.0);
    Subject {
        head: String::new(),
        quantities: vec![
            Quantity::word("pulley", "tensioner", Some(name.to_owned())),
            scale.against(key, label, measure, found.coordinate, 1.0),
            scale.against(rest_key, "  at rest", measure, found.rest_coordinate, 1.0),
            place,
            Quantity::data("rest_centre", Measure::Length, Value::Pair(rest)),
            scale.relative("load", "load of spring or weight", load, found.load),
            scale.relative("stiffness", "stiffness", stiffness, found.stiffness),
            scale.relative(
                "rest_stiffness",
                "  at rest",
                stiffness,
                found.rest_stiffness,
            ),
            constant("constant", "tensioner constant", found.constant),
            constant("rest_constant", "  at rest", found.rest_constant),
        ],
    }
}
