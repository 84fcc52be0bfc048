//! What a user states: a system with one unknown more than equations.

pub(crate) mod dense;
pub(crate) mod system;
