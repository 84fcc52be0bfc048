//! A part of the arc with friction of one kind.

use super::contact::{Contact, Place};
use crate::ZoneKind;
use crate::friction::{creep_rate::Creeping, epp::Elastic};
use bvp::Real;

/// A part of the arc with friction of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ContactZone<S = f64> {
    /// The belt where the zone begins.
    pub(crate) start: Place<S>,
    /// Where it ends, as arc length, m.
    pub(crate) end: S,
    /// What happens in between.
    pub(crate) friction: Friction<S>,
}

/// Friction in a zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Friction<S = f64> {
    /// No displacement, no friction.
    Adhesion,
    /// Friction at its limit: P = P₀ exp(± a (s − s₀)).
    Slip,
    /// Friction below its limit, as a law has it.
    Developing(Law<S>),
}

/// The laws with friction between none and its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Law<S = f64> {
    Elastic(Elastic<S>),
    Creep(Creeping<S>),
}

/// Friction below its limit in a zone.
pub(crate) trait Developing<S: Real> {
    /// The kind of zone.
    fn kind(&self) -> ZoneKind;

    /// The belt at a share of the zone, as [`Contact::at`].
    fn at(&self, contact: &Contact<S>, zone: &ContactZone<S>, share: S) -> Place<S>;

    /// Lengths over which a quantity grows by the factor e, in the whole zone, at most.
    fn decay_lengths(&self, contact: &Contact<S>, zone: &ContactZone<S>) -> S;

    /// Arc length per share of the zone at a place, m.
    fn arc_per_share(&self, _contact: &Contact<S>, zone: &ContactZone<S>, _place: &Place<S>) -> S {
        zone.end - zone.start.arc_length
    }

    /// How much longer the belt in the zone is than without tension, m.
    fn elongation(&self, contact: &Contact<S>, zone: &ContactZone<S>) -> S {
        contact.elongation_by_quadrature(zone)
    }
}

impl<S: Real> Law<S> {
    /// What the law says of friction in the zone.
    pub(crate) fn own(&self) -> &dyn Developing<S> {
        match self {
            Self::Elastic(law) => law,
            Self::Creep(law) => law,
        }
    }
}

impl<S: Real> Friction<S> {
    /// The kind of zone.
    pub(crate) fn kind(&self) -> ZoneKind {
        match self {
            Self::Adhesion => ZoneKind::Adhesion,
            Self::Slip => ZoneKind::Slip,
            Self::Developing(law) => law.own().kind(),
        }
    }
}
