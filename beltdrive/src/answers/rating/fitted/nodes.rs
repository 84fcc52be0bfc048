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
/// polynomial through all neighbours with that reason of what they are per tension without load, in the square of the
/// speed: this is what the momentum flow is about proportional to. Between neighbours with two reasons they are straight.
pub(super) struct Nodes {
    nodes: Vec<Node>,
    /// The neighbours with one reason.
    runs: Vec<Run>,
}

/// Neighbours with one reason.
struct Run {
    places: Range<usize>,
    /// What the last one solved shows of the polynomial through the others.
    error: f64,
}

/// So many nodes have a polynomial that holds beyond the last of them.
const ENOUGH: usize = 4;

impl Nodes {
    /// Of nodes in the order in which they were solved.
    pub(super) fn new(solved: impl Iterator<Item = Node>) -> Self {
        let mut nodes: Vec<(usize, Node)> = solved.enumerate().collect();
        nodes.sort_by(|(_, one), (_, other)| one.load.speed.total_cmp(&other.load.speed));
        let is_like = |(_, one): &(usize, Node), (_, other): &(usize, Node)| {
            one.load.end.is_like(&other.load.end)
        };
        let mut from = 0;
        let runs = nodes.chunk_by(is_like).map(|run| {
            let places = from..from + run.len();
            from = places.end;
            let last = run.iter().max_by_key(|(order, _)| *order);
            let error = last.map_or(f64::INFINITY, |(_, node)| node.off);
            Run { places, error }
        });
        Self {
            runs: runs.collect(),
            nodes: nodes.into_iter().map(|(_, node)| node).collect(),
        }
    }

    /// The last speed; 0 without nodes.
    pub(super) fn last(&self) -> f64 {
        self.nodes.last().map_or(0.0, |node| node.load.speed)
    }

    /// The largest error of the limits themselves.
    pub(super) fn own_error(&self) -> f64 {
        let errors = self.nodes.iter().map(|node| node.load.error);
        errors.fold(0.0, f64::max)
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

    /// The polynomials of a run per tension without load.
    fn of_run(&self, run: &Run, speed: f64, tension: f64) -> Predicted<'_> {
        let nodes = &self.nodes[run.places.clone()];
        let place = |node: &Node| node.load.speed * node.load.speed;
        let at = speed * speed;
        let (mut factor, mut torque) = (0.0, 0.0);
        for (index, node) in nodes.iter().enumerate() {
            let others = nodes
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != index);
            let weight: f64 = others
                .map(|(_, other)| (at - place(other)) / (place(node) - place(other)))
                .product();
            factor += weight * node.load.factor / node.tension;
            torque += weight * node.load.torque / node.tension;
        }
        Predicted {
            factor: factor * tension,
            torque: torque * tension,
            end: &nodes[0].load.end,
            error: run.error,
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
            Some(run) if is_inside || run.places.len() >= ENOUGH => {
                self.of_run(run, speed, tension)
            }
            _ if is_inside => self.between([low, high], speed, tension),
            _ => self.beyond(low, tension),
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
            error: node.off,
        }
    }

    /// The limit between two nodes, per tension without load straight in the square of the speed.
    fn between(&self, [low, high]: [usize; 2], speed: f64, tension: f64) -> Predicted<'_> {
        let [low, high] = [&self.nodes[low], &self.nodes[high]];
        let [from, to] = [low, high].map(|node| node.load.speed * node.load.speed);
        let share = (speed * speed - from) / (to - from);
        let straight = |of: fn(&RatedLoad) -> f64| {
            let [low, high] = [low, high].map(|node| of(&node.load) / node.tension);
            [
                tension * (low + share * (high - low)),
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
            // It lies between the two, as far as it is known.
            error: change.max(low.off.min(high.off)),
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
                .map(|node| node.load.speed * node.load.speed)
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
