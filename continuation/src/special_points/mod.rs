//! Limit points and branch points: found, located, and their null spaces.

pub(crate) mod branch_point;
pub(crate) mod limit_point;
pub(crate) mod neighbour;
pub(crate) mod node;
pub(crate) mod null_space;
pub(crate) mod second_derivative;
pub(crate) mod slopes;
pub(crate) mod span;
