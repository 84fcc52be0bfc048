//! What there is to tell of the tensioner of a belt loop.

use super::super::scale::Scale;
use super::super::{Measure, Quantity, Value};
use crate::Guide;
use crate::belt_loop::TensionerState;

/// The tensioner, in this guide with its pulley of this name.
pub(super) fn quantities(
    name: &str,
    guide: &Guide,
    found: &TensionerState,
    scale: &Scale,
) -> Vec<Quantity> {
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
    vec![
        Quantity::word("pulley", "tensioner", name.to_owned()),
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
    ]
}
