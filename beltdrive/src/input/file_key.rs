//! The numbers of a drive file, by their paths.

use super::{
    Argument, Diagnostic, DriveFile, Finding, check,
    document::{Content, Entry},
    schema::{self, QuantityRule},
    spelling,
    values::Values,
};
use crate::quantity::Measure;

/// A number of a drive file.
#[derive(Clone, Debug)]
pub struct FileKey {
    path: String,
    measure: Measure,
    range: schema::Range,
}

impl FileKey {
    /// Its dotted path, such as `pulley.fan.torque`.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Its name in JSON, CSV and Parquet, without the unit.
    pub fn stem(&self) -> String {
        self.path.replace(['.', ' ', '-', '/'], "_")
    }

    /// What it measures.
    pub fn measure(&self) -> Measure {
        self.measure
    }

    /// Whether a value in SI units lies in its range.
    pub(super) fn allows(&self, value: f64) -> bool {
        match self.range {
            schema::Range::Positive => value > 0.0,
            schema::Range::NotNegative => value >= 0.0,
            schema::Range::Any => true,
            schema::Range::Whole => false,
            schema::Range::Below(limit, _) => value > 0.0 && value < limit,
            schema::Range::Share => value > 0.0 && value <= 1.0,
            schema::Range::AtLeastOne => value >= 1.0,
        }
    }

    /// Whether it cannot be negative.
    pub(crate) fn ends_at_zero(&self) -> bool {
        matches!(self.range, schema::Range::NotNegative)
    }

    /// Whether it cannot be 0 or negative.
    pub(crate) fn is_positive(&self) -> bool {
        matches!(
            self.range,
            schema::Range::Positive | schema::Range::Below(..) | schema::Range::Share
        )
    }
}

/// Keys are the same if their paths are.
impl PartialEq for FileKey {
    fn eq(&self, other: &Self) -> bool {
        self.path == other.path
    }
}

impl DriveFile {
    /// The numbers that the file gives and that its steady state depends on, but for whole ones.
    pub fn keys(&self) -> Vec<FileKey> {
        let entries = self.document.entries.iter();
        entries
            .filter_map(|(path, entry)| match entry.content {
                Content::Text(_) | Content::Number(_) => key(path),
                _ => None,
            })
            .collect()
    }

    /// The value of a number of the file, SI.
    pub fn value(&self, key: &FileKey) -> Option<f64> {
        let values = Values::check(&self.document, &self.source).ok()?;
        values.number(&key.path)
    }

    /// The file with another value of a number, SI, and with what follows from it by the belt section, such as the
    /// groove angle of another diameter.
    #[must_use]
    pub fn with(&self, key: &FileKey, value: f64) -> Self {
        self.restated([(key.path.clone(), Content::Number(value))])
    }

    /// The file with the sense in which its belt runs round the pulleys, where it leaves that to their places: as a
    /// number varies, the belt may come to fit the other way round, too.
    #[must_use]
    pub(crate) fn with_sense(&self) -> Self {
        let mut file = self.clone();
        if let Ok(drive) = self.drive()
            && self.document.entries.contains_key(schema::PULLEY)
        {
            let end = self.document.end.clone();
            let entry = |content| Entry {
                key: end.clone(),
                place: end.clone(),
                content,
            };
            let entries = &mut file.document.entries;
            for (path, content) in [
                ("layout", Content::Table),
                ("layout.sense", Content::Text(drive.sense.name().to_owned())),
            ] {
                entries.entry(path.to_owned()).or_insert(entry(content));
            }
        }
        file
    }

    /// The number of the file that a command line names by its path.
    ///
    /// # Errors
    /// The file has no such number.
    pub fn key(&self, argument: Argument<'_>) -> Result<FileKey, Diagnostic> {
        let (keys, path) = (self.keys(), argument.value);
        if let Some(key) = keys.iter().find(|key| key.path == path) {
            return Ok(key.clone());
        }
        let paths = || keys.iter().map(|key| key.path.as_str());
        let message = match schema::rule(path) {
            Some(_) if schema::is_of_service(path) => {
                format!("`{path}` does not change the steady state")
            }
            Some(rule) if rule.is_whole() => {
                format!("`{path}` is a whole number and does not vary")
            }
            Some(_) => format!("the drive file gives no number `{path}`"),
            None => format!("unknown key `{path}`"),
        };
        let finding = Finding::new(argument.entry().place, message)
            .expected(check::one_of(&paths().collect::<Vec<_>>()))
            .did_you_mean(spelling::nearest_key(path, paths));
        Err(argument.diagnose(finding))
    }
}

impl Argument<'_> {
    /// The value of a number of a drive file, with its unit; SI.
    ///
    /// # Errors
    /// The value is no quantity, of another dimension, or out of its range.
    pub fn number(&self, key: &FileKey) -> Result<f64, Diagnostic> {
        check::quantity(&key.path, &self.entry(), &self.source())
            .map_err(|finding| self.diagnose(finding))
    }

    /// The value as a speed of the driver of a drive file, rad/s.
    ///
    /// # Errors
    /// The value is no speed, or the file gives none.
    pub fn driver_speed(&self, file: &DriveFile) -> Result<f64, Diagnostic> {
        let keys = file.keys();
        match keys.iter().find(|key| key.path().ends_with(".speed")) {
            Some(key) => self.number(key),
            None => {
                let message = "the drive file gives no speed".to_owned();
                Err(self.diagnose(Finding::new(self.entry().place, message)))
            }
        }
    }
}

/// The key of the number at a path, unless it is a whole one, which does not vary, or does not change the steady state.
fn key(path: &str) -> Option<FileKey> {
    (!schema::is_of_service(path)).then(|| varied(path))?
}

/// The key of the number at a path, unless it is a whole one, which does not vary.
pub(super) fn varied(path: &str) -> Option<FileKey> {
    let QuantityRule {
        dimension, range, ..
    } = schema::quantity_rule(path)?;
    if matches!(range, schema::Range::Whole) {
        return None;
    }
    Some(FileKey {
        path: path.to_owned(),
        measure: dimension.measure()?,
        range,
    })
}
