//! What a drive file may hold: every entry with its kind and an example.

use super::{dimension::Dimension, spelling};
use std::f64::consts::FRAC_PI_2;

/// One entry of a drive file.
#[derive(Debug)]
pub(super) struct Rule {
    /// Its dotted path.
    pub(super) path: &'static str,
    /// A right value as TOML.
    pub(super) example: &'static str,
    /// What it holds.
    pub(super) kind: Kind,
}

/// What an entry holds.
#[derive(Debug)]
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
    /// Positive and below a number, in SI units and in words.
    Below(f64, &'static str),
}

const fn quantity(path: &'static str, example: &'static str, dimension: Dimension) -> Rule {
    Rule {
        path,
        example,
        kind: Kind::Quantity {
            dimension,
            range: Range::Positive,
        },
    }
}

const fn word(
    path: &'static str,
    example: &'static str,
    what: &'static str,
    words: &'static [&'static str],
) -> Rule {
    Rule {
        path,
        example,
        kind: Kind::Word { what, words },
    }
}

const fn refused(
    path: &'static str,
    example: &'static str,
    reason: &'static str,
    instead: Option<&'static str>,
) -> Rule {
    Rule {
        path,
        example,
        kind: Kind::Refused { reason, instead },
    }
}

const LATER: &str = "is not supported yet: give one slack and one tight tension";

/// The friction laws.
pub(super) const LAWS: [&str; 4] = ["coulomb", "epp", "bristle", "creep-rate"];

/// Every entry, in the order in which messages list them.
const RULES: [Rule; 27] = [
    Rule {
        path: "title",
        example: "\"Test drive\"",
        kind: Kind::Text,
    },
    word("belt.type", "\"v\"", "belt type", &["v", "flat"]),
    quantity(
        "belt.mass_per_length",
        "\"0.108 kg/m\"",
        Dimension::MASS_PER_LENGTH,
    ),
    quantity("belt.axial_stiffness", "\"120 kN\"", Dimension::FORCE),
    quantity(
        "belt.radial_stiffness",
        "\"900 kN/m^2\"",
        Dimension::FORCE_PER_AREA,
    ),
    quantity("belt.height", "\"8 mm\"", Dimension::LENGTH),
    Rule {
        path: "groove.half_angle",
        example: "\"18 deg\"",
        kind: Kind::Quantity {
            dimension: Dimension::ANGLE,
            range: Range::Below(FRAC_PI_2, "90 deg"),
        },
    },
    word("friction.law", "\"coulomb\"", "friction law", &LAWS),
    quantity("friction.coefficient", "0.4", Dimension::NUMBER),
    quantity(
        "friction.stiffness",
        "\"8.1e6 N/m^2\"",
        Dimension::FORCE_PER_AREA,
    ),
    quantity(
        "friction.bristle_stiffness",
        "\"1620 1/m\"",
        Dimension::INVERSE_LENGTH,
    ),
    quantity("friction.velocity", "\"0.05 m/s\"", Dimension::VELOCITY),
    quantity("pulleys.driver.radius", "\"0.25 m\"", Dimension::LENGTH),
    quantity(
        "pulleys.driver.speed",
        "\"1000 rpm\"",
        Dimension::ANGULAR_SPEED,
    ),
    quantity("pulleys.driven.radius", "\"0.25 m\"", Dimension::LENGTH),
    refused(
        "pulleys.driven.speed",
        "\"1000 rpm\"",
        "may not be given: the speed of the driven pulley follows from the load",
        None,
    ),
    quantity("layout.centre_distance", "\"1.4 m\"", Dimension::LENGTH),
    quantity("load.slack_tractive_tension", "\"100 N\"", Dimension::FORCE),
    quantity("load.slack_tension", "\"110 N\"", Dimension::FORCE),
    quantity("load.tight_tractive_tension", "\"700 N\"", Dimension::FORCE),
    quantity("load.tight_tension", "\"710 N\"", Dimension::FORCE),
    Rule {
        path: TORQUE,
        example: "\"45 N*m\"",
        kind: Kind::Quantity {
            dimension: Dimension::TORQUE,
            range: Range::NotNegative,
        },
    },
    refused(
        "load.torque",
        "\"45 N*m\"",
        "does not say of which pulley it is",
        Some(TORQUE),
    ),
    refused(
        "load.driver_torque",
        "\"45 N*m\"",
        "may not be given: the load is the torque of the driven pulley",
        Some(TORQUE),
    ),
    refused("load.setup_tension", "\"400 N\"", LATER, None),
    refused("load.belt_length", "\"4.36 m\"", LATER, None),
    word(
        NORMAL_FORCE,
        "\"inertia\"",
        "normal force",
        &["inertia", "thesis", "exact"],
    ),
];

/// The entries that state one quantity in two ways: of each pair a drive file has at most one.
pub(super) const SLACK: [&str; 2] = ["load.slack_tractive_tension", "load.slack_tension"];
/// As [`SLACK`], for the tight span.
pub(super) const TIGHT: [&str; 2] = ["load.tight_tractive_tension", "load.tight_tension"];

/// The torque of the driven pulley, in place of the tension of a span.
pub(super) const TORQUE: &str = "load.driven_torque";
/// How the normal force follows from the tension of a flat belt.
pub(super) const NORMAL_FORCE: &str = "model.normal_force";

/// The entries of both span tensions.
pub(super) const TENSIONS: [&str; 4] = [SLACK[0], SLACK[1], TIGHT[0], TIGHT[1]];

impl Rule {
    /// The entry as a line of its table.
    pub(super) fn line(&self) -> String {
        format!("{} = {}", split(self.path).1, self.example)
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
    RULES.iter().find(|rule| rule.path == path)
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

/// The other way to state the quantity at `path`.
pub(super) fn alternative(path: &str) -> Option<&'static str> {
    [SLACK, TIGHT]
        .into_iter()
        .find_map(|[one, other]| match path {
            _ if path == one => Some(other),
            _ if path == other => Some(one),
            _ => None,
        })
}

/// Whether `path` is a table; the empty path is the top level.
pub(super) fn is_table(path: &str) -> bool {
    path.is_empty() || tables().any(|table| table == path)
}

/// The names that may stand in a table, in order: keys and tables.
pub(super) fn names(table: &str) -> Vec<&'static str> {
    let keys = RULES
        .iter()
        .filter(|rule| !rule.is_refused())
        .map(|rule| rule.path);
    let mut names: Vec<_> = keys
        .chain(tables())
        .map(split)
        .filter(|(parent, _)| *parent == table)
        .map(|(_, name)| name)
        .collect();
    names.dedup();
    names
}

/// The right spelling nearest to an unknown path: a name of the same table or, if that has none, the
/// path of a like-named entry of another table.
pub(super) fn nearest(path: &str) -> Option<&'static str> {
    let (table, name) = split(path);
    let elsewhere = || RULES.iter().map(|rule| (split(rule.path).1, rule.meant()));
    spelling::nearest(name, names(table).into_iter().map(|name| (name, name)))
        .or_else(|| spelling::nearest(name, elsewhere()))
        .or_else(|| {
            let near = spelling::nearest_path(path, RULES.iter().map(|rule| rule.path));
            near.and_then(rule).map(Rule::meant)
        })
}

/// The path of the entry `name` of a table. A name that is no bare TOML key keeps its quotes, so
/// that its points do not part tables.
pub(super) fn join(table: &str, name: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    let name = match name.chars().all(is_bare) && !name.is_empty() {
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
    RULES.iter().flat_map(|rule| {
        let ends = rule.path.match_indices('.').map(|(end, _)| end);
        ends.map(|end| &rule.path[..end])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_and_names_follow_from_the_rules() {
        assert!(is_table("pulleys") && is_table("pulleys.driver") && is_table(""));
        assert!(!is_table("belt.type") && !is_table("puls"));
        assert_eq!(names("pulleys"), ["driver", "driven"]);
        assert_eq!(names("pulleys.driven"), ["radius"]);
        let top = [
            "title", "belt", "groove", "friction", "pulleys", "layout", "load", "model",
        ];
        assert_eq!(names(""), top);
    }

    #[test]
    fn entries_are_found_in_other_tables() {
        assert_eq!(nearest("friction.lwa"), Some("law"));
        assert_eq!(nearest("belt.half_angel"), Some("groove.half_angle"));
        assert_eq!(nearest("frction"), Some("friction"));
        assert_eq!(nearest("belt.colour"), None);
        assert_eq!(nearest("pulleys.driver.diameter"), None);
        assert_eq!(nearest("friction.mu"), None);
        assert_eq!(nearest("torqe"), Some(TORQUE));
        assert_eq!(nearest("normal_force"), Some(NORMAL_FORCE));
    }
}
