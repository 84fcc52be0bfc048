//! What a user states: a system with one unknown more than equations.

#[cfg(feature = "bvp")]
mod bvp;
pub(crate) mod dense;
pub(crate) mod system;
