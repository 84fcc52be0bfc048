//! What stands in words beside the numbers of an answer.

use super::precision::six_digits;
use crate::{BeltKind, Check, FrictionLaw, NormalForce};

/// A friction law in words, with its parameters and a coefficient that is the same for all pulleys; what
/// varies has no value.
pub(crate) fn law(law: FrictionLaw, coefficient: Option<f64>, varied: &[&str]) -> String {
    let value = |symbol: &str, path: &str, value: f64, unit: &str| {
        if varied.contains(&path) {
            format!(", {symbol} varied")
        } else {
            format!(", {symbol} = {}{unit}", six_digits(value))
        }
    };
    let (name, parameter) = match law {
        FrictionLaw::Coulomb => ("Coulomb", String::new()),
        FrictionLaw::Epp { stiffness } => (
            "elastic/perfectly-plastic",
            value("k_f", "friction.stiffness", stiffness, " N/m²"),
        ),
        FrictionLaw::Bristle { stiffness } => (
            "bristle",
            value("κ", "friction.bristle_stiffness", stiffness, " 1/m"),
        ),
        FrictionLaw::CreepRate { velocity } => (
            "creep-rate",
            value("v_s", "friction.velocity", velocity, " m/s"),
        ),
    };
    let coefficient = coefficient.map(|number| value("μ", "friction.coefficient", number, ""));
    format!(
        "{name} friction{}{parameter}",
        coefficient.unwrap_or_default()
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
