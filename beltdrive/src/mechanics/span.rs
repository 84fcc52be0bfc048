//! Free spans of the belt as strings.

use crate::Belt;

/// Deflection of a span over its length, the customary one of tension gauges.
pub(crate) const DEFLECTION: f64 = 1.0 / 64.0;

/// First natural frequency in Hz of a span in m as a moving string, from its tractive and its belt tension
/// in N, the belt speed in m/s and the mass flow in kg/s: with the wave speed w² = T V/G of the belt at
/// rest, (w² − V²)/(2 ℓ w).
pub(crate) fn first_frequency(
    length: f64,
    tractive: f64,
    tension: f64,
    speed: f64,
    flow: f64,
) -> f64 {
    tractive / (2.0 * length) * (speed / (flow * tension)).sqrt()
}

/// First natural frequency in Hz of a span in m at rest under a tension in N.
pub(crate) fn rest_frequency(length: f64, tension: f64, belt: &Belt) -> f64 {
    let strain = tension / belt.axial_stiffness;
    (tension * (1.0 + strain) / belt.mass_per_length).sqrt() / (2.0 * length)
}
