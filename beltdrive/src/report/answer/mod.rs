//! An [`Answer`](crate::quantity::Answer) as a table, JSON and CSV: each written once, for any answer.

mod csv;
mod json;
mod table;

pub use self::csv::csv;
pub(super) use json::Groups;
pub use json::json;
pub use table::table;

#[cfg(test)]
mod tests;
