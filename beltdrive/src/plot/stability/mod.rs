//! The axial modes of a flat belt and their eigenvalues.

mod modes;
mod spectrum;

use crate::Stability;
use crate::quantity::{Answer, two_pulleys};

/// The figures, each with the name of its file.
pub(super) fn figures(stability: &Stability) -> [(&'static str, String); 2] {
    [
        ("modes.svg", modes::figure(stability)),
        ("spectrum.svg", spectrum::figure(stability)),
    ]
}

/// What the drive is.
fn heading(stability: &Stability) -> Answer {
    Answer {
        heading: two_pulleys::heading(&stability.drive, &[]),
        ..Answer::default()
    }
}
