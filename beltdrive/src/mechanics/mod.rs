//! Mechanics that all belts share, and roots of equations.

pub(crate) mod root;
pub(crate) mod span;
pub(crate) mod tensioner;
