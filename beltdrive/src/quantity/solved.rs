//! What there is to tell of the steady state of any drive.

use super::{Answer, belt_loop, two_pulleys};
use crate::Solved;

/// The steady state: that of two pulleys under the keys `driver` and `driven`, that of a loop as a list of pulleys.
pub fn answer(solved: &Solved) -> Answer {
    match solved {
        Solved::Drive { state, as_loop } => {
            let as_loop = as_loop.as_deref();
            two_pulleys::answer(state, as_loop.map(|(drive, state)| (drive, state)))
        }
        Solved::Loop { drive, state } => belt_loop::answer(drive, state),
    }
}
