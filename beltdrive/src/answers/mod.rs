//! What is asked of drives: of two pulleys, of loops over a number of the drive file, of drives in service, and of
//! what was published.

mod belt_loop;
pub mod calibrate;
pub(crate) mod check;
pub(crate) mod design;
pub(crate) mod drive;
mod limit_curve;
mod limits;
pub(crate) mod losses;
pub(crate) mod map;
mod members;
pub(crate) mod modes;
pub(crate) mod rating;
mod shares;
pub(crate) mod simulate;
mod solved;
pub(crate) mod sweep;
pub(crate) mod tension;
mod trace;
pub mod uncertainty;
pub mod verify;

pub use belt_loop::{solve, solve_to, solve_with_margins};
pub use limit_curve::{LoopLimitCurve, LoopLimitPoint, limit_curve};
pub use limits::{LoopEnd, LoopLimit, LoopLimits, limits};
pub use members::{Refusal, Refusals, Varied};
pub use solved::{Solved, solve_any};
pub use trace::{LoopBranch, LoopPoint, trace};
