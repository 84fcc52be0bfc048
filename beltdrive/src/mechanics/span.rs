//! Free spans of the belt as strings.

use bvp::Real;

/// Deflection of a span over its length, the customary one of tension gauges.
pub(crate) const DEFLECTION: f64 = 1.0 / 64.0;

/// First natural frequency in Hz of a span in m as a moving string, from its tractive and its belt tension
/// in N, the belt speed in m/s and the mass flow in kg/s: with the wave speed w² = T V/G of the belt at
/// rest, (w² − V²)/(2 ℓ w).
pub(crate) fn first_frequency<S: Real>(length: S, tractive: S, tension: S, speed: S, flow: S) -> S {
    tractive / (length * 2.0) * (speed / (flow * tension)).sqrt()
}

/// First natural frequency in Hz of a span in m at rest under a tension in N, with the mass per length in kg/m and the
/// axial stiffness in N of the belt.
pub(crate) fn rest_frequency<S: Real>(length: S, tension: S, mass: S, axial: S) -> S {
    let strain = tension / axial;
    (tension * (strain + 1.0) / mass).sqrt() / (length * 2.0)
}
