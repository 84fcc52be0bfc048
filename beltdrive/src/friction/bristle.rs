//! Vector bristles in the groove face with a stiffness proportional to the pressure (after Dahl 1968).

use super::{Parameter, Row};
use crate::FrictionLaw;
use crate::quantity::Measure;

pub(super) const ROW: Row = Row {
    name: "bristle",
    title: "bristle",
    other: None,
    parameter: Some(Parameter {
        path: "friction.bristle_stiffness",
        name: "bristle stiffness",
        symbol: "κ",
        measure: Measure::InverseLength,
        example: "\"1620 1/m\"",
    }),
    with: |stiffness| FrictionLaw::Bristle { stiffness },
    in_grooves: true,
    on_rims: None,
};
