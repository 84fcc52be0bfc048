//! The numbers of a drive file, by their paths.

use super::{
    DriveFile, Finding, check,
    dimension::Dimension,
    document::{Content, Entry},
    schema::{self, QuantityRule},
    source::Source,
    spelling,
    values::Values,
};
use crate::input::Diagnostic;
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

    /// What it measures.
    pub fn measure(&self) -> Measure {
        self.measure
    }

    /// Whether it cannot be negative.
    pub(crate) fn ends_at_zero(&self) -> bool {
        matches!(self.range, schema::Range::NotNegative)
    }

    /// Whether it cannot be 0 or negative.
    pub(crate) fn is_positive(&self) -> bool {
        matches!(
            self.range,
            schema::Range::Positive | schema::Range::Below(..)
        )
    }
}

/// Keys are the same if their paths are.
impl PartialEq for FileKey {
    fn eq(&self, other: &Self) -> bool {
        self.path == other.path
    }
}

/// What a dimension is as a measure, if it has one.
fn measure(dimension: Dimension) -> Option<Measure> {
    let measures = [
        (Dimension::NUMBER, Measure::Number),
        (Dimension::ANGLE, Measure::Angle),
        (Dimension::LENGTH, Measure::Length),
        (Dimension::FORCE, Measure::Force),
        (Dimension::FORCE_PER_LENGTH, Measure::Stiffness),
        (Dimension::TORQUE, Measure::Torque),
        (Dimension::TORQUE_PER_ANGLE, Measure::AngularStiffness),
        (Dimension::POWER, Measure::Power),
        (Dimension::VELOCITY, Measure::Velocity),
        (Dimension::ANGULAR_SPEED, Measure::AngularSpeed),
        (Dimension::MASS_PER_LENGTH, Measure::MassPerLength),
        (Dimension::FORCE_PER_AREA, Measure::ForcePerArea),
        (Dimension::INVERSE_LENGTH, Measure::InverseLength),
    ];
    let known = measures.into_iter().find(|(known, _)| *known == dimension);
    known.map(|(_, measure)| measure)
}

impl DriveFile {
    /// The numbers that the file gives.
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

    /// The file with another value of a number, SI.
    #[must_use]
    pub fn with(&self, key: &FileKey, value: f64) -> Self {
        let mut file = self.clone();
        if let Some(entry) = file.document.entries.get_mut(&key.path) {
            entry.content = Content::Number(value);
        }
        file
    }

    /// The number of the file that an option of a command line names by its path.
    ///
    /// # Errors
    /// The file has no such number.
    pub fn key(&self, option: &str, path: &str) -> Result<FileKey, Diagnostic> {
        let keys = self.keys();
        if let Some(key) = keys.iter().find(|key| key.path == path) {
            return Ok(key.clone());
        }
        let source = Source::argument(option, path);
        let place = option.len() + 1..option.len() + 1 + path.len();
        let paths = || keys.iter().map(|key| key.path.as_str());
        let names = paths().map(|path| (schema::split(path).1, path));
        let near = spelling::nearest_path(path, paths());
        let message = match schema::rule(path) {
            Some(_) => format!("the drive file gives no number `{path}`"),
            None => format!("unknown key `{path}`"),
        };
        let finding = Finding::new(place, message)
            .expected(check::one_of(&paths().collect::<Vec<_>>()))
            .did_you_mean(near.or_else(|| spelling::nearest(path, names)));
        Err(Diagnostic::new(finding, &source))
    }

    /// The value of a number as an option of a command line gives it, with its unit; SI.
    ///
    /// # Errors
    /// The value is no quantity, of another dimension, or out of its range.
    pub fn option_value(
        &self,
        option: &str,
        value: &str,
        key: &FileKey,
    ) -> Result<f64, Diagnostic> {
        let source = Source::argument(option, value);
        let place = option.len() + 1..option.len() + 1 + value.len();
        let entry = Entry {
            key: place.clone(),
            place,
            content: Content::Text(value.to_owned()),
        };
        let QuantityRule {
            rule,
            dimension,
            range,
        } = schema::quantity_rule(&key.path).expect("a key is a quantity of the schema");
        check::number(&key.path, rule, dimension, range, &entry, &source)
            .map_err(|finding| Diagnostic::new(finding, &source))
    }
}

/// The key of the number at a path.
fn key(path: &str) -> Option<FileKey> {
    let QuantityRule {
        dimension, range, ..
    } = schema::quantity_rule(path)?;
    Some(FileKey {
        path: path.to_owned(),
        measure: measure(dimension)?,
        range,
    })
}
