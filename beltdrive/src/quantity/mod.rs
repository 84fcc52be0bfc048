//! One description of every answer: quantities, grouped by what they belong to.
//!
//! An [`Answer`] says what there is to tell: each [`Quantity`] has a key, a label, a [`Measure`] with its
//! units, a value in SI units and an error. Tables, JSON and CSV are written from it, each once, in
//! [`crate::report`]; a new quantity is one line where the answer is described.

pub mod belt_loop;
mod measure;
pub(crate) mod precision;
pub(crate) mod words;

pub use measure::{Measure, UnitSystem};

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
    /// Whether there may be several subjects, which are then an array in JSON and columns of a table.
    pub is_list: bool,
    /// The subjects, each with the same quantities in the same order.
    pub subjects: Vec<Subject>,
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
    pub key: &'static str,
    /// What it is called in a table; empty for one that only programs read.
    pub label: &'static str,
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

impl Quantity {
    /// A number with an error.
    pub fn number(
        key: &'static str,
        label: &'static str,
        measure: Measure,
        value: impl Into<Option<f64>>,
        error: f64,
    ) -> Self {
        Self {
            key,
            label,
            measure,
            value: Value::Number(value.into()),
            error,
        }
    }

    /// What only programs read.
    pub fn data(key: &'static str, measure: Measure, value: Value) -> Self {
        Self {
            key,
            label: "",
            measure,
            value,
            error: 0.0,
        }
    }

    /// A word or a name.
    pub fn word(key: &'static str, label: &'static str, word: Option<String>) -> Self {
        Self {
            key,
            label,
            measure: Measure::Number,
            value: Value::Word(word),
            error: 0.0,
        }
    }
}
