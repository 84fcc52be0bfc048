//! Answers as text and files, each form written once: a table for people, JSON, CSV, Parquet and Arrow for programs, and a
//! page in Markdown of published results.

#[cfg(feature = "arrow")]
mod arrow;
mod cells;
mod csv;
mod file;
mod html;
mod json;
pub(crate) mod lines;
mod lookup_table;
mod markdown;
#[cfg(feature = "parquet")]
mod parquet;
mod row_file;
mod rows;
mod table;
mod tree;

#[cfg(feature = "arrow")]
pub use self::arrow::ArrowWriter;
pub use self::csv::{csv, csv_header, csv_rows};
#[cfg(feature = "parquet")]
pub use self::parquet::{ParquetWriter, parquet};
pub(crate) use crate::quantity::precision::six_digits;
pub use file::{WholeFile, write_file};
pub use html::html;
pub(crate) use html::tables;
pub use json::json;
pub use lookup_table::{NoTable, lookup_tables};
pub use markdown::markdown;
pub use row_file::{RowFormat, RowWriter};
pub use rows::{Column, Field, FieldKind, Head, Rows};
pub use table::table;
pub use tree::{Node, tree};
