//! What the belt loop is whose state is told.

use super::super::precision::six_digits;
use super::super::{Quantity, words};
use crate::{BeltKind, Closure, Drive, NormalForce};

/// The title, and what the loop is.
pub(crate) fn heading(drive: &Drive) -> Vec<String> {
    let count = drive.pulleys.len();
    let belt = match (drive.belt.kind, drive.belt.ribs) {
        (BeltKind::V(_), 1) => "V-belt".to_owned(),
        (BeltKind::V(_), ribs) => format!("V-belt with {ribs} ribs"),
        (BeltKind::Flat { .. }, 1) => "Flat belt".to_owned(),
        (BeltKind::Flat { .. }, ribs) => format!("Flat belt with {ribs} ribs"),
    };
    let law = words::law(drive.law, coefficient(drive), &[]);
    let force = |tension: f64| format!("{} N", six_digits(tension));
    let behind = |span: usize| &drive.pulleys[span].name;
    let closed = match drive.closure {
        Closure::UnstretchedLength(length) => {
            format!("unstretched length {} m", six_digits(length))
        }
        Closure::SetupTension(tension) => format!("setup tension {}", force(tension)),
        Closure::SpanTension { span, tension } => {
            format!("tension {} behind {}", force(tension), behind(span))
        }
        Closure::SpanTractiveTension { span, tension } => {
            format!(
                "tractive tension {} behind {}",
                force(tension),
                behind(span)
            )
        }
        Closure::BothSpans(_) => "closed by the tensions of both spans".to_owned(),
        Closure::RestCoordinate(_) => "closed by the tensioner at rest".to_owned(),
    };
    // That of a V-belt is no choice, and the usual one goes without saying.
    let usual = BeltKind::Flat {
        normal_force: NormalForce::default(),
    };
    let kind = drive.belt.kind;
    let convention = words::convention(kind).filter(|_| kind != usual);
    let convention = convention.map_or_else(String::new, |words| format!(", {words}"));
    let what = format!("{belt} round {count} pulleys, {law}{convention}, {closed}");
    let words = drive.title.iter();
    let title: Vec<_> = words.flat_map(|title| title.split_whitespace()).collect();
    match title.is_empty() {
        true => vec![what],
        false => vec![title.join(" "), what],
    }
}

/// The coefficient of friction, if it is the same on all pulleys.
pub(super) fn coefficient(drive: &Drive) -> Option<f64> {
    let mut pulleys = drive.pulleys.iter();
    let first = pulleys.next()?.friction_coefficient;
    let is_same = pulleys.all(|pulley| pulley.friction_coefficient == first);
    is_same.then_some(first)
}

/// What was asked, for programs.
pub(crate) fn statement(drive: &Drive) -> Vec<Quantity> {
    let (belt, normal_force) = match drive.belt.kind {
        BeltKind::V(_) => ("v", None),
        BeltKind::Flat { normal_force } => ("flat", Some(normal_force.name().to_owned())),
    };
    let sense = drive.sense.name();
    let word = |key, word: &str| Quantity::word(key, "", word.to_owned());
    let mut statement = vec![
        Quantity::word("title", "", drive.title.clone()),
        word("belt_type", belt),
        Quantity::word("normal_force", "", normal_force),
        word("friction_law", drive.law.name()),
    ];
    statement.extend(drive.law.kind().map(|kind| word("friction_kind", kind)));
    statement.push(word("sense", sense));
    statement
}
