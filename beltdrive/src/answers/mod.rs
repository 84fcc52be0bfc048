//! What is asked of loops of pulleys: their states over a number of the drive file, and its limits.

mod limit_curve;
mod limits;
mod members;
mod trace;

pub use limit_curve::{LoopLimitCurve, LoopLimitPoint, limit_curve};
pub use limits::{LoopEnd, LoopLimit, LoopLimits, limits};
pub use members::{Refusal, Varied};
pub use trace::{LoopBranch, LoopPoint, trace};
