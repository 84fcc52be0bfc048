//! One description of every answer: quantities, grouped by what they belong to.
//!
//! An [`Answer`] says what there is to tell: each [`Quantity`] has a key, a label, a [`Measure`] with its
//! units, a value in SI units and an error. Tables, JSON and CSV are written from it, each once, in
//! [`crate::report`]; a new quantity is one line where the answer is described.

pub mod belt_loop;
pub mod loop_range;
mod measure;
pub(crate) mod precision;
pub mod two_pulleys;
pub(crate) mod words;

pub use measure::{Measure, UnitSystem};

use std::borrow::Cow;

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
    /// Key in JSON.
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
    /// An array in JSON, and rows of a table.
    Rows,
    /// Each an entry of its own in JSON, under its head, and columns of a table.
    Named,
}

/// Something that has quantities: a pulley, a span, the whole loop.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Subject {
    /// Head of its column in a table.
    pub head: String,
    /// Its quantities.
    pub quantities: Vec<Quantity>,
}

/// A quantity of a subject.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// Key in JSON and CSV, without its unit.
    pub key: Cow<'static, str>,
    /// What it is called in a table; empty for one that only programs read.
    pub label: Cow<'static, str>,
    /// What is measured.
    pub measure: Measure,
    /// Its value, SI.
    pub value: Value,
    /// Largest absolute error, SI: no table shows digits below it.
    pub error: f64,
}

/// A value in SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number, if there is one.
    Number(Option<f64>),
    /// Components along x and y, or both ends of something.
    Pair([f64; 2]),
    /// Values along the belt.
    Series(Vec<f64>),
    /// A word or a name, if there is one.
    Word(Option<String>),
    /// Pairs of subjects of another group, by their places in it.
    Indices(Vec<[usize; 2]>),
    /// Subjects of its own.
    List(Vec<Subject>),
}

impl Answer {
    /// The quantities of other keys than these, for a table that has shown these already.
    #[must_use]
    pub fn without(groups: &[Group], keys: &[&str]) -> Self {
        let mut groups = groups.to_vec();
        for subject in groups.iter_mut().flat_map(|group| &mut group.subjects) {
            subject
                .quantities
                .retain(|quantity| !keys.contains(&&*quantity.key));
        }
        Self {
            groups,
            ..Self::default()
        }
    }
}

impl Quantity {
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
        }
    }

    /// A word or a name.
    pub fn word(key: &'static str, label: &'static str, word: Option<String>) -> Self {
        Self {
            key: key.into(),
            label: label.into(),
            measure: Measure::Number,
            value: Value::Word(word),
            error: 0.0,
        }
    }
}
