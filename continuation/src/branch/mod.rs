//! The curve as a sequence of labelled points: the loop, its acceptance, its switches.

pub(crate) mod assess;
pub(crate) mod branch;
pub(crate) mod labels;
pub(crate) mod step;
pub(crate) mod switching;
