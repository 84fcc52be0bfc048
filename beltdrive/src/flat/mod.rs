//! The flat-belt drive: a string with axial stretch on the rims of two pulleys, in steady motion, in
//! closed form.
//!
//! The coordinate runs along the belt from where it enters a pulley; friction that holds the belt back,
//! on the driven pulley, has the sense +1, that of the driver −1.
//!
//! Sources: D. Kim, MS thesis, Georgia Institute of Technology (2009), chapter 2; K. L. Johnson, Contact
//! Mechanics (1985), section 8.2; S. E. Bechtel, S. Vohra, K. I. Jacob and C. D. Carlson, J. Appl. Mech.
//! 67 (2000); M. J. Leamy and T. M. Wasfy, J. Vib. Acoust. 124 (2002).

mod answers;
pub(crate) mod belt_loop;
#[cfg(test)]
mod boundary_value;
mod closed_form;
mod geometry;
mod limit_curve;
mod limits;
mod model;
mod range;
mod solve;
mod stability;
mod state;
mod trace;

pub use closed_form::ClosedForm;
pub(crate) use model::FlatBelts;

use crate::Role;

/// Indices of the pulleys.
const DRIVEN: usize = 0;
/// As [`DRIVEN`].
const DRIVER: usize = 1;

/// The index of a pulley.
fn index(pulley: Role) -> usize {
    match pulley {
        Role::Driven => DRIVEN,
        Role::Driver => DRIVER,
    }
}

#[cfg(test)]
mod reference_values;
