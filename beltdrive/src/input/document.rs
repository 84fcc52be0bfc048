//! A drive file as a flat list of entries, each under its dotted path and with its place.

use super::{diagnostic::Finding, schema};
use std::{collections::BTreeMap, ops::Range};
use toml::de::{DeTable, DeValue};

/// The entries of a drive file, with overrides applied.
#[derive(Clone, Debug)]
pub(super) struct Document {
    /// Tables and values by dotted path.
    pub(super) entries: BTreeMap<String, Entry>,
    /// The names of the pulleys of a list, in belt order.
    pub(super) pulleys: Vec<String>,
    /// The names of the load cases, in order.
    pub(super) cases: Vec<String>,
    /// What a design may change, in order.
    pub(super) designed: Vec<DesignEntry>,
    /// Points in SI units by dotted path, from files that the entries name.
    pub(super) points: BTreeMap<String, Vec<[f64; 2]>>,
    /// Where the file ends: the place of what it lacks.
    pub(super) end: Range<usize>,
}

/// A table or a value of a document.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    /// Where its key stands.
    pub(super) key: Range<usize>,
    /// Where its value stands; for a table, where it begins.
    pub(super) place: Range<usize>,
    /// What stands there.
    pub(super) content: Content,
}

/// What a design may do to a key of the drive.
#[derive(Clone, Debug)]
pub(super) struct DesignEntry {
    /// The table of `[design]` in which it stands: [`schema::FREE`] or [`schema::CHOOSE`].
    pub(super) table: String,
    /// The dotted path of the key of the drive.
    pub(super) path: String,
    /// Bounds, or values to choose from.
    pub(super) entry: Entry,
}

/// What a drive file may hold under a key.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Content {
    /// A table; its entries have their own paths.
    Table,
    /// A string.
    Text(String),
    /// An integer or a float.
    Number(f64),
    /// An array, whose elements are their own keys.
    List(Vec<Entry>),
    /// Anything else, which is wrong everywhere: the name of its type.
    Other(&'static str),
}

impl Content {
    /// The type as messages call it, with its article.
    pub(super) fn type_name(&self) -> &'static str {
        match self {
            Self::Table => "a table",
            Self::Text(_) => "a text",
            Self::Number(_) => "a number",
            Self::List(_) => "an array",
            Self::Other(name) => name,
        }
    }

    /// Calls a function with the place of each key and value in it.
    fn visit_places(&mut self, visit: &mut dyn FnMut(&mut Range<usize>)) {
        if let Self::List(entries) = self {
            for entry in entries {
                visit(&mut entry.key);
                visit(&mut entry.place);
                entry.content.visit_places(visit);
            }
        }
    }
}

impl Document {
    /// Reads TOML.
    pub(super) fn from_toml(text: &str) -> Result<Self, Finding> {
        let root = DeTable::parse(text).map_err(|error| unreadable(text, &error))?;
        let length = text.trim_end().len();
        let mut document = Self {
            entries: BTreeMap::new(),
            pulleys: Vec::new(),
            cases: Vec::new(),
            designed: Vec::new(),
            points: BTreeMap::new(),
            end: length..length,
        };
        document.insert_table("", root.get_ref())?;
        document
            .designed
            .sort_by_key(|designed| designed.entry.key.start);
        Ok(document)
    }

    /// Inserts the entries of a table of the schema. Tables unknown to the schema stay closed: they
    /// are wrong as a whole.
    fn insert_table(&mut self, path: &str, table: &DeTable<'_>) -> Result<(), Finding> {
        for (key, value) in table {
            let child = schema::join(path, key.get_ref());
            let mut entry = Entry {
                key: key.span(),
                place: value.span(),
                content: content(value.get_ref()),
            };
            match value.get_ref() {
                _ if child == schema::PULLEY || child == schema::CASE => {
                    self.insert_list(&child, &entry, value.get_ref())?;
                    entry.content = Content::Table;
                }
                DeValue::Table(table) if schema::is_of_design(&child) => {
                    self.insert_designed(&child, "", table);
                }
                DeValue::Table(table) if schema::is_table(&child) => {
                    self.insert_table(&child, table)?;
                }
                DeValue::Array(array) if array.len() == 2 => {
                    if let Some(names) = schema::pair(&child) {
                        for (name, value) in names.iter().zip(array) {
                            let content = content(value.get_ref());
                            let (key, place) = (value.span(), value.span());
                            let element = Entry {
                                key,
                                place,
                                content,
                            };
                            self.entries.insert(schema::join(&child, name), element);
                        }
                        entry.content = Content::Table;
                    }
                }
                _ => {}
            }
            self.entries.insert(child, entry);
        }
        Ok(())
    }

    /// Inserts what a table of `[design]` says of keys of the drive. Their paths may be dotted keys or quoted ones.
    fn insert_designed(&mut self, list: &str, path: &str, table: &DeTable<'_>) {
        for (key, value) in table {
            let child = match path {
                "" => key.get_ref().to_string(),
                _ => format!("{path}.{}", key.get_ref()),
            };
            if let DeValue::Table(table) = value.get_ref() {
                self.insert_designed(list, &child, table);
                continue;
            }
            let entry = Entry {
                key: key.span(),
                place: value.span(),
                content: content(value.get_ref()),
            };
            self.designed.push(DesignEntry {
                table: list.to_owned(),
                path: child,
                entry,
            });
        }
    }

    /// Inserts the tables of a list, pulleys or load cases, each under its name, or its number if it has none.
    fn insert_list(
        &mut self,
        list: &str,
        entry: &Entry,
        value: &DeValue<'_>,
    ) -> Result<(), Finding> {
        let (what, order, key) = match list {
            schema::PULLEY => ("pulley", " in belt order", "pulley.NAME.torque"),
            _ => ("load case", "", "case.NAME.torque"),
        };
        let no_list = |place: Range<usize>| {
            let message = format!("`{list}` must be a list of tables, one for each {what}{order}");
            Finding::new(place, message).expected(format!("[[{list}]]"))
        };
        let DeValue::Array(tables) = value else {
            return Err(no_list(entry.key.clone()));
        };
        if tables.is_empty() {
            let message = format!("`{list}` is an empty list");
            return Err(Finding::new(entry.place.clone(), message)
                .expected(format!("[[{list}]] for each {what}")));
        }
        for (index, table) in tables.iter().enumerate() {
            let DeValue::Table(values) = table.get_ref() else {
                return Err(no_list(table.span()));
            };
            let named = values.iter().find(|(key, _)| key.get_ref() == "name");
            let (name, place) = match named.map(|(_, value)| (value.get_ref(), value.span())) {
                Some((DeValue::String(name), place)) => (name.trim().to_owned(), place),
                _ => ((index + 1).to_string(), table.span()),
            };
            if name.is_empty() || name.contains(['.', '=', '*', '"']) {
                let message = format!("`{name}` is no name for a {what}");
                return Err(Finding::new(place, message).expected(format!(
                    "letters, digits, blanks, hyphens: the name stands in keys such as {key}"
                )));
            }
            let names = self.names_mut(list);
            if names.contains(&name) {
                let message = format!("two {what}s have the name `{name}`");
                return Err(Finding::new(place, message)
                    .expected(format!("a name of its own for each {what}")));
            }
            names.push(name.clone());
            let path = schema::join(list, &name);
            self.insert_table(&path, values)?;
            let entry = Entry {
                key: table.span(),
                place: table.span(),
                content: Content::Table,
            };
            self.entries.insert(path, entry);
        }
        Ok(())
    }

    /// The names of a list, in order.
    fn names_mut(&mut self, list: &str) -> &mut Vec<String> {
        match list {
            schema::PULLEY => &mut self.pulleys,
            _ => &mut self.cases,
        }
    }

    /// Puts an entry in the place of the one at `path`, and of those that state the same in another way.
    pub(super) fn replace(&mut self, path: &str, entry: Entry) {
        for other in schema::alternatives(path) {
            self.entries.remove(&other);
        }
        self.entries.insert(path.to_owned(), entry);
    }
}

/// The content of a value that is TOML by itself and stands at byte `start`; `None` if it is no TOML.
pub(super) fn content_of(value: &str, start: usize) -> Option<Content> {
    const KEY: &str = "value=";
    let text = format!("{KEY}{value}");
    let table = DeTable::parse(&text).ok()?;
    let mut found = content(table.get_ref().get("value")?.get_ref());
    found.visit_places(&mut |place| {
        *place = place.start + start - KEY.len()..place.end + start - KEY.len();
    });
    (table.get_ref().len() == 1).then_some(found)
}

fn content(value: &DeValue<'_>) -> Content {
    match value {
        DeValue::Table(_) => Content::Table,
        DeValue::String(text) => Content::Text(text.clone().into_owned()),
        // What does not fit a number is too large for a quantity anyway.
        DeValue::Integer(integer) => Content::Number(
            i128::from_str_radix(integer.as_str(), integer.radix())
                .map_or(f64::INFINITY, |value| value as f64),
        ),
        DeValue::Float(float) => Content::Number(float.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(_) => Content::Other("a boolean"),
        DeValue::Datetime(_) => Content::Other("a date"),
        DeValue::Array(array) => {
            let element = |value: &toml::Spanned<DeValue<'_>>| Entry {
                key: value.span(),
                place: value.span(),
                content: content(value.get_ref()),
            };
            Content::List(array.iter().map(element).collect())
        }
    }
}

/// The finding for a text that is no TOML.
fn unreadable(text: &str, error: &toml::de::Error) -> Finding {
    let range = error.span().unwrap_or(text.len()..text.len());
    let quoted = text.get(..range.start).and_then(|before| {
        let line_start = before.rfind('\n').map_or(0, |feed| feed + 1);
        mend_value(text[line_start..].lines().next()?)
    });
    let (message, expected) = match error.message().split_once(", expected ") {
        Some((message, expected)) => (message, Some(expected)),
        None => (error.message(), None),
    };
    let finding = Finding::new(range, format!("unreadable TOML: {message}"));
    match expected {
        Some(expected) => finding.expected(expected),
        None => finding,
    }
    .did_you_mean(quoted)
}

/// The line `key = 120 kN` with its value in quotes, or `key = 0,4` with a point, where that is what it lacks.
fn mend_value(line: &str) -> Option<String> {
    let (key, value) = line.split_once('=')?;
    let value = value.split('#').next()?.trim();
    let is_bare = value.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '+' | '-' | '.'));
    let is_faulty = is_bare && !value.contains(['"', '\'']) && DeValue::parse(value).is_err();
    let key = key.trim();
    let point = value.replace(',', ".");
    is_faulty.then(|| match point.parse::<f64>() {
        Ok(_) => format!("{key} = {point}"),
        Err(_) => format!("{key} = \"{value}\""),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_that_lacks_quotes_or_a_point_is_mended() {
        assert_eq!(
            mend_value("length = 3 m"),
            Some("length = \"3 m\"".to_owned())
        );
        assert_eq!(mend_value("mu = 0,4 # dry"), Some("mu = 0.4".to_owned()));
        assert_eq!(mend_value("mu = 0.4"), None);
    }

    #[test]
    fn entries_are_flat_and_unknown_tables_closed() {
        let text = "title = 'a'\n[pulleys.driver]\nradius = 0x10\n[x]\ny = 1";
        let document = Document::from_toml(text).unwrap();
        let paths: Vec<_> = document.entries.keys().map(String::as_str).collect();
        assert_eq!(
            paths,
            [
                "pulleys",
                "pulleys.driver",
                "pulleys.driver.radius",
                "title",
                "x"
            ]
        );
        let radius = &document.entries["pulleys.driver.radius"];
        assert_eq!(radius.content, Content::Number(16.0));
        assert_eq!(&text[radius.key.clone()], "radius");
        assert_eq!(
            &text[document.entries["pulleys.driver"].key.clone()],
            "driver"
        );
    }
}
