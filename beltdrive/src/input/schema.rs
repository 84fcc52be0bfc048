//! What a drive file may hold: every entry with its kind and an example.

mod rules;

use super::{dimension::Dimension, spelling};
use rules::RULES;

/// One entry of a drive file.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    /// Its dotted path; `*` stands for the name of a pulley.
    pub(super) path: &'static str,
    /// A right value as TOML.
    pub(super) example: &'static str,
    /// What it holds.
    pub(super) kind: Kind,
}

/// What an entry holds.
#[derive(Clone, Debug)]
pub(super) enum Kind {
    /// Any text.
    Text,
    /// One word of a list.
    Word {
        /// What the words name.
        what: &'static str,
        /// The words.
        words: &'static [&'static str],
    },
    /// A number of a dimension.
    Quantity {
        /// Its dimension.
        dimension: Dimension,
        /// Its range.
        range: Range,
    },
    /// Points: an array of pairs of a place and a value.
    Points {
        /// The dimensions of both.
        dimensions: [Dimension; 2],
    },
    /// Dotted paths of numbers of the file.
    Keys,
    /// How far the number at the rest of the path may be from its value.
    Spread,
    /// Nothing: the entry may not be given.
    Refused {
        /// Why.
        reason: &'static str,
        /// The path of the entry that was probably meant.
        instead: Option<&'static str>,
    },
}

/// The range of a quantity.
#[derive(Clone, Copy, Debug)]
pub(super) enum Range {
    /// Positive.
    Positive,
    /// Positive or zero.
    NotNegative,
    /// Any finite number.
    Any,
    /// A whole number from 1 to 1000.
    Whole,
    /// Positive and below a number, in SI units and in words.
    Below(f64, &'static str),
    /// Positive and at most 1.
    Share,
    /// 1 or more.
    AtLeastOne,
}

/// The tension of the slack span of a drive, stated in one of two ways.
pub(super) const SLACK: [&str; 2] = ["load.slack_tractive_tension", "load.slack_tension"];
/// As [`SLACK`], for the tight span.
pub(super) const TIGHT: [&str; 2] = ["load.tight_tractive_tension", "load.tight_tension"];
/// What the driven pulley takes, stated in one of these ways.
pub(super) const EFFORT: [&str; 3] = [TORQUE, "load.torque", "load.power"];
/// How tight the belt is, other than by the tension of the slack or the tight span.
pub(super) const CLOSURE: [&str; 4] = [
    "load.setup_tension",
    "load.belt_length",
    "load.span_tension",
    "load.span_tractive_tension",
];

/// Entries of which a drive file has at most one, because they state the same.
const ALTERNATIVES: [&[&str]; 12] = [
    &SLACK,
    &TIGHT,
    &EFFORT,
    &CLOSURE,
    &["pulleys.driver.radius", "pulleys.driver.diameter"],
    &["pulleys.driven.radius", "pulleys.driven.diameter"],
    &["pulley.*.radius", "pulley.*.diameter"],
    &["pulley.*.torque", "pulley.*.power"],
    &["case.*.torque", "case.*.power"],
    &["case.*.pulley.*.torque", "case.*.pulley.*.power"],
    &["tensioner.arm.free_angle", "tensioner.arm.preload"],
    &["tensioner.slide.free_position", "tensioner.slide.preload"],
];

/// The torque of the driven pulley, in place of the tension of a span.
pub(super) const TORQUE: &str = "load.driven_torque";
/// The numbers that a calibration finds.
pub(super) const CALIBRATED: &str = "calibration.free";
/// The list of pulleys.
pub(super) const PULLEY: &str = "pulley";
/// The list of load cases.
pub(super) const CASE: &str = "case";
/// The table that has, under the paths of numbers of the file, how far they may be from their values.
pub(super) const UNCERTAINTY: &str = "uncertainty";
/// The ends of an interval there.
pub(super) const ENDS: [&str; 2] = ["from", "to"];
/// What a design makes small.
pub(super) const MINIMISE: &str = "design.minimise";
/// The table of the numbers that a design may change within bounds.
pub(super) const FREE: &str = "design.free";
/// The table of the keys that a design may give one of several values.
pub(super) const CHOOSE: &str = "design.choose";
/// Tables of the service of a drive, which do not change its steady states.
const SERVICE: [&str; 6] = [
    CASE,
    "requirements",
    "losses",
    UNCERTAINTY,
    "design",
    "transient",
];
/// How the normal force follows from the tension of a flat belt.
pub(super) const NORMAL_FORCE: &str = "model.normal_force";

/// The entries of both span tensions.
pub(super) const TENSIONS: [&str; 4] = [SLACK[0], SLACK[1], TIGHT[0], TIGHT[1]];

impl Rule {
    /// The entry as a line of its table.
    pub(super) fn line(&self) -> String {
        format!("{} = {}", split(self.path).1, self.example)
    }

    /// Whether the entry is a whole number.
    pub(super) fn is_whole(&self) -> bool {
        matches!(
            self.kind,
            Kind::Quantity {
                range: Range::Whole,
                ..
            }
        )
    }

    /// Whether the entry may not be given.
    pub(super) fn is_refused(&self) -> bool {
        matches!(self.kind, Kind::Refused { .. })
    }

    /// The path to propose for this entry: its own, unless another one is meant.
    fn meant(&self) -> &'static str {
        match self.kind {
            Kind::Refused { instead, .. } => instead.unwrap_or(self.path),
            _ => self.path,
        }
    }
}

/// The rule for the entry at `path`.
pub(super) fn rule(path: &str) -> Option<&'static Rule> {
    let is_spread = uncertain(path).is_some();
    let is_of = |rule: &&Rule| match is_spread {
        true => matches!(rule.kind, Kind::Spread),
        false => matches(rule.path, path),
    };
    RULES.iter().find(is_of)
}

/// The path of what is uncertain by the entry, or the tables, at `path`.
pub(super) fn uncertain(path: &str) -> Option<&str> {
    path.strip_prefix(UNCERTAINTY)?.strip_prefix('.')
}

/// Whether a path is one of a pattern, in which `*` stands for any name.
fn matches(pattern: &str, path: &str) -> bool {
    // Names are parted for patterns alone: a drive file that is read for every state of a search spends most of its
    // time here.
    if !pattern.contains('*') {
        return pattern == path;
    }
    let mut names = path.split('.');
    let mut wanted = pattern.split('.');
    wanted.all(|wanted| {
        names
            .next()
            .is_some_and(|name| wanted == "*" || wanted == name)
    }) && names.next().is_none()
}

/// The rule of a quantity with what it says.
pub(super) struct QuantityRule {
    /// The rule.
    pub(super) rule: &'static Rule,
    /// The dimension of the quantity.
    pub(super) dimension: Dimension,
    /// Its range.
    pub(super) range: Range,
}

/// The rule for the quantity at `path`, if it is one.
pub(super) fn quantity_rule(path: &str) -> Option<QuantityRule> {
    let rule = rule(path)?;
    match rule.kind {
        Kind::Quantity { dimension, range } => Some(QuantityRule {
            rule,
            dimension,
            range,
        }),
        _ => None,
    }
}

/// The other ways to state what the entry at `path` states.
pub(super) fn alternatives(path: &str) -> Vec<String> {
    let is_of = |patterns: &&&[&str]| patterns.iter().any(|pattern| matches(pattern, path));
    let patterns = ALTERNATIVES.iter().find(is_of).copied().unwrap_or_default();
    let others = patterns.iter().filter(|pattern| !matches(pattern, path));
    let filled = |pattern: &&str| {
        let names = pattern.split('.').zip(path.split('.'));
        let names = names.map(|(wanted, name)| if wanted == "*" { name } else { wanted });
        names.collect::<Vec<_>>().join(".")
    };
    others.map(filled).collect()
}

/// Whether the entry at `path` is one of the service of a drive, which does not change its steady states.
pub(super) fn is_of_service(path: &str) -> bool {
    let (table, _) = path.split_once('.').unwrap_or((path, ""));
    SERVICE.contains(&table)
}

/// Whether `path` is a table of `[design]` that holds keys of the drive.
pub(super) fn is_of_design(path: &str) -> bool {
    [FREE, CHOOSE].contains(&path)
}

/// Whether `path` is a table; the empty path is the top level.
pub(super) fn is_table(path: &str) -> bool {
    let is_of = |path: &str| tables().any(|table| matches(table, path));
    path.is_empty()
        || is_of(path)
        || uncertain(path).is_some_and(|path| is_of(path) || quantity_rule(path).is_some())
}

/// The names in a table that may also be written as an array, in its order: a place or a pair of stops.
pub(super) fn pair(table: &str) -> Option<[&'static str; 2]> {
    if uncertain(table).is_some_and(|path| quantity_rule(path).is_some()) {
        return Some(ENDS);
    }
    match names(table)[..] {
        [one @ ("x" | "low"), other] => Some([one, other]),
        _ => None,
    }
}

/// A table as its header in a drive file names it.
pub(super) fn header(table: &str) -> String {
    let of_list = |list: &str| {
        let rest = table.strip_prefix(list)?.strip_prefix('.')?;
        Some(match rest.split_once('.') {
            None => format!("[[{list}]] `{rest}`"),
            Some((name, rest)) => format!("`{rest}` of [[{list}]] `{name}`"),
        })
    };
    let named = [PULLEY, CASE].into_iter().find_map(of_list);
    named.unwrap_or_else(|| format!("[{table}]"))
}

/// The names that may stand in a table, in order: keys and tables.
pub(super) fn names(table: &str) -> Vec<&'static str> {
    let table = match table {
        UNCERTAINTY => "",
        _ => uncertain(table).unwrap_or(table),
    };
    let keys = RULES
        .iter()
        .filter(|rule| !rule.is_refused())
        .map(|rule| rule.path);
    let mut names: Vec<_> = keys
        .chain(tables())
        .map(split)
        .filter(|(parent, _)| matches(parent, table))
        .map(|(_, name)| name)
        .collect();
    names.dedup();
    names
}

/// What engineers call entries, and the last name of what is meant.
const SYNONYMS: [(&str, &str); 10] = [
    ("mu", "coefficient"),
    ("μ", "coefficient"),
    ("ea", "axial_stiffness"),
    ("beta", "half_angle"),
    ("groove_angle", "half_angle"),
    ("rpm", "speed"),
    ("count", "ribs"),
    ("profile", "section"),
    ("axis_distance", "centre_distance"),
    ("center_distance", "centre_distance"),
];

/// The right spelling nearest to an unknown path: what is meant by a synonym, or a name of the same table or, if that has none, the
/// path of a like-named entry of another table.
pub(super) fn nearest(path: &str) -> Option<&'static str> {
    let (table, name) = split(path);
    let rules = || RULES.iter().filter(|rule| !rule.path.contains('*'));
    // What a load case may have is not found elsewhere.
    let is_elsewhere = !path.starts_with("case.");
    let elsewhere = || {
        let rules = rules().filter(|_| is_elsewhere);
        rules.map(|rule| (split(rule.path).1, rule.meant()))
    };
    let is_called = |(synonym, _): &&(&str, &str)| synonym.eq_ignore_ascii_case(name);
    if let Some((_, meant)) = SYNONYMS.iter().find(is_called) {
        let near = names(table).into_iter().find(|name| name == meant);
        let far = || {
            elsewhere()
                .find(|(name, _)| name == meant)
                .map(|(_, path)| path)
        };
        return near.or_else(far);
    }
    spelling::nearest(name, names(table).into_iter().map(|name| (name, name)))
        .or_else(|| spelling::nearest(name, elsewhere()))
        .or_else(|| {
            let near = spelling::nearest_path(path, rules().map(|rule| rule.path));
            near.and_then(rule).map(Rule::meant)
        })
}

/// The path of the entry `name` of a table. A name that is no bare TOML key keeps its quotes, so
/// that its points do not part tables; that of a pulley or of a load case has none, nor has a path as a name of
/// [`UNCERTAINTY`].
pub(super) fn join(table: &str, name: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    let is_named = [PULLEY, CASE, "case.*.pulley", "transient.pulley"].iter();
    let of = uncertain(table).unwrap_or(table);
    let is_named = { is_named }.any(|list| matches(list, of)) || table == UNCERTAINTY;
    let name = match is_named || name.chars().all(is_bare) && !name.is_empty() {
        true => name.to_owned(),
        false => format!("{name:?}"),
    };
    match table {
        "" => name,
        _ => format!("{table}.{name}"),
    }
}

/// The table and the name of a path.
pub(super) fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('.').unwrap_or(("", path))
}

/// The tables of all depths, each at least once.
fn tables() -> impl Iterator<Item = &'static str> {
    let of_rules = RULES.iter().flat_map(|rule| {
        let ends = rule.path.match_indices('.').map(|(end, _)| end);
        ends.map(|end| &rule.path[..end])
    });
    of_rules.chain([FREE, CHOOSE])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_documents_name_every_entry() {
        let documents = [
            include_str!("../../../docs/commands.md"),
            include_str!("../../../docs/loops.md"),
        ]
        .concat();
        for rule in RULES.iter().filter(|rule| !rule.is_refused()) {
            // Of lists and vectors the tables of the documents have the names alone.
            let (table, name) = split(rule.path);
            let of_part = ["x", "y", "low", "high"].contains(&name);
            let name = if of_part { split(table).1 } else { name };
            let is_part = rule.path.contains('*') || rule.path.starts_with("tensioner.");
            let is_named = documents.contains(&format!("`{}`", rule.path))
                || is_part && documents.contains(&format!("`{name}`"));
            assert!(is_named, "{} is not named", rule.path);
        }
    }

    #[test]
    fn tables_and_names_follow_from_the_rules() {
        assert!(is_table("pulleys") && is_table("pulleys.driver") && is_table(""));
        assert!(!is_table("belt.type") && !is_table("puls"));
        assert_eq!(names("pulleys"), ["driver", "driven"]);
        assert_eq!(
            names("pulleys.driven"),
            ["radius", "diameter", "half_angle"]
        );
        assert_eq!(names("pulley.fan.centre"), ["x", "y"]);
        assert!(
            is_table("pulley.fan") && is_table("pulley.A/C 2") && !is_table("pulley.fan.torque")
        );
        assert_eq!(
            rule("pulley.fan.torque").map(|rule| rule.path),
            Some("pulley.*.torque")
        );
        assert_eq!(alternatives("pulley.fan.torque"), ["pulley.fan.power"]);
        assert_eq!(
            alternatives("case.full load.pulley.fan.power"),
            ["case.full load.pulley.fan.torque"]
        );
        assert_eq!(alternatives(TIGHT[0]), [TIGHT[1]]);
        assert!(alternatives("belt.type").is_empty());
        let top = [
            "title",
            "belt",
            "groove",
            "friction",
            "pulleys",
            "pulley",
            "tensioner",
            "layout",
            "load",
            "model",
            "calibration",
            "case",
            "requirements",
            "losses",
            "uncertainty",
            "design",
            "transient",
        ];
        assert_eq!(names(""), top);
    }

    #[test]
    fn entries_are_found_in_other_tables() {
        assert_eq!(nearest("friction.lwa"), Some("law"));
        assert_eq!(nearest("belt.half_angel"), Some("groove.half_angle"));
        assert_eq!(nearest("frction"), Some("friction"));
        assert_eq!(nearest("belt.colour"), None);
        assert_eq!(nearest("friction.mu"), Some("coefficient"));
        assert_eq!(nearest("mu"), Some("friction.coefficient"));
        assert_eq!(nearest("load.torqe"), Some("torque"));
        assert_eq!(nearest("normal_force"), Some(NORMAL_FORCE));
        assert_eq!(nearest("case.idle.pulley.fan.diameter"), None);
        assert_eq!(nearest("case.idle.pulley.fan.torqe"), Some("torque"));
    }
}
