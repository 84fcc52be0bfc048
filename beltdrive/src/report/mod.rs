//! The steady state of a drive as text: a table for people, JSON and CSV for programs.

mod columns;
mod csv;
mod json;
mod precision;
#[cfg(test)]
pub(crate) mod sample;
mod table;

pub use self::csv::csv;
pub use json::json;
pub(crate) use precision::Precision;
pub use table::table;

use crate::{Drive, FrictionLaw, PulleyState, SteadyState, Warning};
use precision::six_digits;

/// The title of a drive on one line, or what it is when it has no title.
pub(crate) fn heading(drive: &Drive) -> String {
    let words: Vec<_> = drive
        .title
        .iter()
        .flat_map(|title| title.split_whitespace())
        .collect();
    if words.is_empty() {
        "Two-pulley V-belt drive".to_owned()
    } else {
        words.join(" ")
    }
}

/// The friction law of a drive in words, with its parameters.
pub(crate) fn law(drive: &Drive) -> String {
    let coefficient = six_digits(drive.friction_coefficient);
    match drive.law {
        FrictionLaw::Coulomb => format!("Coulomb friction, μ = {coefficient}"),
        FrictionLaw::Epp { stiffness } => format!(
            "elastic/perfectly-plastic friction, μ = {coefficient}, k_f = {} N/m²",
            six_digits(stiffness)
        ),
        FrictionLaw::Bristle { stiffness } => {
            format!(
                "bristle friction, μ = {coefficient}, κ = {} 1/m",
                six_digits(stiffness)
            )
        }
    }
}

/// What a warning tells the user, on one line.
pub(crate) fn warning(warning: &Warning) -> String {
    match warning {
        Warning::Overhang {
            pulley,
            inclination,
        } => format!(
            "the belt overhangs itself on the {}: inclination {:.2}° exceeds 90°, not a usable design",
            pulley.name(),
            inclination.to_degrees()
        ),
    }
}

/// Angular speed in revolutions per minute.
pub(crate) fn rpm(pulley: &PulleyState) -> f64 {
    pulley.angular_speed * 30.0 / std::f64::consts::PI
}

/// The tight tension at the larger radius, N·m: the scale of the error of a torque, which is a
/// difference of tensions.
pub(crate) fn torque_scale(state: &SteadyState) -> f64 {
    state.tight_tension * state.drive.driver_radius.max(state.drive.driven_radius)
}

/// Power between belt and pulley, W.
fn power(pulley: &PulleyState) -> f64 {
    pulley.torque * pulley.angular_speed
}

/// Speed loss s = 1 − ω₁ R₁ / (ω₂ R₂) of the driven pulley 1 against the driver 2; 0 where the
/// driver stands still.
fn speed_loss(state: &SteadyState) -> f64 {
    let driver = state.driver.angular_speed * state.drive.driver_radius;
    let driven = state.driven.angular_speed * state.drive.driven_radius;
    if driver == 0.0 {
        0.0
    } else {
        1.0 - driven / driver
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heading_is_one_line() {
        let mut drive = sample::loaded().drive;
        drive.title = Some("two\n lines ".to_owned());
        assert_eq!(heading(&drive), "two lines");
        drive.title = Some("  ".to_owned());
        assert_eq!(heading(&drive), "Two-pulley V-belt drive");
    }

    #[test]
    fn laws_state_their_parameters() {
        let mut drive = sample::loaded().drive;
        drive.law = FrictionLaw::Coulomb;
        assert_eq!(law(&drive), "Coulomb friction, μ = 0.4");
        drive.law = FrictionLaw::Bristle { stiffness: 1620.0 };
        assert_eq!(law(&drive), "bristle friction, μ = 0.4, κ = 1620 1/m");
        drive.law = FrictionLaw::Epp { stiffness: 8.1e6 };
        assert!(law(&drive).ends_with("k_f = 8.1e6 N/m²"));
    }

    #[test]
    fn a_standing_driver_loses_no_speed() {
        assert_eq!(speed_loss(&sample::idle()), 0.0);
        let state = sample::loaded();
        assert!((speed_loss(&state) - 0.02).abs() < 1e-12);
    }
}
