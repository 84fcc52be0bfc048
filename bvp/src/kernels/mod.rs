//! Dense linear algebra on slices: it knows no boundary value problem.

pub(crate) mod blocked;
pub(crate) mod dense;
pub(crate) mod few;
pub(crate) mod householder;
pub(crate) mod lq;
pub(crate) mod lu;
pub(crate) mod parallel;
pub(crate) mod random;
pub(crate) mod reflections;
pub(crate) mod room;
pub(crate) mod specialise;
