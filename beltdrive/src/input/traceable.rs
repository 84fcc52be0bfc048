//! The entries that a branch can be traced over, and where their values stand in a drive with two pulleys.

use super::schema;
use crate::friction::{ROWS, Row};
use crate::{BeltKind, Drive, Load, SpanTension, TwoPulleys, VBelt};
use std::sync::LazyLock;

/// An entry with the place of its value in a drive.
#[derive(Debug)]
pub(super) struct Traceable {
    /// Its dotted path.
    pub(super) path: &'static str,
    /// What it is called.
    pub(super) name: &'static str,
    slot: Slot,
}

/// Where the value of an entry stands.
#[derive(Clone, Copy, Debug)]
enum Slot {
    /// At a place of the numbers of the drive, if the entry applies.
    Of(fn(&mut TwoPulleys) -> Option<&mut f64>),
    /// It is the parameter of a friction law.
    Parameter(&'static Row),
}

impl Traceable {
    /// Its value in a drive, SI; `None` where the entry does not apply.
    pub(super) fn get(&self, drive: &Drive) -> Option<f64> {
        self.slot(&mut drive.two_pulleys()?).copied()
    }

    /// Changes its value in a drive, SI; `None` where the entry does not apply.
    pub(super) fn set(&self, drive: &mut Drive, value: f64) -> Option<()> {
        let mut two = drive.two_pulleys()?;
        *self.slot(&mut two)? = value;
        drive.set_two_pulleys(two);
        Some(())
    }

    /// Where its value stands; `None` where the entry does not apply.
    fn slot<'d>(&self, drive: &'d mut TwoPulleys) -> Option<&'d mut f64> {
        match self.slot {
            Slot::Of(place) => place(drive),
            Slot::Parameter(wanted) => {
                let (row, value) = drive.law.parts();
                value.filter(|_| row.name == wanted.name)
            }
        }
    }
}

/// Every entry, in the order of the drive file.
pub(super) static ENTRIES: LazyLock<Vec<Traceable>> = LazyLock::new(|| {
    let parameters = ROWS.iter().copied().filter_map(|row| {
        let parameter = row.parameter.as_ref()?;
        Some(Traceable {
            path: parameter.path,
            name: parameter.name,
            slot: Slot::Parameter(row),
        })
    });
    let up_to_friction = UP_TO_FRICTION.into_iter();
    up_to_friction
        .chain(parameters)
        .chain(FROM_PULLEYS)
        .collect()
});

/// The entries up to those that all friction laws have.
const UP_TO_FRICTION: [Traceable; 5] = [
    Traceable {
        path: "belt.mass_per_length",
        name: "mass per length",
        slot: Slot::Of(|drive| Some(&mut drive.belt.mass_per_length)),
    },
    Traceable {
        path: "belt.axial_stiffness",
        name: "axial stiffness",
        slot: Slot::Of(|drive| Some(&mut drive.belt.axial_stiffness)),
    },
    Traceable {
        path: "belt.radial_stiffness",
        name: "radial stiffness",
        slot: Slot::Of(|drive| v_belt(drive).map(|belt| &mut belt.radial_stiffness)),
    },
    Traceable {
        path: "groove.half_angle",
        name: "half groove angle",
        slot: Slot::Of(|drive| v_belt(drive).map(|belt| &mut belt.half_angle)),
    },
    Traceable {
        path: "friction.coefficient",
        name: "coefficient of friction",
        slot: Slot::Of(|drive| Some(&mut drive.friction_coefficient)),
    },
];

/// The entries from those of the pulleys on.
const FROM_PULLEYS: [Traceable; 9] = [
    Traceable {
        path: "pulleys.driver.radius",
        name: "driver radius",
        slot: Slot::Of(|drive| Some(&mut drive.driver_radius)),
    },
    Traceable {
        path: "pulleys.driver.speed",
        name: "driver speed",
        slot: Slot::Of(|drive| Some(&mut drive.driver_speed)),
    },
    Traceable {
        path: "pulleys.driven.radius",
        name: "driven radius",
        slot: Slot::Of(|drive| Some(&mut drive.driven_radius)),
    },
    Traceable {
        path: "layout.centre_distance",
        name: "centre distance",
        slot: Slot::Of(|drive| Some(&mut drive.centre_distance)),
    },
    Traceable {
        path: schema::SLACK[0],
        name: "slack tractive tension",
        slot: Slot::Of(|drive| tractive(&mut drive.load.slack)),
    },
    Traceable {
        path: schema::SLACK[1],
        name: "slack tension",
        slot: Slot::Of(|drive| belt(&mut drive.load.slack)),
    },
    Traceable {
        path: schema::TIGHT[0],
        name: "tight tractive tension",
        slot: Slot::Of(|drive| tractive(&mut drive.load.tight)),
    },
    Traceable {
        path: schema::TIGHT[1],
        name: "tight tension",
        slot: Slot::Of(|drive| belt(&mut drive.load.tight)),
    },
    Traceable {
        path: schema::TORQUE,
        name: "driven torque",
        slot: Slot::Of(|drive| torque(&mut drive.load)),
    },
];

fn v_belt(drive: &mut TwoPulleys) -> Option<&mut VBelt> {
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
