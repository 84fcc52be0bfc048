//! Overrides `KEY=VALUE` of entries of a drive file.

use super::{
    check,
    diagnostic::Finding,
    document::{Content, DesignEntry, Document, Entry, content_of},
    schema, spelling,
};
use std::ops::Range;

/// Applies the override `text`, which starts at byte `start` of the source.
///
/// It replaces the entry at its path and, where a quantity can be stated in two ways, the other
/// way too: `load.tight_tension=…` takes the place of a tight tractive tension. Without a value it
/// removes the entry: `load.tight_tension=`. What a design may do to a key is one entry, whose value is a TOML array:
/// `design.free.load.setup_tension=["300 N", "1 kN"]`.
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

    let is_entry = schema::rule(path).is_some_and(|rule| !rule.is_refused());
    if value.trim().is_empty() && is_entry {
        document.entries.remove(path);
        return Ok(());
    }

    let lists = [
        (schema::PULLEY, "pulley", &document.pulleys),
        (schema::CASE, "load case", &document.cases),
    ];
    for (list, what, names) in lists {
        let rest = path
            .strip_prefix(list)
            .and_then(|rest| rest.strip_prefix('.'));
        let Some(rest) = rest else {
            continue;
        };
        let (name, _) = rest.split_once('.').unwrap_or((rest, ""));
        if !names.iter().any(|known| known == name) {
            let start = path_start + list.len() + 1;
            return Err(unknown(
                list,
                what,
                names,
                (name, start..start + name.len()),
            ));
        }
    }
    let designed = [schema::FREE, schema::CHOOSE]
        .into_iter()
        .find_map(|table| {
            let key = path.strip_prefix(table)?.strip_prefix('.')?;
            Some((table, unquoted(key)))
        });
    // The tables on the way, unless the file has them.
    let parent = designed.map_or(schema::split(path).0, |(table, _)| table);
    let ends = path.match_indices('.').map(|(end, _)| end);
    for end in ends.take_while(|end| *end <= parent.len()) {
        let table = &path[..end];
        let key = path_start + end - schema::split(table).1.len()..path_start + end;
        let entry = Entry {
            place: key.clone(),
            key,
            content: Content::Table,
        };
        document.entries.entry(table.to_owned()).or_insert(entry);
    }

    let name = match parent {
        "" => path,
        _ => &path[parent.len() + 1..],
    };
    let path_end = path_start + path.len();
    let place = value_start + value.len() - value.trim_start().len();
    let mut entry = Entry {
        key: path_end - name.len()..path_end,
        place: place..place + value.trim().len(),
        content: Content::Text(unquoted(value.trim()).to_owned()),
    };
    let Some((table, path)) = designed else {
        document.replace(path, entry);
        return Ok(());
    };
    document.designed.retain(|known| known.path != path);
    if !value.trim().is_empty() {
        entry.content = content_of(value.trim(), place).unwrap_or(entry.content);
        document.designed.push(DesignEntry {
            table: table.to_owned(),
            path: path.to_owned(),
            entry,
        });
    }
    Ok(())
}

/// The finding that a list of the drive file has no table of a name, which stands at a place.
pub(super) fn unknown(
    list: &str,
    what: &str,
    names: &[String],
    (name, place): (&str, Range<usize>),
) -> Finding {
    let names: Vec<_> = names.iter().map(String::as_str).collect();
    let near = spelling::nearest(name, names.iter().map(|name| (name, name)));
    let finding = Finding::new(place, format!("there is no {what} `{name}`")).did_you_mean(near);
    match names.is_empty() {
        true => finding.help(format!("the drive file has no [[{list}]]")),
        false => finding.expected(check::one_of(&names)),
    }
}

/// Advice on how to do without the entry at `path`.
pub(super) fn removal(path: &str) -> String {
    format!("`--set {path}=`, without a value, leaves that entry out for one run")
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
    fn an_override_without_a_value_removes_an_entry() {
        let mut document = Document::from_toml("[load]\ntight_tension = 700").unwrap();
        for text in [
            "load.tight_tension = ",
            "load.slack_tension=",
            "belt.height=",
        ] {
            apply(&mut document, text, 100).unwrap();
        }
        assert_eq!(document.entries.keys().collect::<Vec<_>>(), ["load"]);
        // What is no entry stays, to be found fault with.
        apply(&mut document, "load.colour=", 100).unwrap();
        apply(&mut document, "load.driver_torque=", 100).unwrap();
        assert_eq!(document.entries.len(), 3);
    }

    #[test]
    fn quotes_come_in_pairs() {
        assert_eq!(unquoted("\"a\""), "a");
        assert_eq!(unquoted("'a\""), "'a\"");
        assert_eq!(unquoted("\""), "\"");
    }

    #[test]
    fn an_override_takes_the_place_of_what_a_design_may_do_to_a_key() {
        let text = "[design.free]\nload.setup_tension = [1, 2]\nlayout.centre_distance = [3, 4]";
        let mut document = Document::from_toml(text).unwrap();
        let value = "['300 N', 4]";
        let set = format!("design.choose.load.setup_tension = {value}");
        apply(&mut document, &set, 100).unwrap();
        apply(&mut document, "design.free.layout.centre_distance=", 200).unwrap();
        let [designed] = &document.designed[..] else {
            panic!("{:?}", document.designed)
        };
        assert_eq!(designed.table, schema::CHOOSE);
        assert_eq!(designed.path, "load.setup_tension");
        let start = 100 + set.find(value).unwrap();
        assert_eq!(designed.entry.place, start..start + value.len());
        let Content::List(values) = &designed.entry.content else {
            panic!("{designed:?}")
        };
        assert_eq!(values[0].content, Content::Text("300 N".to_owned()));
        assert_eq!(values[0].place, start + 1..start + 8);
        assert_eq!(values[1].content, Content::Number(4.0));
        let paths: Vec<_> = document.entries.keys().map(String::as_str).collect();
        assert_eq!(paths, ["design", "design.choose", "design.free"]);
    }
}
