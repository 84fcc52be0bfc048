//! The steady state of a V-belt round n pulleys. [`crate::belt_loop`] is the public face.
//!
//! Pulleys inside the loop are grooves, with the mechanics of a drive with two pulleys; pulleys outside
//! touch the back of the belt and are flat. `problem` states the running loop as one boundary value
//! problem, `rest` the belt at rest.

mod at_rest;
mod back;
mod capacity;
mod checks;
mod climb;
mod contacts;
mod elastic_limit;
mod guess;
mod largest_load;
mod last_state;
mod levelling;
mod like;
mod pair;
mod pieces;
mod plane;
mod problem;
mod rest;
mod rest_guess;
mod rising;
mod round;
mod running;
mod seat;
mod seating;
mod slipping;
mod solve;
mod start;
mod state;
mod stiffening;
mod tensioner;
mod unknowns;

pub(crate) use climb::{Top, limit_accuracy};
pub(crate) use largest_load::{NearLargestLoad, largest_load};
pub(crate) use last_state::last_state;
pub(crate) use solve::{LoopNeighbour, at_rest, solve, solve_from, solve_with_margins};
