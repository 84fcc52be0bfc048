//! A part of the arc with friction of one kind.

use super::contact::{Contact, Place};
use crate::ZoneKind;
use crate::friction::{creep_rate::Creeping, epp::Elastic};
use std::ops::Deref;

/// A part of the arc with friction of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ContactZone {
    /// The belt where the zone begins.
    pub(crate) start: Place,
    /// Where it ends, as arc length, m.
    pub(crate) end: f64,
    /// What happens in between.
    pub(crate) friction: Friction,
}

/// Friction in a zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Friction {
    /// No displacement, no friction.
    Adhesion,
    /// Friction at its limit: P = P₀ exp(± a (s − s₀)).
    Slip,
    /// Friction below its limit, as a law has it.
    Developing(Law),
}

/// The laws with friction between none and its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Law {
    Elastic(Elastic),
    Creep(Creeping),
}

/// Friction below its limit in a zone.
pub(crate) trait Developing {
    /// The kind of zone.
    fn kind(&self) -> ZoneKind;

    /// The belt at a share of the zone, as [`Contact::at`].
    fn at(&self, contact: &Contact, zone: &ContactZone, share: f64) -> Place;

    /// Lengths over which a quantity grows by the factor e, in the whole zone, at most.
    fn decay_lengths(&self, contact: &Contact, zone: &ContactZone) -> f64;

    /// Arc length per share of the zone at a place, m.
    fn arc_per_share(&self, _contact: &Contact, zone: &ContactZone, _place: &Place) -> f64 {
        zone.end - zone.start.arc_length
    }

    /// How much longer the belt in the zone is than without tension, m.
    fn elongation(&self, contact: &Contact, zone: &ContactZone) -> f64 {
        contact.elongation_by_quadrature(zone)
    }
}

impl Deref for Law {
    type Target = dyn Developing;

    fn deref(&self) -> &Self::Target {
        match self {
            Self::Elastic(law) => law,
            Self::Creep(law) => law,
        }
    }
}

impl Friction {
    /// The kind of zone.
    pub(crate) fn kind(&self) -> ZoneKind {
        match self {
            Self::Adhesion => ZoneKind::Adhesion,
            Self::Slip => ZoneKind::Slip,
            Self::Developing(law) => law.kind(),
        }
    }
}
