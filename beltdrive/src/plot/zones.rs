//! Names and colours of the zones of friction.

use super::header::Mark;
use super::sheet::{Color, PALETTE};
use crate::quantity::Answer;

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

/// Entries of a legend for the kinds of zones that occur in an answer.
pub(super) fn legend(answer: &Answer, mark: fn(Color) -> Mark) -> Vec<(String, Mark)> {
    let occurs = |kind: &str| {
        let zones = answer.subjects("pulleys").iter();
        let mut zones = zones.flat_map(|pulley| pulley.list("zones"));
        zones.any(|zone| zone.word("kind") == Some(kind))
    };
    let kinds = KINDS.iter().filter(|(kind, _)| occurs(kind));
    let entry = |(kind, color): &(&str, Color)| (format!("{kind} zone"), mark(color));
    kinds.map(entry).collect()
}
