//! Entries and values that a command line names: what is traced, and from where to where.

use super::{
    belt, check,
    diagnostic::{Diagnostic, Finding},
    document::{Content, Entry},
    file,
    key::Key,
    schema::{self, Kind},
    source::Source,
    spelling,
};
use crate::{BeltKind, Drive};
use std::ops::Range;

/// An option of a command line and its value.
#[derive(Clone, Copy, Debug)]
pub struct Argument<'a> {
    /// The option, e.g. `--from`.
    pub option: &'a str,
    /// Its value, e.g. `700 N`.
    pub value: &'a str,
}

impl Argument<'_> {
    /// The entry of the drive file, given by its dotted path, over which a drive can be traced.
    ///
    /// # Errors
    /// There is no such entry, it is no number, or it does not apply to the drive.
    pub fn key(&self, drive: &Drive) -> Result<Key, Diagnostic> {
        // The torque of a drive with two pulleys has two names.
        let path = match self.value {
            "load.torque" => schema::TORQUE,
            path => path,
        };
        let known = Key::all(drive).find(|key| key.path() == path);
        known.ok_or_else(|| self.diagnose(self.no_key(drive)))
    }

    /// The index of the pulley of a drive with this name.
    ///
    /// # Errors
    /// There is no such pulley.
    pub fn pulley(&self, drive: &Drive) -> Result<usize, Diagnostic> {
        let mut pulleys = drive.pulleys.iter();
        let known = pulleys.position(|pulley| pulley.name == self.value);
        known.ok_or_else(|| {
            let names: Vec<_> = { drive.pulleys.iter() }
                .map(|pulley| &*pulley.name)
                .collect();
            let near = spelling::nearest(self.value, names.iter().map(|name| (name, name)));
            let message = format!("there is no pulley `{}`", self.value);
            self.diagnose(
                Finding::new(self.entry().place, message)
                    .did_you_mean(near)
                    .expected(check::one_of(&names)),
            )
        })
    }

    /// The end of the range of an entry over which the drive is traced, in SI units. What the drive
    /// has for another entry that is `free`, because it is found for each value, does not count.
    ///
    /// # Errors
    /// The value is no quantity, of another dimension, out of its range, or contradicts the drive.
    pub fn value(&self, key: Key, drive: &Drive, free: Option<Key>) -> Result<f64, Diagnostic> {
        self.quantity(key, drive, free)
            .map_err(|finding| self.diagnose(finding))
    }

    fn quantity(&self, key: Key, drive: &Drive, free: Option<Key>) -> Result<f64, Finding> {
        let entry = self.entry();
        let value = check::quantity(key.path(), &entry, &self.source())?;
        let mut drive = drive.clone();
        key.set(&mut drive, value);
        let is_free = |path: &&str| free.is_some_and(|free| free.path() == *path);
        match drive
            .two_pulleys()
            .and_then(|two| file::contradiction(&two))
        {
            Some(contradiction) if !contradiction.between.iter().any(is_free) => {
                Err(Finding::new(entry.place, contradiction.message))
            }
            _ => Ok(value),
        }
    }

    /// Why the value is no entry over which the drive can be traced.
    fn no_key(&self, drive: &Drive) -> Finding {
        let path = self.value;
        let place = self.entry().place;
        let finding = |message| Finding::new(place.clone(), message);
        match schema::rule(path).map(|rule| &rule.kind) {
            Some(Kind::Refused { reason, instead }) => {
                let applies = |path: &&str| Key::all(drive).any(|key| key.path() == *path);
                finding(format!("`{path}` {reason}")).did_you_mean(instead.filter(applies))
            }
            Some(
                Kind::Text | Kind::Word { .. } | Kind::Points { .. } | Kind::Keys | Kind::Spread,
            ) => finding(format!("`{path}` is no number, so it cannot be traced")),
            Some(Kind::Quantity { .. }) => inapplicable(path, drive, &place),
            None => {
                let keys = || Key::all(drive).map(|key| key.path());
                finding(format!("unknown key `{path}`"))
                    .did_you_mean(spelling::nearest_key(path, keys))
            }
        }
        .expected(check::one_of(
            &Key::all(drive).map(|key| key.path()).collect::<Vec<_>>(),
        ))
    }

    pub(super) fn source(&self) -> Source {
        Source::argument(self.option, self.value)
    }

    /// The value as an entry of its source.
    pub(super) fn entry(&self) -> Entry {
        let start = self.option.len() + 1;
        let place = start..start + self.value.len();
        Entry {
            key: place.clone(),
            place,
            content: Content::Text(self.value.to_owned()),
        }
    }

    pub(super) fn diagnose(&self, finding: Finding) -> Diagnostic {
        Diagnostic::new(finding, &self.source())
    }
}

/// Why a quantity of the schema is none over which the drive can be traced.
fn inapplicable(path: &str, drive: &Drive, place: &Range<usize>) -> Finding {
    let finding = |message| Finding::new(place.clone(), message);
    let belt = belt::name(drive.belt.kind);
    let is_v_belt = matches!(drive.belt.kind, BeltKind::V(_));
    match schema::split(path).0 {
        table if path.ends_with(".diameter") => {
            let radius = schema::join(table, "radius");
            finding(format!(
                "a drive with two pulleys is traced over `{radius}`"
            ))
            .did_you_mean(Some(radius))
        }
        _ if schema::is_of_service(path) || is_v_belt && path.starts_with("belt.") => finding(
            format!("`{path}` does not change the steady state, so it cannot be traced"),
        ),
        "friction" => {
            let law = drive.law.name();
            finding(format!(
                "`{path}` does not apply to the friction law `{law}`"
            ))
        }
        "load" if path != schema::TORQUE || !is_v_belt => {
            let others = schema::alternatives(path);
            let other = Key::all(drive).find(|key| others.iter().any(|other| other == key.path()));
            let other = other.unwrap_or_else(|| Key::load(drive)).path();
            finding(format!("`{path}` is not given: the drive has `{other}`"))
                .did_you_mean(Some(other))
        }
        _ => finding(format!("`{path}` does not apply to {belt}")),
    }
}
