//! An answer as JSON: complete, at full precision, every key with its unit.

use crate::quantity::{Answer, Group, Layout, Quantity, Subject, Value};
use crate::report::json::pretty;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// An answer as pretty-printed JSON. Angles are in degrees (`_deg`), everything else is in SI units; a
/// number that is not known is `null`. The quantities of a group without a key stand at the top.
pub fn json(answer: &Answer) -> String {
    pretty(&Groups(&answer.groups))
}

/// Groups as the entries of an object.
pub(in crate::report) struct Groups<'a>(pub(in crate::report) &'a [Group]);

impl Serialize for Groups<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for group in self.0 {
            match (group.key, group.layout, &group.subjects[..]) {
                ("", Layout::Single, subjects) => {
                    let quantities = subjects.iter().flat_map(|subject| &subject.quantities);
                    for quantity in quantities {
                        entry(&mut map, quantity)?;
                    }
                }

                (key, Layout::Single, subjects) => {
                    map.serialize_entry(key, &subjects.first().map(Object))?;
                }
                (_, Layout::Named, subjects) => {
                    for subject in subjects {
                        map.serialize_entry(&subject.head, &Object(subject))?;
                    }
                }
                (key, _, subjects) => map.serialize_entry(key, &List(subjects))?,
            }
        }
        map.end()
    }
}

/// A quantity as an entry of an object.
fn entry<M: SerializeMap>(map: &mut M, quantity: &Quantity) -> Result<(), M::Error> {
    let (suffix, factor) = quantity.measure.stored();
    let key = format!("{}{suffix}", quantity.key);
    // Without a factor not even the sign of zero changes.
    let stored = |value: f64| if factor == 1.0 { value } else { value * factor };
    match &quantity.value {
        Value::Number(value) => map.serialize_entry(&key, &value.map(stored)),
        Value::Pair(pair) => map.serialize_entry(&key, &pair.map(stored)),
        Value::Series(values) => {
            let values: Vec<_> = values.iter().map(|&value| stored(value)).collect();
            map.serialize_entry(&key, &values)
        }
        Value::Word(word) => map.serialize_entry(&key, word),
        Value::Indices(pairs) => map.serialize_entry(&key, pairs),
        Value::List(subjects) => map.serialize_entry(&key, &List(subjects)),
    }
}

struct Object<'a>(&'a Subject);

impl Serialize for Object<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.quantities.len()))?;
        for quantity in &self.0.quantities {
            entry(&mut map, quantity)?;
        }
        map.end()
    }
}

struct List<'a>(&'a [Subject]);

impl Serialize for List<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(Object))
    }
}
