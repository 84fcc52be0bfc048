//! What there is to tell of a warning.

use super::precision::six_digits;
use super::{Group, Layout, Measure, Quantity, Subject, words};
use crate::{Role, Warning};
use std::fmt;

/// What a warning calls a pulley.
pub(super) trait Named {
    /// For programs.
    fn key(&self) -> &str;
    /// In a sentence.
    fn in_words(&self) -> String;
}

impl Named for Role {
    fn key(&self) -> &str {
        words::pulley(*self)
    }

    fn in_words(&self) -> String {
        format!("the {}", self.name())
    }
}

impl Named for String {
    fn key(&self) -> &str {
        self
    }

    fn in_words(&self) -> String {
        format!("pulley `{self}`")
    }
}

/// The group of the warnings of a state, for programs.
pub(super) fn group(warnings: &[Warning<impl Named>]) -> Group {
    let subjects = warnings.iter().map(subject).collect();
    Group::new("warnings", Layout::Columns, subjects)
}

/// What warnings tell the user, on one line each.
pub(super) fn messages(warnings: &[Warning<impl Named>]) -> Vec<String> {
    warnings.iter().map(message).collect()
}

/// The sentence of the table.
impl fmt::Display for Warning<Role> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&message(self))
    }
}

/// The sentence of the table.
impl fmt::Display for Warning<String> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&message(self))
    }
}

/// What a warning tells the user, on one line.
fn message(warning: &Warning<impl Named>) -> String {
    match warning {
        Warning::Overhang {
            pulley,
            inclination,
        } => format!(
            "the belt overhangs itself on {}: inclination {:.2}° exceeds 90°, not a usable design",
            pulley.in_words(),
            inclination.to_degrees()
        ),
        Warning::LargeStrain { strain } => format!(
            "the belt is stretched by {:.2} %, too much for small strains: choose \
             normal_force=\"exact\"",
            100.0 * strain
        ),
        Warning::LargeStretch { strain } => format!(
            "the belt is stretched by {} %, more than the model stands for: check the tensions and \
             axial_stiffness",
            six_digits(100.0 * strain)
        ),
        Warning::Sunk {
            pulley,
            penetration,
            height,
        } => format!(
            "the belt sinks into the groove of {} by {:.2} mm, more than its height of {} mm: not a \
             usable design",
            pulley.in_words(),
            1e3 * penetration,
            six_digits(1e3 * height)
        ),
    }
}

/// A remark on the validity of a state, for programs.
pub(super) fn subject(remark: &Warning<impl Named>) -> Subject {
    let number = |key, measure, value| Quantity::number(key, "", measure, value, 0.0);
    let mut quantities = match remark {
        Warning::Overhang {
            pulley,
            inclination,
        } => vec![
            Quantity::word("kind", "", "overhang".to_owned()),
            Quantity::word("pulley", "", pulley.key().to_owned()),
            number("inclination", Measure::Angle, *inclination),
        ],
        Warning::LargeStrain { strain } | Warning::LargeStretch { strain } => vec![
            Quantity::word("kind", "", "large strain".to_owned()),
            number("strain", Measure::Number, *strain),
        ],
        Warning::Sunk {
            pulley,
            penetration,
            height,
        } => vec![
            Quantity::word("kind", "", "belt height".to_owned()),
            Quantity::word("pulley", "", pulley.key().to_owned()),
            number("penetration", Measure::Length, *penetration),
            number("height", Measure::Length, *height),
        ],
    };
    quantities.push(Quantity::word("message", "", message(remark)));
    Subject::new("", quantities)
}
