//! What a user states: a system with one unknown more than equations.

#[cfg(feature = "sparse")]
mod bordered;
#[cfg(feature = "bvp")]
mod bvp;
mod closures;
#[cfg(all(feature = "bvp", feature = "sparse"))]
mod colouring;
pub(crate) mod dense;
pub(crate) mod difference;
#[cfg(feature = "bvp")]
pub(crate) mod exact;
mod permutation;
#[cfg(feature = "sparse")]
pub(crate) mod sparse;
#[cfg(feature = "sparse")]
mod sparse_lu;
pub(crate) mod system;
