//! The trace of a branch: steps, labelled points, discretisations.

mod assess;
pub(crate) mod branch;
mod closing;
mod discretisation;
mod events;
mod found;
mod labels;
mod progress;
mod start;
mod step;
pub(crate) mod switching;
