//! The steady state of a flat belt round n pulleys. [`crate::belt_loop`] is the public face.

mod check;
mod error;
mod limit;
mod results;
mod running;
mod solve;
mod state;
mod tensioner;

pub use error::{LoadedState, LoopError};
pub(crate) use solve::solve;
pub use state::{
    GrooveState, LoadLimit, LoopConvergence, LoopState, PulleyState, SpanState, TensionerState,
};
