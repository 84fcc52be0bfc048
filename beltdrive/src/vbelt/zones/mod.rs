//! A contact cut into the zones on which its equations are smooth.
//!
//! Elastic and slipping friction cross at places that are not known beforehand, and the right-hand side
//! has a kink there. Elastic friction that grows along the contact may come to hold the belt, which then sticks
//! until it breaks loose. Every contact also has a turn: the belt that was pulled into the groove begins to be
//! lifted out of it, and where it hardly slips the traction turns within an arc that is as short as the slip
//! is small. Once the zones between these places are segments of unknown length, every segment is smooth
//! and the mesh follows the turn.

mod kinds;
mod places;
mod samples;

use super::path::Solved;
use super::{ANGLE, BeltProblem, DriveProblem, Law, MAX_STATES, Regime};
use kinds::{
    SHORTEST_BEHIND_STICK, SHORTEST_CUT, SHORTEST_CUT_LOCKED, SHORTEST_ZONE, cut_at_breakaway,
    cut_at_turn, friction_zones, is_cut, join, join_elastic, one_zone, prolong_elastic,
    stick_between, sticks, without_kinks, without_short_elastic,
};
use places::{ends, keep_junctions, locate};
use samples::{CLEAR_TURN, locks, pulled_from, samples};

pub(super) use kinds::Zone;
pub(super) use samples::{Sample, displacement_felt};

/// Nodes nearer than this to each other or to the ends of a zone, in its length, are left out.
const NODE_MARGIN: f64 = 1e-4;

/// How far inside a zone, in its length, the states at its ends are taken: more than the rounding of a place.
const INSIDE: f64 = 1e-13;

/// Where a belt that sticks is taken to break loose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Loose {
    /// Where the solution shows it.
    Seen,
    /// Where the bristles hold it with the smallest share of their limit, which falls as long as it sticks.
    Early,
    /// Where the bristles reach their limit again.
    Late,
    /// In the turn of the traction that lifts it, so that it slips nowhere in front of that.
    Turning,
    /// At once: it does not stick.
    Never,
}

/// A zone that is cut more than this share of the contact beside the end of a segment is cut elsewhere.
const ELSEWHERE: f64 = 0.02;

/// A solution cut anew into zones: the guess of the problem that has them as segments.
pub(super) struct Cut<'a, P = DriveProblem> {
    solved: &'a Solved<P>,
    samples: Vec<Vec<Sample>>,
    pulleys: Vec<Vec<Zone>>,
    /// Whether the traction of vector EPP friction is brought to its limit where the belt slips.
    at_limit: bool,
}

impl<'a, P: BeltProblem> Cut<'a, P> {
    /// The zones that a solution shows.
    pub(super) fn of(solved: &'a Solved<P>) -> Self {
        Self::new(solved, false, |_| Loose::Seen)
    }

    /// As [`Cut::of`], with zones at the ends of contacts that may lie between two samples: with elastic friction at the entry,
    /// where the displacement grows from zero, and with a slip zone where elastic friction reaches the exit, where the belt
    /// presses no longer.
    pub(super) fn with_ends(solved: &'a Solved<P>) -> Self {
        Self::new(solved, true, |_| Loose::Seen)
    }

    /// As [`Cut::of`], with the belt at rest on every pulley from where scalar elastic friction pulls it to where it breaks away,
    /// if there is such a pulley.
    pub(super) fn with_belt_at_rest(solved: &'a Solved<P>) -> Option<Self> {
        let mut cut = Self::of(solved);
        let mut rests = false;
        for (pulley, zones) in cut.pulleys.iter_mut().enumerate() {
            let first = solved.problem.zones(pulley).start;
            let locked = solved.problem.breakaway(pulley);
            let breakaway = locked.and_then(|segment| ends(solved, pulley).nth(segment - first));
            if let (Some(from), Some(to)) = (pulled_from(&cut.samples[pulley]), breakaway)
                && from < to
            {
                stick_between(zones, [from, to]);
                rests = true;
            }
        }
        rests.then_some(cut)
    }

    /// As [`Cut::of`], with all between the first and the last elastic zone of a pulley as one.
    pub(super) fn with_one_elastic_zone(solved: &'a Solved<P>) -> Self {
        let mut cut = Self::of(solved);
        cut.pulleys.iter_mut().for_each(join_elastic);
        cut
    }

    /// The zones that bristles show on every pulley, those of elastic and slipping friction taken together.
    pub(super) fn of_bristles(solved: &'a Solved<P>, loose: &[Loose]) -> Self {
        Self::new(solved, false, |pulley| loose[pulley])
    }

    fn new(solved: &'a Solved<P>, at_ends: bool, loose: impl Fn(usize) -> Loose) -> Self {
        let pulleys = 0..solved.problem.pulleys();
        let (samples, pulleys) = pulleys
            .map(|pulley| cut(solved, pulley, at_ends, loose(pulley)))
            .unzip();
        Self {
            solved,
            samples,
            pulleys,
            at_limit: false,
        }
    }

    /// The same zones with the traction of vector EPP friction at its limit where the belt slips. It is below that
    /// where the plastic rate sets in gradually.
    pub(super) fn at_limit(self) -> Self {
        Self {
            at_limit: true,
            ..self
        }
    }

    /// Whether the belt passes a place at which elastic friction might have brought it to rest.
    pub(super) fn passes_rest(&self) -> bool {
        let mut pulleys = self.samples.iter().zip(&self.pulleys);
        pulleys.any(|(samples, zones)| samples::passes_rest(samples, zones))
    }

    /// Whether they are the segments of the solution but for the place of the turn.
    pub(super) fn is_nearly_kept(&self) -> bool {
        let kinds = |mut pulleys: Vec<Vec<Regime>>| {
            pulleys.iter_mut().for_each(Vec::dedup);
            pulleys
        };
        kinds(self.regimes()) == kinds(self.solved.problem.regimes())
    }

    /// Whether they are the same zones at the same places.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.pulleys == other.pulleys
    }

    /// The kinds of friction along every pulley.
    pub(super) fn regimes(&self) -> Vec<Vec<Regime>> {
        let regimes = |zones: &Vec<Zone>| zones.iter().map(|zone| zone.regime).collect();
        self.pulleys.iter().map(regimes).collect()
    }

    /// Whether they are the segments of the solution.
    pub(super) fn is_kept(&self) -> bool {
        self.regimes() == self.solved.problem.regimes()
            && (0..self.pulleys.len()).all(|pulley| self.is_in_place(pulley))
    }

    /// Whether the zones of a pulley are cut where segments of the solution are.
    fn is_in_place(&self, pulley: usize) -> bool {
        let (problem, p) = (&self.solved.problem, self.solved.solution.parameters());
        let near = ELSEWHERE * problem.contact_length(pulley, p);
        let pairs = self.pulleys[pulley].windows(2);
        pairs
            .zip(ends(self.solved, pulley))
            .filter(|(pair, _)| is_cut(pair))
            .all(|(pair, end)| (pair[1].from - end).abs() <= near)
    }

    /// A problem with these zones as segments.
    pub(super) fn apply(&self, problem: P) -> P {
        problem.with_zones(&self.regimes())
    }

    /// All zones with their pulleys.
    fn zones(&self) -> impl Iterator<Item = (usize, Zone)> {
        let pulleys = self.pulleys.iter().enumerate();
        pulleys.flat_map(|(pulley, zones)| zones.iter().map(move |zone| (pulley, *zone)))
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

/// Zones that a state shows other than its segments, and that Newton's method refused; none by default.
#[derive(Clone, Debug, Default)]
pub(super) struct Refused(Option<Vec<Vec<Regime>>>);

impl Refused {
    /// Those of a state that was to have the zones that it shows.
    pub(super) fn by<P: BeltProblem>(solved: &Solved<P>) -> Self {
        let cut = Cut::of(solved);
        Self((!cut.is_kept()).then(|| cut.regimes()))
    }

    /// Whether the zones of a state are its segments, but for these.
    pub(super) fn are_all<P: BeltProblem>(&self, solved: &Solved<P>) -> bool {
        let cut = Cut::of(solved);
        cut.is_kept() || self.0.as_ref() == Some(&cut.regimes())
    }
}

/// What is seen of a solution along a pulley, and its zones.
fn cut<P: BeltProblem>(
    solved: &Solved<P>,
    pulley: usize,
    at_ends: bool,
    loose: Loose,
) -> (Vec<Sample>, Vec<Zone>) {
    let problem = &solved.problem;
    let length = problem.contact_length(pulley, solved.solution.parameters());
    let Some(groove) = problem.in_groove(pulley) else {
        let whole = problem.zones(pulley).map(|segment| Zone {
            regime: problem.regime(segment),
            from: 0.0,
            to: length,
        });
        return (Vec::new(), whole.collect());
    };
    let samples = samples(solved, (pulley, groove), at_ends, loose);
    let mut zones = match (problem.has_zones(), loose) {
        (true, Loose::Seen) => friction_zones(&samples, length),
        (true, _) => without_kinks(friction_zones(&samples, length)),
        (false, _) => one_zone(length),
    };
    // Before they are cut, which depends on where they end, and the cuts behind it.
    let near = ELSEWHERE * length;
    keep_junctions(&mut zones, (solved, pulley), near);
    let mut cuts = problem
        .zones(pulley)
        .filter(|&segment| problem.is_cut(segment));
    let margin = length
        * match (sticks(&zones), cuts.next(), cuts.next()) {
            (true, Some(_), _) => SHORTEST_BEHIND_STICK,
            (true, ..) | (.., Some(_)) => SHORTEST_ZONE,
            _ if matches!(groove.law, Law::Sliding { .. }) && locks(&samples) => {
                SHORTEST_CUT_LOCKED
            }
            _ => SHORTEST_CUT,
        };
    let mut zones = match groove.law {
        Law::Normalised { .. } => zones,
        Law::Vector { .. } => {
            let mut zones = match problem.has_junctions() {
                true => zones,
                false => without_short_elastic(zones, length),
            };
            let slipped = |zone: &Zone| {
                let (segment, _) = locate(solved, pulley, 0.5 * (zone.from + zone.to));
                problem.regime(segment) == Regime::Slip
            };
            prolong_elastic(&mut zones, slipped);
            let mut zones = cut_at_turn(zones, &samples, length, CLEAR_TURN, margin);
            join(&mut zones, |regime| regime == Regime::Elastic);
            zones
        }
        // Where the direction is not led yet the belt breaks away elsewhere.
        Law::Sliding { lead, .. } if lead > 0.0 => cut_sliding(zones, &samples, length, margin),
        _ if loose == Loose::Turning && sticks(&zones) => zones,
        _ => cut_at_turn(zones, &samples, length, 0.0, margin),
    };
    keep_junctions(&mut zones, (solved, pulley), near);
    (samples, zones)
}

/// The zones with those of sliding friction cut where a direction that is led needs it.
fn cut_sliding(zones: Vec<Zone>, samples: &[Sample], length: f64, margin: f64) -> Vec<Zone> {
    let zones = cut_at_turn(zones, samples, length, CLEAR_TURN, margin);
    cut_at_breakaway(zones, samples, margin)
}

/// The zones of Coulomb or scalar EPP friction of a contact that locks, from samples along it.
pub(super) fn zones_of(samples: &[Sample], length: f64, has_zones: bool) -> Vec<Zone> {
    let zones = match has_zones {
        true => friction_zones(samples, length),
        false => one_zone(length),
    };
    let margin = match sticks(&zones) {
        true => SHORTEST_BEHIND_STICK,
        false => SHORTEST_ZONE,
    };
    cut_sliding(zones, samples, length, margin * length)
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
    let groove = solved.problem.groove(pulley);
    friction_zones(
        &samples(solved, (pulley, groove), false, Loose::Seen),
        length,
    )
    .into_iter()
    .map(|zone| (zone.regime, [zone.from, zone.to].map(angle)))
    .collect()
}

impl<P: BeltProblem> bvp::Guess for Cut<'_, P> {
    /// The states of the solution; from bristles the direction of their traction.
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let zone = self.zones().nth(segment);
        let (pulley, Zone { from, to, regime }) = zone.expect("a segment for every zone");
        // States may jump at its ends.
        let place = from + s.clamp(INSIDE, 1.0 - INSIDE) * (to - from);
        let Solved { problem, solution } = self.solved;
        let (known, s) = locate(self.solved, pulley, place);
        let mut states = [0.0; MAX_STATES];
        let count = solution.segments()[known].states;
        solution.state(known, s, &mut states[..count]);
        let law = problem.law_states(known).start;
        match (problem.law(), problem.in_groove(pulley)) {
            // In place of both states of bristles there is one of the direction; on the back there is none.
            (Law::Bristle { .. }, Some(_)) => {
                states.copy_within(law + 2..count, law + 1);
                states[law] = self.direction(pulley, place);
            }
            (Law::Bristle { .. }, None) => states.copy_within(law + 1..count, law),
            // Where the belt slips a traction above its limit returns to it.
            (Law::Vector { .. }, Some(groove)) if regime == Regime::Slip => {
                let size = states[law].hypot(states[law + 1]);
                let limit = groove.friction_coefficient;
                if self.at_limit || size > limit {
                    for bristle in &mut states[law..law + 2] {
                        *bristle *= limit / size;
                    }
                }
            }
            _ => {}
        }
        y.copy_from_slice(&states[..y.len()]);
    }

    fn parameters(&self, p: &mut [f64]) {
        let Solved { problem, solution } = self.solved;
        let (first, count) = (problem.first_length(), self.zones().count());
        p[..first].copy_from_slice(&solution.parameters()[..first]);
        for (length, (_, zone)) in p[first..].iter_mut().zip(self.zones()) {
            *length = zone.to - zone.from;
        }
        p[first + count..].fill(problem.behind_lengths(solution));
    }

    /// The nodes of the solution, cut at the zones.
    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        let Solved { problem, solution } = self.solved;
        let p = solution.parameters();
        let places = |pulley: usize| {
            let (mut places, mut before) = (Vec::new(), 0.0);
            for segment in problem.zones(pulley) {
                let length = problem.length(segment, p);
                let nodes = solution.mesh(segment);
                places.extend(nodes.iter().map(|s| before + s * length));
                before += length;
            }
            places
        };
        let places: Vec<_> = (0..problem.pulleys()).map(places).collect();
        let nodes = |(pulley, zone): (usize, Zone)| {
            let within = places[pulley]
                .iter()
                .map(|place| (place - zone.from) / (zone.to - zone.from))
                .filter(|s| (NODE_MARGIN..=1.0 - NODE_MARGIN).contains(s));
            let mut nodes: Vec<f64> = [0.0].into_iter().chain(within).chain([1.0]).collect();
            nodes.dedup_by(|b, a| *b - *a < NODE_MARGIN);
            nodes
        };
        Some(self.zones().map(nodes).collect())
    }
}
