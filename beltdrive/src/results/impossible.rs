//! Why a state that solves the equations is that of no drive.

use crate::Role;
use crate::quantity::precision::six_digits;

/// Why a state that solves the equations is that of no drive.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Impossible {
    /// The belt runs faster than axial waves along it, D = EA − m c² < 0: it would get shorter the
    /// harder it is pulled.
    #[error(
        "the belt would run at {} m/s, faster than axial waves run along it, sqrt(EA/m) = {} m/s: lower \
         the speed, or check mass_per_length and axial_stiffness", six_digits(*.speed), six_digits(*.waves)
    )]
    FasterThanWaves {
        /// Speed c = G/m of the unstretched belt, m/s.
        speed: f64,
        /// Speed of axial waves, m/s.
        waves: f64,
    },
    /// The belt is pushed somewhere on a pulley.
    #[error(
        "the {} on the {} falls to {} N, {:.2}° behind the entry: the belt is too slack", tension_name(*.tractive),
        .pulley.name(), six_digits(*.tension), .angle.to_degrees()
    )]
    Slack {
        /// Whether it is the tractive tension F that is negative, or also the belt tension T.
        tractive: bool,
        /// The pulley.
        pulley: Role,
        /// Angle from the entry, rad.
        angle: f64,
        /// The tension, N.
        tension: f64,
    },
    /// The belt would have to be held in the groove or on the rim.
    #[error(
        "the belt would pull at the {} instead of pressing on it: normal force {} N/m, {:.2}° behind the \
         entry, where {} N/m is the largest", .pulley.name(), six_digits(*.force), .angle.to_degrees(),
        six_digits(*.largest)
    )]
    Pulls {
        /// The pulley.
        pulley: Role,
        /// Angle from the entry, rad.
        angle: f64,
        /// Normal force per length there, N/m; negative.
        force: f64,
        /// The largest normal force per length, N/m.
        largest: f64,
    },
    /// Friction is larger than μ times the normal force.
    #[error(
        "friction on the {} would be {} N/m and can be {} N/m, {:.2}° behind the entry", .pulley.name(),
        six_digits(*.friction), six_digits(*.limit), .angle.to_degrees()
    )]
    ExcessFriction {
        /// The pulley.
        pulley: Role,
        /// Angle from the entry, rad.
        angle: f64,
        /// Friction force per length there, N/m.
        friction: f64,
        /// μ times the normal force per length there, N/m.
        limit: f64,
    },
    /// Power appears or is lost without a cause.
    #[error(
        "of {} W from the driver {} W reach the driven pulley, but friction takes {} W and compression of \
         the belt {} W", six_digits(*.given), six_digits(*.taken), six_digits(*.friction), six_digits(*.compression)
    )]
    Powers {
        /// Power of the driver, W.
        given: f64,
        /// Power of the driven pulley, W.
        taken: f64,
        /// Power lost in friction, W.
        friction: f64,
        /// Power spent on compressing the belt, W.
        compression: f64,
    },
    /// A length is not positive.
    #[error("the {name} would be {} m long", six_digits(*.length))]
    Length {
        /// What would have that length.
        name: &'static str,
        /// The length, m.
        length: f64,
    },
}

fn tension_name(tractive: bool) -> &'static str {
    match tractive {
        true => "tractive tension",
        false => "belt tension",
    }
}
