//! The belt along a whole pulley, from its entry to its exit.

use super::arc::Point;
use super::entry::Entering;
use super::exit::{Leaving, leaving};
use super::rest::Rest;
use crate::SpanTension;
use crate::vbelt::groove::{ANGLE, INCLINATION, LAW, PENETRATION, TENSION};
use crate::vbelt::zones::{Zone, zones_of};
use crate::vbelt::{EndAngles, Regime, deepening};
use std::f64::consts::{PI, TAU};

/// The belt along a segment, from its beginning.
pub(super) type Course = Vec<Point>;

/// λ times the least arc on which the belt is locked: on shorter ones what is left of the entry reaches the exit.
const LOCKED: f64 = 2.0;
/// First step of the places on that arc over 1/λ, and by how much each is longer than the one before.
const STEP: f64 = 0.25;
const LONGER: f64 = 1.3;

/// Index of the displacement u among the states of a point.
const DISPLACEMENT: usize = LAW + 1;

/// A pulley on which the belt locks.
pub(super) struct Pulley {
    rest: Rest,
    entry: Vec<Point>,
    /// The span behind the exit.
    span: SpanTension,
    leaving: Leaving,
    /// Length of the arc on which it is locked.
    locked: f64,
}

impl Pulley {
    /// The pulley with a belt that comes to rest and leaves into a span, with half a turn.
    pub(super) fn new((rest, entry): Entering, span: SpanTension) -> Option<Self> {
        let locked = PI - entry[entry.len() - 1].states[ANGLE];
        let displacement = rest.displacement + rest.growing() * locked;
        let leaving = leaving(&rest, span, displacement)?;
        Some(Self {
            rest,
            entry,
            span,
            leaving,
            locked,
        })
    }

    /// The inclinations at both ends.
    pub(super) fn angles(&self) -> EndAngles<f64> {
        EndAngles {
            entry: self.entry[0].states[INCLINATION],
            exit: self.leaving.theta(),
        }
    }

    /// The slip at which the belt breaks away.
    pub(super) fn slip(&self) -> f64 {
        self.leaving.slip
    }

    /// Lets the belt sweep an angle on the pulley: by which share of the displacement with which it breaks loose that differs from
    /// the one that it leaves with.
    pub(super) fn sweep(&mut self, wrap: f64) -> f64 {
        let swept = |arc: &[Point]| arc[arc.len() - 1].states[ANGLE] - arc[0].states[ANGLE];
        let left = wrap - swept(&self.entry) - swept(&self.leaving.exit);
        self.locked = left * (1.0 - self.rest.depth);
        match self.rest.is_held {
            true => (self.leaving.displacement / self.displacement() - 1.0).abs(),
            false => 0.0,
        }
    }

    /// Where the belt leaves, corrected for the displacement that it breaks loose with.
    pub(super) fn correct(&mut self) -> Option<()> {
        if self.rest.is_held {
            let missed = self.displacement() - self.leaving.displacement;
            self.leaving = self.leaving.corrected(&self.rest, self.span, missed)?;
        }
        Some(())
    }

    /// The displacement that it breaks loose with.
    fn displacement(&self) -> f64 {
        self.rest.displacement + self.rest.growing() * self.locked
    }

    /// The zones with the belt along each, if it locks.
    pub(super) fn zones(&self) -> Option<Vec<(Regime, Course)>> {
        let whole = self.whole()?;
        let groove = &self.rest.rim.groove;
        let samples: Vec<_> = whole
            .iter()
            .map(|point| self.rest.rim.sample(point))
            .collect();
        let length = whole[whole.len() - 1].s;
        let zones = zones_of(&samples, length, groove.elastic().is_some());
        let with_course = |zone: Zone| (zone.regime, course(&whole, [zone.from, zone.to]));
        Some(zones.into_iter().map(with_course).collect())
    }

    /// The belt along the whole pulley, if it locks.
    fn whole(&self) -> Option<Vec<Point>> {
        let least = match self.rest.is_held {
            true => 0.0,
            false => LOCKED / self.rest.rate,
        };
        if self.locked.is_nan() || self.locked < least {
            return None;
        }
        let entry = moved(&self.entry, 0.0, 0.0);
        let enters = entry[entry.len() - 1];
        let turned = self.locked / (1.0 - self.rest.depth);
        let exit = moved(
            &self.leaving.exit,
            enters.s + self.locked,
            enters.states[ANGLE] + turned,
        );
        let between = match self.rest.is_held {
            true => self.held(enters),
            false => self.hardly_slipping([enters, exit[0]]),
        };
        let mut whole = [entry, between, exit].concat();
        if self.rest.rim.groove.elastic().is_some() {
            self.carry_displacement(&mut whole);
        }
        let mut before = PI;
        for point in &mut whole {
            let direction = &mut point.states[LAW];
            *direction += TAU * ((before - *direction) / TAU).round();
            before = *direction;
        }
        Some(whole)
    }

    /// The arc on which friction holds the belt.
    fn held(&self, enters: Point) -> Vec<Point> {
        let Rest {
            rim,
            tractive,
            depth,
            ..
        } = self.rest;
        let deep = deepening(rim.speed) * depth;
        let sweep = 1.0 / (1.0 - depth);
        let at = |share: f64| {
            let s = share * self.locked;
            let mut states = enters.states;
            (states[TENSION], states[INCLINATION], states[PENETRATION]) = (tractive, 0.0, deep);
            states[ANGLE] += s * sweep;
            states[LAW] = PI;
            let mut rates = [0.0; DISPLACEMENT + 1];
            rates[ANGLE] = sweep;
            Point {
                s: enters.s + s,
                states,
                rates,
                sticks: true,
            }
        };
        [0.0, 0.5, 1.0].map(at).to_vec()
    }

    /// The arc on which the belt is locked with full friction: what is left of the entry, and what becomes of the exit.
    fn hardly_slipping(&self, [enters, leaves]: [Point; 2]) -> Vec<Point> {
        let locked = self.locked;
        let Rest {
            rim,
            rate,
            depth,
            tractive,
            turning,
            ..
        } = self.rest;
        let at_rest = deepening(rim.speed) * depth;
        let beside = [enters, leaves].map(|point| {
            let [tension, theta, deep, ..] = point.states;
            [tension - tractive, theta, deep - at_rest]
        });
        let mut places = Vec::new();
        let (mut place, mut step) = (STEP / rate, STEP / rate);
        while place < 0.5 * locked {
            places.push(place);
            step *= LONGER;
            place += step;
        }
        let from_exit: Vec<_> = places.iter().rev().map(|place| locked - place).collect();
        places.extend(from_exit);
        let point = |s: f64| {
            let [decayed, grown] = [-rate * s, rate * (s - locked)].map(f64::exp);
            let rest = |i: usize| decayed * beside[0][i] + grown * beside[1][i];
            let rest_rate = |i: usize| rate * (grown * beside[1][i] - decayed * beside[0][i]);
            let mut states = [0.0; DISPLACEMENT + 1];
            states[TENSION] = tractive + rest(0);
            states[INCLINATION] = rest(1);
            states[PENETRATION] = at_rest + rest(2);
            states[ANGLE] = enters.states[ANGLE] + s / (1.0 - depth);
            states[LAW] = PI - turning * rest(1);
            let mut rates = [0.0; DISPLACEMENT + 1];
            rates[TENSION] = rest_rate(0);
            rates[INCLINATION] = rest_rate(1);
            rates[PENETRATION] = rest_rate(2);
            rates[ANGLE] = 1.0 / (1.0 - depth);
            rates[LAW] = -turning * rest_rate(1);
            Point {
                s: enters.s + s,
                states,
                rates,
                sticks: false,
            }
        };
        places.into_iter().map(point).collect()
    }

    /// Carries the displacement of elastic friction on from the entry, where it is known: along every step that of the cubic
    /// with its rate T − `T_o` at both ends and the slopes of that.
    fn carry_displacement(&self, points: &mut [Point]) {
        let rim = &self.rest.rim;
        let growing = |point: &Point| rim.growing(point.states[TENSION]);
        // T is linear in F.
        let slope = rim.growing(1.0) - rim.growing(0.0);
        for index in 1..points.len() {
            let [before, after] = [points[index - 1], points[index]];
            let length = after.s - before.s;
            let bent = (before.rates[TENSION] - after.rates[TENSION]) * slope * length / 6.0;
            let mean = 0.5 * (growing(&before) + growing(&after) + bent);
            let point = &mut points[index];
            point.states[DISPLACEMENT] = before.states[DISPLACEMENT] + mean * length;
            point.rates[DISPLACEMENT] = growing(&after);
        }
    }
}

/// The belt along a segment between two places, from its beginning.
fn course(points: &[Point], [from, to]: [f64; 2]) -> Course {
    let mut course = vec![at(points, from, false)];
    let inside = points.iter().filter(|point| from < point.s && point.s < to);
    course.extend(inside);
    course.push(at(points, to, true));
    moved(&course, 0.0, course[0].states[ANGLE])
}

/// The belt at a place, as it arrives there or as it leaves it.
pub(super) fn at(points: &[Point], s: f64, arrives: bool) -> Point {
    let next = match arrives {
        true => points.partition_point(|point| point.s < s),
        false => points.partition_point(|point| point.s <= s),
    };
    let next = next.clamp(1, points.len() - 1);
    let [before, after] = [points[next - 1], points[next]];
    let share = (s - before.s) / (after.s - before.s);
    Point {
        s,
        states: cubic(&before, &after, s),
        rates: std::array::from_fn(|i| {
            before.rates[i] + share * (after.rates[i] - before.rates[i])
        }),
        sticks: before.sticks,
    }
}

/// The states at a place between two points, on the cubic with the states and rates there (Hermite).
fn cubic(before: &Point, after: &Point, place: f64) -> [f64; LAW + 2] {
    let length = after.s - before.s;
    let share = (place - before.s) / length;
    let rest = 1.0 - share;
    std::array::from_fn(|i| {
        let [from, to] = [before, after].map(|point| point.states[i]);
        let [leaves, arrives] = [before, after].map(|point| length * point.rates[i]);
        let bent = rest * (leaves - (to - from)) - share * (arrives - (to - from));
        rest * from + share * to + share * rest * bent
    })
}

/// An arc that begins at a place and a swept angle.
fn moved(arc: &[Point], s: f64, angle: f64) -> Vec<Point> {
    let first = arc[0];
    let moved = arc.iter().map(|point| {
        let mut moved = *point;
        moved.s += s - first.s;
        moved.states[ANGLE] += angle - first.states[ANGLE];
        moved
    });
    moved.collect()
}
