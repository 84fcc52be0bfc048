//! What a user states: a system with one unknown more than equations.

#[cfg(feature = "bvp")]
mod bvp;
mod closures;
pub(crate) mod dense;
#[cfg(feature = "bvp")]
pub(crate) mod exact;
mod permutation;
pub(crate) mod system;
