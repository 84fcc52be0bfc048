//! Names and colours of the zones of friction.

use super::header::Mark;
use super::sheet::{Color, PALETTE};
use crate::quantity::{Answer, Subject};

/// The kinds of zones in the order of a legend, each with its colour.
const KINDS: [(&str, Color); 5] = [
    ("elastic", PALETTE[1]),
    ("locked", PALETTE[6]),
    ("adhesion", PALETTE[2]),
    ("creep", PALETTE[3]),
    ("slip", PALETTE[4]),
];

/// The colour of a kind of zone.
pub(super) fn color(kind: &str) -> Color {
    let known = KINDS.iter().find(|(known, _)| *known == kind);
    known.map_or(PALETTE[5], |(_, color)| color)
}

/// The kinds of friction along a pulley with the angles where they begin and end, rad. Where a belt at full friction
/// hardly slips it is locked.
pub(super) fn along(pulley: &Subject) -> Vec<(&str, [f64; 2])> {
    let zones = pulley.list("zones").iter().filter_map(|zone| {
        let ends = [zone.number("from")?, zone.number("to")?];
        Some((zone.word("kind")?, ends))
    });
    let (from, to) = (pulley.number("locked_from"), pulley.number("locked_to"));
    let Some((from, to)) = from.zip(to) else {
        return zones.collect();
    };
    let parts = zones.flat_map(|(kind, [begin, end])| {
        let locked = match kind {
            "slip" => [from, to].map(|place| place.clamp(begin, end)),
            _ => [begin; 2],
        };
        let parts = [
            (kind, [begin, locked[0]]),
            ("locked", locked),
            (kind, [locked[1], end]),
        ];
        parts.into_iter().filter(|(_, [from, to])| from < to)
    });
    parts.collect()
}

/// Entries of a legend for the kinds of zones that occur in an answer.
pub(super) fn legend(answer: &Answer, mark: fn(Color) -> Mark) -> Vec<(String, Mark)> {
    let occurs = |kind: &str| {
        let mut zones = answer.subjects("pulleys").iter();
        zones.any(|pulley| along(pulley).iter().any(|(known, _)| *known == kind))
    };
    let kinds = KINDS.iter().filter(|(kind, _)| occurs(kind));
    kinds
        .map(|(kind, color)| entry(kind, mark(color)))
        .collect()
}

/// The entry of a legend for a kind of zone.
pub(super) fn entry(kind: &str, mark: Mark) -> (String, Mark) {
    (format!("{kind} zone"), mark)
}
