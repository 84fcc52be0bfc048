//! Coulomb friction that is weaker in slip than at rest, μ n χ, on the rim of a flat belt.

use super::coulomb;
use super::rim::contact::{Arc, Contact};
use super::row::OnRims;
use super::{Parameter, Row};
use crate::FrictionLaw;
use crate::quantity::Measure;

pub(super) const ROW: Row = Row {
    name: "kinetic",
    title: "kinetic",
    parameter: Some(Parameter {
        path: "friction.kinetic_ratio",
        name: "kinetic ratio",
        symbol: "χ",
        measure: Measure::Number,
        example: "0.8",
    }),
    with: |ratio| FrictionLaw::Kinetic { ratio },
    in_grooves: false,
    on_rims: Some(OnRims {
        solve: |arc, _, ratio| solve(arc, ratio),
        convention: None,
    }),
};

/// The contact of an arc that slips with the share `ratio` of its friction at rest.
fn solve(arc: Arc, ratio: f64) -> Option<Contact> {
    coulomb::solve(Arc {
        slip_rate: ratio * arc.slip_rate,
        ..arc
    })
}
