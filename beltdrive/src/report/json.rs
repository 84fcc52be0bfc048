//! An answer as JSON: complete, at full precision, every key with its unit.

use crate::quantity::{Answer, Group, Layout, Quantity, Subject, Value};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// An answer as pretty-printed JSON. Angles are in degrees (`_deg`), everything else is in SI units; a
/// number that is not known is `null`.
pub fn json(answer: &Answer) -> String {
    serde_json::to_string_pretty(&Groups(&answer.groups)).expect("strings and numbers")
}

/// Groups as the entries of an object.
struct Groups<'a>(&'a [Group]);

impl Serialize for Groups<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for group in self.0 {
            let subjects = &group.subjects[..];
            match (group.key, group.layout) {
                ("", Layout::Single) => {
                    let quantities = subjects.iter().flat_map(|subject| &subject.quantities);
                    for quantity in quantities {
                        entry(&mut map, quantity)?;
                    }
                }
                ("", Layout::Named) => {
                    for subject in subjects {
                        map.serialize_entry(&subject.head, &Object(&subject.quantities))?;
                    }
                }
                ("", _) => {}
                (key, Layout::Single) => {
                    let subject = subjects.first();
                    let object = subject.map(|subject| Object(&subject.quantities));
                    map.serialize_entry(key, &object)?;
                }
                (key, Layout::Named) => map.serialize_entry(key, &Named(subjects))?,
                (key, _) => map.serialize_entry(key, &List(subjects))?,
            }
        }
        map.end()
    }
}

/// A quantity as an entry of an object, unless it is for people only.
fn entry<M: SerializeMap>(map: &mut M, quantity: &Quantity) -> Result<(), M::Error> {
    if quantity.key.is_empty() {
        return Ok(());
    }
    let (suffix, factor) = quantity.measure.stored();
    let key = format!("{}{suffix}", quantity.key);
    // Without a factor not even the sign of zero changes.
    let stored = |value: f64| if factor == 1.0 { value } else { value * factor };
    match &quantity.value {
        Value::Number(value) => map.serialize_entry(&key, &value.map(stored)),
        Value::Count(count) => map.serialize_entry(&key, count),
        Value::Pair(pair) => map.serialize_entry(&key, &pair.map(stored)),
        Value::Parts(parts) => {
            let parts = parts.iter().map(|&(part, value)| (part, stored(value)));
            map.serialize_entry(&key, &Parts(parts.collect()))
        }
        Value::Series(values) => {
            let values: Vec<_> = values.iter().map(|&value| stored(value)).collect();
            map.serialize_entry(&key, &values)
        }
        Value::Word(word) => map.serialize_entry(&key, word),
        Value::List(subjects) => map.serialize_entry(&key, &List(subjects)),
        Value::Object(object) => map.serialize_entry(&key, &object.as_deref().map(Object)),
        Value::Json(value) => map.serialize_entry(&key, value),
    }
}

struct Object<'a>(&'a [Quantity]);

impl Serialize for Object<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for quantity in self.0 {
            entry(&mut map, quantity)?;
        }
        map.end()
    }
}

struct Parts(Vec<(&'static str, f64)>);

impl Serialize for Parts {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().copied())
    }
}

struct Named<'a>(&'a [Subject]);

impl Serialize for Named<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let subjects = self.0.iter();
        serializer.collect_map(subjects.map(|subject| (&subject.head, Object(&subject.quantities))))
    }
}

struct List<'a>(&'a [Subject]);

impl Serialize for List<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let subjects = self.0.iter();
        serializer.collect_seq(subjects.map(|subject| Object(&subject.quantities)))
    }
}
