//! What stands in words beside the numbers of an answer.

use super::precision::six_digits;
use super::{Measure, UnitSystem};
use crate::{BeltKind, Check, FrictionLaw, NormalForce};

/// A friction law in words, with its parameters and a coefficient that is the same for all pulleys; what
/// varies has no value.
pub(crate) fn law(law: FrictionLaw, coefficient: Option<f64>, varied: &[&str]) -> String {
    let part = |symbol: &str, path: &str, value: f64, measure: Measure| {
        if varied.contains(&path) {
            return format!(", {symbol} varied");
        }
        let unit = measure.shown(UnitSystem::Si).symbol;
        let space = if unit.is_empty() { "" } else { " " };
        format!(", {symbol} = {}{space}{unit}", six_digits(value))
    };
    let row = law.row();
    let coefficient =
        coefficient.map(|value| part("μ", "friction.coefficient", value, Measure::Number));
    let parameter = row.parameter.as_ref().zip(law.parameter());
    let parameter = parameter
        .map(|(parameter, value)| part(parameter.symbol, parameter.path, value, parameter.measure));
    format!(
        "{} friction{}{}",
        row.title,
        coefficient.unwrap_or_default(),
        parameter.unwrap_or_default()
    )
}

/// A verified invariant, and whether it holds.
pub(crate) fn check(check: &Check) -> String {
    let verdict = if check.holds() { "holds" } else { "VIOLATED" };
    format!(
        "check: {:<45} {:<9} deviation {:.1e}, limit {:.1e}",
        check.name, verdict, check.deviation, check.limit
    )
}

/// How the normal force of a flat belt follows from its tension; nothing for a V-belt.
pub(crate) fn convention(belt: BeltKind) -> Option<&'static str> {
    match belt {
        BeltKind::V(_) => None,
        BeltKind::Flat { normal_force } => Some(match normal_force {
            NormalForce::Thesis => "normal force n = T/R",
            NormalForce::Inertia => "normal force n = (T − G V)/R",
            NormalForce::Exact => "normal force n = (T − G V)/R, finite strain",
        }),
    }
}
