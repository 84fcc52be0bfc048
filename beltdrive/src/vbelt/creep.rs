//! Creep: the slip of a pulley under a load that has led to it from rest.
//!
//! Without load the belt slips nowhere, and on the branch of states that begins there the smallest slip on a pulley grows faster
//! than the load. Other states have the same load and more slip: behind a limit point of the branch, or on a branch of their
//! own that begins and ends where a pulley stands. In those the slip falls with the load, or grows more slowly than it.

/// The smallest slip on a pulley above which the state may be of those to which no load leads from rest. At 1000 N one random
/// drive has a state that is reached, with 0.002 on the driver, and one that is not, with 0.03; with 0.05 `solve` told this one.
pub(super) const CREEP: f64 = 0.01;

/// Whether the slip of a pulley, through two states on a line over the load, the heavier one last, is less than `CREEP` at rest:
/// the line of slip that grows faster than the load from none ends below zero.
///
/// Soft elastic friction lets the driver of one drive creep by 0.08: 58 Newton steps become 62 with this, and 115 where the load
/// is lowered until the slip is small.
pub(super) fn begins_at_rest(
    [light, here]: [f64; 2],
    [less, load]: [f64; 2],
    without: f64,
) -> bool {
    here - (here - light) / (load - less) * (load - without) < CREEP
}
