//! What the torques of a loop do to the tractions of its belt.

use bvp::Real;

/// Tractions that follow from the torques by themselves.
pub(super) struct Loads<S = f64> {
    /// Change of the traction P on each pulley, N.
    pub(super) changes: Vec<S>,
    /// Traction of each span above the slackest, N.
    pub(super) offsets: Vec<S>,
    /// The largest of these, N.
    pub(super) largest: S,
}

impl<S: Real> Loads<S> {
    /// With the radius in m and the torque in N·m of each pulley; the torque of the driver means nothing, and balances
    /// the others.
    pub(super) fn new(driver: usize, loads: impl Iterator<Item = (S, S)>) -> Self {
        let mut changes: Vec<_> = loads.map(|(radius, torque)| torque / radius).collect();
        changes[driver] = S::ZERO;
        changes[driver] = S::ZERO - changes.iter().copied().sum::<S>();
        let count = changes.len();
        let mut offsets = vec![S::ZERO; count];
        for step in 1..count {
            let pulley = (driver + step) % count;
            let behind = (driver + step - 1) % count;
            offsets[pulley] = offsets[behind] + changes[pulley];
        }
        let lowest = offsets.iter().copied();
        let lowest = lowest.fold(S::from_f64(f64::INFINITY), S::min);
        offsets.iter_mut().for_each(|offset| *offset -= lowest);
        let largest = offsets.iter().copied().fold(S::ZERO, S::max);
        Self {
            changes,
            offsets,
            largest,
        }
    }
}
