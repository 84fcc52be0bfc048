//! Curves of limit points and of branch points in two parameters.

pub(crate) mod branch_point_curve;
pub(crate) mod limit_point_curve;
pub(crate) mod null_surface;
