//! Published results beside the computed ones.

mod csv;
mod figures;
mod json;
mod markdown;
mod notes;
#[cfg(test)]
mod sample;
mod table;
mod words;

pub use self::csv::csv;
pub use json::json;
pub use markdown::markdown;
pub use table::table;
