//! Coulomb friction: an arc of adhesion, then an arc of slip (Johnson, Contact Mechanics, 1985).

use super::Row;
use super::rim::contact::{Arc, Contact, Place};
use super::rim::zone::{ContactZone, Friction};
use super::row::OnRims;
use crate::FrictionLaw;
use bvp::Real;

pub(super) const ROW: Row = Row {
    name: "coulomb",
    title: "Coulomb",
    other: None,
    parameter: None,
    with: |_| FrictionLaw::Coulomb,
    in_grooves: true,
    on_rims: Some(OnRims { convention: None }),
};

/// The contact of an arc with rigid friction: the belt enters as fast as the rim, keeps its tension
/// over the arc of adhesion, and slips over the last ln(P(L)/P(0))/a of the arc. `None` if that is not
/// less than the whole arc.
pub(crate) fn solve<S: Real>(arc: Arc<S>) -> Option<Contact<S>> {
    let slipping = arc.load() / arc.slip_rate;
    (slipping < arc.length).then(|| contact(arc, slipping))
}

/// As [`solve`], but an arc whose friction does not carry the load slips as a whole, with its friction
/// raised to what does.
pub(crate) fn carried<S: Real>(arc: Arc<S>) -> Contact<S> {
    let (slip_rate, slipping) = slipping(&arc);
    contact(Arc { slip_rate, ..arc }, slipping)
}

/// The slip rate of an arc, raised to what carries the load, in 1/m, and the length on which it slips, m.
pub(crate) fn slipping<S: Real>(arc: &Arc<S>) -> (S, S) {
    let load = arc.load();
    let slip_rate = arc.slip_rate.max(load / arc.length);
    (slip_rate, (load / slip_rate).min(arc.length))
}

/// The contact with an arc of slip of a given length.
fn contact<S: Real>(arc: Arc<S>, slipping: S) -> Contact<S> {
    let start = Place {
        arc_length: S::ZERO,
        traction: arc.entry(),
        displacement: S::ZERO,
        friction: S::ZERO,
    };
    let place = arc.length - slipping;
    let mut zones = vec![ContactZone {
        start,
        end: place,
        friction: Friction::Adhesion,
    }];
    if slipping > 0.0 {
        let start = Place {
            arc_length: place,
            ..start
        };
        zones.push(ContactZone {
            start,
            end: arc.length,
            friction: Friction::Slip,
        });
    }
    Contact {
        arc,
        strain: S::ZERO,
        zones,
        evaluations: 0,
    }
}
