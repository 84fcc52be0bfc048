//! Elastic/perfectly-plastic friction f = min(`k_f` |u|, μ n) in closed form (Kim 2009, chapter 2).
//!
//! ```text
//! elastic   |u| = (e/w) sinh w σ       P = P_o ± D |u|′      w = sqrt(k_f/D), e = |u|′(0)
//! slip      P = P₁ exp(± a (s − s₁))
//! ```
//!
//! with the upper sign on the driven pulley. Where slip begins, at σ₁, friction is at its limit,
//! `k_f` |u₁| = a P₁ (α + β P₁), and P₁ follows from σ₁ by a quadratic equation,
//!
//! ```text
//! P₁ = P(0) ± (a/w) tanh(w σ₁/2) P₁ (α + β P₁)
//! ```
//!
//! so that the load is an explicit function of σ₁, which is the unknown: the strain
//! e = w |u₁|/sinh(w σ₁) would be one only as long as it is no smaller than 1e-308.
//!
//! Where the bristles are so soft that a > w, the limit of friction rises along the driven pulley
//! faster than elastic friction can follow: the belt that slips sticks again, and there is a third,
//! elastic zone. The first zone then ends before the elastic friction touches its limit from below.

mod arc;
mod zone;

pub(crate) use zone::Elastic;

use super::rim::contact::{Arc, Contact};
use super::row::{OnRims, Other};
use super::{Parameter, Row};
use crate::FrictionLaw;
use crate::mechanics::implicit::{Implicit, bracketed};
use crate::quantity::Measure;
use arc::ElasticArc;

/// A stiffness in place of 0: it is so soft that the displacement is a parabola.
const SOFT: f64 = 1e-9;

const STIFFNESS: Parameter = Parameter {
    path: "friction.stiffness",
    name: "friction stiffness",
    symbol: "k_f",
    measure: Measure::ForcePerArea,
    example: "\"8.1e6 N/m^2\"",
};

/// Friction `min(k_f |u|, μ p)` along the slip.
pub(super) const ROW: Row = Row {
    name: "epp",
    title: "elastic/perfectly-plastic",
    other: Some(Other {
        path: "friction.epp.kind",
        words: ["scalar", "vector"],
        example: "\"vector\"",
        row: &VECTOR,
    }),
    parameter: Some(STIFFNESS),
    with: |stiffness| FrictionLaw::Epp { stiffness },
    in_grooves: true,
    on_rims: Some(OnRims { convention: None }),
};

/// The same as a vector in the face of a groove. On the rim of a flat pulley there is one direction only.
pub(super) const VECTOR: Row = Row {
    name: "epp",
    title: "vector elastic/perfectly-plastic",
    other: None,
    parameter: Some(STIFFNESS),
    with: |stiffness| FrictionLaw::VectorEpp { stiffness },
    in_grooves: true,
    on_rims: None,
};

/// The contact of an arc with friction of stiffness `k_f`, N/m²; `None` if the load is not below the
/// capacity of the arc.
pub(crate) fn solve<S: Implicit>(arc: Arc<S>, stiffness: S) -> Option<Contact<S>> {
    let elastic = ElasticArc::new(arc, stiffness);
    let load = arc.load();
    if load >= arc.capacity() {
        return None;
    }
    if let Some(contact) = elastic.near(load) {
        return Some(contact);
    }
    let last = elastic.last_transition()?;
    let excess = elastic.load(last)? - load;
    if excess >= 0.0 {
        return elastic.all_elastic();
    }
    let nowhere = S::from_f64(f64::NAN);
    let residual = |place| elastic.load(place).map_or(nowhere, |found| found - load);
    let ends = [arc.capacity() - load, excess];
    let place = bracketed(residual, [S::ZERO, last], ends)?;
    elastic.slipping(place)
}

/// The stiffness below which friction is elastic over the whole arc, N/m², if there is one at this load.
pub(crate) fn smallest_stiffness(arc: Arc) -> Option<f64> {
    let load = arc.load();
    let excess = |logarithm: f64| {
        let elastic = ElasticArc::new(arc, logarithm.exp());
        let carried = elastic
            .last_transition()
            .and_then(|last| elastic.load(last));
        carried.map_or(f64::NAN, |carried| carried - load)
    };
    let unit = arc.belt.stiffness / (arc.length * arc.length);
    let softest = (SOFT * unit).ln();
    // With stiff bristles an elastic arc carries a load of a/w.
    let stiffest = (arc.belt.stiffness * (4.0 * arc.slip_rate / load).powi(2)).ln();
    let ends = [softest, stiffest.max(softest + 1.0)];
    let root = bracketed(excess, ends, ends.map(excess))?;
    Some(root.exp())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NormalForce;
    use crate::friction::rim::traction::Traction;

    /// An arc of 0.3 m that takes the traction from 300 N to 500 N, or back.
    pub(super) fn sample(belt: Traction, sense: f64) -> Arc {
        Arc {
            belt,
            sense,
            slip_rate: belt.slip_rate(0.5, 0.1),
            length: 0.3,
            low: 300.0,
            change: 200.0,
        }
    }

    #[test]
    fn where_slip_begins_is_found_in_few_evaluations() {
        for normal_force in NormalForce::ALL {
            let belt = Traction::new(normal_force, 0.1, 1e5, 20.0);
            for sense in [1.0, -1.0] {
                let arc = sample(belt, sense);
                let contact = solve(arc, 1e8).unwrap();
                assert_eq!(contact.zones.len(), 2);
                assert!(contact.evaluations < 8, "{}", contact.evaluations);
                assert!((contact.end(&contact.zones[1]).traction / arc.exit() - 1.0).abs() < 1e-13);
            }
        }
    }
}
