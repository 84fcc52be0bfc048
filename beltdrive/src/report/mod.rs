//! Answers as text, each form written once: a table for people, JSON and CSV for programs, and a page in
//! Markdown of published results.

mod cells;
mod csv;
mod file;
pub(crate) mod html;
mod json;
pub(crate) mod lines;
mod lookup_table;
mod markdown;
mod table;

pub use self::csv::csv;
pub(crate) use crate::quantity::precision::six_digits;
pub use file::write_file;
pub use json::json;
pub use lookup_table::{NoTable, lookup_tables};
pub use markdown::markdown;
pub use table::table;
