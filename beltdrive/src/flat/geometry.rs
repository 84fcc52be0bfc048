//! The open belt: where it touches the pulleys.

use crate::TwoPulleys;

/// Plane geometry of an open belt around two pulleys.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OpenBelt {
    /// Wrap angles on the driven pulley and on the driver, rad; 2 π in all.
    pub(super) wrap: [f64; 2],
    /// Length of each free span, m.
    pub(super) span: f64,
}

impl OpenBelt {
    /// The belt around two pulleys at a distance C: the spans are inclined by α to the line of
    /// centres, sin α = (R₁ − R₂)/C, and the wraps are π ± 2 α.
    pub(super) fn new(drive: &TwoPulleys) -> Self {
        let difference = drive.driven_radius - drive.driver_radius;
        let inclination = (difference / drive.centre_distance).asin();
        let pi = std::f64::consts::PI;
        Self {
            wrap: [pi + 2.0 * inclination, pi - 2.0 * inclination],
            span: drive.centre_distance * inclination.cos(),
        }
    }
}
