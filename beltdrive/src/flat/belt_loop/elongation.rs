//! How much longer the running belt on a pulley is than without tension.
//!
//! With ε/(1 + ε) = (P + m c²)/(P + S) per length of the running belt the elongation L − `L_0` is, where the
//! belt slips, ds = dP/(± a P),
//!
//! ```text
//! | m c² ln(P₁/P₀) + D ln((S + P₁)/(S + P₀)) |/(a S)
//! ```

use crate::friction::coulomb;
use crate::friction::rim::contact::{Arc, Contact};
use crate::friction::rim::zone::Friction;
use bvp::Real;

/// The elongation of the belt on a pulley with rigid friction, raised where it does not carry the load, m.
pub(super) fn rigid<S: Real>(arc: &Arc<S>) -> S {
    let (slip_rate, slipping) = coulomb::slipping(arc);
    let adhesion = (arc.length - slipping) * arc.belt.elongation(arc.entry());
    let sense = arc.sense;
    adhesion
        + slipped(
            arc,
            slip_rate,
            slip_rate * slipping,
            [arc.entry(), arc.change * sense],
        )
}

/// The elongation of the belt on a pulley, m.
pub(super) fn elongation<S: Real>(contact: &Contact<S>) -> S {
    let (belt, arc) = (contact.arc.belt, &contact.arc);
    let zones = contact.zones.iter().map(|zone| {
        let (length, from) = (zone.end - zone.start.arc_length, zone.start.traction);
        match &zone.friction {
            Friction::Adhesion => length * belt.elongation(from),
            Friction::Slip => {
                let extent = arc.slip_rate * length;
                let grown = from * (extent * arc.sense).exp_m1();
                slipped(arc, arc.slip_rate, extent, [from, grown])
            }
            Friction::Developing(law) => law.own().elongation(contact, zone),
        }
    });
    zones.sum()
}

/// The elongation where the traction grows by slip, by `extent` logarithms or by `grown` N from a value.
fn slipped<S: Real>(arc: &Arc<S>, slip_rate: S, extent: S, [from, grown]: [S; 2]) -> S {
    let (belt, offset) = (arc.belt, arc.belt.offset());
    let stretched = (grown / (offset + from)).ln_1p().abs();
    (belt.inertia * extent + belt.stiffness * stretched) / (slip_rate * offset)
}
