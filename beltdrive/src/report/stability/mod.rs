//! The stability of the axial motion of a flat belt as text.

mod csv;
mod json;
mod meaning;
#[cfg(test)]
pub(crate) mod sample;
mod table;
mod words;

pub use self::csv::csv;
pub use json::json;
pub use table::table;
pub(crate) use words::{complex, form_label, outcome};
