//! The Newton matrix of a discretised problem: condensed, factored, solved with.

pub(crate) mod almost_block_diagonal;
mod balance;
pub(crate) mod condensation;
pub(crate) mod dependence;
pub(crate) mod derivative_states;
pub(crate) mod end_system;
pub(crate) mod singular;
pub(crate) mod stage_system;
pub(crate) mod transitions;
