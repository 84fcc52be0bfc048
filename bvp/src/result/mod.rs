//! What the solver returns.

pub(crate) mod error;
mod messages;
pub(crate) mod quality;
pub(crate) mod report;
pub(crate) mod restored;
pub(crate) mod solution;
pub(crate) mod stats;
#[cfg(feature = "serde")]
pub(crate) mod stored;
