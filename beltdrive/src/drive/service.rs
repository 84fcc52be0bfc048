//! What a drive is there for: its load cases, and what is required of it in each of them.

use crate::Drive;

/// The service of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Service {
    /// The load cases; at least one.
    pub cases: Vec<LoadCase>,
    /// What is required in every case.
    pub requirements: Requirements,
    /// Losses that the model of the belt does not know.
    pub given_losses: GivenLosses,
}

/// A load of a drive that lasts.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadCase {
    /// Its name.
    pub name: String,
    /// Its share of the time, above 0; the shares of all cases add up to 1. `None` in every case where the
    /// times are not known.
    pub share: Option<f64>,
    /// The drive with its load and speed in this case.
    pub drive: Drive,
}

/// What is required in every load case; `None` where nothing is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Requirements {
    /// Smallest factor on all torques at which a pulley may slip grossly; at least 1.
    pub smallest_slip_margin: Option<f64>,
    /// Largest speed loss 1 − R ω/(R ω of the driver) of a pulley with a torque.
    pub largest_speed_loss: Option<f64>,
    /// Largest force of the belt on a hub, N, running or at rest.
    pub largest_hub_load: Option<f64>,
    /// Largest belt tension, N, of a span in motion or at rest.
    pub largest_tension: Option<f64>,
}

/// Losses of a drive that the model of the belt does not know, by numbers that were measured or that a
/// catalogue gives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GivenLosses {
    /// Loss of the belt in bending round the pulleys.
    pub bending: Option<BendingLoss>,
    /// Friction torque of the bearings of each shaft, N·m.
    pub bearing_torque: Option<f64>,
}

/// What a belt loses as it is bent round a pulley and straightened again: the share ψ of the energy EI/(2 R²)
/// per length that it takes to bend it to the radius R.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BendingLoss {
    /// Bending stiffness EI, N·m².
    pub stiffness: f64,
    /// Share ψ of the energy that is lost, 0 < ψ ≤ 1.
    pub damping: f64,
}

impl GivenLosses {
    /// Whether none is given.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bending.is_none() && self.bearing_torque.is_none()
    }
}
