//! The units in which the boundary value problem is stated.

use crate::{FrictionLaw, SpanTension, TwoPulleys, ZoneKind};

/// Units that make all states and parameters of order one.
///
/// ```text
/// tension          F₀           the prescribed tension of the tight span, or thereabouts
/// excess T − T_o   μ F₀/w       in elastic zones, w² = k_f R²/EA: layers are of the width R/w
///                  EA v_s/(ω₂ R₂), where friction grows up to the slip velocity v_s; at most F₀
///                  F₀           in all others
/// speed            ω₂ R₂        the rim of the driver
/// length           R            of each pulley; lengths along the belt are angles
/// displacement     μ F₀/(k_f R) in elastic zones, where friction k_f u is of order μ F₀/R
///                  R F₀/EA      in all others, where u′ = (T − T_o)/EA
/// ```
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    /// Unit of tensions F₀, N.
    pub(super) force: f64,
    /// Unit of speeds ω₂ R₂, m/s.
    pub(super) speed: f64,
    /// Units of lengths on the driven pulley and on the driver, m.
    pub(super) radius: [f64; 2],
    /// Units of the excess of the tension in elastic zones, in units of tension.
    excess: [f64; 2],
    /// The same in zones of creep.
    creep: f64,
    /// Units of displacements outside elastic zones, m.
    free: [f64; 2],
    /// Units of displacements in elastic zones, m.
    elastic: [f64; 2],
}

impl Units {
    /// The units for a drive.
    pub(super) fn new(drive: &TwoPulleys) -> Self {
        let (axial, speed) = (
            drive.belt.axial_stiffness,
            drive.driver_speed * drive.driver_radius,
        );
        let (stiffness, creep) = match drive.law {
            FrictionLaw::Epp { stiffness } => (Some(stiffness), 1.0),
            FrictionLaw::CreepRate { velocity } => (None, velocity / speed),
            _ => (None, 1.0),
        };
        let force = match [drive.load.slack, drive.load.tight] {
            [SpanTension::DrivenTorque(_), other] => other.value(),
            [other, SpanTension::DrivenTorque(torque)] => {
                other.value() + torque / drive.driven_radius
            }
            [slack, tight] => slack.value().max(tight.value()),
        };
        let radius = [drive.driven_radius, drive.driver_radius];
        let free = radius.map(|radius| radius * force / axial);
        let limit = drive.friction_coefficient * force;
        let elastic = |stiffness: f64| radius.map(|radius| limit / (stiffness * radius));
        let excess = |stiffness: f64| {
            radius.map(|radius| {
                let layers = (stiffness / axial).sqrt() * radius;
                (drive.friction_coefficient / layers).min(1.0)
            })
        };
        Self {
            force,
            speed,
            excess: stiffness.map_or([1.0; 2], excess),
            creep: (creep * axial / force).min(1.0),
            radius,
            free,
            elastic: stiffness.map_or(free, elastic),
        }
    }

    /// Unit of the excess of the tension over `T_o` in a zone, in units of tension.
    pub(super) fn excess(&self, pulley: usize, kind: ZoneKind) -> f64 {
        match kind {
            ZoneKind::Elastic => self.excess[pulley],
            ZoneKind::Creep => self.creep,
            ZoneKind::Adhesion | ZoneKind::Slip => 1.0,
        }
    }

    /// Unit of displacements in a zone, m.
    pub(super) fn displacement(&self, pulley: usize, kind: ZoneKind) -> f64 {
        match kind {
            ZoneKind::Elastic => self.elastic[pulley],
            ZoneKind::Adhesion | ZoneKind::Slip | ZoneKind::Creep => self.free[pulley],
        }
    }
}
