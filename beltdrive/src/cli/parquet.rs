//! Parquet files, where the program is built with them.

use super::failure::Failure;
use super::origin::Origin;
use beltdrive::quantity::Answer;
#[cfg(feature = "parquet")]
use beltdrive::report;
use beltdrive::report::RowFormat;

/// Refuses Parquet if the program is built without.
#[cfg(feature = "parquet")]
#[expect(clippy::unnecessary_wraps, reason = "refused without the feature")]
pub(super) fn check() -> Result<(), Failure> {
    Ok(())
}

/// Refuses Parquet if the program is built without.
#[cfg(not(feature = "parquet"))]
pub(super) fn check() -> Result<(), Failure> {
    Err(Failure::usage(
        "error: this program is built without Parquet\nhelp: --csv writes the same rows; `cargo install --path \
         beltdrive` installs the program with Parquet",
    ))
}

/// The rows of an answer with their origin.
#[cfg(feature = "parquet")]
#[expect(clippy::unnecessary_wraps, reason = "refused without the feature")]
pub(super) fn bytes(answer: &Answer, origin: &Origin) -> Result<Vec<u8>, Failure> {
    Ok(report::parquet(answer, &origin.entries()))
}

/// The rows of an answer with their origin.
#[cfg(not(feature = "parquet"))]
pub(super) fn bytes(_: &Answer, _: &Origin) -> Result<Vec<u8>, Failure> {
    check().map(|()| Vec::new())
}

/// The form of Parquet files.
#[cfg(feature = "parquet")]
#[expect(clippy::unnecessary_wraps, reason = "refused without the feature")]
pub(super) fn format() -> Result<RowFormat, Failure> {
    Ok(RowFormat::Parquet)
}

/// The form of Parquet files.
#[cfg(not(feature = "parquet"))]
pub(super) fn format() -> Result<RowFormat, Failure> {
    check().map(|()| RowFormat::Csv)
}
