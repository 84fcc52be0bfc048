//! A drive file with other values, and its text with them in place.

use super::{
    Diagnostic, DriveFile,
    diagnostic::Finding,
    document::{Content, Document, Entry},
    quantity, schema, section, unit,
};
use std::collections::BTreeMap;

/// Significant digits of a written number: what rounding to them changes is far below the accuracy of any answer.
const DIGITS: usize = 12;

impl DriveFile {
    /// The file with other contents under keys that it has, and with what follows from them by its belt section. An
    /// entry that the section gave and that has another content now keeps it, and all else stays as the section says.
    pub(super) fn restated(&self, contents: impl IntoIterator<Item = (String, Content)>) -> Self {
        let mut file = self.clone();
        let entries = &mut file.document.entries;
        let (mut given, mut replaced) = (BTreeMap::new(), BTreeMap::new());
        if let Some(filled) = file.filled_in.take() {
            let paths = filled.entries.into_iter().map(|entry| entry.path);
            for path in paths.chain(filled.replaced.keys().cloned()) {
                given.extend(entries.remove(&path).map(|entry| (path, entry)));
            }
            replaced = filled.replaced;
        }
        for (path, content) in contents {
            if let Some(entry) = entries.get_mut(&path) {
                entry.content = content;
            } else if let Some(entry) = given.remove(&path) {
                replaced.insert(path, Entry { content, ..entry });
            }
        }
        file.filled_in = section::fill(&mut file.document, &file.source);
        if let Some(filled) = &mut file.filled_in {
            filled
                .entries
                .retain(|entry| !replaced.contains_key(&entry.path));
            file.document.entries.extend(replaced.clone());
            filled.replaced = replaced;
        }
        file
    }

    /// The text of the file with the contents of this one in their places: comments, order and units stay.
    ///
    /// # Errors
    /// An override gives an entry that the text has no place for.
    pub fn rewritten(&self) -> Result<String, Diagnostic> {
        let text = self.source.file();
        let written =
            Document::from_toml(text).map_err(|finding| Diagnostic::new(finding, &self.source))?;
        let mut edits = Vec::new();
        for (path, entry) in &self.document.entries {
            let is_filled = self.filled_in.as_ref().is_some_and(|filled| {
                let mut entries = filled.entries.iter();
                entries.any(|entry| entry.path == *path)
            });
            if is_filled || entry.content == Content::Table {
                continue;
            }
            let (_, name) = schema::split(path);
            match written.entries.get(path) {
                Some(old) if old.content == entry.content => {}
                Some(old) => edits.push((old.place.clone(), value(entry, Some(old)))),
                None => {
                    // What stood for the same in another way makes room.
                    let others = schema::alternatives(path);
                    let other = others.iter().find_map(|other| written.entries.get(other));
                    let Some(old) = other else {
                        let message = format!("the drive file has no place for `{path}`");
                        let finding = Finding::new(entry.key.clone(), message)
                            .expected("an entry of the drive file itself, without which it cannot be written back");
                        return Err(Diagnostic::new(finding, &self.source));
                    };
                    let line = format!("{name} = {}", value(entry, None));
                    edits.push((old.key.start..old.place.end, line));
                }
            }
        }
        let is_kept = |path: &str| {
            let entries = &self.document.entries;
            entries.contains_key(path)
                || schema::alternatives(path)
                    .iter()
                    .any(|other| entries.contains_key(other))
        };
        for (path, old) in &written.entries {
            if !is_kept(path) {
                let range = old.key.start..old.place.end;
                edits.push((range.clone(), format!("# {}", &text[range])));
            }
        }
        edits.sort_by_key(|(range, _)| range.start);
        let mut text = text.to_owned();
        for (range, new) in edits.into_iter().rev() {
            text.replace_range(range, &new);
        }
        Ok(text)
    }
}

/// The value of an entry as TOML; a number in the unit of the one in whose place it comes.
fn value(entry: &Entry, old: Option<&Entry>) -> String {
    match &entry.content {
        Content::Text(text) => quoted(text),
        Content::Number(number) => {
            let symbol = old.and_then(|old| match &old.content {
                Content::Text(text) => {
                    let (_, range) = quantity::parse(text).ok()?.unit?;
                    Some(&text[range])
                }
                _ => None,
            });
            let unit = symbol.and_then(|symbol| Some((symbol, unit::parse(symbol).ok()?.scale)));
            match unit {
                Some((symbol, scale)) => quoted(&format!("{} {symbol}", digits(number / scale))),
                None => digits(*number),
            }
        }
        _ => String::new(),
    }
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// A number with the digits that are written.
fn digits(number: f64) -> String {
    let rounded: f64 = format!("{number:.*e}", DIGITS - 1)
        .parse()
        .unwrap_or(number);
    // A whole number stays one: `ribs = 6`.
    match rounded.fract() == 0.0 && rounded.abs() < 1e15 {
        true => format!("{rounded:.0}"),
        false => format!("{rounded:?}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::examples;

    #[test]
    fn values_come_in_their_places_with_their_units() {
        let text = examples::find("spb-fan").unwrap().text;
        let read = |text: &str, overrides: &[&str]| {
            let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
            DriveFile::read("f.toml", text, &overrides).unwrap()
        };
        let file = read(text, &[]);
        assert_eq!(file.rewritten().unwrap(), text);
        let contents = [
            (
                "pulleys.driver.diameter".to_owned(),
                Content::Number(0.1505),
            ),
            ("belt.section".to_owned(), Content::Text("SPA".to_owned())),
        ];
        let other = file.restated(contents);
        let expected = text
            .replace("\"140 mm\"", "\"150.5 mm\"")
            .replace("section = \"SPB\"", "section = \"SPA\"");
        assert_eq!(other.rewritten().unwrap(), expected);
        assert_eq!(
            read(&expected, &[]).drive().unwrap(),
            other.drive().unwrap()
        );
        // Overrides are written, too: a value, another way to state it, and one that is left out.
        let set = read(
            text,
            &["load.power=3 kW", "load.belt_length=1.9 m", "belt.ribs="],
        );
        let expected = text
            .replace("\"7.5 kW\"", "\"3 kW\"")
            .replace("setup_tension = \"700 N\"", "belt_length = \"1.9 m\"");
        assert_eq!(set.rewritten().unwrap(), expected);
        let without = read(text, &["load.setup_tension="]);
        assert!(
            without
                .rewritten()
                .unwrap()
                .contains("\n# setup_tension = \"700 N\"")
        );
        let more = read(text, &["belt.ribs=2"]).rewritten().unwrap_err();
        assert!(
            more.to_string().contains("no place for `belt.ribs`"),
            "{more}"
        );
    }
}
