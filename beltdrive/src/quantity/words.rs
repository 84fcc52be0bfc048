//! What stands in words beside the numbers of an answer.

use super::precision::six_digits;
use super::{Measure, UnitSystem};
use crate::input::Key;
use crate::{BeltKind, Check, Drive, FrictionLaw, NormalForce, Role, Zone, ZoneKind};

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

/// The title of a drive on one line, or what it is when it has no title.
pub(crate) fn heading(drive: &Drive) -> String {
    let words = drive
        .title
        .iter()
        .flat_map(|title| title.split_whitespace());
    let words: Vec<_> = words.collect();
    match (words.is_empty(), drive.belt.kind) {
        (false, _) => words.join(" "),
        (true, BeltKind::V(_)) => "Two-pulley V-belt drive".to_owned(),
        (true, BeltKind::Flat { .. }) => "Two-pulley flat-belt drive".to_owned(),
    }
}

/// The heading of a drive, then its friction law and, for a flat belt, how the normal force follows from the
/// tension; what varies has no value.
pub(crate) fn title(drive: &Drive, varied: &[Key]) -> Vec<String> {
    let convention = convention(drive.belt.kind);
    let convention = convention.map_or_else(String::new, |words| format!(", {words}"));
    vec![heading(drive), law_of(drive, varied) + &convention]
}

/// The friction law of a drive in words, with its parameters; what varies has no value.
pub(crate) fn law_of(drive: &Drive, varied: &[Key]) -> String {
    let paths: Vec<_> = varied.iter().map(Key::path).collect();
    law(drive.law, Some(drive.pair().friction_coefficient), &paths)
}

/// What the speed loss of a belt is called, and for V-belts the note that tells why.
pub(crate) fn speed_loss(belt: BeltKind) -> (&'static str, Option<String>) {
    match belt {
        BeltKind::Flat { .. } => ("speed loss", None),
        BeltKind::V(_) => {
            let note = "speed loss against the speeds of the pitch circles: a V-belt that sinks more deeply \
                        into one groove than into another has one without load";
            ("speed loss, pitch circles", Some(note.to_owned()))
        }
    }
}

/// The word for a pulley in columns, JSON and CSV.
pub(crate) fn pulley(pulley: Role) -> &'static str {
    match pulley {
        Role::Driven => "driven",
        Role::Driver => "driver",
    }
}

/// The sum of the slip zones of a pulley, rad; where the belt overhangs, the angle from the entry falls.
pub(crate) fn slip_arc(zones: &[Zone]) -> f64 {
    let slip = zones.iter().filter(|zone| zone.kind == ZoneKind::Slip);
    // A sum of nothing is a negative zero.
    0.0 + slip.map(|zone| (zone.to - zone.from).abs()).sum::<f64>()
}

/// What the effect of ℓ/R or ε on the numbers of a state is called.
pub(super) fn effect_of_smoothing(smoothing: f64) -> String {
    format!("effect of smoothing {smoothing:.1e}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::samples::{flat, v_belt};

    #[test]
    fn a_slip_zone_where_the_belt_overhangs_is_an_arc() {
        let zone = |kind, from, to| Zone { kind, from, to };
        let elastic = zone(ZoneKind::Elastic, 0.0, 3.5);
        let arc = slip_arc(&[elastic, zone(ZoneKind::Slip, 3.5, 3.25)]);
        assert_eq!(arc, 0.25);
    }

    #[test]
    fn heading_is_one_line() {
        let mut drive = v_belt::loaded().drive;
        drive.title = Some("two\n lines ".to_owned());
        assert_eq!(heading(&drive), "two lines");
        drive.title = Some("  ".to_owned());
        assert_eq!(heading(&drive), "Two-pulley V-belt drive");
    }

    #[test]
    fn the_title_states_the_convention_of_a_flat_belt() {
        assert_eq!(title(&v_belt::loaded().drive, &[]).len(), 2);
        let mut drive = flat::epp().drive;
        drive.title = None;
        let lines = title(&drive, &[]);
        assert_eq!(lines[0], "Two-pulley flat-belt drive");
        let law = "elastic/perfectly-plastic friction, μ = 0.6, k_f = 5e7 N/m²";
        assert_eq!(lines[1], format!("{law}, normal force n = (T − G V)/R"));
        let normal_force = NormalForce::Exact;
        drive.belt.kind = BeltKind::Flat { normal_force };
        let lines = title(&drive, &[]);
        assert_eq!(
            lines[1],
            format!("{law}, normal force n = (T − G V)/R, finite strain")
        );
        drive.law = FrictionLaw::Coulomb;
        assert!(title(&drive, &[])[1].ends_with("finite strain"));
    }

    #[test]
    fn laws_state_their_parameters() {
        let mut drive = v_belt::loaded().drive;
        drive.law = FrictionLaw::Coulomb;
        assert_eq!(law_of(&drive, &[]), "Coulomb friction, μ = 0.4");
        drive.law = FrictionLaw::Bristle { stiffness: 1620.0 };
        assert_eq!(
            law_of(&drive, &[]),
            "bristle friction, μ = 0.4, κ = 1620 1/m"
        );
        drive.law = FrictionLaw::Epp { stiffness: 8.1e6 };
        assert!(law_of(&drive, &[]).ends_with("k_f = 8.1e6 N/m²"));
        let mut keys = Key::all(&drive);
        let coefficient = keys.find(|key| key.path() == "friction.coefficient");
        let text = law_of(&drive, &[coefficient.unwrap()]);
        assert!(text.contains("μ varied, k_f = 8.1e6 N/m²"), "{text}");
    }

    #[test]
    fn only_slip_zones_count() {
        let zone = |kind, from, to| Zone { kind, from, to };
        let zones = [
            zone(ZoneKind::Slip, 0.0, 0.5),
            zone(ZoneKind::Elastic, 0.5, 2.0),
            zone(ZoneKind::Slip, 2.0, 3.0),
        ];
        assert_eq!(slip_arc(&zones), 1.5);
        assert_eq!(slip_arc(&zones[1..2]).to_string(), "0");
    }

    #[test]
    fn every_convention_is_told_from_the_others() {
        let mut drive = flat::epp().drive;
        let mut words = NormalForce::ALL.map(|normal_force| {
            drive.belt.kind = BeltKind::Flat { normal_force };
            convention(drive.belt.kind).unwrap()
        });
        words.sort_unstable();
        assert!(words.windows(2).all(|pair| pair[0] != pair[1]), "{words:?}");
        assert_eq!(convention(v_belt::loaded().drive.belt.kind), None);
    }
}
