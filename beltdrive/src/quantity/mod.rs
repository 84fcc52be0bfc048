//! One description of every answer: quantities, grouped by what they belong to.
//!
//! An [`Answer`] says what there is to tell: each [`Quantity`] has a key, a label, a [`Measure`] with its
//! units, a value in SI units and an error. Tables, JSON and CSV are written from it, each once, in
//! [`crate::report`]; a new quantity is one line where the answer is described.

mod as_loop;
pub mod belt_loop;
pub mod branch;
pub mod calibration;
pub mod check;
pub mod design;
mod errors;
pub(crate) mod events;
pub mod limit_curve;
pub mod limits;
pub mod loop_range;
pub mod map;
mod measure;
pub mod modes;
mod parameter;
pub(crate) mod precision;
pub mod rating;
mod scalars;
mod scale;
pub mod section;
pub mod solved;
pub mod stability;
pub mod sweep;
pub mod tension;
pub mod transient;
pub mod two_pulleys;
pub mod uncertainty;
pub(crate) mod value;
pub mod verification;
mod warning;
pub(crate) mod words;

pub use measure::{Measure, UnitSystem};

use crate::Drive;
use std::borrow::Cow;

/// The title of a drive on one line, or what it is when it has no title.
pub fn title(drive: &Drive) -> String {
    words::heading(drive)
}

/// A whole answer, in the order in which it is shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answer {
    /// Lines above a table.
    pub heading: Vec<String>,
    /// What else has to be said, each on its own: below the heading, before the numbers.
    pub remarks: Vec<String>,
    /// The quantities.
    pub groups: Vec<Group>,
    /// Lines below a table.
    pub notes: Vec<String>,
}

/// Quantities of subjects of one kind, such as all pulleys.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Key in JSON. Without one, the quantities of a single subject and named subjects stand at the top, and
    /// all others only in tables and CSV.
    pub key: &'static str,
    /// How the subjects stand beside each other.
    pub layout: Layout,
    /// The subjects, each with the same quantities in the same order.
    pub subjects: Vec<Subject>,
}

/// How the subjects of a group stand beside each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// There is one: an object in JSON, and lines of a table.
    Single,
    /// An array in JSON, and columns of a table.
    Columns,
    /// As columns, and a row of CSV each.
    Beside,
    /// An array in JSON, and rows of a table. Of many rows a table leaves some out, but none with a head.
    Rows,
    /// An entry of an object in JSON each, under its head, and columns of a table.
    Named,
}

/// Something that has quantities: a pulley, a span, the whole loop.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Subject {
    /// Head of its column in a table, and its key where it is named.
    pub head: String,
    /// Its quantities.
    pub quantities: Vec<Quantity>,
}

/// A quantity of a subject.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// Key in JSON and CSV, without its unit; empty for one that only people read.
    pub key: Cow<'static, str>,
    /// What it is called in a table; empty for one that only programs read.
    pub label: Cow<'static, str>,
    /// What is measured.
    pub measure: Measure,
    /// Its value, SI.
    pub value: Value,
    /// Largest absolute error, SI: no table shows digits below it.
    pub error: f64,
    /// Most significant digits in a table. One or two are those of a power of ten.
    pub digits: u8,
}

/// Most digits of a number, of a located one, and of an error.
const USUAL: u8 = 6;
const LOCATED: u8 = 10;
const OF_ERROR: u8 = 2;

/// A value in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number, if there is one.
    Number(Option<f64>),
    /// A whole number.
    Count(usize),
    /// Components along x and y.
    Pair([f64; 2]),
    /// Numbers with names: an object in JSON, and a line or a column each elsewhere.
    Parts(Vec<(&'static str, f64)>),
    /// Values along the belt.
    Series(Vec<f64>),
    /// A word or a name, if there is one.
    Word(Option<String>),
    /// Subjects of its own.
    List(Vec<Subject>),
    /// A subject of its own, if there is one: an object in JSON, and a line or a column for each of its
    /// quantities elsewhere.
    Object(Option<Vec<Quantity>>),
    /// What only JSON holds, in the units that its key states.
    Json(serde_json::Value),
}

impl Group {
    /// One subject.
    pub(crate) fn single(key: &'static str, quantities: Vec<Quantity>) -> Self {
        let subject = Subject {
            head: String::new(),
            quantities,
        };
        Self::new(key, Layout::Single, vec![subject])
    }

    /// Subjects in a layout.
    pub(crate) fn new(key: &'static str, layout: Layout, subjects: Vec<Subject>) -> Self {
        Self {
            key,
            layout,
            subjects,
        }
    }
}

impl Answer {
    /// The subjects of the group of a key; none if there is no such group.
    #[must_use]
    pub fn subjects(&self, key: &str) -> &[Subject] {
        let mut groups = self.groups.iter();
        let group = groups.find(|group| group.key == key);
        group.map_or(&[], |group| &group.subjects)
    }
}

impl Subject {
    /// The quantity of a key.
    #[must_use]
    pub fn quantity(&self, key: &str) -> Option<&Quantity> {
        self.quantities.iter().find(|quantity| quantity.key == key)
    }

    /// The number of a key, SI.
    #[must_use]
    pub fn number(&self, key: &str) -> Option<f64> {
        match self.quantity(key)?.value {
            Value::Number(number) => number,
            _ => None,
        }
    }

    /// The pair of a key, SI.
    #[must_use]
    pub fn pair(&self, key: &str) -> Option<[f64; 2]> {
        match self.quantity(key)?.value {
            Value::Pair(pair) => Some(pair),
            _ => None,
        }
    }

    /// The word of a key.
    #[must_use]
    pub fn word(&self, key: &str) -> Option<&str> {
        match &self.quantity(key)?.value {
            Value::Word(word) => word.as_deref(),
            _ => None,
        }
    }

    /// The values of a key along the belt, SI; none if it has none.
    #[must_use]
    pub fn series(&self, key: &str) -> &[f64] {
        match self.quantity(key).map(|quantity| &quantity.value) {
            Some(Value::Series(values)) => values,
            _ => &[],
        }
    }

    /// The subjects of a key; none if it has none.
    #[must_use]
    pub fn list(&self, key: &str) -> &[Self] {
        match self.quantity(key).map(|quantity| &quantity.value) {
            Some(Value::List(subjects)) => subjects,
            _ => &[],
        }
    }

    /// A subject with a head.
    pub(crate) fn new(head: impl Into<String>, quantities: Vec<Quantity>) -> Self {
        Self {
            head: head.into(),
            quantities,
        }
    }
}

/// Quantities with the parts and objects among them taken apart: a part or a quantity of an object has its
/// name behind that of the whole, in keys and labels, and no label where the whole has none.
pub(crate) fn flat(quantities: &[Quantity]) -> Vec<Quantity> {
    let mut flat = Vec::new();
    for whole in quantities {
        let named = |label: String| match whole.label.is_empty() {
            true => Cow::Borrowed(""),
            false => label.into(),
        };
        match &whole.value {
            Value::Parts(parts) => flat.extend(parts.iter().map(|(part, value)| Quantity {
                key: format!("{part}_{}", whole.key).into(),
                label: named(format!("{part} {}", whole.label)),
                value: Value::Number(Some(*value)),
                ..whole.clone()
            })),
            Value::Object(inner) => {
                let inner = self::flat(inner.as_deref().unwrap_or_default());
                flat.extend(inner.into_iter().map(|quantity| Quantity {
                    key: match quantity.key.is_empty() {
                        true => quantity.key,
                        false => format!("{}_{}", whole.key, quantity.key).into(),
                    },
                    label: match quantity.label.is_empty() {
                        true => quantity.label,
                        false => named(format!("{}: {}", whole.label, quantity.label)),
                    },
                    ..quantity
                }));
            }
            _ => flat.push(whole.clone()),
        }
    }
    flat
}

impl Quantity {
    /// The number with its unit, to so many significant digits and none below its error; one without an error
    /// as it was given.
    pub(crate) fn shown(&self, digits: f64) -> Option<String> {
        let Value::Number(Some(value)) = self.value else {
            return None;
        };
        let unit = self.measure.shown(UnitSystem::Engineering);
        let value = value * unit.factor;
        let number = match self.error > 0.0 {
            true => precision::known(value, self.error * unit.factor.abs(), digits),
            false => precision::six_digits(value),
        };
        Some(match unit.symbol {
            "" => number,
            "°" => number + "°",
            symbol => format!("{number} {symbol}"),
        })
    }

    /// A number with an error.
    pub fn number(
        key: impl Into<Cow<'static, str>>,
        label: impl Into<Cow<'static, str>>,
        measure: Measure,
        value: impl Into<Option<f64>>,
        error: f64,
    ) -> Self {
        Self {
            key: key.into(),
            label: label.into(),
            measure,
            value: Value::Number(value.into()),
            error,
            digits: USUAL,
        }
    }

    /// What only programs read.
    pub fn data(key: &'static str, measure: Measure, value: Value) -> Self {
        Self {
            key: key.into(),
            label: "".into(),
            measure,
            value,
            error: 0.0,
            digits: USUAL,
        }
    }

    /// A word or a name.
    pub fn word(
        key: &'static str,
        label: impl Into<Cow<'static, str>>,
        word: impl Into<Option<String>>,
    ) -> Self {
        Self {
            label: label.into(),
            ..Self::data(key, Measure::Number, Value::Word(word.into()))
        }
    }

    /// A whole number.
    pub(crate) fn count(key: &'static str, label: &'static str, count: usize) -> Self {
        Self {
            label: label.into(),
            ..Self::data(key, Measure::Number, Value::Count(count))
        }
    }

    /// An estimated error.
    pub(crate) fn error(
        key: &'static str,
        label: impl Into<Cow<'static, str>>,
        measure: Measure,
        error: impl Into<Option<f64>>,
    ) -> Self {
        Self {
            digits: OF_ERROR,
            ..Self::number(key, label, measure, error, 0.0)
        }
    }

    /// What only JSON holds, in the units that its key states.
    pub(crate) fn json(key: &'static str, value: impl Into<serde_json::Value>) -> Self {
        Self::data(key, Measure::Number, Value::Json(value.into()))
    }

    /// The same, for people only and under another name.
    pub(crate) fn shown_as(self, label: impl Into<Cow<'static, str>>) -> Self {
        let label = label.into();
        let key = "".into();
        Self { key, label, ..self }
    }

    /// The same, for programs only.
    pub(crate) fn unlabelled(self) -> Self {
        let label = "".into();
        Self { label, ..self }
    }
}
