//! What is measured, and in which units it is stored and shown.

use std::f64::consts::PI;

/// What a quantity measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// A pure number.
    Number,
    /// A share, shown in per cent.
    Share,
    /// An angle.
    Angle,
    /// A length.
    Length,
    /// A force.
    Force,
    /// A force per length.
    LineLoad,
    /// A torque.
    Torque,
    /// A power.
    Power,
    /// A power that is small beside those of the pulleys.
    Loss,
    /// A velocity.
    Velocity,
    /// An angular speed.
    AngularSpeed,
    /// A frequency of vibration.
    Frequency,
    /// An angular frequency of vibration.
    AngularFrequency,
    /// A rate of growth.
    Growth,
    /// A time.
    Time,
    /// An energy.
    Energy,
    /// A mass flow.
    MassFlow,
    /// A mass.
    Mass,
    /// A mass per length.
    MassPerLength,
    /// A mass per area.
    MassPerArea,
    /// A force per area.
    ForcePerArea,
    /// An inverse length.
    InverseLength,
    /// A stiffness against a displacement.
    Stiffness,
    /// A stiffness against a rotation.
    AngularStiffness,
}

/// In which units numbers are shown. Files are not concerned: their units stand in the keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UnitSystem {
    /// SI base and derived units without prefixes; angles in degrees.
    Si,
    /// What European drawings and data sheets use: mm, rpm, kW.
    #[default]
    Engineering,
    /// Inch, pound-force, foot-pound, horsepower.
    Us,
}

/// A unit in which a quantity is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unit {
    /// Its symbol; empty for a pure number.
    pub(crate) symbol: &'static str,
    /// A value in SI units times this is the value in the unit.
    pub(crate) factor: f64,
}

const fn unit(symbol: &'static str, factor: f64) -> Unit {
    Unit { symbol, factor }
}

/// One inch in m, one pound-force in N, exact by definition.
const INCH: f64 = 0.0254;
const POUND: f64 = 4.448_221_615_260_5;
const FOOT: f64 = 12.0 * INCH;
/// A pound in kg and a mechanical horsepower (550 ft lbf/s) in W.
const POUND_MASS: f64 = 0.453_592_37;
const HORSEPOWER: f64 = 550.0 * FOOT * POUND;

const DEGREE: Unit = unit("°", 180.0 / PI);
const RPM: Unit = unit("rpm", 30.0 / PI);

impl Measure {
    /// The end of a key with this measure in JSON and CSV, and the factor from SI to that unit.
    pub(crate) fn stored(self) -> (&'static str, f64) {
        match self {
            Self::Number | Self::Share => ("", 1.0),
            Self::Angle => ("_deg", DEGREE.factor),
            Self::Length => ("_m", 1.0),
            Self::Force => ("_N", 1.0),
            Self::LineLoad | Self::Stiffness => ("_N_per_m", 1.0),
            Self::Torque => ("_N_m", 1.0),
            Self::Power | Self::Loss => ("_W", 1.0),
            Self::Velocity => ("_m_per_s", 1.0),
            Self::AngularSpeed | Self::AngularFrequency => ("_rad_per_s", 1.0),
            Self::Growth => ("_per_s", 1.0),
            Self::Time => ("_s", 1.0),
            Self::Energy => ("_J", 1.0),
            Self::Frequency => ("_Hz", 1.0),
            Self::MassFlow => ("_kg_per_s", 1.0),
            Self::Mass => ("_kg", 1.0),
            Self::MassPerLength => ("_kg_per_m", 1.0),
            Self::MassPerArea => ("_kg_per_m2", 1.0),
            Self::ForcePerArea => ("_N_per_m2", 1.0),
            Self::InverseLength => ("_per_m", 1.0),
            Self::AngularStiffness => ("_N_m_per_rad", 1.0),
        }
    }

    /// The unit in which a system shows it.
    pub(crate) fn shown(self, system: UnitSystem) -> Unit {
        let [si, engineering, us] = match self {
            Self::Number => [unit("", 1.0); 3],
            Self::Share => [unit("%", 100.0); 3],
            Self::Angle => [DEGREE; 3],
            Self::Length => [unit("m", 1.0), unit("mm", 1e3), unit("in", 1.0 / INCH)],
            Self::Force => [unit("N", 1.0), unit("N", 1.0), unit("lbf", 1.0 / POUND)],
            Self::LineLoad | Self::Stiffness => [
                unit("N/m", 1.0),
                unit("N/mm", 1e-3),
                unit("lbf/in", INCH / POUND),
            ],
            Self::Torque => [
                unit("N·m", 1.0),
                unit("N·m", 1.0),
                unit("lbf·ft", 1.0 / (POUND * FOOT)),
            ],
            Self::Power => [
                unit("W", 1.0),
                unit("kW", 1e-3),
                unit("hp", 1.0 / HORSEPOWER),
            ],
            Self::Loss => [unit("W", 1.0), unit("W", 1.0), unit("hp", 1.0 / HORSEPOWER)],
            Self::Velocity => [
                unit("m/s", 1.0),
                unit("m/s", 1.0),
                unit("ft/min", 60.0 / FOOT),
            ],
            Self::AngularSpeed => [unit("rad/s", 1.0), RPM, RPM],
            Self::Frequency => [unit("Hz", 1.0); 3],
            Self::AngularFrequency => [unit("rad/s", 1.0); 3],
            Self::Growth => [unit("1/s", 1.0); 3],
            Self::Time => [unit("s", 1.0); 3],
            Self::Energy => [
                unit("J", 1.0),
                unit("J", 1.0),
                unit("lbf·ft", 1.0 / (POUND * FOOT)),
            ],
            Self::MassFlow => [
                unit("kg/s", 1.0),
                unit("kg/s", 1.0),
                unit("lb/s", 1.0 / POUND_MASS),
            ],
            Self::Mass => [
                unit("kg", 1.0),
                unit("kg", 1.0),
                unit("lb", 1.0 / POUND_MASS),
            ],
            Self::MassPerLength => [
                unit("kg/m", 1.0),
                unit("kg/m", 1.0),
                unit("lb/ft", FOOT / POUND_MASS),
            ],
            Self::MassPerArea => [
                unit("kg/m²", 1.0),
                unit("kg/m²", 1.0),
                unit("lb/ft²", FOOT * FOOT / POUND_MASS),
            ],
            Self::ForcePerArea => [
                unit("N/m²", 1.0),
                unit("N/mm²", 1e-6),
                unit("psi", INCH * INCH / POUND),
            ],
            Self::InverseLength => [unit("1/m", 1.0), unit("1/m", 1.0), unit("1/in", INCH)],
            Self::AngularStiffness => [
                unit("N·m/rad", 1.0),
                unit("N·m/rad", 1.0),
                unit("lbf·ft/rad", 1.0 / (POUND * FOOT)),
            ],
        };
        match system {
            UnitSystem::Si => si,
            UnitSystem::Engineering => engineering,
            UnitSystem::Us => us,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_those_of_their_definitions() {
        let shown = |measure: Measure, value: f64| value * measure.shown(UnitSystem::Us).factor;
        assert!((shown(Measure::Power, 745.699_871_582_270_2) - 1.0).abs() < 1e-15);
        assert!((shown(Measure::Torque, 1.355_817_948_331_400_4) - 1.0).abs() < 1e-15);
        assert!((shown(Measure::Velocity, 5.08e-3) - 1.0).abs() < 1e-15);
        assert!((shown(Measure::AngularSpeed, PI) - 30.0).abs() < 1e-13);
        assert!((shown(Measure::Stiffness, 175.126_835_246_476) - 1.0).abs() < 1e-12);
    }
}
