//! The units of a drive with two pulleys.

use super::Units;
use super::numbers::Numbers;
use crate::TwoPulleys;

/// The units of a drive with two pulleys.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scales {
    /// Those that both pulleys share.
    pub(crate) units: Units,
    /// Pitch radii of the driven pulley and of the driver, m.
    pub(crate) radius: [f64; 2],
}

impl Scales {
    /// Units by the largest prescribed tension: tensions are then of order one at every load.
    pub(crate) fn new(drive: &TwoPulleys) -> Self {
        let force = drive.load.tight.value().max(drive.load.slack.value());
        Self::with_force(drive, force)
    }

    /// Units with a given reference force in N, to compare states of different loads.
    pub(crate) fn with_force(drive: &TwoPulleys, force: f64) -> Self {
        let numbers = Numbers::new(drive);
        Self {
            units: numbers.units(force),
            radius: numbers.radius,
        }
    }
}
