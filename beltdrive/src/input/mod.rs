//! Drive files: from a TOML text and overrides to a [`Drive`], or to one [`Diagnostic`].
//!
//! A drive file states quantities with units, `"120 kN"`; a bare number is in SI units. The stages:
//!
//! ```text
//! text ── document ── overrides ── values ── drive
//!         TOML        --set        schema:   relations between
//!                                  keys,     values, choice of
//!                                  units,    belt, law and
//!                                  ranges    load
//! ```
//!
//! What a branch is traced over, a [`Key`] with its range, is read by the same rules from an
//! [`Argument`] of the command line.
//!
//! The first finding of any stage ends the reading and is shown where it stands.

mod argument;
mod bare_speed;
mod belt;
mod belt_loop;
mod calibration;
mod check;
mod csv;
mod design;
mod diagnostic;
mod dimension;
mod document;
mod file;
mod file_key;
mod friction;
mod heading;
mod key;
mod load;
mod measurements;
mod overrides;
mod points_file;
mod quantity;
mod restated;
mod schema;
mod section;
mod service;
mod source;
pub(crate) mod spelling;
mod table;
mod tensioner;
mod traceable;
mod transient;
mod uncertainty;
mod unit;
mod values;
mod variants;

pub use argument::Argument;
pub use design::{Choice, ChoiceValue, DesignObjective, DesignQuestion, FreeKey};
pub use diagnostic::Diagnostic;
pub use file_key::FileKey;
pub use key::Key;
pub use measurements::{MeasuredRow, Measurements, Reading};
pub use section::{FilledEntry, FilledIn, FilledValue};
pub use table::TableHead;
pub use uncertainty::{Spread, Uncertain};
pub use variants::Variants;

use crate::Drive;
use diagnostic::Finding;
use document::Document;
use source::Source;
use values::Values;

/// Reads the drive file `text`, called `name` in messages, with overrides `KEY=VALUE` in place of
/// entries or in addition to them. A key is a dotted path; a value may be quoted or not; without a
/// value, `KEY=`, the entry is left out.
///
/// ```
/// let text = beltdrive::examples::find("kim2009")?.text;
/// let overrides = ["friction.law=epp".to_owned(), "friction.coefficient = 0.35".to_owned()];
/// let drive = beltdrive::input::parse("kim2009.toml", text, &overrides)?;
/// assert_eq!(drive.law.name(), "epp");
/// assert_eq!(drive.pulleys[0].friction_coefficient, 0.35);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// The first finding, in the order of the text: the text is no TOML, a table or key is unknown or
/// missing, a value has the wrong type, unit, dimension or range, or values contradict each other.
pub fn parse(name: &str, text: &str, overrides: &[String]) -> Result<Drive, Diagnostic> {
    DriveFile::read(name, text, overrides)?.drive()
}

/// A drive file with its overrides, as it stands: any of its quantities can be looked up and changed.
#[derive(Clone, Debug)]
pub struct DriveFile {
    source: Source,
    document: Document,
    filled_in: Option<FilledIn>,
}

impl DriveFile {
    /// The drive file `text`, called `name` in messages, with overrides as for [`parse`].
    ///
    /// # Errors
    /// The text is no TOML, or an override has no place.
    pub fn read(name: &str, text: &str, overrides: &[String]) -> Result<Self, Diagnostic> {
        let source = Source::new(name, text, overrides);
        match document(&source, text, overrides) {
            Ok(mut document) => {
                let filled_in = section::fill(&mut document, &source);
                Ok(Self {
                    source,
                    document,
                    filled_in,
                })
            }
            Err(finding) => Err(Diagnostic::new(finding, &source)),
        }
    }

    /// The entries that the file leaves out and takes from the belt section that it names.
    pub fn filled_in(&self) -> Option<&FilledIn> {
        self.filled_in.as_ref()
    }

    /// The drive that the file states.
    ///
    /// # Errors
    /// As [`parse`].
    pub fn drive(&self) -> Result<Drive, Diagnostic> {
        let values = Values::check(&self.document, &self.source);
        let drive = values.and_then(|values| file::drive(&values));
        drive.map_err(|finding| Diagnostic::new(finding, &self.source))
    }
}

fn document(source: &Source, text: &str, overrides: &[String]) -> Result<Document, Finding> {
    let mut document = Document::from_toml(text)?;
    for (text, start) in overrides.iter().zip(source.override_starts()) {
        overrides::apply(&mut document, text, start)?;
    }
    Ok(document)
}
