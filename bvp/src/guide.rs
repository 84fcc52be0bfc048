//! The guide: boundary value problems by example.
//!
//! | page | what it shows |
//! | --- | --- |
//! | [`other_solvers`] | From `bvp4c`, `solve_bvp`, COLNEW or TWPBVPC in five minutes; how to read a solution |
//! | [`layers`] | A thin layer: what the mesh does, and a way there where the direct one fails |
//! | [`eigenvalues`] | Unknown parameters, normalisation, the k-th eigenvalue |
//! | [`free_boundaries`] | Unknown lengths, places and periods |
//! | [`forms`] | Interfaces, inner conditions, kinks, integrals, singular ends, infinite intervals, complex states |
//! | [`failures`] | What to do when there is no solution, or one that is not to be trusted |
//! | [`families`] | Problems with several solutions or none: curves of solutions and their folds |
//! | [`accuracy`] | What the tolerance means, how the error is estimated, what it costs; many problems at once |
//!
//! The pages can be read in any order after the first. Whole programs with published solutions are in
//! `bvp/examples`; `cargo run -p bvp --example NAME` runs one.

pub mod accuracy;
pub mod eigenvalues;
pub mod failures;
pub mod families;
pub mod forms;
pub mod free_boundaries;
pub mod layers;
pub mod other_solvers;
