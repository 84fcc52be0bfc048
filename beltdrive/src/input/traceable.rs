//! The entries that a branch can be traced over, and where their values stand in a drive with two pulleys.

use super::schema;
use crate::drive::Number;
use crate::friction::{ROWS, Row};
use crate::{Drive, SpanTension, TwoPulleys};
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

/// Which number of a drive the value of an entry is.
#[derive(Clone, Copy, Debug)]
enum Slot {
    /// The same one of every drive that has it.
    Number(Number),
    /// One that depends on the load, if the entry applies.
    OfLoad(fn(&TwoPulleys) -> Option<Number>),
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

    /// Which number of a drive it is; `None` where the entry does not apply.
    pub(super) fn number(&self, drive: &TwoPulleys) -> Option<Number> {
        let number = match self.slot {
            Slot::Number(number) => number,
            Slot::OfLoad(number) => number(drive)?,
            Slot::Parameter(wanted) if drive.law.row().name == wanted.name => {
                Number::FrictionParameter
            }
            Slot::Parameter(_) => return None,
        };
        number.place(&mut { *drive }).map(|_| number)
    }

    /// Where its value stands; `None` where the entry does not apply.
    fn slot<'d>(&self, drive: &'d mut TwoPulleys) -> Option<&'d mut f64> {
        self.number(drive)?.place(drive)
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
        slot: Slot::Number(Number::MassPerLength),
    },
    Traceable {
        path: "belt.axial_stiffness",
        name: "axial stiffness",
        slot: Slot::Number(Number::AxialStiffness),
    },
    Traceable {
        path: "belt.radial_stiffness",
        name: "radial stiffness",
        slot: Slot::Number(Number::RadialStiffness),
    },
    Traceable {
        path: "groove.half_angle",
        name: "half groove angle",
        slot: Slot::Number(Number::HalfAngle),
    },
    Traceable {
        path: "friction.coefficient",
        name: "coefficient of friction",
        slot: Slot::Number(Number::FrictionCoefficient),
    },
];

/// The entries from those of the pulleys on.
const FROM_PULLEYS: [Traceable; 9] = [
    Traceable {
        path: "pulleys.driver.radius",
        name: "driver radius",
        slot: Slot::Number(Number::DriverRadius),
    },
    Traceable {
        path: "pulleys.driver.speed",
        name: "driver speed",
        slot: Slot::Number(Number::DriverSpeed),
    },
    Traceable {
        path: "pulleys.driven.radius",
        name: "driven radius",
        slot: Slot::Number(Number::DrivenRadius),
    },
    Traceable {
        path: "layout.centre_distance",
        name: "centre distance",
        slot: Slot::Number(Number::CentreDistance),
    },
    Traceable {
        path: schema::SLACK[0],
        name: "slack tractive tension",
        slot: Slot::OfLoad(|drive| tractive(drive.load.slack, Number::Slack)),
    },
    Traceable {
        path: schema::SLACK[1],
        name: "slack tension",
        slot: Slot::OfLoad(|drive| belt(drive.load.slack, Number::Slack)),
    },
    Traceable {
        path: schema::TIGHT[0],
        name: "tight tractive tension",
        slot: Slot::OfLoad(|drive| tractive(drive.load.tight, Number::Tight)),
    },
    Traceable {
        path: schema::TIGHT[1],
        name: "tight tension",
        slot: Slot::OfLoad(|drive| belt(drive.load.tight, Number::Tight)),
    },
    Traceable {
        path: schema::TORQUE,
        name: "driven torque",
        slot: Slot::OfLoad(torque),
    },
];

/// The number of a span whose tractive tension is prescribed.
fn tractive(span: SpanTension, number: Number) -> Option<Number> {
    matches!(span, SpanTension::Tractive(_)).then_some(number)
}

/// The number of a span whose belt tension is prescribed.
fn belt(span: SpanTension, number: Number) -> Option<Number> {
    matches!(span, SpanTension::Belt(_)).then_some(number)
}

/// The driven torque, whichever span follows from it.
fn torque(drive: &TwoPulleys) -> Option<Number> {
    let spans = [
        (drive.load.slack, Number::Slack),
        (drive.load.tight, Number::Tight),
    ];
    let by_torque = |span| matches!(span, SpanTension::DrivenTorque(_));
    let found = spans.into_iter().find(|&(span, _)| by_torque(span));
    found.map(|(_, number)| number)
}
