//! A drive as its engineer describes it, in SI units.

pub(crate) mod belt_loop;
pub(crate) mod check;
pub(crate) mod layout;

use crate::{Belt, FrictionLaw};

/// A two-pulley belt drive and its load: everything a drive file states.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// A name for outputs and figures.
    pub title: Option<String>,
    /// The belt.
    pub belt: Belt,
    /// Coefficient of friction μ > 0 between belt and pulleys.
    pub friction_coefficient: f64,
    /// How friction depends on slip.
    pub law: FrictionLaw,
    /// Pitch radius of the driver, m.
    pub driver_radius: f64,
    /// Angular speed ω₂ of the driver, rad/s; positive.
    pub driver_speed: f64,
    /// Pitch radius of the driven pulley, m.
    pub driven_radius: f64,
    /// Distance between the pulley centres, m; greater than the sum of the radii.
    pub centre_distance: f64,
    /// The end tensions that close the drive.
    pub load: Load,
}

/// What is prescribed for the two spans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Tension of the slack span.
    pub slack: SpanTension,
    /// Tension of the tight span; at least that of the slack span.
    pub tight: SpanTension,
}

/// What the tension of a span is prescribed by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpanTension {
    /// Tractive tension F = T − G V, N.
    Tractive(f64),
    /// Belt tension T, N.
    Belt(f64),
    /// Torque of the driven pulley, N·m, not negative: the tension follows from that of the other
    /// span. One span at most; flat belts only.
    DrivenTorque(f64),
}

impl SpanTension {
    /// The prescribed number, N or N·m, whatever it is.
    pub fn value(self) -> f64 {
        match self {
            Self::Tractive(value) | Self::Belt(value) | Self::DrivenTorque(value) => value,
        }
    }

    /// Another number of the same kind.
    pub(crate) fn with_value(self, value: f64) -> Self {
        match self {
            Self::Tractive(_) => Self::Tractive(value),
            Self::Belt(_) => Self::Belt(value),
            Self::DrivenTorque(_) => Self::DrivenTorque(value),
        }
    }
}
