//! The rating of a V-belt, whose limit is solved at some speeds.

mod nodes;

use super::range::{RatingEnd, Speeds};
use super::{LOCATED, RatedLoad, Rating, at_lift_off, is_at_end, places};
use crate::SolveError;
use crate::answers::shares::each;
use crate::mechanics::maximum;
use crate::model::NearLargest;
use nodes::{Node, Nodes};
use std::f64::consts::PI;
use std::sync::Mutex;

/// Speeds at which the limit is solved at first, an odd number.
const FIRST: usize = 5;

/// Most rounds of further speeds.
const ROUNDS: usize = 5;

/// The polynomials are good enough once they predict further limits to this, relative: no friction is known better.
const GOOD: f64 = 5e-4;

/// How near to lift-off the limit is solved, as a share of the square of the speed there: nearer, where less than a fifth
/// of the tension is left, states are so hard to find that one takes as long as all others.
const NEAREST: f64 = 0.8;

/// How near to lift-off it is looked whether a load is still the largest, as shares of the square of the speed there. The
/// tension falls by less than a half from one to the next: by more, as from 0.9 to 0.95, the last one of `kim2009-epp` had to
/// be found from nothing, in 4 s and to 2 %.
const PROBED: [f64; 2] = [0.88, 0.93];

/// Where a speed is as near to a solved one as this, as a share of the range, another says little more.
const SAME: f64 = 0.02;

/// How nearly the last speed with a largest load is found, relative.
const NEAR: f64 = 5e-3;

/// A limit that was solved, and what others are found from.
type Solved = (Node, NearLargest);

/// Who is told of progress.
type Told<'s> = &'s mut (dyn FnMut(f64, &str) + Send);

/// The search for the limits.
struct Fit<'s> {
    speeds: &'s Speeds<'s>,
    range: [f64; 2],
    /// Whether the belt lifts off at the end of the range.
    lifts_off: bool,
    /// How many speeds were tried, and who is told.
    done: Mutex<(f64, Told<'s>)>,
    solved: Vec<Solved>,
    missing: Vec<(f64, SolveError)>,
}

pub(super) fn rating(
    speeds: &Speeds<'_>,
    range: [f64; 2],
    end: RatingEnd,
    stated: f64,
    progress: &mut (dyn FnMut(f64, &str) + Send),
) -> Result<Rating, SolveError> {
    let mut fit = Fit {
        speeds,
        range,
        lifts_off: matches!(end, RatingEnd::LiftsOff { .. }),
        done: Mutex::new((0.0, progress)),
        solved: Vec::new(),
        missing: Vec::new(),
    };
    fit.first(stated)?;
    for _ in 0..ROUNDS {
        let nodes = fit.nodes();
        let asked = std::iter::once(fit.optimum(&nodes)?).chain(nodes.changes());
        let asked = asked.chain(nodes.doubtful(GOOD));
        let width = range[1] - range[0];
        let asked = asked.filter(|speed| !nodes.has(*speed, SAME * width));
        let asked: Vec<f64> = asked.chain(fit.middle()).collect();
        if asked.is_empty() {
            break;
        }
        fit.solve(&asked);
        if fit.nodes().error() < GOOD && fit.middle().is_none() {
            break;
        }
    }
    let nodes = fit.nodes();
    let (range, end) = match fit.ceiling() {
        Some(_) => {
            let speed = nodes.last();
            ([range[0], speed], RatingEnd::SlipsEverMore { speed })
        }
        None => (range, end),
    };
    let [optimum, stated] = fit.loads(&nodes, [fit.optimum(&nodes)?, stated]);
    let optimum = match optimum {
        Ok(optimum) => optimum,
        // Beyond the last speed with a limit the power may seem to grow.
        Err(error) => fit.strongest().cloned().ok_or(error)?,
    };
    let points = places(range).filter_map(|speed| match &end {
        RatingEnd::LiftsOff { speed: last } if speed == *last => Some(at_lift_off(speed, speeds)),
        _ => fit.load(&nodes, speed),
    });
    let points: Vec<_> = points.collect();
    let solved = std::iter::once(&optimum).chain(stated.as_ref().ok());
    let errors = points.iter().chain(solved).map(|point| point.error);
    Ok(Rating {
        drive: speeds.drive.clone(),
        error: errors.fold(0.0, f64::max),
        points,
        optimum_at_end: is_at_end(&optimum, range),
        optimum,
        stated,
        stretches: nodes.stretches(range),
        end,
        missing: fit.missing,
    })
}

impl Fit<'_> {
    /// The limit at a speed, from that at another one and as nodes tell it.
    fn limit(
        &self,
        speed: f64,
        near: Option<&Solved>,
        nodes: &Nodes,
    ) -> Result<Solved, (f64, SolveError)> {
        let found = self.speeds.pressing(speed).and_then(|tension| {
            let expected = match near {
                Some(_) => nodes.at(speed, tension).factor,
                None => self.speeds.expected(speed)?,
            };
            let state = near.map(|(_, state)| state);
            let (load, state) = self.speeds.largest(speed, state, expected)?;
            let off = match near {
                Some(_) => (expected / load.factor - 1.0).abs(),
                None => f64::INFINITY,
            };
            Ok((Node { load, tension, off }, state))
        });
        if let Ok(mut done) = self.done.lock() {
            done.0 += 1.0;
            // Usually there are two speeds near lift-off, that of the drive file, the optimum and one more.
            let share = done.0 / (FIRST as f64 + 5.0);
            (done.1)(share.min(1.0), "speeds");
        }
        found.map_err(|error| (speed, error))
    }

    fn keep(&mut self, found: impl IntoIterator<Item = Result<Solved, (f64, SolveError)>>) {
        for found in found {
            match found {
                Ok(solved) => self.solved.push(solved),
                Err(failed) => self.missing.push(failed),
            }
        }
    }

    fn nodes(&self) -> Nodes {
        let nodes = self.solved.iter().map(|(node, _)| node.clone());
        let last = self.ceiling().unwrap_or(f64::INFINITY);
        Nodes::new(nodes.filter(|node| node.load.speed < last))
    }

    /// The lowest speed from which on pulleys slip ever more under more load, up to one at which the driver does; none if
    /// they do so at every lower speed, where centrifugal force is not the reason.
    fn ceiling(&self) -> Option<f64> {
        let mut loads: Vec<&RatedLoad> = self.solved.iter().map(|(node, _)| &node.load).collect();
        loads.sort_by(|one, other| one.speed.total_cmp(&other.speed));
        let driver = Some(self.speeds.drive.driver());
        let slows = |load: &&RatedLoad| load.end.is_growing() && load.end.pulley() == driver;
        let of_driver = loads.iter().position(slows)?;
        let lower = loads[..=of_driver].iter().rev();
        let growing = lower.take_while(|load| load.end.is_growing());
        let lowest = growing.last().map(|load| load.speed);
        lowest.filter(|speed| *speed > loads[0].speed)
    }

    /// The middle between the last speed with a largest load and the first without one, until they are near.
    fn middle(&self) -> Option<f64> {
        let ceiling = self.ceiling()?;
        let last = self.nodes().last().max(self.range[0]);
        (ceiling - last > NEAR * ceiling).then(|| f64::midpoint(last, ceiling))
    }

    /// The first speeds, in ascending order: Chebyshev's places in the square of the speed, and that of the drive file,
    /// alone where it is near one of them.
    fn first_speeds(&self, stated: f64) -> Vec<f64> {
        let [low, high] = self.range.map(|speed| speed * speed);
        let nearest = if self.lifts_off { NEAREST } else { 1.0 };
        let chebyshev = (0..FIRST).map(|index| {
            let angle = PI * (index as f64 + 0.5) / FIRST as f64;
            let high = high * nearest;
            f64::midpoint(low, high) - 0.5 * (high - low) * angle.cos()
        });
        let probed = PROBED
            .iter()
            .filter(|_| self.lifts_off)
            .map(|share| share * high);
        let mut speeds: Vec<f64> = chebyshev.chain(probed).map(f64::sqrt).collect();
        let [from, to] = self.range;
        if (from..to).contains(&stated) {
            speeds.retain(|speed| (speed - stated).abs() > SAME * (to - from));
            speeds.push(stated);
        }
        speeds.sort_by(f64::total_cmp);
        speeds
    }

    /// The limits at the first speeds, from a middle one to both ends.
    fn first(&mut self, stated: f64) -> Result<(), SolveError> {
        let speeds = self.first_speeds(stated);
        let (below, above) = speeds.split_at(speeds.len() / 2);
        let first = self.limit(above[0], None, &self.nodes());
        let begin = first.as_ref().ok();
        let both = each(2, |side| {
            let mut line: Vec<Solved> = begin.cloned().into_iter().collect();
            let speeds: Vec<f64> = match side {
                0 => below.iter().rev().copied().collect(),
                _ => above[1..].to_vec(),
            };
            let found = speeds.into_iter().map(|speed| {
                let nodes = Nodes::new(line.iter().map(|(node, _)| node.clone()));
                let next = self.limit(speed, line.last(), &nodes);
                line.extend(next.as_ref().ok().cloned());
                next
            });
            found.collect::<Vec<_>>()
        });
        self.keep(std::iter::once(first).chain(both.into_iter().flatten()));
        match (self.solved.is_empty(), self.missing.first()) {
            (true, Some((_, error))) => Err(error.clone()),
            _ => Ok(()),
        }
    }

    /// Solves the limits at speeds, each from the nearest one.
    fn solve(&mut self, asked: &[f64]) {
        let nodes = self.nodes();
        let found = each(asked.len(), |index| {
            self.limit(asked[index], self.nearest(asked[index]), &nodes)
        });
        self.keep(found);
    }

    /// The solved speed nearest to another in the logarithm of the tension without load, with which the limit goes.
    fn nearest(&self, speed: f64) -> Option<&Solved> {
        let tension = self.speeds.pressing(speed).ok()?;
        let distance = |(node, _): &Solved| (node.tension / tension).ln().abs();
        let solved = self.solved.iter();
        solved.min_by(|one, other| distance(one).total_cmp(&distance(other)))
    }

    /// The speed of the largest power, as the nodes tell it.
    fn optimum(&self, nodes: &Nodes) -> Result<f64, SolveError> {
        if nodes.last() == 0.0 {
            return Err(SolveError::NotFound {
                what: "largest load",
            });
        }
        let last = match self.ceiling() {
            Some(_) => nodes.last(),
            None => f64::INFINITY,
        };
        let power = |speed: f64| match self.speeds.pressing(speed) {
            Ok(tension) if speed <= last => speed * nodes.at(speed, tension).torque,
            _ => 0.0,
        };
        let speeds: Vec<f64> = places(self.range).collect();
        let powers: Vec<f64> = speeds.iter().map(|speed| power(*speed)).collect();
        let best = (0..speeds.len()).max_by(|one, other| powers[*one].total_cmp(&powers[*other]));
        let best = best.unwrap_or(0);
        let beside = [best.saturating_sub(1), (best + 1).min(speeds.len() - 1)];
        let located = maximum::between(power, beside.map(|index| speeds[index]), LOCATED);
        match power(located) > powers[best] {
            true => Ok(located),
            false => Ok(speeds[best]),
        }
    }

    /// The limits at two speeds, solved.
    fn loads(&self, nodes: &Nodes, speeds: [f64; 2]) -> [Result<RatedLoad, SolveError>; 2] {
        let mut loads = each(2, |index| {
            let speed = speeds[index];
            match self.nearest(speed) {
                Some((node, _)) if node.load.speed == speed => Ok(node.load.clone()),
                near => {
                    let found = self.limit(speed, near, nodes);
                    found.map(|(node, _)| node.load).map_err(|(_, error)| error)
                }
            }
        });
        let last = loads.pop();
        [loads.pop(), last].map(|load| {
            load.unwrap_or(Err(SolveError::NotFound {
                what: "largest load",
            }))
        })
    }

    /// The solved limit with the largest power.
    fn strongest(&self) -> Option<&RatedLoad> {
        let loads = self.solved.iter().map(|(node, _)| &node.load);
        loads.max_by(|one, other| one.power.total_cmp(&other.power))
    }

    /// The limit at a speed by the nodes.
    fn load(&self, nodes: &Nodes, speed: f64) -> Option<RatedLoad> {
        let tension = self.speeds.pressing(speed).ok()?;
        let predicted = nodes.at(speed, tension);
        Some(RatedLoad {
            speed,
            factor: predicted.factor,
            torque: predicted.torque,
            power: speed * predicted.torque,
            power_out: None,
            end: predicted.end.clone(),
            error: predicted.error,
        })
    }
}
