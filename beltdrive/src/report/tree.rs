//! An answer as named values: what JSON says, and what other programming languages hold.

use crate::quantity::{Answer, Group, Layout, Quantity, Subject, Value};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// A part of an answer, in the units that the keys state: angles in degrees (`_deg`), everything else in SI units.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Node {
    /// A number, if it is known.
    Number(Option<f64>),
    /// A whole number.
    Count(usize),
    /// Numbers: those along the belt, or the components along x and y.
    Numbers(Vec<f64>),
    /// A word or a name, if there is one.
    Word(Option<String>),
    /// Values by their keys, in the order in which they are told.
    Object(Vec<(String, Self)>),
    /// Objects without keys.
    List(Vec<Self>),
    /// Something that there is not.
    Nothing,
    /// What only JSON holds.
    Json(serde_json::Value),
}

/// An answer by its keys, complete and at full precision.
#[must_use]
pub fn tree(answer: &Answer) -> Node {
    Node::Object(answer.groups.iter().flat_map(entries).collect())
}

/// The entries of a group.
fn entries(group: &Group) -> Vec<(String, Node)> {
    let subjects = &group.subjects[..];
    let list = || subjects.iter().map(of_subject);
    match (group.key, group.layout) {
        ("", Layout::Single) => { subjects.iter() }
            .flat_map(|subject| named(&subject.quantities))
            .collect(),
        ("", Layout::Named) => by_head(subjects),
        ("", _) => Vec::new(),
        (key, Layout::Single) => {
            let object = list().next().unwrap_or(Node::Nothing);
            vec![(key.to_owned(), object)]
        }
        (key, Layout::Named) => vec![(key.to_owned(), Node::Object(by_head(subjects)))],
        (key, _) => vec![(key.to_owned(), Node::List(list().collect()))],
    }
}

fn by_head(subjects: &[Subject]) -> Vec<(String, Node)> {
    let subjects = subjects.iter();
    subjects
        .map(|subject| (subject.head.clone(), of_subject(subject)))
        .collect()
}

fn of_subject(subject: &Subject) -> Node {
    Node::Object(named(&subject.quantities))
}

/// The quantities with a key: the others are for people only.
fn named(quantities: &[Quantity]) -> Vec<(String, Node)> {
    let quantities = quantities.iter();
    quantities
        .filter(|quantity| !quantity.key.is_empty())
        .map(named_value)
        .collect()
}

fn named_value(quantity: &Quantity) -> (String, Node) {
    let (suffix, factor) = quantity.measure.stored();
    // Without a factor not even the sign of zero changes.
    let stored = |value: f64| if factor == 1.0 { value } else { value * factor };
    let node = match &quantity.value {
        Value::Number(value) => Node::Number(value.map(stored)),
        Value::Count(count) => Node::Count(*count),
        Value::Pair(pair) => Node::Numbers(pair.map(stored).to_vec()),
        Value::Parts(parts) => {
            let parts = parts.iter();
            let part =
                |&(part, value): &(&str, f64)| (part.to_owned(), Node::Number(Some(stored(value))));
            Node::Object(parts.map(part).collect())
        }
        Value::Series(values) => Node::Numbers(values.iter().map(|&value| stored(value)).collect()),
        Value::Word(word) => Node::Word(word.clone()),
        Value::List(subjects) => Node::List(subjects.iter().map(of_subject).collect()),
        Value::Object(Some(object)) => Node::Object(named(object)),
        Value::Object(None) => Node::Nothing,
        Value::Json(value) => Node::Json(value.clone()),
    };
    (format!("{}{suffix}", quantity.key), node)
}

/// As JSON: a number that is not known is `null`.
impl Serialize for Node {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(number) => number.serialize(serializer),
            Self::Count(count) => count.serialize(serializer),
            Self::Numbers(numbers) => numbers.serialize(serializer),
            Self::Word(word) => word.serialize(serializer),
            Self::Object(entries) => {
                let mut map = serializer.serialize_map(Some(entries.len()))?;
                for (key, value) in entries {
                    map.serialize_entry(key, value)?;
                }
                map.end()
            }
            Self::List(objects) => objects.serialize(serializer),
            Self::Nothing => serializer.serialize_none(),
            Self::Json(value) => value.serialize(serializer),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::Measure;
    use serde_json::json;

    #[test]
    fn groups_stand_under_their_keys_and_in_the_units_of_these() {
        let angle = Quantity::number("turn", "turn", Measure::Angle, 0.5_f64.to_radians(), 0.0);
        let unknown = Quantity::number("loss", "loss", Measure::Power, None, 0.0);
        let hidden = Quantity::number("", "only people", Measure::Power, 1.0, 0.0);
        let along = Value::Series(vec![1.0, f64::NAN]);
        let along = Quantity::data("tension", Measure::Force, along);
        let groups = vec![
            Group::single("", vec![angle, unknown, hidden]),
            Group::new(
                "pulleys",
                Layout::Columns,
                vec![Subject::new("a", vec![along])],
            ),
            Group::new("", Layout::Named, vec![Subject::new("driver", vec![])]),
            Group::new("", Layout::Rows, vec![Subject::new("none", vec![])]),
            Group::new("empty", Layout::Single, vec![]),
        ];
        let node = tree(&Answer {
            groups,
            ..Answer::default()
        });
        let expected = json!({
            "turn_deg": 0.5, "loss_W": null, "pulleys": [{ "tension_N": [1.0, null] }],
            "driver": {}, "empty": null,
        });
        assert_eq!(serde_json::to_value(&node).unwrap(), expected);
    }
}
