//! Rows in one of the forms that files have.

#[cfg(feature = "arrow")]
use super::arrow::ArrowWriter;
use super::csv::{csv_header, csv_rows};
#[cfg(feature = "parquet")]
use super::parquet::ParquetWriter;
use super::rows::{Column, Field};
use std::io::{self, Write};

/// A form of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowFormat {
    /// Comma-separated values.
    Csv,
    /// Parquet.
    #[cfg(feature = "parquet")]
    Parquet,
    /// Arrow IPC.
    #[cfg(feature = "arrow")]
    Arrow,
}

impl RowFormat {
    /// The extension of its files.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            #[cfg(feature = "parquet")]
            Self::Parquet => "parquet",
            #[cfg(feature = "arrow")]
            Self::Arrow => "arrow",
        }
    }
}

/// Writes rows in a form as they come.
#[derive(Debug)]
pub enum RowWriter<W: Write + Send> {
    /// Comma-separated values.
    Csv(W),
    /// Parquet.
    #[cfg(feature = "parquet")]
    Parquet(Box<ParquetWriter<W>>),
    /// Arrow IPC.
    #[cfg(feature = "arrow")]
    Arrow(Box<ArrowWriter<W>>),
}

impl<W: Write + Send> RowWriter<W> {
    /// Begins with columns and, where the form has a place for it, metadata: keys with values.
    ///
    /// # Errors
    /// What the output says.
    pub fn new(
        format: RowFormat,
        mut output: W,
        columns: &[Column],
        metadata: &[(String, String)],
    ) -> io::Result<Self> {
        match format {
            RowFormat::Csv => {
                let _ = metadata;
                output.write_all(csv_header(columns).as_bytes())?;
                Ok(Self::Csv(output))
            }
            #[cfg(feature = "parquet")]
            RowFormat::Parquet => {
                let writer = ParquetWriter::new(output, columns.to_vec(), metadata)?;
                Ok(Self::Parquet(Box::new(writer)))
            }
            #[cfg(feature = "arrow")]
            RowFormat::Arrow => {
                let writer = ArrowWriter::new(output, columns.to_vec(), metadata)?;
                Ok(Self::Arrow(Box::new(writer)))
            }
        }
    }

    /// Writes rows, each with a field for every column: some thousands at a time.
    ///
    /// # Errors
    /// What the output says.
    pub fn write(&mut self, rows: &[Vec<Option<Field>>]) -> io::Result<()> {
        match self {
            Self::Csv(output) => output.write_all(csv_rows(rows).as_bytes()),
            #[cfg(feature = "parquet")]
            Self::Parquet(writer) => writer.write(rows),
            #[cfg(feature = "arrow")]
            Self::Arrow(writer) => writer.write(rows),
        }
    }

    /// Ends; what it was written to still has to be flushed.
    ///
    /// # Errors
    /// What the output says.
    pub fn finish(self) -> io::Result<W> {
        match self {
            Self::Csv(output) => Ok(output),
            #[cfg(feature = "parquet")]
            Self::Parquet(writer) => writer.finish(),
            #[cfg(feature = "arrow")]
            Self::Arrow(writer) => writer.finish(),
        }
    }
}
