//! What is found of a drive: states, branches, limits, and why there are none.

pub(crate) mod branch;
pub(crate) mod difficulty;
pub(crate) mod error;
pub(crate) mod impossible;
pub(crate) mod largest_load;
pub(crate) mod limit_curve;
pub(crate) mod limits;
pub(crate) mod loop_state;
pub(crate) mod measured;
pub(crate) mod possible;
#[cfg(test)]
pub(crate) mod samples;
pub(crate) mod stability;
pub(crate) mod state_summary;
pub(crate) mod steady_state;
pub(crate) mod v_warnings;
pub(crate) mod warning;
