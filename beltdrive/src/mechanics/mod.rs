//! Mechanics that all belts share, roots of equations and maxima of functions.

pub(crate) mod implicit;
pub(crate) mod maximum;
pub(crate) mod root;
pub(crate) mod span;
pub(crate) mod tensioner;
