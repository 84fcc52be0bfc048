//! A curve of limits as text.

mod csv;
mod json;
mod table;

pub use self::csv::csv;
pub use json::json;
pub use table::table;
