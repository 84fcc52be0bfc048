//! Whether nothing changes any more.

use super::dynamics::Dynamics;

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
    pub(crate) fn new(rates: &impl Dynamics) -> Self {
        let axles = rates.wheels().iter().map(|wheel| &wheel.axle);
        let given = axles.flat_map(|axle| axle.schedule()).flatten();
        let corners = given.flat_map(|given| given.points().iter().map(|point| point[0]));
        Self {
            corner: corners.fold(0.0, f64::max),
            still: 0,
        }
    }

    /// The time of the last corner of what is given over time, s.
    pub(crate) fn last_corner(&self) -> f64 {
        self.corner
    }

    /// Looks at a state and its rates at the time of a sample in s; whether it is steady.
    pub(crate) fn look(
        &mut self,
        time: f64,
        rates: &impl Dynamics,
        state: &[f64],
        changes: &[f64],
    ) -> bool {
        let rims = |list: &[f64]| {
            let speeds = rates.wheels().iter().zip(&list[rates.speeds()]);
            let rims = speeds.map(|(wheel, speed)| (wheel.radius * speed).abs());
            rims.fold(0.0, f64::max)
        };
        let is_still = rates.unrest(state, changes) < STILL && rims(changes) <= STILL * rims(state);
        self.still = match is_still && time >= self.corner {
            true => self.still + 1,
            false => 0,
        };
        self.still >= SAMPLES
    }
}
