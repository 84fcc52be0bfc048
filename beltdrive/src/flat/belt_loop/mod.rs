//! The steady state of a flat belt round n pulleys. [`crate::belt_loop`] is the public face.

mod check;
mod checks;
mod closing;
mod elongation;
mod error;
mod limit;
mod loads;
mod results;
mod running;
mod solve;
mod state;
mod tensioner;

pub(crate) use check::check;
pub use error::{LoadedState, LoopError};
pub(crate) use results::{DEFLECTION, first_frequency, rest_frequency};
pub(crate) use solve::solve;
pub(crate) use state::Contacts;
pub use state::{
    GrooveState, LoadLimit, LoopConvergence, LoopState, PulleyState, SpanState, TensionerState,
};
pub(crate) use tensioner::{Held, Towards, equilibrium, length_derivatives, within_travel};
