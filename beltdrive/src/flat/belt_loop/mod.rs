//! The steady state of a flat belt round n pulleys. [`crate::belt_loop`] is the public face.

mod checks;
mod closing;
mod derivatives;
mod elongation;
mod equations;
mod evaluated;
mod largest_load;
mod limit;
mod loads;
mod numbers;
mod problem;
mod rest;
mod results;
mod running;
mod solve;
mod solved;

pub(crate) use derivatives::Derivatives;
pub(crate) use largest_load::largest_load;
pub(crate) use rest::at_rest;
pub(crate) use solve::{solve, unloaded_tension};
