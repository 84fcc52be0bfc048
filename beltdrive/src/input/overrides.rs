//! Overrides `KEY=VALUE` of entries of a drive file.

use super::{
    diagnostic::Finding,
    document::{Content, Document, Entry},
    schema,
};

/// Applies the override `text`, which starts at byte `start` of the source.
///
/// It replaces the entry at its path and, where a quantity can be stated in two ways, the other
/// way too: `load.tight_tension=…` takes the place of a tight tractive tension.
pub(super) fn apply(document: &mut Document, text: &str, start: usize) -> Result<(), Finding> {
    let whole = start..start + text.len();
    let malformed = |message: &str| {
        Finding::new(whole.clone(), message)
            .expected("KEY=VALUE with the dotted path of an entry, e.g. friction.law=coulomb")
    };
    let (path, value) = text
        .split_once('=')
        .ok_or_else(|| malformed(&format!("the override `{text}` has no value")))?;
    let value_start = start + path.len() + 1;
    let path_start = start + path.len() - path.trim_start().len();
    let path = path.trim();
    if path
        .split('.')
        .any(|name| name.trim() != name || name.is_empty())
    {
        return Err(malformed(&format!("malformed key `{path}`")));
    }

    // The tables on the way, unless the file has them.
    for (end, _) in path.match_indices('.') {
        let table = &path[..end];
        let key = path_start + end - schema::split(table).1.len()..path_start + end;
        let entry = Entry {
            place: key.clone(),
            key,
            content: Content::Table,
        };
        document.entries.entry(table.to_owned()).or_insert(entry);
    }

    if let Some(other) = schema::alternative(path) {
        document.entries.remove(other);
    }
    let (_, name) = schema::split(path);
    let path_end = path_start + path.len();
    let place = value_start + value.len() - value.trim_start().len();
    let entry = Entry {
        key: path_end - name.len()..path_end,
        place: place..place + value.trim().len(),
        content: Content::Text(unquoted(value.trim()).to_owned()),
    };
    document.entries.insert(path.to_owned(), entry);
    Ok(())
}

/// The text within a pair of quotes, or the text itself.
fn unquoted(value: &str) -> &str {
    ['"', '\'']
        .iter()
        .find_map(|quote| value.strip_prefix(*quote)?.strip_suffix(*quote))
        .unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_override_replaces_both_ways_to_state_a_quantity() {
        let mut document = Document::from_toml("[load]\ntight_tractive_tension = 700").unwrap();
        apply(&mut document, "load.tight_tension = '710 N'", 100).unwrap();
        let paths: Vec<_> = document.entries.keys().map(String::as_str).collect();
        assert_eq!(paths, ["load", "load.tight_tension"]);
        let entry = &document.entries["load.tight_tension"];
        assert_eq!(entry.content, Content::Text("710 N".to_owned()));
        assert_eq!(
            (entry.key.clone(), entry.place.clone()),
            (105..118, 121..128)
        );
    }

    #[test]
    fn quotes_come_in_pairs() {
        assert_eq!(unquoted("\"a\""), "a");
        assert_eq!(unquoted("'a\""), "'a\"");
        assert_eq!(unquoted("\""), "\"");
    }
}
