//! A problem with a free parameter as a nonlinear system for a curve.

pub(crate) mod family;
mod layout;
mod remesh;
mod saved;
