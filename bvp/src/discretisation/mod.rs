//! Schemes, meshes and the unknowns of a discretised problem.

pub(crate) mod iterate;
mod lagrange;
pub(crate) mod mesh;
pub(crate) mod powers;
mod quadrature;
pub(crate) mod ratio;
pub(crate) mod restriction;
pub(crate) mod scheme;
pub(crate) mod tableau;
