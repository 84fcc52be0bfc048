//! Physical dimensions and their names.

use crate::quantity::Measure;
use std::fmt;

/// Exponents of mass, length, time and angle.
///
/// Angle counts as a dimension here, although SI takes it for a pure number, so that `rad/s`, `rpm`
/// and `Hz` are told from `1/s`, and an angle from a coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Dimension {
    mass: i32,
    length: i32,
    time: i32,
    angle: i32,
}

impl Dimension {
    pub(super) const NUMBER: Self = Self::new(0, 0, 0, 0);
    pub(super) const MASS: Self = Self::new(1, 0, 0, 0);
    pub(super) const LENGTH: Self = Self::new(0, 1, 0, 0);
    pub(super) const TIME: Self = Self::new(0, 0, 1, 0);
    pub(super) const ANGLE: Self = Self::new(0, 0, 0, 1);
    pub(super) const INVERSE_LENGTH: Self = Self::new(0, -1, 0, 0);
    pub(super) const VELOCITY: Self = Self::new(0, 1, -1, 0);
    pub(super) const ACCELERATION: Self = Self::new(0, 1, -2, 0);
    pub(super) const ANGULAR_SPEED: Self = Self::new(0, 0, -1, 1);
    pub(super) const MASS_PER_LENGTH: Self = Self::new(1, -1, 0, 0);
    pub(super) const FORCE: Self = Self::new(1, 1, -2, 0);
    pub(super) const FORCE_PER_AREA: Self = Self::new(1, -1, -2, 0);
    pub(super) const TORQUE: Self = Self::new(1, 2, -2, 0);
    pub(super) const FORCE_PER_LENGTH: Self = Self::new(1, 0, -2, 0);
    pub(super) const TORQUE_PER_ANGLE: Self = Self::new(1, 2, -2, -1);
    pub(super) const POWER: Self = Self::new(1, 2, -3, 0);
    pub(super) const BENDING_STIFFNESS: Self = Self::new(1, 3, -2, 0);
    pub(super) const MOMENT_OF_INERTIA: Self = Self::new(1, 2, 0, 0);
    pub(super) const AXIAL_DAMPING: Self = Self::new(1, 1, -1, 0);
    pub(super) const DAMPING_PER_LENGTH: Self = Self::new(1, -1, -1, 0);
    pub(super) const TORQUE_PER_SPEED: Self = Self::new(1, 2, -1, -1);

    /// The dimensions that have a name in messages.
    const NAMES: [(Self, &str); 23] = [
        (Self::NUMBER, "a pure number"),
        (Self::MASS, "a mass"),
        (Self::LENGTH, "a length"),
        (Self::TIME, "a time"),
        (Self::ANGLE, "an angle"),
        (Self::INVERSE_LENGTH, "an inverse length"),
        (Self::VELOCITY, "a velocity"),
        (Self::ANGULAR_SPEED, "an angular speed"),
        (Self::MASS_PER_LENGTH, "a mass per length"),
        (Self::FORCE, "a force"),
        (Self::FORCE_PER_AREA, "a force per area"),
        (Self::TORQUE, "a torque"),
        (Self::POWER, "a power"),
        (Self::BENDING_STIFFNESS, "a bending stiffness"),
        (Self::new(0, 2, 0, 0), "an area"),
        (Self::new(0, 0, -1, 0), "an inverse time"),
        (Self::ACCELERATION, "an acceleration"),
        (Self::FORCE_PER_LENGTH, "a force per length"),
        (Self::TORQUE_PER_ANGLE, "a torque per angle"),
        (Self::MOMENT_OF_INERTIA, "a moment of inertia"),
        (Self::AXIAL_DAMPING, "an axial damping"),
        (Self::DAMPING_PER_LENGTH, "a damping per length"),
        (Self::TORQUE_PER_SPEED, "a torque per angular speed"),
    ];

    /// The dimensions that quantities of drive files have, as measures.
    const MEASURES: [(Self, Measure); 13] = [
        (Self::NUMBER, Measure::Number),
        (Self::ANGLE, Measure::Angle),
        (Self::LENGTH, Measure::Length),
        (Self::FORCE, Measure::Force),
        (Self::FORCE_PER_LENGTH, Measure::Stiffness),
        (Self::TORQUE, Measure::Torque),
        (Self::TORQUE_PER_ANGLE, Measure::AngularStiffness),
        (Self::POWER, Measure::Power),
        (Self::VELOCITY, Measure::Velocity),
        (Self::ANGULAR_SPEED, Measure::AngularSpeed),
        (Self::MASS_PER_LENGTH, Measure::MassPerLength),
        (Self::FORCE_PER_AREA, Measure::ForcePerArea),
        (Self::INVERSE_LENGTH, Measure::InverseLength),
    ];

    const fn new(mass: i32, length: i32, time: i32, angle: i32) -> Self {
        Self {
            mass,
            length,
            time,
            angle,
        }
    }

    /// The dimension of a quantity of this dimension times one of dimension `other` to the power
    /// `exponent`.
    pub(super) const fn times(self, other: Self, exponent: i32) -> Self {
        Self::new(
            self.mass + other.mass * exponent,
            self.length + other.length * exponent,
            self.time + other.time * exponent,
            self.angle + other.angle * exponent,
        )
    }

    /// What it is as a measure, if it has one.
    pub(super) fn measure(self) -> Option<Measure> {
        let known = Self::MEASURES.into_iter().find(|(known, _)| *known == self);
        known.map(|(_, measure)| measure)
    }

    /// The dimension of a measure, if quantities of drive files have it.
    pub(super) fn of(measure: Measure) -> Option<Self> {
        let known = Self::MEASURES
            .into_iter()
            .find(|(_, known)| *known == measure);
        known.map(|(dimension, _)| dimension)
    }
}

/// The name with its article, or the SI unit of a dimension without a name.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((_, name)) = Self::NAMES.iter().find(|(named, _)| named == self) {
            return f.write_str(name);
        }
        f.write_str("a quantity in")?;
        let powers = [
            ("kg", self.mass),
            ("m", self.length),
            ("s", self.time),
            ("rad", self.angle),
        ];
        powers
            .into_iter()
            .filter(|(_, exponent)| *exponent != 0)
            .try_for_each(|(symbol, exponent)| match exponent {
                1 => write!(f, " {symbol}"),
                _ => write!(f, " {symbol}^{exponent}"),
            })
    }
}

#[cfg(test)]
mod tests {
    use super::Dimension;

    #[test]
    fn names_are_of_products_too() {
        let pressure = Dimension::FORCE.times(Dimension::LENGTH, -2);
        assert_eq!(pressure, Dimension::FORCE_PER_AREA);
        assert_eq!(pressure.to_string(), "a force per area");
        let volume = Dimension::LENGTH.times(Dimension::LENGTH, 2);
        assert_eq!(volume.to_string(), "a quantity in m^3");
    }
}
