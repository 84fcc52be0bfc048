//! What there is to tell of a pulley of a belt loop.

use super::super::scale::{HUB_LOAD, Scale};
use super::super::{Measure, Quantity, Subject, Value, words};
use super::statement::coefficient;
use crate::belt_loop::LoopState;
use crate::{BeltKind, Drive, Duty, Profile, Side};

/// A pulley, with the belt along it.
pub(super) fn subject(drive: &Drive, state: &LoopState, index: usize, scale: &Scale) -> Subject {
    let (stated, pulley) = (&drive.pulleys[index], &state.pulleys[index]);
    let profile = &state.profile(index);
    let radius = stated.radius;
    let ribs = f64::from(drive.belt.ribs);
    // A torque is a difference of tensions.
    let torque = scale.tension * radius;
    let is_ribbed = drive.belt.ribs > 1;
    let side = match stated.side {
        Side::Inside => "inside",
        Side::Outside => "outside",
    };
    let duty = match stated.duty {
        Duty::Driver(_) => "driver",
        Duty::Torque(_) | Duty::Driven => "torque",
        Duty::Power(_) => "power",
    };
    let margin = scale.with(pulley.torque_margin_error);
    let mut quantities = vec![
        Quantity::word("name", "", pulley.name.clone()),
        Quantity::word("side", "", side.to_owned()),
        Quantity::word("duty", "", duty.to_owned()),
        Quantity::data("centre", Measure::Length, Value::Pair(pulley.centre)),
        Quantity::data("radius", Measure::Length, Value::Number(Some(radius))),
        scale.relative(
            "friction_coefficient",
            match coefficient(drive) {
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
        scale.power("power", "power", pulley.power),
        scale.angle("wrap_angle", "wrap angle", pulley.wrap),
        scale.angle("rest_wrap_angle", "", pulley.rest_wrap),
        scale.angle("no_slip_arc", "", pulley.no_slip_arc),
        scale.angle("slip_arc", "slip arc", pulley.slip_arc),
        scale.relative(
            "friction_utilisation",
            "friction utilisation",
            Measure::Share,
            pulley.friction_utilisation,
        ),
        margin.relative(
            "torque_capacity",
            "torque capacity",
            Measure::Torque,
            pulley.torque_capacity,
        ),
        margin.relative(
            "torque_margin",
            "torque margin",
            Measure::Number,
            pulley.torque_margin,
        ),
        scale.against(
            "speed_loss",
            words::speed_loss(drive.belt.kind).0,
            Measure::Share,
            pulley.speed_loss,
            1.0,
        ),
        scale.loss("friction_loss", "friction loss", pulley.friction_loss),
        scale.relative(
            "reference_tension",
            "",
            Measure::Force,
            pulley.reference_tension,
        ),
        scale.relative("entry_strain", "", Measure::Number, pulley.entry_strain),
    ];
    quantities.extend(scale.hub_load(HUB_LOAD, "hub load", pulley.hub_load));
    quantities.extend(scale.hub_load(
        [
            "hub_load_rest",
            "hub_load_rest_magnitude",
            "hub_load_rest_direction",
        ],
        "hub load at rest",
        pulley.rest_hub_load,
    ));
    quantities.push(scale.zones(&pulley.zones));
    if let BeltKind::V(_) = drive.belt.kind {
        let groove = pulley.groove.as_ref();
        let inclination = |end: usize| groove.map(|groove| groove.inclination[end]);
        quantities.extend([
            scale.relative(
                "max_penetration",
                "largest penetration",
                Measure::Length,
                groove.map(|groove| groove.max_penetration),
            ),
            scale.angle("entry_inclination", "inclination at entry", inclination(0)),
            scale.angle("exit_inclination", "inclination at exit", inclination(1)),
            scale.relative(
                "transverse_loss",
                "",
                Measure::Loss,
                groove.map(|groove| groove.transverse_loss),
            ),
        ]);
        let least = groove.map(|groove| groove.least_slip);
        quantities.extend(least.iter().flat_map(|least| scale.least_slip(least)));
        quantities.extend(scale.locked(least.as_ref()));
    }
    quantities.extend(along(profile));
    Subject::new(&*pulley.name, quantities)
}

/// The belt along a pulley.
pub(crate) fn along(profile: &Profile) -> [Quantity; 10] {
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
