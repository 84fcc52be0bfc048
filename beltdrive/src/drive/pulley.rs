//! A pulley of a drive.

use super::layout::Side;
use super::tensioner::Tensioner;

/// A pulley of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulley {
    /// The name in messages.
    pub name: String,
    /// What holds its axis.
    pub mount: Mount,
    /// Radius R of the centre line of the belt, m; positive. Of a V-belt: of the pitch line where the belt
    /// enters the groove, or where it lies on a flat pulley on its back.
    pub radius: f64,
    /// On which side of the belt it lies. A pulley outside touches the back of a V-belt and is flat.
    pub side: Side,
    /// Coefficient of friction μ > 0 between belt and pulley.
    pub friction_coefficient: f64,
    /// Half groove angle β of this pulley in rad, 0 < β < π/2, if it is not that of the belt; of V-belts
    /// and pulleys inside only.
    pub half_angle: Option<f64>,
    /// What it does.
    pub duty: Duty,
}

impl Pulley {
    /// A pulley with a fixed centre in m and a radius in m inside the loop, with the groove of the belt.
    #[must_use]
    pub fn new(
        name: &str,
        centre: [f64; 2],
        radius: f64,
        friction_coefficient: f64,
        duty: Duty,
    ) -> Self {
        Self {
            name: name.to_owned(),
            mount: Mount::Fixed(centre),
            radius,
            side: Side::Inside,
            friction_coefficient,
            half_angle: None,
            duty,
        }
    }
}

/// What holds the axis of a pulley.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mount {
    /// A fixed centre, m.
    Fixed([f64; 2]),
    /// A tensioner; for one idler of a loop.
    Tensioner(Tensioner),
}

/// What a pulley does in a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Duty {
    /// It turns with the belt at this angular speed, rad/s; positive.
    Driver(f64),
    /// This torque in N·m acts between belt and shaft: positive where it takes power out of the belt, 0 on
    /// an idler, negative where it drives as well.
    Torque(f64),
    /// It takes this power in W out of the belt; negative where it puts power into it.
    Power(f64),
    /// It takes what the tensions of both spans leave it, with [`Closure::BothSpans`](crate::Closure::BothSpans) only.
    Driven,
}

impl Duty {
    /// The number that it gives, SI; 0 without one.
    pub(crate) fn value(self) -> f64 {
        match self {
            Self::Driver(value) | Self::Torque(value) | Self::Power(value) => value,
            Self::Driven => 0.0,
        }
    }

    /// Torque in N·m of a pulley that turns at a speed in rad/s; 0 where it follows from the others.
    pub(crate) fn torque_at(self, speed: f64) -> f64 {
        match self {
            Self::Driver(_) | Self::Driven => 0.0,
            Self::Torque(torque) => torque,
            Self::Power(power) => power / speed,
        }
    }
}
