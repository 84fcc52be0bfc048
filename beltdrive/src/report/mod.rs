//! Answers as text, each form written once: a table for people, JSON and CSV for programs, and a page in
//! Markdown of published results.

mod csv;
mod file;
mod json;
pub(crate) mod lines;
mod markdown;
#[cfg(test)]
pub(crate) mod sample;
#[cfg(test)]
pub(crate) mod sample_branch;
#[cfg(test)]
pub(crate) mod sample_flat;
mod table;
#[cfg(test)]
mod tests;

pub use self::csv::csv;
pub(crate) use crate::quantity::precision::{Precision, six_digits};
pub(crate) use crate::quantity::words::{heading, law_of as law, slip_arc, warning};
pub(crate) use crate::quantity::{events as words, value};
pub use file::write_file;
pub use json::json;
pub(crate) use lines::folded;
pub use markdown::markdown;
pub use table::table;

use crate::Drive;

/// How the normal force of a flat belt follows from its tension; nothing for a V-belt.
pub(crate) fn convention(drive: &Drive) -> Option<&'static str> {
    crate::quantity::words::convention(drive.belt.kind)
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
