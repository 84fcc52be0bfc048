//! Coulomb friction of which a share acts: a toy that shows what a law costs.

use super::rim::contact::Arc;
use super::row::OnRims;
use super::{Parameter, Row, coulomb};
use crate::FrictionLaw;
use crate::quantity::Measure;

pub(super) const ROW: Row = Row {
    name: "toy",
    title: "a share of Coulomb",
    other: None,
    parameter: Some(Parameter {
        path: "friction.share",
        name: "share",
        symbol: "σ",
        measure: Measure::Number,
        example: "0.5",
    }),
    with: |share| FrictionLaw::Toy { share },
    in_grooves: false,
    on_rims: Some(OnRims {
        solve: |arc, _, share| {
            coulomb::solve(Arc {
                slip_rate: arc.slip_rate * share,
                ..arc
            })
        },
        convention: None,
    }),
};
