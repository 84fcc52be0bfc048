//! The discretised problem as a nonlinear system, and Newton's method.

pub(crate) mod collocation;
pub(crate) mod evaluation;
pub(crate) mod failure;
mod largest_correction;
mod linearity;
pub(crate) mod newton;
pub(crate) mod norm;
