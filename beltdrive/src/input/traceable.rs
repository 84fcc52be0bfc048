//! The entries that a branch can be traced over, and where their values stand in a drive.

use super::schema;
use crate::{BeltKind, Drive, FrictionLaw, Load, SpanTension, VBelt};

/// An entry with the place of its value in a drive.
#[derive(Debug)]
pub(super) struct Traceable {
    /// Its dotted path.
    pub(super) path: &'static str,
    /// What it is called.
    pub(super) name: &'static str,
    /// Where its value stands; `None` where the entry does not apply.
    pub(super) slot: fn(&mut Drive) -> Option<&mut f64>,
}

/// Every entry, in the order of the drive file.
pub(super) const ENTRIES: [Traceable; 17] = [
    Traceable {
        path: "belt.mass_per_length",
        name: "mass per length",
        slot: |drive| Some(&mut drive.belt.mass_per_length),
    },
    Traceable {
        path: "belt.axial_stiffness",
        name: "axial stiffness",
        slot: |drive| Some(&mut drive.belt.axial_stiffness),
    },
    Traceable {
        path: "belt.radial_stiffness",
        name: "radial stiffness",
        slot: |drive| v_belt(drive).map(|belt| &mut belt.radial_stiffness),
    },
    Traceable {
        path: "groove.half_angle",
        name: "half groove angle",
        slot: |drive| v_belt(drive).map(|belt| &mut belt.half_angle),
    },
    Traceable {
        path: "friction.coefficient",
        name: "coefficient of friction",
        slot: |drive| Some(&mut drive.friction_coefficient),
    },
    Traceable {
        path: "friction.stiffness",
        name: "friction stiffness",
        slot: |drive| match &mut drive.law {
            FrictionLaw::Epp { stiffness } => Some(stiffness),
            _ => None,
        },
    },
    Traceable {
        path: "friction.bristle_stiffness",
        name: "bristle stiffness",
        slot: |drive| match &mut drive.law {
            FrictionLaw::Bristle { stiffness } => Some(stiffness),
            _ => None,
        },
    },
    Traceable {
        path: "friction.velocity",
        name: "creep velocity",
        slot: |drive| match &mut drive.law {
            FrictionLaw::CreepRate { velocity } => Some(velocity),
            _ => None,
        },
    },
    Traceable {
        path: "pulleys.driver.radius",
        name: "driver radius",
        slot: |drive| Some(&mut drive.driver_radius),
    },
    Traceable {
        path: "pulleys.driver.speed",
        name: "driver speed",
        slot: |drive| Some(&mut drive.driver_speed),
    },
    Traceable {
        path: "pulleys.driven.radius",
        name: "driven radius",
        slot: |drive| Some(&mut drive.driven_radius),
    },
    Traceable {
        path: "layout.centre_distance",
        name: "centre distance",
        slot: |drive| Some(&mut drive.centre_distance),
    },
    Traceable {
        path: schema::SLACK[0],
        name: "slack tractive tension",
        slot: |drive| tractive(&mut drive.load.slack),
    },
    Traceable {
        path: schema::SLACK[1],
        name: "slack tension",
        slot: |drive| belt(&mut drive.load.slack),
    },
    Traceable {
        path: schema::TIGHT[0],
        name: "tight tractive tension",
        slot: |drive| tractive(&mut drive.load.tight),
    },
    Traceable {
        path: schema::TIGHT[1],
        name: "tight tension",
        slot: |drive| belt(&mut drive.load.tight),
    },
    Traceable {
        path: schema::TORQUE,
        name: "driven torque",
        slot: |drive| torque(&mut drive.load),
    },
];

fn v_belt(drive: &mut Drive) -> Option<&mut VBelt> {
    match &mut drive.belt.kind {
        BeltKind::V(belt) => Some(belt),
        BeltKind::Flat { .. } => None,
    }
}

fn tractive(tension: &mut SpanTension) -> Option<&mut f64> {
    match tension {
        SpanTension::Tractive(value) => Some(value),
        _ => None,
    }
}

fn belt(tension: &mut SpanTension) -> Option<&mut f64> {
    match tension {
        SpanTension::Belt(value) => Some(value),
        _ => None,
    }
}

/// The driven torque, whichever span follows from it.
fn torque(load: &mut Load) -> Option<&mut f64> {
    [&mut load.slack, &mut load.tight]
        .into_iter()
        .find_map(|tension| match tension {
            SpanTension::DrivenTorque(value) => Some(value),
            _ => None,
        })
}
