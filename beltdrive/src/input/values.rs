//! The entries of a document, each checked by itself: known, of the right type, unit and range.

use super::{
    check,
    diagnostic::Finding,
    document::{Content, Document, Entry},
    overrides,
    schema::{self, Kind, Rule},
    source::Source,
    uncertainty,
};
use std::{collections::BTreeMap, ops::Range};

/// The checked values of a drive file by path.
#[derive(Clone, Debug)]
pub(super) struct Values<'d> {
    document: &'d Document,
    /// Quantities in SI units.
    numbers: BTreeMap<&'d str, f64>,
    /// Points in SI units.
    points: BTreeMap<&'d str, Vec<[f64; 2]>>,
    /// Texts and words.
    texts: BTreeMap<&'d str, &'d str>,
}

impl<'d> Values<'d> {
    /// Checks every entry, in the order of the source.
    pub(super) fn check(document: &'d Document, source: &Source) -> Result<Self, Finding> {
        let mut values = Self {
            document,
            numbers: BTreeMap::new(),
            points: BTreeMap::new(),
            texts: BTreeMap::new(),
        };
        let mut entries: Vec<_> = document.entries.iter().collect();
        entries.sort_by_key(|(_, entry)| entry.key.start);
        for (path, entry) in entries {
            match schema::rule(path) {
                Some(rule) => values.insert(path, rule, entry, source)?,
                None => check::table(path, entry)?,
            }
        }
        Ok(values)
    }

    /// The number at `path`, if it is given.
    pub(super) fn number(&self, path: &str) -> Option<f64> {
        self.numbers.get(path).copied()
    }

    /// Puts a checked number, SI, in the place of the one at `path`.
    pub(super) fn set_number(&mut self, path: &'d str, number: f64) {
        self.numbers.insert(path, number);
    }

    /// The points at `path`, if they are given.
    pub(super) fn points(&self, path: &str) -> Option<&[[f64; 2]]> {
        self.points.get(path).map(Vec::as_slice)
    }

    /// The text at `path`, if it is given.
    pub(super) fn text(&self, path: &str) -> Option<&'d str> {
        self.texts.get(path).copied()
    }

    /// The names of the pulleys of a list, in belt order.
    pub(super) fn pulleys(&self) -> &'d [String] {
        &self.document.pulleys
    }

    /// The index of the pulley that the text `name` at `path` names.
    pub(super) fn pulley(&self, path: &str, name: &str) -> Result<usize, Finding> {
        let pulleys = self.pulleys();
        let index = pulleys.iter().position(|pulley| pulley == name);
        index.ok_or_else(|| {
            let named = (name, self.place(path));
            overrides::unknown(schema::PULLEY, "pulley", pulleys, named)
        })
    }

    /// Whether a table or an entry is given at `path`.
    pub(super) fn has(&self, path: &str) -> bool {
        self.document.entries.contains_key(path)
    }

    /// Those of the entries at `paths` that are given.
    pub(super) fn given<'p>(&self, paths: &[&'p str]) -> Vec<&'p str> {
        let given = paths.iter().filter(|path| self.has(path));
        given.copied().collect()
    }

    /// The number that a drive must have at `path`.
    pub(super) fn required_number(&self, path: &str) -> Result<f64, Finding> {
        self.number(path).ok_or_else(|| self.missing(&[path]))
    }

    /// The text that a drive must have at `path`.
    pub(super) fn required_text(&self, path: &str) -> Result<&'d str, Finding> {
        self.text(path).ok_or_else(|| self.missing(&[path]))
    }

    /// Where the value at `path` stands.
    pub(super) fn place(&self, path: &str) -> Range<usize> {
        let entry = self.document.entries.get(path);
        entry.map_or(self.document.end.clone(), |entry| entry.place.clone())
    }

    /// Where a point of the array at `path` stands.
    pub(super) fn point_place(&self, path: &str, point: usize) -> Range<usize> {
        match self.document.entries.get(path).map(|entry| &entry.content) {
            Some(Content::List(points)) if point < points.len() => points[point].place.clone(),
            _ => self.place(path),
        }
    }

    /// Where the key of the entry at `path` stands.
    pub(super) fn key_place(&self, path: &str) -> Range<usize> {
        let entry = self.document.entries.get(path);
        entry.map_or(self.document.end.clone(), |entry| entry.key.clone())
    }

    /// The finding that a drive has none of the entries at `paths`, all of one table.
    pub(super) fn missing(&self, paths: &[&str]) -> Finding {
        let rules: Vec<_> = paths.iter().filter_map(|path| schema::rule(path)).collect();
        let table = paths.first().map_or("", |path| schema::split(path).0);
        let lines: Vec<_> = rules.iter().map(|rule| rule.line()).collect();
        let lines = lines.join(" or ");
        match self.document.entries.get(table) {
            Some(entry) => {
                let keys: Vec<_> = paths.iter().map(|path| schema::split(path).1).collect();
                let keys = keys.join("` or `");
                Finding::new(
                    entry.key.clone(),
                    format!("missing key `{keys}` in {}", schema::header(table)),
                )
                .expected(lines)
            }
            None => {
                let end = self.document.end.clone();
                let table = schema::header(table);
                Finding::new(end, format!("missing table {table}"))
                    .expected(format!("{table} with {lines}"))
            }
        }
    }

    /// The finding that a drive has none of several entries, all of which it needs.
    pub(super) fn all_missing(&self, paths: &[&str]) -> Finding {
        let rules = paths.iter().filter_map(|path| schema::rule(path));
        let examples: Vec<_> = rules
            .map(|rule| format!("{} = {}", rule.path, rule.example))
            .collect();
        let keys = paths.join("`, `");
        Finding::new(self.document.end.clone(), format!("missing keys `{keys}`"))
            .expected(examples.join(", "))
    }

    fn insert(
        &mut self,
        path: &'d str,
        rule: &Rule,
        entry: &'d Entry,
        source: &Source,
    ) -> Result<(), Finding> {
        match rule.kind {
            Kind::Quantity { dimension, range } => {
                let value = check::number(path, rule, dimension, range, entry, source)?;
                self.numbers.insert(path, value);
            }
            Kind::Points { dimensions } => {
                let points = match (&entry.content, self.document.points.get(path)) {
                    (Content::Text(_), Some(read)) => read.clone(),
                    _ => check::points(path, rule, dimensions, entry, source)?,
                };
                self.points.insert(path, points);
            }
            Kind::Word { what, words } => {
                self.texts
                    .insert(path, check::word(path, rule, what, words, entry)?);
            }
            Kind::Text => {
                self.texts.insert(path, check::text(path, rule, entry)?);
            }
            Kind::Keys => check::keys(path, rule, entry)?,
            Kind::Spread => {
                uncertainty::spread(path, entry, source)?;
            }
            Kind::Refused { reason, instead } => {
                let message = format!("`{path}` {reason}");
                let expected = check::one_of(&schema::names(schema::split(path).0));
                return Err(Finding::new(entry.key.clone(), message)
                    .expected(expected)
                    .did_you_mean(instead.map(|path| schema::split(path).1)));
            }
        }
        Ok(())
    }
}
