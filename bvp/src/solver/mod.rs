//! The driver: from a statement and a guess to a solution or an error.

pub(crate) mod acceptance;
pub(crate) mod at_solution;
pub(crate) mod conditioning;
pub(crate) mod corrected;
pub(crate) mod discretised;
pub(crate) mod embedding;
pub(crate) mod failure;
pub(crate) mod homotopy;
pub(crate) mod options;
pub(crate) mod solver;
pub(crate) mod statement;
pub(crate) mod stepping;
pub(crate) mod straight;
pub(crate) mod transfer;
