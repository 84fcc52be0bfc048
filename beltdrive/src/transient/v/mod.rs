//! V-belts in time.
pub(crate) mod initial;
pub(crate) mod radial;
pub(crate) mod rates;
pub(crate) mod state;
pub(crate) mod system;
#[cfg(test)]
mod tests;
