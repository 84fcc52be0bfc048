//! A contact cut into the zones on which its equations are smooth.
//!
//! Elastic and slipping friction cross at places that are not known beforehand, and the right-hand side
//! has a kink there. Every contact also has a turn: the belt that was pulled into the groove begins to be
//! lifted out of it, and where it hardly slips the traction turns within an arc that is as short as the slip
//! is small. Once the zones between these places are segments of unknown length, every segment is smooth
//! and the mesh follows the turn.

use super::path::Solved;
use super::{
    ANGLE, Contact, DRIVEN, DRIVER, DriveProblem, LAW, Law, MAX_STATES, Regime, limit_excess,
};

use std::f64::consts::TAU;

/// Samples per mesh interval in search of crossings.
const SAMPLES: usize = 8;
/// A zone shorter than this share of the contact is not told from its neighbours.
const SHORTEST_ZONE: f64 = 1e-4;
/// Nodes nearer than this to each other or to the ends of a zone, in its length, are left out.
const NODE_MARGIN: f64 = 1e-4;

/// A zone of one kind between two places on a pulley, in scaled arc length from the entry.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Zone {
    regime: Regime,
    from: f64,
    to: f64,
}

/// What is seen of a solution at a place on a pulley.
#[derive(Clone, Copy, Debug)]
struct Sample {
    place: f64,
    /// Excess of elastic friction over its limit.
    limit: f64,
    /// Excess of the traction over that in the middle of the turn.
    turn: f64,
    /// Direction of the traction, continuous along the pulley.
    direction: f64,
}

/// A solution cut anew into zones: the guess of the problem that has them as segments.
pub(super) struct Cut<'a> {
    solved: &'a Solved,
    samples: [Vec<Sample>; 2],
    pulleys: [Vec<Zone>; 2],
}

impl<'a> Cut<'a> {
    /// The zones that a solution shows.
    pub(super) fn of(solved: &'a Solved) -> Self {
        Self::of_samples(solved, false)
    }

    /// As [`Cut::of`], with a last slip zone where elastic friction reaches the exit. The belt presses no
    /// longer there, so that it slips at the very end, on a way that may lie between two samples.
    pub(super) fn with_exits(solved: &'a Solved) -> Self {
        Self::of_samples(solved, true)
    }

    fn of_samples(solved: &'a Solved, at_exit: bool) -> Self {
        let samples = [DRIVEN, DRIVER].map(|pulley| samples(solved, pulley, at_exit));
        let p = solved.solution.parameters();
        let pulleys = [DRIVEN, DRIVER].map(|pulley| {
            let length = solved.problem.contact_length(pulley, p);
            match solved.problem.has_zones() {
                true => friction_zones(&samples[pulley], length),
                false => around_turn(&samples[pulley], length),
            }
        });
        Self {
            solved,
            samples,
            pulleys,
        }
    }

    fn regimes(&self) -> [Vec<Regime>; 2] {
        self.pulleys.each_ref().map(|zones| {
            let zones = zones.iter();
            zones.map(|zone| zone.regime).collect()
        })
    }

    /// Whether they are the segments of the solution.
    pub(super) fn is_kept(&self) -> bool {
        self.regimes() == self.solved.problem.regimes()
    }

    /// A problem with these zones as segments.
    pub(super) fn apply(&self, problem: DriveProblem) -> DriveProblem {
        let [driven, driver] = &self.regimes();
        problem.with_zones([driven, driver])
    }

    /// The pulley of a zone, counted over both, and the zone.
    fn zone(&self, segment: usize) -> (usize, Zone) {
        let [driven, driver] = &self.pulleys;
        match driven.get(segment) {
            Some(zone) => (DRIVEN, *zone),
            None => (DRIVER, driver[segment - driven.len()]),
        }
    }

    /// The direction of the traction at a place.
    fn direction(&self, pulley: usize, place: f64) -> f64 {
        let samples = &self.samples[pulley];
        let next = samples.partition_point(|sample| sample.place < place);
        let [before, after] = [next.saturating_sub(1), next.min(samples.len() - 1)];
        let [before, after] = [samples[before], samples[after]];
        let width = after.place - before.place;
        match width > 0.0 {
            true => {
                let share = (place - before.place) / width;
                before.direction + share * (after.direction - before.direction)
            }
            false => after.direction,
        }
    }
}

/// Looks at a solution along one pulley, at the exit too if asked for.
fn samples(solved: &Solved, pulley: usize, at_exit: bool) -> Vec<Sample> {
    let (problem, solution) = (&solved.problem, &solved.solution);
    let p = solution.parameters();
    let groove = problem.groove(pulley);
    let (speed, flow) = (DriveProblem::speed(pulley, p), DriveProblem::flow(p));
    let mut samples: Vec<Sample> = Vec::new();
    let mut before = 0.0;
    for segment in problem.zones(pulley) {
        let length = p[DriveProblem::length_index(segment)];
        let mut y = [0.0; MAX_STATES];
        let y = &mut y[..solution.segments()[segment].states];
        let inside = solution.mesh(segment).windows(2).flat_map(|pair| {
            let share = |sample| (sample as f64 + 0.5) / SAMPLES as f64;
            (0..SAMPLES).map(move |sample| pair[0] + (pair[1] - pair[0]) * share(sample))
        });
        let is_last = segment + 1 == problem.zones(pulley).end;
        for s in inside.chain((at_exit && is_last).then_some(1.0)) {
            solution.state(segment, s, y);
            let contact = problem.contact(segment, y, p);
            let direction = direction(groove.law, y, &contact);
            samples.push(Sample {
                place: before + s * length,
                limit: limit_excess(groove, y, speed, flow),
                turn: contact.turn_excess(groove),
                direction: samples.last().map_or(direction, |last| {
                    let turns = (last.direction - direction) / TAU;
                    direction + turns.round() * TAU
                }),
            });
        }
        before += length;
    }
    samples
}

/// The direction of the traction, up to whole turns.
fn direction(law: Law, y: &[f64], contact: &Contact<f64>) -> f64 {
    match law {
        Law::Sliding { .. } => y[LAW],
        Law::Bristle { .. } => y[LAW].atan2(y[LAW + 1]),
        Law::Coulomb | Law::Epp { .. } => contact.slip[0].atan2(contact.slip[1]),
    }
}

/// The zones before and behind the turn.
fn around_turn(samples: &[Sample], length: f64) -> Vec<Zone> {
    let zone = |from: f64, to: f64| Zone {
        regime: Regime::Slip,
        from,
        to,
    };
    let mut pairs = samples.windows(2).rev();
    match pairs.find(|pair| pair[0].turn < 0.0 && pair[1].turn >= 0.0) {
        Some([before, after]) => {
            let place = crossing(before.place, before.turn, after.place, after.turn);
            vec![zone(0.0, place), zone(place, length)]
        }
        _ => vec![zone(0.0, length)],
    }
}

/// The zones of elastic and slipping friction, from the sign of the excess of the one over the other.
fn friction_zones(samples: &[Sample], length: f64) -> Vec<Zone> {
    let mut zones: Vec<Zone> = Vec::new();
    // The last sample, and the size of the limit, below which a sign is rounding.
    let (mut last, mut largest) = (None::<Sample>, 0.0f64);
    for &sample in samples {
        let Sample { place, limit, .. } = sample;
        largest = largest.max(limit.abs());
        if limit.abs() <= 1e-9 * largest {
            continue;
        }
        let regime = if limit > 0.0 {
            Regime::Slip
        } else {
            Regime::Elastic
        };
        match zones.last_mut() {
            Some(zone) if zone.regime == regime => zone.to = place,
            Some(zone) => {
                let before = last.unwrap_or(sample);
                let from = crossing(before.place, before.limit, place, limit);
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
    merge_short(zones, SHORTEST_ZONE * length)
}

/// Where a value that changes its sign between two places is zero, linearly.
fn crossing(from: f64, before: f64, to: f64, after: f64) -> f64 {
    from + (to - from) * before / (before - after)
}

/// Gives zones shorter than `shortest` to their neighbours and joins zones of one kind.
fn merge_short(zones: Vec<Zone>, shortest: f64) -> Vec<Zone> {
    let mut merged: Vec<Zone> = Vec::with_capacity(zones.len());
    for mut zone in zones {
        match merged.last_mut() {
            Some(last) if last.to - last.from < shortest => {
                zone.from = last.from;
                *last = zone;
            }
            Some(last) if last.regime == zone.regime || zone.to - zone.from < shortest => {
                last.to = zone.to;
            }
            _ => merged.push(zone),
        }
    }
    merged.dedup_by(|next, zone| {
        let same = zone.regime == next.regime;
        if same {
            zone.to = next.to;
        }
        same
    });
    merged
}

/// The segment of a solution with a place on a pulley (scaled arc length from the entry), and s
/// there.
fn locate(solved: &Solved, pulley: usize, place: f64) -> (usize, f64) {
    let p = solved.solution.parameters();
    let length = |segment| p[DriveProblem::length_index(segment)];
    let segments = solved.problem.zones(pulley);
    let (mut segment, mut before) = (segments.start, 0.0);
    while segment + 1 < segments.end && place > before + length(segment) {
        before += length(segment);
        segment += 1;
    }
    (segment, (place - before) / length(segment))
}

/// The kinds of friction along one pulley with the swept angles where they begin and end.
pub(super) fn angles(solved: &Solved, pulley: usize) -> Vec<(Regime, [f64; 2])> {
    let angle = |place: f64| {
        let (segment, s) = locate(solved, pulley, place);
        let mut y = [0.0; MAX_STATES];
        let n = solved.solution.segments()[segment].states;
        solved.solution.state(segment, s, &mut y[..n]);
        y[ANGLE]
    };
    let p = solved.solution.parameters();
    let length = solved.problem.contact_length(pulley, p);
    friction_zones(&samples(solved, pulley, false), length)
        .into_iter()
        .map(|zone| (zone.regime, [zone.from, zone.to].map(angle)))
        .collect()
}

impl bvp::Guess for Cut<'_> {
    /// The states of the solution; from bristles the direction of their traction.
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let (pulley, Zone { from, to, .. }) = self.zone(segment);
        let place = from + s * (to - from);
        let (known, s) = locate(self.solved, pulley, place);
        let mut states = [0.0; MAX_STATES];
        let count = self.solved.solution.segments()[known].states;
        self.solved.solution.state(known, s, &mut states[..count]);
        if let Law::Bristle { .. } = self.solved.problem.groove(pulley).law {
            states[LAW] = self.direction(pulley, place);
        }
        y.copy_from_slice(&states[..y.len()]);
    }

    fn parameters(&self, p: &mut [f64]) {
        let first = DriveProblem::length_index(0);
        p[..first].copy_from_slice(&self.solved.solution.parameters()[..first]);
        let zones = self.pulleys.concat();
        for (segment, zone) in zones.iter().enumerate() {
            p[DriveProblem::length_index(segment)] = zone.to - zone.from;
        }
        p[DriveProblem::length_index(zones.len())..].fill(self.solved.tight_tension());
    }

    /// The nodes of the solution, cut at the zones.
    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        let p = self.solved.solution.parameters();
        let places = [DRIVEN, DRIVER].map(|pulley| {
            let (mut places, mut before) = (Vec::new(), 0.0);
            for segment in self.solved.problem.zones(pulley) {
                let length = p[DriveProblem::length_index(segment)];
                let nodes = self.solved.solution.mesh(segment);
                places.extend(nodes.iter().map(|s| before + s * length));
                before += length;
            }
            places
        });
        let nodes = |segment: usize| {
            let (pulley, zone) = self.zone(segment);
            let within = places[pulley]
                .iter()
                .map(|place| (place - zone.from) / (zone.to - zone.from))
                .filter(|s| (NODE_MARGIN..=1.0 - NODE_MARGIN).contains(s));
            let mut nodes: Vec<f64> = [0.0].into_iter().chain(within).chain([1.0]).collect();
            nodes.dedup_by(|b, a| *b - *a < NODE_MARGIN);
            nodes
        };
        let count = self.pulleys[DRIVEN].len() + self.pulleys[DRIVER].len();
        Some((0..count).map(nodes).collect())
    }
}
