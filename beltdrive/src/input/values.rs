//! The entries of a document, each checked by itself: known, of the right type, unit and range.

use super::{
    check,
    diagnostic::Finding,
    document::{Document, Entry},
    schema::{self, Kind, Rule},
    source::Source,
};
use std::{collections::BTreeMap, ops::Range};

/// The checked values of a drive file by path.
pub(super) struct Values<'d> {
    document: &'d Document,
    /// Quantities in SI units.
    numbers: BTreeMap<&'static str, f64>,
    /// Texts and words.
    texts: BTreeMap<&'static str, String>,
}

impl<'d> Values<'d> {
    /// Checks every entry, in the order of the source.
    pub(super) fn check(document: &'d Document, source: &Source) -> Result<Self, Finding> {
        let mut values = Self {
            document,
            numbers: BTreeMap::new(),
            texts: BTreeMap::new(),
        };
        let mut entries: Vec<_> = document.entries.iter().collect();
        entries.sort_by_key(|(_, entry)| entry.key.start);
        for (path, entry) in entries {
            match schema::rule(path) {
                Some(rule) => values.insert(rule, entry, source)?,
                None => check::table(path, entry)?,
            }
        }
        Ok(values)
    }

    /// The number at `path`, if it is given.
    pub(super) fn number(&self, path: &str) -> Option<f64> {
        self.numbers.get(path).copied()
    }

    /// The text at `path`, if it is given.
    pub(super) fn text(&self, path: &str) -> Option<&str> {
        self.texts.get(path).map(String::as_str)
    }

    /// The number that a drive must have at `path`.
    pub(super) fn required_number(&self, path: &str) -> Result<f64, Finding> {
        self.number(path).ok_or_else(|| self.missing(&[path]))
    }

    /// The text that a drive must have at `path`.
    pub(super) fn required_text(&self, path: &str) -> Result<&str, Finding> {
        self.text(path).ok_or_else(|| self.missing(&[path]))
    }

    /// Where the value at `path` stands.
    pub(super) fn place(&self, path: &str) -> Range<usize> {
        let entry = self.document.entries.get(path);
        entry.map_or(self.document.end.clone(), |entry| entry.place.clone())
    }

    /// Where the key of the entry at `path` stands.
    pub(super) fn key_place(&self, path: &str) -> Range<usize> {
        let entry = self.document.entries.get(path);
        entry.map_or(self.document.end.clone(), |entry| entry.key.clone())
    }

    /// The finding that a drive has none of the entries at `paths`, all of one table.
    pub(super) fn missing(&self, paths: &[&str]) -> Finding {
        let rules: Vec<_> = paths.iter().filter_map(|path| schema::rule(path)).collect();
        let table = rules.first().map_or("", |rule| schema::split(rule.path).0);
        let lines: Vec<_> = rules.iter().map(|rule| rule.line()).collect();
        let lines = lines.join(" or ");
        match self.document.entries.get(table) {
            Some(entry) => {
                let keys: Vec<_> = paths.iter().map(|path| schema::split(path).1).collect();
                let keys = keys.join("` or `");
                Finding::new(
                    entry.key.clone(),
                    format!("missing key `{keys}` in [{table}]"),
                )
                .expected(lines)
            }
            None => {
                let end = self.document.end.clone();
                Finding::new(end, format!("missing table [{table}]"))
                    .expected(format!("[{table}] with {lines}"))
            }
        }
    }

    fn insert(&mut self, rule: &Rule, entry: &Entry, source: &Source) -> Result<(), Finding> {
        match rule.kind {
            Kind::Quantity { dimension, range } => {
                let value = check::number(rule, dimension, range, entry, source)?;
                self.numbers.insert(rule.path, value);
            }
            Kind::Word { what, words } => {
                let word = check::word(rule, what, words, entry)?;
                self.texts.insert(rule.path, word.to_owned());
            }
            Kind::Text => {
                let text = check::text(rule, entry)?;
                self.texts.insert(rule.path, text.to_owned());
            }
            Kind::Refused { reason, instead } => {
                let message = format!("`{}` {reason}", rule.path);
                let expected = check::one_of(&schema::names(schema::split(rule.path).0));
                return Err(Finding::new(entry.key.clone(), message)
                    .expected(expected)
                    .did_you_mean(instead.map(|path| schema::split(path).1)));
            }
        }
        Ok(())
    }
}
