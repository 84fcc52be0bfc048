//! The numbers of a drive with two pulleys that an entry of the drive file may stand for.

use super::closure::SpanTension;
use super::two_pulleys::TwoPulleys;
use crate::BeltKind;

/// A number of a drive with two pulleys, SI.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Number {
    /// Mass of the belt per unstretched length.
    MassPerLength,
    /// Axial stiffness of the belt.
    AxialStiffness,
    /// Radial stiffness of a V-belt.
    RadialStiffness,
    /// Half groove angle of a V-belt.
    HalfAngle,
    /// Coefficient of friction.
    FrictionCoefficient,
    /// The parameter of the friction law beside the coefficient.
    FrictionParameter,
    /// Pitch radius of the driver.
    DriverRadius,
    /// Angular speed of the driver.
    DriverSpeed,
    /// Pitch radius of the driven pulley.
    DrivenRadius,
    /// Distance between the pulley centres.
    CentreDistance,
    /// What the tension of the slack span is prescribed by.
    Slack,
    /// What the tension of the tight span is prescribed by.
    Tight,
}

impl Number {
    /// Where it stands in a drive; `None` where the drive has none.
    pub(crate) fn place(self, drive: &mut TwoPulleys) -> Option<&mut f64> {
        let v_belt = match &mut drive.belt.kind {
            BeltKind::V(belt) => Some(belt),
            BeltKind::Flat { .. } => None,
        };
        Some(match self {
            Self::MassPerLength => &mut drive.belt.mass_per_length,
            Self::AxialStiffness => &mut drive.belt.axial_stiffness,
            Self::RadialStiffness => &mut v_belt?.radial_stiffness,
            Self::HalfAngle => &mut v_belt?.half_angle,
            Self::FrictionCoefficient => &mut drive.friction_coefficient,
            Self::FrictionParameter => drive.law.parts().1?,
            Self::DriverRadius => &mut drive.driver_radius,
            Self::DriverSpeed => &mut drive.driver_speed,
            Self::DrivenRadius => &mut drive.driven_radius,
            Self::CentreDistance => &mut drive.centre_distance,
            Self::Slack => value(&mut drive.load.slack),
            Self::Tight => value(&mut drive.load.tight),
        })
    }
}

/// The number that prescribes a tension, whatever it is.
fn value(tension: &mut SpanTension) -> &mut f64 {
    match tension {
        SpanTension::Tractive(value)
        | SpanTension::Belt(value)
        | SpanTension::DrivenTorque(value) => value,
    }
}
