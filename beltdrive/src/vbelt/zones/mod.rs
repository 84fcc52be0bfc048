//! A contact cut into the zones on which its equations are smooth.
//!
//! Elastic and slipping friction cross at places that are not known beforehand, and the right-hand side
//! has a kink there. Elastic friction that grows along the contact may come to hold the belt, which then sticks
//! until it breaks loose. Every contact also has a turn: the belt that was pulled into the groove begins to be
//! lifted out of it, and where it hardly slips the traction turns within an arc that is as short as the slip
//! is small. Once the zones between these places are segments of unknown length, every segment is smooth
//! and the mesh follows the turn.

mod kinds;
mod samples;

use super::path::Solved;
use super::{ANGLE, DRIVEN, DRIVER, DriveProblem, LAW, Law, MAX_STATES, Regime};
use kinds::{Zone, cut_at_turn, friction_zones, one_zone, without_kinks};
use samples::{Sample, samples};

/// Nodes nearer than this to each other or to the ends of a zone, in its length, are left out.
const NODE_MARGIN: f64 = 1e-4;

/// Where a belt that sticks is taken to break loose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Loose {
    /// Where the solution shows it.
    Seen,
    /// Where the bristles hold it with the smallest share of their limit, which falls as long as it sticks.
    Early,
    /// Where the bristles reach their limit again.
    Late,
    /// At once: it does not stick.
    Never,
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
        Self::new(solved, false, [Loose::Seen; 2])
    }

    /// As [`Cut::of`], with a last slip zone where elastic friction reaches the exit. The belt presses no
    /// longer there, so that it slips at the very end, on a way that may lie between two samples.
    pub(super) fn with_exits(solved: &'a Solved) -> Self {
        Self::new(solved, true, [Loose::Seen; 2])
    }

    /// The zones that bristles show on the driven pulley and the driver, those of elastic and slipping friction
    /// taken together.
    pub(super) fn of_bristles(solved: &'a Solved, loose: [Loose; 2]) -> Self {
        Self::new(solved, false, loose)
    }

    fn new(solved: &'a Solved, at_exit: bool, loose: [Loose; 2]) -> Self {
        let samples =
            [DRIVEN, DRIVER].map(|pulley| samples(solved, pulley, at_exit, loose[pulley]));
        let p = solved.solution.parameters();
        let pulleys = [DRIVEN, DRIVER].map(|pulley| {
            let length = solved.problem.contact_length(pulley, p);
            let zones = match (solved.problem.has_zones(), loose[pulley]) {
                (true, Loose::Seen) => friction_zones(&samples[pulley], length),
                (true, _) => without_kinks(friction_zones(&samples[pulley], length)),
                (false, _) => one_zone(length),
            };
            match solved.problem.groove(pulley).law {
                Law::Normalised { .. } => zones,
                _ => cut_at_turn(zones, &samples[pulley], length),
            }
        });
        Self {
            solved,
            samples,
            pulleys,
        }
    }

    /// Whether they are the segments of the solution but for the place of the turn.
    pub(super) fn is_nearly_kept(&self) -> bool {
        let kinds = |zones: &[Regime]| {
            let mut kinds = zones.to_vec();
            kinds.dedup();
            kinds
        };
        let seen = self.regimes().map(|zones| kinds(&zones));
        seen == self.solved.problem.regimes().map(kinds)
    }

    /// Whether they are the same zones at the same places.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.pulleys == other.pulleys
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
    friction_zones(&samples(solved, pulley, false, Loose::Seen), length)
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
            states[LAW + 1] = states[LAW + 2];
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
