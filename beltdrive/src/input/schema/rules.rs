//! Every entry of a drive file.

use super::{CALIBRATED, Kind, MINIMISE, NORMAL_FORCE, Range, Rule, TORQUE};
use crate::friction::ROWS;
use crate::input::dimension::Dimension;
use crate::sections;
use std::f64::consts::FRAC_PI_2;
use std::sync::LazyLock;

/// The range of half a groove angle.
const HALF_ANGLE: Range = Range::Below(FRAC_PI_2, "90 deg");

/// The sides of the belt on which a pulley may lie.
const SIDES: [&str; 2] = ["inside", "outside"];

/// The senses in which the belt may run round the loop.
const SENSES: [&str; 2] = ["clockwise", "counter-clockwise"];

const fn ranged(
    path: &'static str,
    example: &'static str,
    dimension: Dimension,
    range: Range,
) -> Rule {
    Rule {
        path,
        example,
        kind: Kind::Quantity { dimension, range },
    }
}

const fn quantity(path: &'static str, example: &'static str, dimension: Dimension) -> Rule {
    ranged(path, example, dimension, Range::Positive)
}

const fn share(path: &'static str, example: &'static str) -> Rule {
    ranged(path, example, Dimension::NUMBER, Range::Share)
}

const fn any(path: &'static str, example: &'static str, dimension: Dimension) -> Rule {
    ranged(path, example, dimension, Range::Any)
}

const fn text(path: &'static str, example: &'static str) -> Rule {
    Rule {
        path,
        example,
        kind: Kind::Text,
    }
}

const fn word(
    path: &'static str,
    example: &'static str,
    what: &'static str,
    words: &'static [&'static str],
) -> Rule {
    Rule {
        path,
        example,
        kind: Kind::Word { what, words },
    }
}

const fn points(path: &'static str, example: &'static str, dimensions: [Dimension; 2]) -> Rule {
    Rule {
        path,
        example,
        kind: Kind::Points { dimensions },
    }
}

const fn refused(
    path: &'static str,
    example: &'static str,
    reason: &'static str,
    instead: Option<&'static str>,
) -> Rule {
    Rule {
        path,
        example,
        kind: Kind::Refused { reason, instead },
    }
}

/// The names of the friction laws.
const LAWS: [&str; ROWS.len()] = {
    let mut names = [""; ROWS.len()];
    let mut index = 0;
    while index < names.len() {
        names[index] = ROWS[index].name;
        index += 1;
    }
    names
};

/// Every entry, in the order in which messages list them; `*` stands for the name of a pulley.
pub(super) static RULES: LazyLock<Vec<Rule>> = LazyLock::new(|| {
    let laws = ROWS
        .iter()
        .copied()
        .filter_map(|law| law.parameter.as_ref());
    let laws = laws.filter_map(|parameter| {
        let dimension = Dimension::of(parameter.measure)?;
        Some(quantity(parameter.path, parameter.example, dimension))
    });
    let kinds = ROWS.iter().copied().filter_map(|law| law.other.as_ref());
    let kinds = kinds.map(|other| word(other.path, other.example, "kind of law", &other.words));
    [
        UP_TO_FRICTION.to_vec(),
        laws.collect(),
        kinds.collect(),
        FROM_PULLEYS.to_vec(),
        SERVICE.to_vec(),
        TRANSIENT.to_vec(),
    ]
    .concat()
});

/// The entries up to those that all friction laws have.
const UP_TO_FRICTION: &[Rule] = &[
    text("title", "\"Test drive\""),
    word("belt.type", "\"v\"", "belt type", &["v", "flat"]),
    word("belt.section", "\"SPB\"", "belt section", &sections::NAMES),
    quantity("belt.width", "\"25 mm\"", Dimension::LENGTH),
    quantity(
        "belt.mass_per_length",
        "\"0.108 kg/m\"",
        Dimension::MASS_PER_LENGTH,
    ),
    quantity("belt.axial_stiffness", "\"120 kN\"", Dimension::FORCE),
    quantity(
        "belt.radial_stiffness",
        "\"900 kN/m^2\"",
        Dimension::FORCE_PER_AREA,
    ),
    quantity("belt.height", "\"8 mm\"", Dimension::LENGTH),
    ranged("belt.ribs", "6", Dimension::NUMBER, Range::Whole),
    ranged(
        "groove.half_angle",
        "\"18 deg\"",
        Dimension::ANGLE,
        HALF_ANGLE,
    ),
    word("friction.law", "\"coulomb\"", "friction law", &LAWS),
    quantity("friction.coefficient", "0.4", Dimension::NUMBER),
];

/// The entries from those of the pulleys on.
const FROM_PULLEYS: &[Rule] = &[
    quantity("pulleys.driver.radius", "\"0.25 m\"", Dimension::LENGTH),
    quantity("pulleys.driver.diameter", "\"0.5 m\"", Dimension::LENGTH),
    quantity(
        "pulleys.driver.speed",
        "\"1000 rpm\"",
        Dimension::ANGULAR_SPEED,
    ),
    ranged(
        "pulleys.driver.half_angle",
        "\"18 deg\"",
        Dimension::ANGLE,
        HALF_ANGLE,
    ),
    quantity("pulleys.driven.radius", "\"0.25 m\"", Dimension::LENGTH),
    quantity("pulleys.driven.diameter", "\"0.5 m\"", Dimension::LENGTH),
    ranged(
        "pulleys.driven.half_angle",
        "\"18 deg\"",
        Dimension::ANGLE,
        HALF_ANGLE,
    ),
    refused(
        "pulleys.driven.speed",
        "\"1000 rpm\"",
        "may not be given: the speed of the driven pulley follows from the load",
        None,
    ),
    text("pulley.*.name", "\"crankshaft\""),
    any("pulley.*.centre.x", "\"120 mm\"", Dimension::LENGTH),
    any("pulley.*.centre.y", "\"80 mm\"", Dimension::LENGTH),
    quantity("pulley.*.radius", "\"60 mm\"", Dimension::LENGTH),
    quantity("pulley.*.diameter", "\"120 mm\"", Dimension::LENGTH),
    word("pulley.*.side", "\"inside\"", "side of the belt", &SIDES),
    quantity("pulley.*.friction_coefficient", "0.4", Dimension::NUMBER),
    ranged(
        "pulley.*.half_angle",
        "\"18 deg\"",
        Dimension::ANGLE,
        HALF_ANGLE,
    ),
    quantity("pulley.*.speed", "\"1000 rpm\"", Dimension::ANGULAR_SPEED),
    any("pulley.*.torque", "\"20 N*m\"", Dimension::TORQUE),
    any("pulley.*.power", "\"2 kW\"", Dimension::POWER),
    text("tensioner.pulley", "\"tensioner\""),
    any("tensioner.arm.pivot.x", "\"50 mm\"", Dimension::LENGTH),
    any("tensioner.arm.pivot.y", "\"150 mm\"", Dimension::LENGTH),
    quantity("tensioner.arm.length", "\"80 mm\"", Dimension::LENGTH),
    quantity(
        "tensioner.arm.stiffness",
        "\"20 N*m/rad\"",
        Dimension::TORQUE_PER_ANGLE,
    ),
    any("tensioner.arm.free_angle", "\"-120 deg\"", Dimension::ANGLE),
    any("tensioner.arm.preload", "\"12 N*m\"", Dimension::TORQUE),
    quantity("tensioner.arm.weight", "\"50 N\"", Dimension::FORCE),
    any("tensioner.arm.angle", "\"-80 deg\"", Dimension::ANGLE),
    any("tensioner.arm.rest_angle", "\"-85 deg\"", Dimension::ANGLE),
    any("tensioner.arm.stops.low", "\"-110 deg\"", Dimension::ANGLE),
    any("tensioner.arm.stops.high", "\"-60 deg\"", Dimension::ANGLE),
    any("tensioner.slide.origin.x", "\"200 mm\"", Dimension::LENGTH),
    any("tensioner.slide.origin.y", "\"-80 mm\"", Dimension::LENGTH),
    any("tensioner.slide.direction", "\"90 deg\"", Dimension::ANGLE),
    quantity(
        "tensioner.slide.stiffness",
        "\"5 N/mm\"",
        Dimension::FORCE_PER_LENGTH,
    ),
    any(
        "tensioner.slide.free_position",
        "\"60 mm\"",
        Dimension::LENGTH,
    ),
    any("tensioner.slide.preload", "\"150 N\"", Dimension::FORCE),
    quantity("tensioner.slide.weight", "\"200 N\"", Dimension::FORCE),
    any("tensioner.slide.position", "\"20 mm\"", Dimension::LENGTH),
    any(
        "tensioner.slide.rest_position",
        "\"20 mm\"",
        Dimension::LENGTH,
    ),
    any("tensioner.slide.stops.low", "\"0 mm\"", Dimension::LENGTH),
    any("tensioner.slide.stops.high", "\"50 mm\"", Dimension::LENGTH),
    quantity("layout.centre_distance", "\"1.4 m\"", Dimension::LENGTH),
    word("layout.sense", "\"clockwise\"", "sense", &SENSES),
    quantity("load.slack_tractive_tension", "\"100 N\"", Dimension::FORCE),
    quantity("load.slack_tension", "\"110 N\"", Dimension::FORCE),
    quantity("load.tight_tractive_tension", "\"700 N\"", Dimension::FORCE),
    quantity("load.tight_tension", "\"710 N\"", Dimension::FORCE),
    ranged(TORQUE, "\"45 N*m\"", Dimension::TORQUE, Range::NotNegative),
    ranged(
        "load.torque",
        "\"45 N*m\"",
        Dimension::TORQUE,
        Range::NotNegative,
    ),
    ranged(
        "load.power",
        "\"4 kW\"",
        Dimension::POWER,
        Range::NotNegative,
    ),
    quantity("load.setup_tension", "\"400 N\"", Dimension::FORCE),
    quantity("load.belt_length", "\"4.36 m\"", Dimension::LENGTH),
    text("load.span", "\"crankshaft\""),
    quantity("load.span_tension", "\"300 N\"", Dimension::FORCE),
    quantity("load.span_tractive_tension", "\"280 N\"", Dimension::FORCE),
    refused(
        "load.driver_torque",
        "\"45 N*m\"",
        "may not be given: the load is the torque of the driven pulley",
        Some(TORQUE),
    ),
    word(
        NORMAL_FORCE,
        "\"inertia\"",
        "normal force",
        &["inertia", "thesis", "exact"],
    ),
    Rule {
        path: CALIBRATED,
        example: "[\"friction.coefficient\"]",
        kind: Kind::Keys,
    },
];

/// The entries of the service of a drive, which do not change its steady states.
const SERVICE: &[Rule] = &[
    text("case.*.name", "\"full load\""),
    share("case.*.share", "\"20 %\""),
    any("case.*.torque", "\"45 N*m\"", Dimension::TORQUE),
    any("case.*.power", "\"4 kW\"", Dimension::POWER),
    quantity("case.*.speed", "\"1000 rpm\"", Dimension::ANGULAR_SPEED),
    any("case.*.pulley.*.torque", "\"20 N*m\"", Dimension::TORQUE),
    any("case.*.pulley.*.power", "\"2 kW\"", Dimension::POWER),
    quantity(
        "case.*.pulley.*.speed",
        "\"1000 rpm\"",
        Dimension::ANGULAR_SPEED,
    ),
    ranged(
        "requirements.smallest_slip_margin",
        "1.5",
        Dimension::NUMBER,
        Range::AtLeastOne,
    ),
    share("requirements.largest_speed_loss", "\"2 %\""),
    quantity(
        "requirements.largest_hub_load",
        "\"800 N\"",
        Dimension::FORCE,
    ),
    quantity("requirements.largest_tension", "\"2 kN\"", Dimension::FORCE),
    quantity(
        "losses.bending_stiffness",
        "\"0.5 N*m^2\"",
        Dimension::BENDING_STIFFNESS,
    ),
    share("losses.bending_damping", "\"20 %\""),
    quantity("losses.bearing_torque", "\"0.1 N*m\"", Dimension::TORQUE),
    Rule {
        path: "uncertainty.*",
        example: "\"5 %\"",
        kind: Kind::Spread,
    },
    text(MINIMISE, "\"hub_load\""),
];

/// The states at time 0.
const STARTS: [&str; 2] = ["rest", "running"];

/// How a load acts on a pulley.
const LOAD_SENSES: [&str; 2] = ["against-motion", "one-way"];

/// The entries of a drive in time.
const TRANSIENT: &[Rule] = &[
    word("transient.start", "\"rest\"", "state at time 0", &STARTS),
    quantity("transient.end", "\"0.6 s\"", Dimension::TIME),
    quantity("transient.interval", "\"1 ms\"", Dimension::TIME),
    quantity("transient.time_step", "\"2 us\"", Dimension::TIME),
    ranged("transient.cells", "240", Dimension::NUMBER, Range::Whole),
    ranged(
        "transient.axial_damping",
        "\"0.1 N*s\"",
        Dimension::AXIAL_DAMPING,
        Range::NotNegative,
    ),
    ranged(
        "transient.friction_damping",
        "\"2000 N*s/m^2\"",
        Dimension::DAMPING_PER_LENGTH,
        Range::NotNegative,
    ),
    ranged(
        "transient.transverse.damping",
        "\"0.2 N*s/m^2\"",
        Dimension::DAMPING_PER_LENGTH,
        Range::NotNegative,
    ),
    ranged(
        "transient.transverse.gravity",
        "\"9.81 m/s^2\"",
        Dimension::ACCELERATION,
        Range::NotNegative,
    ),
    ranged(
        "transient.transverse.gravity_direction",
        "\"-90 deg\"",
        Dimension::ANGLE,
        Range::Any,
    ),
    ranged(
        "transient.pulley.*.run_out",
        "\"0.05 mm\"",
        Dimension::LENGTH,
        Range::NotNegative,
    ),
    ranged(
        "transient.pulley.*.run_out_order",
        "1",
        Dimension::NUMBER,
        Range::Whole,
    ),
    ranged(
        "transient.pulley.*.pluck",
        "\"1 mm\"",
        Dimension::LENGTH,
        Range::Any,
    ),
    ranged(
        "transient.pulley.*.pluck_mode",
        "1",
        Dimension::NUMBER,
        Range::Whole,
    ),
    quantity(
        "transient.pulley.*.inertia",
        "\"0.005 kg*m^2\"",
        Dimension::MOMENT_OF_INERTIA,
    ),
    points(
        "transient.pulley.*.speed",
        "[[\"0 s\", \"0 rpm\"], [\"0.2 s\", \"1450 rpm\"]]",
        [Dimension::TIME, Dimension::ANGULAR_SPEED],
    ),
    points(
        "transient.pulley.*.motor_torque",
        "[[\"0 s\", \"0 N*m\"], [\"0.1 s\", \"40 N*m\"]]",
        [Dimension::TIME, Dimension::TORQUE],
    ),
    points(
        "transient.pulley.*.motor_torque_over_speed",
        "[[\"0 rpm\", \"60 N*m\"], [\"1500 rpm\", \"0 N*m\"]]",
        [Dimension::ANGULAR_SPEED, Dimension::TORQUE],
    ),
    points(
        "transient.pulley.*.load",
        "[[\"0.5 s\", \"0 N*m\"], [\"0.5 s\", \"30 N*m\"]]",
        [Dimension::TIME, Dimension::TORQUE],
    ),
    ranged(
        "transient.pulley.*.load_per_speed",
        "\"0.02 N*m*s/rad\"",
        Dimension::TORQUE_PER_SPEED,
        Range::NotNegative,
    ),
    ranged(
        "transient.pulley.*.load_amplitude",
        "\"5 N*m\"",
        Dimension::TORQUE,
        Range::NotNegative,
    ),
    quantity(
        "transient.pulley.*.load_frequency",
        "\"120 Hz\"",
        Dimension::ANGULAR_SPEED,
    ),
    word(
        "transient.pulley.*.load_sense",
        "\"one-way\"",
        "sense of a load",
        &LOAD_SENSES,
    ),
];
