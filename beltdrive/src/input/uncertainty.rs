//! How far numbers of a drive file may be from their values.

use super::{
    Diagnostic, DriveFile, FileKey, check,
    diagnostic::Finding,
    dimension::Dimension,
    document::{Content, Entry},
    file_key,
    schema::{self, ENDS, QuantityRule, Range, UNCERTAINTY},
    source::Source,
    spelling,
    values::Values,
};
use std::collections::BTreeMap;

/// A number of a drive file that is not known exactly.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Uncertain {
    /// Which one.
    pub key: FileKey,
    /// Its value in the file, SI.
    pub value: f64,
    /// Where it may lie.
    pub spread: Spread,
}

/// Where a number may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spread {
    /// Around its value by the normal distribution of this standard deviation, SI, positive.
    Normal(f64),
    /// Anywhere between two ends, SI, the lower first, with the same probability.
    Interval([f64; 2]),
}

impl Uncertain {
    /// Its expected value, SI.
    #[must_use]
    pub fn mean(&self) -> f64 {
        match self.spread {
            Spread::Normal(_) => self.value,
            Spread::Interval([from, to]) => f64::midpoint(from, to),
        }
    }

    /// Its standard deviation, SI.
    #[must_use]
    pub fn standard_deviation(&self) -> f64 {
        match self.spread {
            Spread::Normal(deviation) => deviation,
            Spread::Interval([from, to]) => (to - from) / 12_f64.sqrt(),
        }
    }
}

impl DriveFile {
    /// What the table `[uncertainty]` of the file says, in its order; nothing without one.
    ///
    /// # Errors
    /// An entry is of no number of the file, or no spread around its value.
    pub fn uncertainty(&self) -> Result<Vec<Uncertain>, Diagnostic> {
        self.uncertain()
            .map_err(|finding| Diagnostic::new(finding, &self.source))
    }

    fn uncertain(&self) -> Result<Vec<Uncertain>, Finding> {
        let values = Values::check(&self.document, &self.source)?;
        // Intervals have an entry for each end under that of the whole.
        type Parts<'e> = (&'e Entry, [Option<f64>; 2], Option<Deviation>);
        let mut stated: BTreeMap<&str, Parts<'_>> = BTreeMap::new();
        for (path, entry) in &self.document.entries {
            let found = match schema::rule(path).map(|rule| &rule.kind) {
                Some(schema::Kind::Spread) => spread(path, entry, &self.source)?,
                _ => None,
            };
            let of = schema::uncertain(path).unwrap_or_default();
            match found {
                None => {}
                Some(Stated::Deviation(deviation)) => {
                    stated.entry(of).or_insert((entry, [None; 2], None)).2 = Some(deviation);
                }
                Some(Stated::End(end, value)) => {
                    let (whole, _) = schema::split(of);
                    let ends = &mut stated.entry(whole).or_insert((entry, [None; 2], None)).1;
                    ends[end] = Some(value);
                }
            }
        }
        let mut stated: Vec<_> = stated.into_iter().collect();
        stated.sort_by_key(|(_, (entry, ..))| entry.place.start);
        let uncertain = stated.into_iter().map(|(path, (entry, ends, deviation))| {
            let value = values.number(path);
            let (Some(key), Some(value)) = (file_key::varied(path), value) else {
                return Err(self.not_given(path, entry));
            };
            let spread = match (deviation, ends) {
                (Some(Deviation::Absolute(deviation)), _) => Spread::Normal(deviation),
                (Some(Deviation::Share(share)), _) if value != 0.0 => {
                    Spread::Normal(share * value.abs())
                }
                (Some(Deviation::Share(_)), _) => {
                    let message = format!("`{path}` is 0, so that a share of it says nothing");
                    return Err(Finding::new(entry.place.clone(), message)
                        .expected("a standard deviation with its unit"));
                }
                (None, [Some(from), Some(to)]) if from < to && (from..=to).contains(&value) => {
                    Spread::Interval([from, to])
                }
                (None, [Some(_), Some(_)]) => {
                    let message =
                        format!("the interval of `{path}` does not contain its value, or is empty");
                    return Err(Finding::new(entry.place.clone(), message).expected(
                        "the lower end before the upper one, and the value between them",
                    ));
                }
                (None, _) => {
                    let message = format!("the interval of `{path}` has one end");
                    return Err(
                        Finding::new(entry.key.clone(), message).expected("`from` and `to`")
                    );
                }
            };
            Ok(Uncertain { key, value, spread })
        });
        uncertain.collect()
    }

    /// The finding that the file gives no number of which an entry says how uncertain it is.
    fn not_given(&self, path: &str, entry: &Entry) -> Finding {
        let entries = self.document.entries.iter();
        let given: Vec<_> = entries
            .filter(|(_, entry)| matches!(entry.content, Content::Number(_) | Content::Text(_)))
            .map(|(path, _)| path.as_str())
            .filter(|path| is_of_drive(path) && file_key::varied(path).is_some())
            .collect();
        let near = spelling::nearest_key(path, || given.iter().copied());
        let message = format!("the drive file gives no number `{path}`");
        Finding::new(entry.key.clone(), message)
            .expected(check::one_of(&given))
            .did_you_mean(near)
    }
}

/// What an entry of the table says.
pub(super) enum Stated {
    /// A standard deviation.
    Deviation(Deviation),
    /// An end of an interval, the lower one first.
    End(usize, f64),
}

/// A standard deviation, positive.
pub(super) enum Deviation {
    /// SI.
    Absolute(f64),
    /// As a share of the value.
    Share(f64),
}

/// Checks an entry of the table by itself; nothing for a table of it.
pub(super) fn spread(
    path: &str,
    entry: &Entry,
    source: &Source,
) -> Result<Option<Stated>, Finding> {
    let of = schema::uncertain(path).unwrap_or_default();
    let (whole, name) = schema::split(of);
    let end = ENDS.iter().position(|end| *end == name);
    let end = end.filter(|_| schema::quantity_rule(whole).is_some());
    let of_number = if end.is_some() { whole } else { of };
    let Some(QuantityRule {
        rule,
        dimension,
        range,
    }) = schema::quantity_rule(of_number).filter(|_| is_of_drive(of_number))
    else {
        return match entry.content {
            Content::Table if schema::is_table(of) => Ok(None),
            _ => Err(no_number(of, entry)),
        };
    };
    if rule.is_whole() {
        let message = format!("`{of_number}` is a whole number and is known exactly");
        return Err(Finding::new(entry.key.clone(), message));
    }
    let number = |range, dimension| check::number(path, rule, dimension, range, entry, source);
    let stated = match (end, &entry.content) {
        (None, Content::Table) => return Ok(None),
        (Some(end), _) => Stated::End(end, number(range, dimension)?),
        (None, Content::Text(text)) if text.trim_end().ends_with('%') => {
            let share = number(Range::Positive, Dimension::NUMBER)?;
            Stated::Deviation(Deviation::Share(share))
        }
        (None, Content::Text(_) | Content::Number(_)) => {
            Stated::Deviation(Deviation::Absolute(number(Range::Positive, dimension)?))
        }
        (None, _) => {
            let message = format!("`{path}` is no spread of a number");
            return Err(Finding::new(entry.place.clone(), message).expected(
                "a standard deviation, as \"5 %\" of the value or with its unit, or an interval such as [0.3, 0.5]",
            ));
        }
    };
    Ok(Some(stated))
}

/// Whether a path is that of a number that belongs to the drive, its loads or its losses.
fn is_of_drive(path: &str) -> bool {
    match path.split_once('.') {
        Some((schema::CASE, rest)) => !rest.ends_with(".share"),
        Some(("requirements" | UNCERTAINTY, _)) => false,
        _ => true,
    }
}

/// The finding that there is no such number.
fn no_number(path: &str, entry: &Entry) -> Finding {
    let (table, name) = schema::split(path);
    let message = match schema::rule(path) {
        Some(_) => format!("`{path}` is not a number that varies"),
        None => format!(
            "unknown key `{name}` in [{UNCERTAINTY}{}{table}]",
            if table.is_empty() { "" } else { "." }
        ),
    };
    let finding = Finding::new(entry.key.clone(), message).did_you_mean(schema::nearest(path));
    match schema::names(table) {
        names if names.is_empty() => finding,
        names => finding.expected(check::one_of(&names)),
    }
}
