//! Arrow IPC files, where the program is built with them.

use super::failure::Failure;
use beltdrive::report::RowFormat;

/// The form of Arrow IPC files; refused if the program is built without.
#[cfg(feature = "arrow")]
#[expect(clippy::unnecessary_wraps, reason = "refused without the feature")]
pub(super) fn format() -> Result<RowFormat, Failure> {
    Ok(RowFormat::Arrow)
}

/// The form of Arrow IPC files; refused if the program is built without.
#[cfg(not(feature = "arrow"))]
pub(super) fn format() -> Result<RowFormat, Failure> {
    Err(Failure::usage(
        "error: this program is built without Arrow\nhelp: --csv writes the same rows; `cargo install --path \
         beltdrive` installs the program with Arrow",
    ))
}
