//! Everything that decides whether a solution is good enough, and which mesh is better.

pub(crate) mod amplification;
pub(crate) mod defect;
pub(crate) mod direction;
pub(crate) mod further_places;
pub(crate) mod global_error;
pub(crate) mod layers;
mod looked_at;
pub(crate) mod mesh_selection;
pub(crate) mod rounding;
mod segment_look;
mod singular_ends;
