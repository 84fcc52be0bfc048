//! Whether nothing changes any more.

use super::rates::Rates;
use super::string;

/// Largest change in a second, relative.
const STILL: f64 = 1e-6;

/// Samples one after the other in which nothing changes: a vibration is still at single instants.
const SAMPLES: usize = 5;

/// What looks for the steady state.
pub(crate) struct Stillness {
    /// The last corner of what is given over time, s.
    corner: f64,
    /// Samples up to now in which nothing changed.
    still: usize,
}

impl Stillness {
    /// Looks for the steady state of a system.
    pub(crate) fn new(rates: &Rates<'_>) -> Self {
        let axles = rates.system.wheels.iter().map(|wheel| &wheel.axle);
        let given = axles.flat_map(|axle| axle.schedule()).flatten();
        let corners = given.flat_map(|given| given.points().iter().map(|point| point[0]));
        Self {
            corner: corners.fold(0.0, f64::max),
            still: 0,
        }
    }

    /// Whether a time in s is after the last corner of what is given over time.
    pub(crate) fn is_after_corners(&self, time: f64) -> bool {
        time >= self.corner
    }

    /// Looks at a state and its rates at the time of a sample in s; whether it is steady.
    pub(crate) fn look(
        &mut self,
        time: f64,
        rates: &Rates<'_>,
        state: &[f64],
        changes: &[f64],
    ) -> bool {
        let system = rates.system;
        let parts = &system.parts;
        let rims = |list: &[f64]| {
            let speeds = system.wheels.iter().zip(&list[parts.speed.clone()]);
            let rims = speeds.map(|(wheel, speed)| (wheel.radius * speed).abs());
            rims.fold(0.0, f64::max)
        };
        let densities = state[parts.density.clone()].iter();
        let tensions = densities.zip(&changes[parts.density.clone()]);
        // The rate of T = EA (1/ρ − 1) over T.
        let tension =
            tensions.map(|(density, change)| (change / (density * (1.0 - density))).abs());
        let tension = tension.fold(0.0, f64::max);
        let is_still = tension < STILL
            && rims(changes) <= STILL * rims(state)
            && string::fastest(system, changes) <= STILL * system.mesh.length();
        self.still = match is_still && self.is_after_corners(time) {
            true => self.still + 1,
            false => 0,
        };
        self.still >= SAMPLES
    }
}
