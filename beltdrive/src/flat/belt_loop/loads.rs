//! What the torques of a loop do to the tractions of its belt.

use crate::Drive;

/// Tractions that follow from the torques by themselves.
pub(super) struct Loads {
    /// Change of the traction P on each pulley, N.
    pub(super) changes: Vec<f64>,
    /// Traction of each span above the slackest, N.
    pub(super) offsets: Vec<f64>,
    /// The largest of these, N.
    pub(super) largest: f64,
}

impl Loads {
    /// With a torque of each pulley, N·m; that of the driver means nothing, and balances the others.
    pub(super) fn new(drive: &Drive, torques: &[f64]) -> Self {
        let pulleys = &drive.pulleys;
        let driver = drive.driver();
        let loads = pulleys.iter().zip(torques);
        let mut changes: Vec<_> = loads
            .map(|(pulley, torque)| torque / pulley.radius)
            .collect();
        changes[driver] = 0.0;
        changes[driver] = 0.0 - changes.iter().sum::<f64>();
        let mut offsets = vec![0.0; pulleys.len()];
        for step in 1..pulleys.len() {
            let pulley = (driver + step) % pulleys.len();
            let behind = (driver + step - 1) % pulleys.len();
            offsets[pulley] = offsets[behind] + changes[pulley];
        }
        let lowest = offsets.iter().copied().fold(f64::INFINITY, f64::min);
        offsets.iter_mut().for_each(|offset| *offset -= lowest);
        let largest = offsets.iter().copied().fold(0.0, f64::max);
        Self {
            changes,
            offsets,
            largest,
        }
    }
}
