//! Zones of one kind of friction, from what is seen along a pulley.

use super::samples::{BEHIND_ENTRY, Sample, breakaway, crossing, turn};
use crate::vbelt::Regime;

/// A zone shorter than this share of the contact is not told from its neighbours.
pub(super) const SHORTEST_ZONE: f64 = 1e-4;
/// A zone is not cut nearer than this share of the contact to its ends: with segments as short as 1e-4 Newton's
/// method failed on 1 of 40 drives. Those of a belt that breaks away are kept as long as they are zones at all: the contact
/// of a stiff belt with a light load is lifted within an arc as short as that.
pub(super) const SHORTEST_CUT: f64 = 3e-3;
/// The same where sliding friction hardly moves the belt: the place at which that turns moves with the load abruptly, and a branch
/// goes on in short steps where it is not cut. With 3e-3 `limits` of 44 random drives with Coulomb friction takes 42 s at most in
/// place of 14, and of another one, with a turn at 2.4e-3, 22 times as long. Cut so near to the end where the belt slips, the limit
/// of the drive of Kim (2009) with a coefficient of friction of 0.5 is known to 1e-3 N in place of 1e-5 N.
pub(super) const SHORTEST_CUT_LOCKED: f64 = 3e-4;
/// The same where a belt that sticks, and slides an arc as short as its slip is small before it is lifted, is known to turn. With
/// 1e-4 the states of six more of 30 random drives without load are not found from their integrals.
pub(super) const SHORTEST_BEHIND_STICK: f64 = 1e-8;
/// An elastic zone that gradual friction shows is left out if it is shorter than this share of the contact. With one of
/// 5e-4 Newton's method failed; without one of 2e-3, which was there, it failed, too.
const SHORTEST_SEEN: f64 = 1e-3;
/// A turn in less than this share of the contact from the entry is left to the mesh, too. The belt is lifted out
/// of the groove at its end; where soft friction turns gradually, the middle of the turn may come to lie anywhere,
/// and end with the load.
const EARLIEST_TURN: f64 = 0.7;

/// A zone of one kind between two places on a pulley, in scaled arc length from the entry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::vbelt) struct Zone {
    pub(in crate::vbelt) regime: Regime,
    pub(in crate::vbelt) from: f64,
    pub(in crate::vbelt) to: f64,
}

/// One zone of sliding from entry to exit.
pub(super) fn one_zone(length: f64) -> Vec<Zone> {
    vec![Zone {
        regime: Regime::Slip,
        from: 0.0,
        to: length,
    }]
}

/// The zones with those of elastic and slipping friction taken together.
pub(super) fn without_kinks(zones: Vec<Zone>) -> Vec<Zone> {
    let blurred = zones.into_iter().map(|zone| match zone.regime {
        Regime::Stick => zone,
        _ => Zone {
            regime: Regime::Either,
            ..zone
        },
    });
    merge_short(blurred.collect(), 0.0)
}

/// The zones with that which has the turn in two, unless it is nearer than `margin` to an end of it.
pub(super) fn cut_at_turn(
    zones: Vec<Zone>,
    samples: &[Sample],
    length: f64,
    clear: f64,
    margin: f64,
) -> Vec<Zone> {
    match turn(samples, clear) {
        Some(place) if place > EARLIEST_TURN * length => cut(zones, place, margin),
        _ => zones,
    }
}

/// The zones that were cut at the turn with that in two in which the belt breaks away in front of it, unless the
/// belt sticks: then it does so at the end of that.
pub(super) fn cut_at_breakaway(zones: Vec<Zone>, samples: &[Sample], margin: f64) -> Vec<Zone> {
    if sticks(&zones) {
        return zones;
    }
    let Some(turn) = zones.windows(2).rfind(|pair| is_cut(pair)) else {
        return zones;
    };
    let turn = samples.partition_point(|sample| sample.place < turn[1].from);
    match breakaway(&samples[..turn]) {
        Some(place) => cut(zones, place, margin),
        None => zones,
    }
}

/// Makes the belt stick between two places.
pub(super) fn stick_between(zones: &mut Vec<Zone>, [from, to]: [f64; 2]) {
    let behind = zones.partition_point(|zone| zone.to <= to);
    let in_front = zones.partition_point(|zone| zone.from < from);
    let regime = Regime::Stick;
    let mut last = zones.split_off(behind);
    zones.truncate(in_front);
    if let Some(zone) = zones.last_mut() {
        zone.to = from;
    }
    if let Some(zone) = last.first_mut() {
        zone.from = to;
    }
    zones.push(Zone { regime, from, to });
    zones.append(&mut last);
}

/// Makes all between the first and the last elastic zone one.
pub(super) fn join_elastic(zones: &mut Vec<Zone>) {
    let is_elastic = |zone: &Zone| zone.regime == Regime::Elastic;
    let (first, last) = (
        zones.iter().position(is_elastic),
        zones.iter().rposition(is_elastic),
    );
    if let (Some(first), Some(last)) = (first, last) {
        zones[first].to = zones[last].to;
        zones.drain(first + 1..=last);
    }
}

/// Prolongs elastic zones that are new, where a solution shows a negative plastic rate Λ of a belt that is taken to slip.
///
/// The traction |B| leaves its limit as the integral of Λ, and is back at it later than Λ at zero. Of a parabola Λ ∝ s (s − l)
/// the integral s² (s/3 − l/2) vanishes at s = 3 l/2. At s = l its derivative does, so that Newton's method goes from there
/// anywhere, and to the double root s = 0.
pub(super) fn prolong_elastic(zones: &mut [Zone], is_new: impl Fn(&Zone) -> bool) {
    for index in 1..zones.len() {
        let [zone, behind] = [zones[index - 1], zones[index]];
        if zone.regime == Regime::Elastic && is_new(&zone) {
            let longer = 0.5 * (zone.to - zone.from);
            let end = zone.to + longer.min(0.5 * (behind.to - behind.from));
            zones[index - 1].to = end;
            zones[index].from = end;
        }
    }
}

/// The zones with hardly visible elastic ones taken for slip.
pub(super) fn without_short_elastic(mut zones: Vec<Zone>, length: f64) -> Vec<Zone> {
    for zone in &mut zones {
        if zone.regime == Regime::Elastic && zone.to - zone.from < SHORTEST_SEEN * length {
            zone.regime = Regime::Slip;
        }
    }
    join(&mut zones, |_| true);
    zones
}

/// Whether the belt sticks in one of the zones.
pub(super) fn sticks(zones: &[Zone]) -> bool {
    zones.iter().any(|zone| zone.regime == Regime::Stick)
}

/// Whether two neighbours are of the same kind.
pub(super) fn is_cut(pair: &[Zone]) -> bool {
    pair[0].regime == pair[1].regime
}

/// The zones with that in two in which a place is, unless that is nearer than `margin` to an end of it or the belt sticks
/// there.
fn cut(zones: Vec<Zone>, place: f64, margin: f64) -> Vec<Zone> {
    let halves = |zone: Zone| match zone.regime != Regime::Stick
        && zone.from + margin < place
        && place < zone.to - margin
    {
        true => vec![
            Zone { to: place, ..zone },
            Zone {
                from: place,
                ..zone
            },
        ],
        false => vec![zone],
    };
    zones.into_iter().flat_map(halves).collect()
}

/// The zones of elastic and slipping friction, from the sign of the excess of the one over the other.
pub(super) fn friction_zones(samples: &[Sample], length: f64) -> Vec<Zone> {
    let mut zones: Vec<Zone> = Vec::new();
    // The last sample, and the size of the limit, below which a sign is rounding.
    let (mut last, mut largest) = (None::<Sample>, 0.0f64);
    for &sample in samples {
        let Sample { place, limit, .. } = sample;
        largest = largest.max(limit.abs());
        if limit.abs() <= 1e-9 * largest {
            continue;
        }
        let regime = match limit > 0.0 {
            _ if sample.sticks => Regime::Stick,
            true => Regime::Slip,
            false if sample.displacement < 0.0 => Regime::Reversed,
            false => Regime::Elastic,
        };
        match zones.last_mut() {
            Some(zone) if zone.regime == regime => zone.to = place,
            Some(zone) => {
                let before = last.unwrap_or(sample);
                let from = match before.sticks || sample.sticks {
                    true => 0.5 * (before.place + place),
                    false if zone.regime.is_elastic() && regime.is_elastic() => {
                        let [from, to] = [before, sample].map(|sample| sample.displacement);
                        crossing(before.place, from, place, to)
                    }
                    false => crossing(before.place, before.limit, place, limit),
                };
                zone.to = from;
                let to = place;
                zones.push(Zone { regime, from, to });
            }
            None => zones.push(Zone {
                regime,
                from: 0.0,
                to: place,
            }),
        }
        last = Some(sample);
    }
    if let Some(zone) = zones.last_mut() {
        zone.to = length;
    }
    merge_short(zones, length)
}

/// Gives short zones of a contact of this length to their neighbours and joins zones of one kind. A slip zone at the exit
/// stays: with soft friction it may be as short as 1e-6 of the contact, and without it the normal force is negative there. So
/// does an elastic zone at the entry, which is short with stiff friction, if it is long enough to be looked for: where it
/// vanishes along a branch something of its length is left.
fn merge_short(zones: Vec<Zone>, length: f64) -> Vec<Zone> {
    let shorter = |zone: &Zone, share: f64| zone.to - zone.from < share * length;
    let is_short = |zone: &Zone, stays: bool| !stays && shorter(zone, SHORTEST_ZONE);
    let mut merged: Vec<Zone> = Vec::with_capacity(zones.len());
    let stays_at_entry = |zone: &Zone| zone.regime.is_elastic() && !shorter(zone, BEHIND_ENTRY[0]);
    let at_exit = zones.len().saturating_sub(1);
    for (index, mut zone) in zones.into_iter().enumerate() {
        let slips_at_exit = index == at_exit && zone.regime == Regime::Slip;
        let is_second = merged.len() == 1;
        match merged.last_mut() {
            Some(last) if is_short(last, is_second && stays_at_entry(last)) => {
                zone.from = last.from;
                *last = zone;
            }
            Some(last) if last.regime == zone.regime || is_short(&zone, slips_at_exit) => {
                last.to = zone.to;
            }
            _ => merged.push(zone),
        }
    }
    join(&mut merged, |_| true);
    merged
}

/// Joins neighbours of one kind, of the kinds that are asked for.
pub(super) fn join(zones: &mut Vec<Zone>, is_joined: impl Fn(Regime) -> bool) {
    zones.dedup_by(|next, zone| {
        let same = zone.regime == next.regime && is_joined(zone.regime);
        if same {
            zone.to = next.to;
        }
        same
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_belt_sticks_between_two_places() {
        let zone = |regime, from, to| Zone { regime, from, to };
        let mut zones = vec![
            zone(Regime::Elastic, 0.0, 1.0),
            zone(Regime::Slip, 1.0, 2.0),
            zone(Regime::Slip, 2.0, 3.0),
        ];
        stick_between(&mut zones, [0.75, 2.0]);
        let expected = vec![
            zone(Regime::Elastic, 0.0, 0.75),
            zone(Regime::Stick, 0.75, 2.0),
            zone(Regime::Slip, 2.0, 3.0),
        ];
        assert_eq!(zones, expected);
        stick_between(&mut zones, [0.75, 2.5]);
        let ends: Vec<_> = zones.iter().map(|zone| [zone.from, zone.to]).collect();
        assert_eq!(ends, [[0.0, 0.75], [0.75, 2.5], [2.5, 3.0]]);
    }

    #[test]
    fn a_new_elastic_zone_ends_behind_the_zero_of_the_plastic_rate() {
        let zone = |regime, from, to| Zone { regime, from, to };
        let seen = |last| {
            vec![
                zone(Regime::Slip, 0.0, 1.0),
                zone(Regime::Elastic, 1.0, 1.25),
                zone(Regime::Slip, 1.25, last),
            ]
        };
        let end = |mut zones: Vec<Zone>, is_new| {
            prolong_elastic(&mut zones, |_| is_new);
            assert_eq!(zones[1].to, zones[2].from);
            zones[1].to
        };
        assert_eq!(end(seen(3.0), true), 1.375);
        // Something is left of what is behind.
        assert_eq!(end(seen(1.375), true), 1.3125);
        assert_eq!(end(seen(3.0), false), 1.25);
    }
}
