//! A state in a row of a table, with the digits that are known.

use super::{Precision, slip_arc, torque_scale};
use crate::input::Key;
use crate::{Drive, PulleySummary, StateSummary};

/// Most significant digits of a scalar.
const DIGITS: u8 = 6;

/// The smallest digit shown of a share in percent and of a slip arc in degrees, both of which may be
/// as small as they like but have a column of fixed width.
const PERCENT: f64 = 1e-5;
const DEGREES: f64 = 1e-4;

/// A state and how far its digits are known.
pub(super) struct Shown<'a> {
    state: &'a StateSummary,
    precision: Precision,
    /// What the error of a torque is relative to, N·m.
    torque_scale: f64,
}

impl<'a> Shown<'a> {
    /// A state of a drive with values of entries that vary; its error is the tolerance where it is
    /// not estimated.
    pub(super) fn of(
        drive: &Drive,
        values: &[(Key, f64)],
        state: &'a StateSummary,
        tolerance: f64,
    ) -> Self {
        let mut drive = drive.clone();
        for (key, value) in values {
            key.set(&mut drive, *value);
        }
        let error = state.error_estimate.unwrap_or(tolerance);
        Self {
            state,
            precision: Precision::new(error, DIGITS),
            torque_scale: torque_scale(&drive, state.tight_tension),
        }
    }

    /// The driver.
    pub(super) fn driver(&self) -> &'a PulleySummary {
        &self.state.driver
    }

    /// The driven pulley.
    pub(super) fn driven(&self) -> &'a PulleySummary {
        &self.state.driven
    }

    /// Speed of the driven pulley, rad/s, which may be about to stop.
    pub(super) fn driven_speed(&self) -> String {
        let scale = self.state.driver.angular_speed;
        self.precision
            .show_against(self.state.driven.angular_speed, scale)
    }

    /// Speed loss, %.
    pub(super) fn speed_loss(&self) -> String {
        let loss = 100.0 * self.state.speed_loss;
        self.precision.show_above(loss, 100.0, PERCENT)
    }

    /// Efficiency, %.
    pub(super) fn efficiency(&self) -> String {
        let efficiency = 100.0 * self.state.efficiency;
        self.precision.show_against(efficiency, 100.0)
    }

    /// Torque of the driven pulley, N·m.
    pub(super) fn driven_torque(&self) -> String {
        let torque = self.state.driven.torque;
        self.precision.show_against(torque, self.torque_scale)
    }

    /// An angle, rad, in degrees.
    pub(super) fn angle(&self, angle: f64) -> String {
        let scale = 1_f64.to_degrees();
        self.precision.show_against(angle.to_degrees(), scale)
    }

    /// The slip arc of a pulley, degrees.
    pub(super) fn slip_arc(&self, pulley: &PulleySummary) -> String {
        let arc = slip_arc(&pulley.zones).to_degrees();
        self.precision.show_above(arc, 1_f64.to_degrees(), DEGREES)
    }
}
