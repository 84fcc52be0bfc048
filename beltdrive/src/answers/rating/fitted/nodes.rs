//! The limits at the speeds at which they were solved, and between them.

use super::super::{RatedLoad, RatingStretch};
use crate::results::largest_load::LoadEnd;
use std::ops::Range;

/// A limit that was solved.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) load: RatedLoad,
    /// Tractive tension without load, N.
    pub(super) tension: f64,
    /// By how much the nodes before it predicted another load, relative; infinite where there were none.
    pub(super) off: f64,
}

/// A limit that was not.
pub(super) struct Predicted<'n> {
    pub(super) factor: f64,
    pub(super) torque: f64,
    pub(super) end: &'n LoadEnd,
    /// Its relative error, as it is expected.
    pub(super) error: f64,
}

/// The nodes in the order of their speeds. Between neighbours with the same reason factor and torque follow by the
/// polynomial in the square of the speed through all neighbours with that reason, of what they are per tension without
/// load, which the square of the speed changes in proportion, or of themselves, as that of an overhang, which hardly
/// depends on the tension. They are straight between neighbours with two reasons, and where that polynomial is none.
pub(super) struct Nodes {
    nodes: Vec<Node>,
    /// The neighbours with one reason.
    runs: Vec<Run>,
}

/// Neighbours with one reason.
struct Run {
    places: Range<usize>,
    per: Per,
    /// Whether the polynomial says anything between the nodes.
    is_smooth: bool,
    /// The relative error of the limits themselves.
    own: f64,
    /// That of the polynomial: what the last one solved, or a node that is left out, shows of those through the others.
    error: f64,
}

/// What a polynomial has the limit over: with this it hardly changes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Per {
    /// The tension without load, of which a belt that slips carries a share.
    Tension,
    /// Nothing, where the belt overhangs itself: it has locked in its groove, whatever the tension without load.
    One,
}

/// A polynomial that misses a node between others by more than this without it, relative, is none. Those of the shipped
/// drives miss by 0.02 at most; over the wrong quantity it was 1 and more, and torques between the nodes were negative.
const WILD: f64 = 0.1;

impl Per {
    fn of(self, tension: f64) -> f64 {
        match self {
            Self::Tension => tension,
            Self::One => 1.0,
        }
    }

    /// The value at a place of the polynomial through limits at others, over that with a tension there.
    fn polynomial<'n>(
        self,
        nodes: impl Iterator<Item = &'n Node> + Clone,
        of: fn(&RatedLoad) -> f64,
        (at, tension): (f64, f64),
    ) -> f64 {
        let terms = nodes.clone().enumerate().map(|(index, node)| {
            let others = nodes.clone().enumerate();
            let others = others.filter(|(other, _)| *other != index);
            let weight: f64 = others
                .map(|(_, other)| (at - other.place()) / (node.place() - other.place()))
                .product();
            weight * of(&node.load) / self.of(node.tension)
        });
        terms.sum::<f64>() * self.of(tension)
    }

    /// The factor at a place by all nodes but one.
    fn without(self, nodes: &[Node], left_out: usize, at: (f64, f64)) -> f64 {
        let others = nodes[..left_out].iter().chain(&nodes[left_out + 1..]);
        self.polynomial(others, |load| load.factor, at)
    }

    /// By how much the polynomials through all others miss a node between them, relative, at most.
    fn missed(self, nodes: &[Node]) -> f64 {
        let inner = 1..nodes.len().max(1) - 1;
        let missed = inner.map(|left_out| {
            let node = &nodes[left_out];
            let found = self.without(nodes, left_out, (node.place(), node.tension));
            (found / node.load.factor - 1.0).abs()
        });
        missed.fold(0.0, f64::max)
    }
}

/// The largest error of limits themselves.
fn own_error(nodes: &[Node]) -> f64 {
    let errors = nodes.iter().map(|node| node.load.error);
    errors.fold(0.0, f64::max)
}

impl Node {
    /// The place of a polynomial: the square of the speed.
    fn place(&self) -> f64 {
        self.load.speed * self.load.speed
    }
}

/// So many nodes have a polynomial that holds beyond the last of them, and without one of them.
const ENOUGH: usize = 4;

impl Nodes {
    /// Of nodes in the order in which they were solved.
    pub(super) fn new(solved: impl Iterator<Item = Node>) -> Self {
        let mut nodes: Vec<(usize, Node)> = solved.enumerate().collect();
        nodes.sort_by(|(_, one), (_, other)| one.load.speed.total_cmp(&other.load.speed));
        let (orders, nodes): (Vec<usize>, Vec<Node>) = nodes.into_iter().unzip();
        let is_like = |one: &Node, other: &Node| one.load.end.is_like(&other.load.end);
        let mut from = 0;
        let runs = nodes.chunk_by(is_like).map(|run| {
            let places = from..from + run.len();
            from = places.end;
            let last = places.clone().max_by_key(|index| orders[*index]);
            let last = last.map_or(f64::INFINITY, |index| nodes[index].off);
            let per = match run[0].load.end {
                LoadEnd::Overhangs(_) => Per::One,
                _ => Per::Tension,
            };
            let missed = per.missed(run);
            Run {
                places,
                per,
                is_smooth: missed <= WILD,
                own: own_error(run),
                error: match run.len() >= ENOUGH {
                    true => last.min(missed),
                    false => last,
                },
            }
        });
        Self {
            runs: runs.collect(),
            nodes,
        }
    }

    /// The last speed; 0 without nodes.
    pub(super) fn last(&self) -> f64 {
        self.nodes.last().map_or(0.0, |node| node.load.speed)
    }

    /// The largest error of the polynomials.
    pub(super) fn error(&self) -> f64 {
        self.runs.iter().map(|run| run.error).fold(0.0, f64::max)
    }

    /// Whether there is a node within a distance of a speed.
    pub(super) fn has(&self, speed: f64, distance: f64) -> bool {
        let mut nodes = self.nodes.iter();
        nodes.any(|node| (node.load.speed - speed).abs() <= distance)
    }

    /// The polynomials of a run. They are as far off as they would be without the nearest node: between nodes, and beyond
    /// the last one, near lift-off by far more than the last one solved shows, of `kim2009-epp` by 0.01 to 0.1. Towards
    /// standstill the error of a polynomial grows from its first node on as the distance from there.
    fn of_run(&self, run: &Run, speed: f64, tension: f64) -> Predicted<'_> {
        let nodes = &self.nodes[run.places.clone()];
        let at = (speed * speed, tension);
        let value = |of: fn(&RatedLoad) -> f64| run.per.polynomial(nodes.iter(), of, at);
        let distance = |index: &usize| (nodes[*index].place() - at.0).abs();
        let nearest = { 0..nodes.len() }
            .min_by(|one, other| distance(one).total_cmp(&distance(other)))
            .unwrap_or(0);
        let factor = value(|load| load.factor);
        let without = run.per.without(nodes, nearest, at);
        let [first, last] = [0, nodes.len() - 1].map(|index| nodes[index].place());
        let share = match at.0 < first {
            true => (first - at.0) / (last - first),
            false => 1.0,
        };
        let shown = share * (without / factor - 1.0).abs();
        let shown = match nodes.len() >= ENOUGH {
            true => shown,
            false => shown.max(run.error),
        };
        Predicted {
            factor,
            torque: value(|load| load.torque),
            end: &nodes[0].load.end,
            error: shown.max(run.own),
        }
    }

    /// The limit at a speed, with the tractive tension without load there.
    pub(super) fn at(&self, speed: f64, tension: f64) -> Predicted<'_> {
        let last = self.nodes.len() - 1;
        let above = self.nodes.partition_point(|node| node.load.speed <= speed);
        let [low, high] = [above.saturating_sub(1), above.min(last)];
        let run = |index: usize| self.runs.iter().find(|run| run.places.contains(&index));
        let is_inside = low != high;
        match run(low).filter(|run| run.places.contains(&high)) {
            Some(run) if run.is_smooth && (is_inside || run.places.len() >= ENOUGH) => {
                self.of_run(run, speed, tension)
            }
            Some(run) if is_inside => self.between(run.per, [low, high], speed, tension),
            None => self.between(Per::Tension, [low, high], speed, tension),
            Some(_) => self.beyond(low, tension),
        }
    }

    /// The limit beyond the first or last node: it goes with the power of the tension without load with which it went
    /// from the neighbour with the same reason to that. In proportion to the tension the limit of `kim2009-epp` at 90 m/s,
    /// where an eighth of the tension is left, was expected 13 % too high, and took twice as long.
    fn beyond(&self, nearest: usize, tension: f64) -> Predicted<'_> {
        let node = &self.nodes[nearest];
        let neighbour = self.nodes.get(if nearest == 0 { 1 } else { nearest - 1 });
        let neighbour = neighbour.filter(|other| other.load.end.is_like(&node.load.end));
        let at = |of: fn(&RatedLoad) -> f64| {
            let powers = neighbour.map(|other| {
                let [loads, tensions] = [
                    of(&other.load) / of(&node.load),
                    other.tension / node.tension,
                ];
                loads.ln() / tensions.ln()
            });
            let power = powers.filter(|power| power.is_finite()).unwrap_or(1.0);
            of(&node.load) * (tension / node.tension).powf(power)
        };
        Predicted {
            factor: at(|load| load.factor),
            torque: at(|load| load.torque),
            end: &node.load.end,
            error: node.off.max(node.load.error),
        }
    }

    /// The limit between two nodes, straight in the square of the speed: it lies between the two, as far as it is known.
    fn between(
        &self,
        per: Per,
        [low, high]: [usize; 2],
        speed: f64,
        tension: f64,
    ) -> Predicted<'_> {
        let [low, high] = [low, high].map(|index| &self.nodes[index]);
        let share = (speed * speed - low.place()) / (high.place() - low.place());
        let straight = |of: fn(&RatedLoad) -> f64| {
            let [low, high] = [low, high].map(|node| of(&node.load) / per.of(node.tension));
            [
                per.of(tension) * (low + share * (high - low)),
                (high / low).ln().abs(),
            ]
        };
        let [factor, change] = straight(|load| load.factor);
        let [torque, _] = straight(|load| load.torque);
        Predicted {
            factor,
            torque,
            end: if share < 0.5 {
                &low.load.end
            } else {
                &high.load.end
            },
            error: change
                .max(low.off.min(high.off))
                .max(low.load.error)
                .max(high.load.error),
        }
    }

    /// About the speeds at which the reason changes: between two nodes.
    pub(super) fn changes(&self) -> Vec<f64> {
        let pairs = self.runs.windows(2);
        let middle = |pair: &[Run]| {
            let places = [pair[0].places.end - 1, pair[1].places.start];
            let [from, to] = places.map(|index| self.nodes[index].load.speed);
            f64::midpoint(from * from, to * to).sqrt()
        };
        pairs.map(middle).collect()
    }

    /// The speeds, one of each run whose error is not `good`, at which its polynomial says least: where the product of the distances to its nodes
    /// is largest in the middle between two of them.
    pub(super) fn doubtful(&self, good: f64) -> Vec<f64> {
        let doubtful = self.runs.iter().filter(|run| run.error >= good);
        let doubtful = doubtful.filter_map(|run| {
            let places: Vec<f64> = { self.nodes[run.places.clone()].iter() }
                .map(Node::place)
                .collect();
            let middles = places
                .windows(2)
                .map(|pair| f64::midpoint(pair[0], pair[1]));
            let doubt =
                |at: f64| -> f64 { places.iter().map(|place| (at - place).abs().ln()).sum() };
            let most = middles.max_by(|one, other| doubt(*one).total_cmp(&doubt(*other)));
            most.map(f64::sqrt)
        });
        doubtful.collect()
    }

    /// The ranges of speed with one reason, within a range.
    pub(super) fn stretches(&self, [from, to]: [f64; 2]) -> Vec<RatingStretch> {
        let mut ends = vec![from];
        ends.extend(self.changes());
        ends.push(to);
        let runs = self.runs.iter().zip(ends.windows(2));
        runs.map(|(run, ends)| RatingStretch {
            range: [ends[0], ends[1]],
            end: self.nodes[run.places.start].load.end.clone(),
        })
        .collect()
    }
}
