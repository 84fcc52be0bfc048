//! The checks of a single entry against its rule.

use super::{
    diagnostic::Finding,
    dimension::Dimension,
    document::{Content, Entry},
    friction,
    quantity::{self, Fault},
    schema::{self, QuantityRule, Rule},
    source::Source,
    spelling, unit,
};
use std::ops::Range;

/// Checks an entry without a rule: it must be a table of the schema.
pub(super) fn table(path: &str, entry: &Entry) -> Result<(), Finding> {
    if schema::is_table(path) {
        let expected = match schema::pair(path) {
            Some([one, other]) => {
                let example =
                    schema::rule(&schema::join(path, one)).map_or("", |rule| rule.example);
                format!("an array of {one} and {other}, e.g. [{example}, {example}]")
            }
            None => schema::header(path),
        };
        return match entry.content {
            Content::Table => Ok(()),
            _ if schema::pair(path).is_some() => {
                Err(wrong_type(path, "a pair", entry).expected(expected))
            }
            _ => Err(wrong_type(path, "a table", entry).expected(expected)),
        };
    }
    let (table, name) = schema::split(path);
    let what = match entry.content {
        Content::Table => "table",
        _ => "key",
    };
    let place = match table {
        "" => String::new(),
        _ => format!(" in {}", schema::header(table)),
    };
    let finding = Finding::new(entry.key.clone(), format!("unknown {what} `{name}`{place}"))
        .did_you_mean(schema::nearest(path));
    Err(match schema::names(table) {
        names if names.is_empty() => finding,
        names => finding.expected(one_of(&names)),
    })
}

/// Checks a text.
pub(super) fn text<'e>(path: &str, rule: &Rule, entry: &'e Entry) -> Result<&'e str, Finding> {
    match &entry.content {
        Content::Text(text) => Ok(text),
        _ => Err(wrong_type(path, "a text", entry).expected(rule.line())),
    }
}

/// Checks an array of keys. Whether the file has them is asked where they are used.
pub(super) fn keys(path: &str, rule: &Rule, entry: &Entry) -> Result<(), Finding> {
    match &entry.content {
        Content::List(keys)
            if !keys.is_empty() && { keys.iter() }
                .all(|key| matches!(key.content, Content::Text(_))) =>
        {
            Ok(())
        }
        _ => Err(wrong_type(path, "an array of keys", entry).expected(rule.line())),
    }
}

/// Checks points and gives them in SI units.
pub(super) fn points(
    path: &str,
    rule: &Rule,
    dimensions: [Dimension; 2],
    entry: &Entry,
    source: &Source,
) -> Result<Vec<[f64; 2]>, Finding> {
    let wrong = |entry: &Entry| {
        let (_, key) = schema::split(path);
        wrong_type(
            key,
            "an array of points, each a pair, or the name of a CSV file",
            entry,
        )
        .expected(rule.line())
    };
    let Content::List(pairs) = &entry.content else {
        return Err(wrong(entry));
    };
    let pairs = pairs.iter().map(|pair| {
        let Content::List(parts) = &pair.content else {
            return Err(wrong(pair));
        };
        let [place, value] = &parts[..] else {
            let message = format!("a point must have two numbers, got {}", parts.len());
            return Err(Finding::new(pair.place.clone(), message).expected(rule.line()));
        };
        let part = |dimension, entry: &Entry| {
            let any = schema::Range::Any;
            number(path, rule, dimension, any, entry, source)
                .map_err(|finding| finding.expected(rule.line()))
        };
        Ok([part(dimensions[0], place)?, part(dimensions[1], value)?])
    });
    pairs.collect()
}

/// Checks that a text is one of `words`.
pub(super) fn word<'e>(
    path: &str,
    rule: &Rule,
    what: &str,
    words: &[&str],
    entry: &'e Entry,
) -> Result<&'e str, Finding> {
    let text = text(path, rule, entry)?;
    if words.contains(&text) {
        return Ok(text);
    }
    let nearest = spelling::nearest(text, words.iter().map(|word| (word, word)));
    let finding = Finding::new(entry.place.clone(), format!("unknown {what} `{text}`"))
        .expected(one_of(words));
    Err(match friction::kind_of(text) {
        Some(kind) if path == friction::LAW => finding.help(kind),
        _ => finding.did_you_mean(nearest),
    })
}

/// Checks a text or a number as the quantity at a path of the schema.
pub(super) fn quantity(path: &str, entry: &Entry, source: &Source) -> Result<f64, Finding> {
    let QuantityRule {
        rule,
        dimension,
        range,
    } = schema::quantity_rule(path).expect("a key is a quantity of the schema");
    number(path, rule, dimension, range, entry, source)
}

/// Checks a quantity and its range, and gives it in SI units.
pub(super) fn number(
    path: &str,
    rule: &Rule,
    dimension: Dimension,
    range: schema::Range,
    entry: &Entry,
    source: &Source,
) -> Result<f64, Finding> {
    let expected = format!("{dimension}, e.g. {}", rule.example);
    let (value, unit) = match &entry.content {
        Content::Number(value) => (*value, None),
        Content::Text(text) => {
            let at = |part| within(text, part, entry, source);
            let quantity = quantity::parse(text).map_err(|(fault, part)| {
                misread(fault, &text[part.clone()], at(part)).expected(&expected)
            })?;
            (
                quantity.value,
                quantity.unit.map(|(found, part)| (found, at(part))),
            )
        }
        _ => return Err(wrong_type(path, "a quantity", entry).expected(expected)),
    };
    let is_bare = unit.is_none();
    if let Some((found, place)) = unit
        && found != dimension
    {
        let message = format!("wrong dimension: expected {dimension}, got {found}");
        let finding = Finding::new(place, message).expected(expected);
        return Err(match found.times(Dimension::ANGLE, 1) == dimension {
            true => finding.help("write what turns by: an angle in rad, deg or rev"),
            false if found.times(Dimension::ACCELERATION, 1) == dimension => {
                finding.help("a mass is no force: write lbf, kgf or N")
            }
            false => finding,
        });
    }
    let is_within = match range {
        schema::Range::Positive => value > 0.0,
        schema::Range::NotNegative => value >= 0.0,
        schema::Range::Any => true,
        schema::Range::Whole => (1.0..=1000.0).contains(&value) && value.fract() == 0.0,
        schema::Range::Below(limit, _) => value > 0.0 && value < limit,
        schema::Range::Share => value > 0.0 && value <= 1.0,
        schema::Range::AtLeastOne => value >= 1.0,
    };
    if is_within && value.is_finite() {
        return Ok(value);
    }
    let fault = match range {
        _ if !value.is_finite() => "is not a finite number".to_owned(),
        schema::Range::Positive | schema::Range::Any => "must be positive".to_owned(),
        schema::Range::Whole => "must be a whole number from 1 to 1000".to_owned(),
        schema::Range::NotNegative => "must not be negative".to_owned(),
        schema::Range::Below(_, limit) => format!("must lie between 0 and {limit}"),
        schema::Range::Share => "must be above 0 and at most 1".to_owned(),
        schema::Range::AtLeastOne => "must be at least 1".to_owned(),
    };
    if dimension == Dimension::ANGLE && is_bare && value.is_finite() && value > 0.0 {
        // A bare number beyond the range is meant in degrees.
        let message = format!("`{path}` has no unit: {value} rad {fault}");
        return Err(Finding::new(entry.place.clone(), message)
            .expected(expected)
            .did_you_mean(Some(format!("{value} deg"))));
    }
    let finding = Finding::new(entry.place.clone(), format!("`{path}` {fault}"));
    Err(finding.expected(expected))
}

/// The words of a list for a message.
pub(super) fn one_of(words: &[&str]) -> String {
    let several = if words.len() > 1 { "one of " } else { "" };
    format!("{several}`{}`", words.join("`, `"))
}

/// The finding for a value of another type than expected.
pub(super) fn wrong_type(path: &str, expected: &str, entry: &Entry) -> Finding {
    let found = entry.content.type_name();
    let place = match entry.content {
        Content::Table => &entry.key,
        _ => &entry.place,
    };
    Finding::new(
        place.clone(),
        format!("`{path}` must be {expected}, got {found}"),
    )
}

/// The finding for a text, or its part at fault, that is no quantity.
fn misread(fault: Fault, part: &str, range: Range<usize>) -> Finding {
    match fault {
        Fault::Number if part.is_empty() => Finding::new(range, "missing number"),
        Fault::Number => {
            let point = part.replace(',', ".");
            let point = point.parse::<f64>().is_ok().then_some(point);
            Finding::new(range, format!("malformed number `{part}`")).did_you_mean(point)
        }
        Fault::NotFinite => Finding::new(range, format!("`{part}` is not a finite number")),
        Fault::Unit => {
            Finding::new(range, format!("unknown unit `{part}`")).did_you_mean(unit::nearest(part))
        }
    }
}

/// Where a part of a text stands: within the entry's value, or the whole value where the text does
/// not stand there as it is read, because of escapes.
fn within(text: &str, part: Range<usize>, entry: &Entry, source: &Source) -> Range<usize> {
    let written = source.text(entry.place.clone());
    match written.find(text) {
        Some(start) if !part.is_empty() => {
            let start = entry.place.start + start;
            start + part.start..start + part.end
        }
        _ => entry.place.clone(),
    }
}
