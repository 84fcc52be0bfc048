//! How much longer the running belt on a pulley is than without tension.
//!
//! With ε/(1 + ε) = (P + m c²)/(P + S) per length of the running belt the elongation L − `L_0` is, where the
//! belt slips, ds = dP/(± a P),
//!
//! ```text
//! | m c² ln(P₁/P₀) + D ln((S + P₁)/(S + P₀)) |/(a S)
//! ```
//!
//! and where it creeps, ds = `v_s` D/(a c) dP/(P (P − `P_o`)), that of `P_o` times the length and
//!
//! ```text
//! v_s D²/(a c S (S + P_o)) ln( P₁ (S + P₀)/(P₀ (S + P₁)) )
//! ```

use crate::friction::coulomb;
use crate::friction::rim::contact::{Arc, Contact, Friction, Place};

/// The elongation of the belt on a pulley with rigid friction, raised where it does not carry the load, m.
pub(super) fn rigid(arc: &Arc) -> f64 {
    let (slip_rate, slipping) = coulomb::slipping(arc);
    let adhesion = (arc.length - slipping) * arc.belt.elongation(arc.entry());
    let sense = arc.sense;
    adhesion
        + slipped(
            arc,
            slip_rate,
            slip_rate * slipping,
            [arc.entry(), sense * arc.change],
        )
}

/// The elongation of the belt on a pulley, m; by quadrature where friction is elastic.
pub(super) fn elongation(contact: &Contact) -> f64 {
    let (belt, arc) = (contact.arc.belt, &contact.arc);
    let zones = contact.zones.iter().map(|zone| {
        let (length, from) = (zone.end - zone.start.arc_length, zone.start.traction);
        match zone.friction {
            Friction::Adhesion => length * belt.elongation(from),
            Friction::Slip => {
                let extent = arc.slip_rate * length;
                let grown = from * (arc.sense * extent).exp_m1();
                slipped(arc, arc.slip_rate, extent, [from, grown])
            }
            Friction::Creep {
                speed, saturation, ..
            } => {
                let (reference, offset) = (contact.reference(), belt.offset());
                let to = contact.end(zone).traction;
                let logarithm = (to / from * ((offset + from) / (offset + to))).ln();
                let stiffness = belt.stiffness * belt.stiffness;
                let unit = saturation * stiffness / (arc.slip_rate * speed * offset);
                length * belt.elongation(reference) + unit * logarithm / (offset + reference)
            }
            Friction::Elastic { .. } => {
                contact.over(zone, &|place: &Place| belt.elongation(place.traction))
            }
        }
    });
    zones.sum()
}

/// The elongation where the traction grows by slip, by `extent` logarithms or by `grown` N from a value.
fn slipped(arc: &Arc, slip_rate: f64, extent: f64, [from, grown]: [f64; 2]) -> f64 {
    let (belt, offset) = (arc.belt, arc.belt.offset());
    let stretched = (grown / (offset + from)).ln_1p().abs();
    (belt.inertia * extent + belt.stiffness * stretched) / (slip_rate * offset)
}
