//! A branch of steady states as text.

mod csv;
mod json;
mod table;

pub use self::csv::csv;
pub use json::json;
pub(in crate::report) use json::{ConvergenceReport, EndReport};
pub(in crate::report) use table::convergence;
pub use table::table;
