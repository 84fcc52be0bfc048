//! LU factors of square matrices.

mod large;
pub(crate) mod lu;
mod panels;
mod singular;
mod small;
