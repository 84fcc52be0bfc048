//! Zones of EPP friction: where it is elastic and where it slips.
//!
//! The two friction forces cross at places that are not known beforehand, and the right-hand side
//! has a kink there. Once the zones are segments whose lengths are unknown, every segment is
//! smooth.

use super::path::Solved;
use super::{ANGLE, DRIVEN, DRIVER, DriveProblem, MAX_STATES, Regime, limit_excess};

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

/// The zones of both pulleys.
#[derive(Clone, Debug)]
pub(super) struct Split {
    pulleys: [Vec<Zone>; 2],
}

impl Split {
    /// The zones of a solution where they differ from the segments of its problem, or `None` where
    /// every segment is of one kind and known to be.
    pub(super) fn of(solved: &Solved) -> Option<Self> {
        Self::of_zones(
            solved,
            [DRIVEN, DRIVER].map(|pulley| zones(solved, pulley, false)),
        )
    }

    /// As [`Split::of`], with a last slip zone where elastic friction reaches the exit. The belt presses no
    /// longer there, so that it slips at the very end, on a way that may lie between two samples.
    pub(super) fn with_exits(solved: &Solved) -> Option<Self> {
        Self::of_zones(
            solved,
            [DRIVEN, DRIVER].map(|pulley| zones(solved, pulley, true)),
        )
    }

    fn of_zones(solved: &Solved, pulleys: [Vec<Zone>; 2]) -> Option<Self> {
        let split = Self { pulleys };
        let same = [DRIVEN, DRIVER]
            .into_iter()
            .all(|pulley| split.regimes(pulley) == solved.problem.regimes(pulley));
        (!same && solved.problem.has_zones()).then_some(split)
    }

    fn regimes(&self, pulley: usize) -> Vec<Regime> {
        let zones = self.pulleys[pulley].iter();
        zones.map(|zone| zone.regime).collect()
    }

    /// The problem with these zones as segments.
    pub(super) fn problem(&self, solved: &Solved) -> DriveProblem {
        let problem = solved.problem.clone();
        problem.with_zones(&self.regimes(DRIVEN), &self.regimes(DRIVER))
    }

    /// The solution cut at the zones, as the guess of that problem.
    pub(super) fn guess<'a>(&'a self, solved: &'a Solved) -> impl bvp::Guess + 'a {
        Cut {
            zones: self.pulleys.concat(),
            driven: self.pulleys[DRIVEN].len(),
            solved,
        }
    }
}

/// The zones of one pulley, from the sign of the excess of elastic over slipping friction, sampled at the
/// exit too if asked for.
fn zones(solved: &Solved, pulley: usize, at_exit: bool) -> Vec<Zone> {
    let mut zones: Vec<Zone> = Vec::new();
    let p = solved.solution.parameters();
    let total = solved.problem.contact_length(pulley, p);
    let mut before = 0.0;
    // The last sample, and the size of the limit, below which a sign is rounding.
    let (mut last, mut largest) = (None::<(f64, f64)>, 0.0f64);
    for segment in solved.problem.zones(pulley) {
        let length = p[DriveProblem::length_index(segment)];
        let mut y = [0.0; MAX_STATES];
        let y = &mut y[..solved.solution.segments()[segment].states];
        let mesh = solved.solution.mesh(segment);
        let inside = mesh.windows(2).flat_map(|pair| {
            let share = |sample| (sample as f64 + 0.5) / SAMPLES as f64;
            (0..SAMPLES).map(move |sample| pair[0] + (pair[1] - pair[0]) * share(sample))
        });
        let is_last = segment + 1 == solved.problem.zones(pulley).end;
        let exit = (at_exit && is_last).then_some(1.0);
        for s in inside.chain(exit) {
            solved.solution.state(segment, s, y);
            let speed = DriveProblem::speed(pulley, p);
            let groove = solved.problem.groove(pulley);
            let excess = limit_excess(groove, y, speed, DriveProblem::flow(p));
            let place = before + s * length;
            largest = largest.max(excess.abs());
            if excess.abs() <= 1e-9 * largest {
                continue;
            }
            let regime = if excess > 0.0 {
                Regime::Slip
            } else {
                Regime::Elastic
            };
            match zones.last_mut() {
                Some(zone) if zone.regime == regime => zone.to = place,
                Some(zone) => {
                    let (at, value) = last.unwrap_or((place, excess));
                    let crossing = at + (place - at) * value / (value - excess);
                    zone.to = crossing;
                    zones.push(Zone {
                        regime,
                        from: crossing,
                        to: place,
                    });
                }
                None => zones.push(Zone {
                    regime,
                    from: 0.0,
                    to: place,
                }),
            }
            last = Some((place, excess));
        }
        before += length;
    }
    if let Some(zone) = zones.last_mut() {
        zone.to = total;
    }
    merge_short(zones, SHORTEST_ZONE * total)
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

/// A solution cut anew into zones.
struct Cut<'a> {
    zones: Vec<Zone>,
    driven: usize,
    solved: &'a Solved,
}

impl Cut<'_> {
    fn pulley(&self, zone: usize) -> usize {
        if zone < self.driven { DRIVEN } else { DRIVER }
    }
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
    zones(solved, pulley, false)
        .into_iter()
        .map(|zone| (zone.regime, [zone.from, zone.to].map(angle)))
        .collect()
}

impl bvp::Guess for Cut<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let Zone { from, to, .. } = self.zones[segment];
        let place = from + s * (to - from);
        let (known, s) = locate(self.solved, self.pulley(segment), place);
        self.solved.solution.state(known, s, y);
    }

    fn parameters(&self, p: &mut [f64]) {
        p[..DriveProblem::length_index(0)]
            .copy_from_slice(&self.solved.solution.parameters()[..DriveProblem::length_index(0)]);
        for (segment, zone) in self.zones.iter().enumerate() {
            p[DriveProblem::length_index(segment)] = zone.to - zone.from;
        }
        p[DriveProblem::length_index(self.zones.len())..].fill(self.solved.tight_tension());
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
        let nodes = |(index, zone): (usize, &Zone)| {
            let within = places[self.pulley(index)]
                .iter()
                .map(|place| (place - zone.from) / (zone.to - zone.from))
                .filter(|s| (NODE_MARGIN..=1.0 - NODE_MARGIN).contains(s));
            let mut nodes: Vec<f64> = [0.0].into_iter().chain(within).chain([1.0]).collect();
            nodes.dedup_by(|b, a| *b - *a < NODE_MARGIN);
            nodes
        };
        Some(self.zones.iter().enumerate().map(nodes).collect())
    }
}
