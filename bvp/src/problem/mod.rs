//! What a user states: segments, equations, conditions and a guess.

pub(crate) mod automatic;
pub(crate) mod check;
pub(crate) mod complex;
pub(crate) mod difference;
pub(crate) mod dual;
mod dual_arithmetic;
pub(crate) mod equations;
pub(crate) mod guess;
pub(crate) mod held;
pub(crate) mod in_units;
pub(crate) mod pieces;
pub(crate) mod problem;
pub(crate) mod real;
pub(crate) mod two_point;
pub(crate) mod unknown;
