//! Results as text: a table for people, JSON and CSV for programs.
//!
//! [`table()`], [`json()`] and [`csv()`] are of a steady state; [`branch`], [`limits`],
//! [`limit_curve`], [`stability`] and [`verification`] have their own.

pub mod answer;
mod belt;
pub mod branch;
mod columns;
mod csv;
mod errors;
mod file;
mod json;
pub mod limit_curve;
pub mod limits;
mod lines;
mod rows;
#[cfg(test)]
pub(crate) mod sample;
#[cfg(test)]
pub(crate) mod sample_branch;
#[cfg(test)]
pub(crate) mod sample_flat;
mod scalars;
mod shown;
mod slip_arc;
pub mod stability;
mod state_columns;
mod table;
mod table_columns;
pub(crate) mod value;
pub mod verification;
pub(crate) mod words;

pub use self::csv::csv;
pub(crate) use crate::quantity::precision::Precision;
pub(crate) use belt::convention;
pub use file::write_file;
pub use json::json;
pub(crate) use lines::folded;
pub(crate) use slip_arc::slip_arc;
pub use table::table;

use crate::input::Key;
pub(crate) use crate::quantity::precision::six_digits;
use crate::quantity::words::law as words_of_law;
use crate::{Drive, Warning};

/// The title of a drive on one line, or what it is when it has no title.
pub(crate) fn heading(drive: &Drive) -> String {
    let words: Vec<_> = drive
        .title
        .iter()
        .flat_map(|title| title.split_whitespace())
        .collect();
    if words.is_empty() {
        belt::description(drive).to_owned()
    } else {
        words.join(" ")
    }
}

/// The friction law of a drive in words, with its parameters; what varies has no value.
pub(crate) fn law(drive: &Drive, varied: &[Key]) -> String {
    let paths: Vec<_> = varied.iter().map(Key::path).collect();
    words_of_law(drive.law, Some(drive.friction_coefficient), &paths)
}

/// The heading of a table: the title of a drive, then its friction law and, for a flat belt, how the
/// normal force follows from the tension, on one line if they fit.
fn title(drive: &Drive, varied: &[Key]) -> Vec<String> {
    let mut lines = vec![heading(drive), law(drive, varied)];
    if let Some(convention) = convention(drive) {
        let together = format!("{}, {convention}", lines[1]);
        if together.chars().count() <= lines::WIDTH {
            lines[1] = together;
        } else {
            lines.push(convention.to_owned());
        }
    }
    lines
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
        Warning::LargeStrain { strain } => format!(
            "the belt is stretched by {:.2} %, too much for small strains: choose \
             normal_force=\"exact\"",
            100.0 * strain
        ),
        Warning::LargeStretch { strain } => format!(
            "the belt is stretched by {} %, more than the model stands for: check the tensions and \
             axial_stiffness",
            six_digits(100.0 * strain)
        ),
        Warning::Sunk {
            pulley,
            penetration,
            height,
        } => format!(
            "the belt sinks into the groove of the {} by {:.2} mm, more than its height of {} mm: not a \
             usable design",
            pulley.name(),
            1e3 * penetration,
            six_digits(1e3 * height)
        ),
    }
}

/// An angular speed in revolutions per minute.
pub(crate) fn rpm(angular_speed: f64) -> f64 {
    angular_speed * 30.0 / std::f64::consts::PI
}

/// The tight tension at the larger radius, N·m: the scale of the error of a torque, which is a
/// difference of tensions.
pub(crate) fn torque_scale(drive: &Drive, tight_tension: f64) -> f64 {
    tight_tension * drive.driver_radius.max(drive.driven_radius)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BeltKind, FrictionLaw, NormalForce};

    #[test]
    fn heading_is_one_line() {
        let mut drive = sample::loaded().drive;
        drive.title = Some("two\n lines ".to_owned());
        assert_eq!(heading(&drive), "two lines");
        drive.title = Some("  ".to_owned());
        assert_eq!(heading(&drive), "Two-pulley V-belt drive");
    }

    #[test]
    fn the_title_states_the_convention_of_a_flat_belt() {
        assert_eq!(title(&sample::loaded().drive, &[]).len(), 2);
        let mut drive = sample_flat::epp().drive;
        drive.title = None;
        let lines = title(&drive, &[]);
        assert_eq!(lines[0], "Two-pulley flat-belt drive");
        let law = "elastic/perfectly-plastic friction, μ = 0.6, k_f = 5e7 N/m²";
        assert_eq!(lines[1], format!("{law}, normal force n = (T − G V)/R"));
        let normal_force = NormalForce::Exact;
        drive.belt.kind = BeltKind::Flat { normal_force };
        let lines = title(&drive, &[]);
        assert_eq!(lines[1], law);
        assert_eq!(lines[2], "normal force n = (T − G V)/R, finite strain");
        drive.law = FrictionLaw::Coulomb;
        assert!(title(&drive, &[])[1].ends_with("finite strain"));
    }

    #[test]
    fn laws_state_their_parameters() {
        let mut drive = sample::loaded().drive;
        drive.law = FrictionLaw::Coulomb;
        assert_eq!(law(&drive, &[]), "Coulomb friction, μ = 0.4");
        drive.law = FrictionLaw::Bristle { stiffness: 1620.0 };
        assert_eq!(law(&drive, &[]), "bristle friction, μ = 0.4, κ = 1620 1/m");
        drive.law = FrictionLaw::Epp { stiffness: 8.1e6 };
        assert!(law(&drive, &[]).ends_with("k_f = 8.1e6 N/m²"));
        let mut keys = Key::all(&drive);
        let coefficient = keys.find(|key| key.path() == "friction.coefficient");
        let text = law(&drive, &[coefficient.unwrap()]);
        assert!(text.contains("μ varied, k_f = 8.1e6 N/m²"), "{text}");
    }
}
