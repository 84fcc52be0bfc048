//! One step of a branch: prediction, correction, and what decides whether it is good.

use crate::branch::events::Events;
use crate::branch::found::{Found, UNVERIFIED};
use crate::branch::progress::Progress;
use crate::curve::corrector::{Accuracy, Condition, Correction};
use crate::curve::curve::{Curve, reverse};
use crate::curve::predictor::History;
use crate::difficulty::Difficulty;
use crate::options::{Options, Parameterisation, Predictor};
use crate::special_points::branch_point::find_seconds;
use crate::special_points::limit_point::suspicion;
use crate::special_points::node::Node;
use crate::system::system::System;
use std::borrow::Cow;
use std::f64::consts::PI;

/// Contraction of Newton's method at which the step length stays as it is.
const CONTRACTION: f64 = 0.1;
/// Error of the prediction, as a share of the step, at which the step length stays as it is.
const PREDICTION: f64 = 0.1;
/// Predictions that miss by more than this share of the step are not trusted.
const MISSED: f64 = 0.7;
/// A step changes by at most these factors.
const CHANGE: [f64; 2] = [0.3, 2.0];
/// A tangent must turn by less than this many times the wanted angle.
const SHARPEST: f64 = 3.0;
/// Angle by which the second null vector should turn per step, rad, ...
const SECOND: f64 = 0.4;
/// ... and by which it may: between two branch points it turns by about a right angle. Of 601 branch points on
/// 40 trivial branches of the Swift-Hohenberg equation none was missed; 36 were with 0.6 and 1.2 rad, which
/// took a third fewer points there. On curves with few branch points the steps are the same, but 0.4 for the
/// latter made them depend on copies of equations.
const SECOND_LIMIT: f64 = 0.5;
/// A step on which η should have changed its sign, and by more than this share of it, but has not, may
/// have passed two branch points.
const REFLECTED: f64 = 0.5;
/// It is not shortened below this share of the largest, where η only touches zero.
const TOUCHING: f64 = 1.0 / 64.0;
/// A linearisation further than this share of the step from a point gives no tangent there.
const DRIFTED: f64 = 0.05;
/// Corrections from the place that the tangent tells of must shrink to less than this on their way to the point that
/// was found, else they may end on another sheet of solutions, to which they do not shrink at all. Of 960 traces on
/// steep sheets 0.1 to 1e-4 apart 223 were wrong without this, 15 are with it, with one percent more points.
const DEPARTURE: f64 = 0.5;
/// Sheets that are closer together than this in the arclength norm are not told apart: noise in G would be taken
/// for them.
const APART: f64 = 1e-7;
/// Nor are those closer than this share of what the first correction takes away: with zero 7 of the 960 are wrong,
/// but every step takes two residuals more instead of one.
const LINEAR: f64 = 0.01;
/// Corrections of the place of the prediction, which is off by the square of the angle at first.
const ALIGNMENTS: usize = 2;
/// The most repetitions of a cut that puts the prediction on a bound.
const CUTS: usize = 8;

/// A corrected and assessed step with its labelled points.
pub(crate) struct Step {
    pub(crate) node: Node,
    pub(crate) found: Vec<Found>,
    /// Whether it ends on a bound of λ.
    pub(crate) on_bound: bool,
    /// The factor by which the next step may be longer.
    pub(crate) growth: f64,
}

/// The corrected end of a step.
pub(crate) struct Arrival {
    z: Vec<f64>,
    pub(crate) on_bound: bool,
    report: Correction,
}

/// What a step from the last point works with.
pub(crate) struct Stepper<'s, 'a, S> {
    pub(crate) curve: &'s mut Curve<'a, S>,
    pub(crate) events: &'s mut Events<'a, S>,
    pub(crate) progress: &'s Progress,
    pub(crate) options: &'s Options,
}

impl<S: System> Stepper<'_, '_, S> {
    /// The points before the last one that the prediction uses.
    fn history(&self) -> Cow<'_, History> {
        match self.options.predictor {
            Predictor::Polynomial => Cow::Borrowed(&self.progress.history),
            Predictor::Tangent => Cow::Owned(History::default()),
        }
    }

    /// The predicted point a step h ahead.
    pub(crate) fn predict(&self, h: f64) -> Vec<f64> {
        let Node {
            z,
            tangent,
            arclength: s,
            ..
        } = &self.progress.node;
        let mut predicted = self.history().predict(z, tangent, *s, h).0;
        if self.options.parameterisation == Parameterisation::Natural {
            // A polynomial would pass limit points now and then.
            let n = z.len() - 1;
            predicted[n] = z[n] + h * tangent[n];
        }
        predicted
    }

    /// The corrected point near the one predicted a step h ahead, or on the bound of λ that it would cross.
    pub(crate) fn correct(&mut self, predicted: Vec<f64>, h: f64) -> Result<Arrival, Difficulty> {
        let n = predicted.len() - 1;
        let [low, high] = self.options.bounds;
        let bound = predicted[n].clamp(low, high);
        if bound != predicted[n] {
            return self.land(predicted, bound, h);
        }
        let condition = match self.options.parameterisation {
            Parameterisation::Natural => Condition::lambda(n + 1, predicted[n]),
            Parameterisation::Pseudoarclength => {
                Condition::plane(&self.curve.metric, &self.progress.node.tangent, &predicted)
            }
        };
        let accuracy = Accuracy::Length(self.curve.accuracy(self.options.accuracy));
        let (mut z, limit) = (predicted.clone(), self.options.corrections);
        match self.curve.correct(&mut z, &condition, accuracy, limit) {
            Ok(report) if report.first <= MISSED * h => Ok(Arrival {
                z,
                on_bound: false,
                report,
            }),
            Ok(report) => Err(Difficulty::NoConvergence {
                correction: report.first,
                steps: 1,
                limit: MISSED * h,
            }),
            Err(Difficulty::OutOfBounds { lambda }) => {
                self.land(predicted, lambda.clamp(low, high), h)
            }
            Err(difficulty) => Err(difficulty),
        }
    }

    /// The point on a bound of λ, where a step h would lead beyond: the step is cut so that the prediction
    /// lies on it.
    fn land(&mut self, mut z: Vec<f64>, bound: f64, h: f64) -> Result<Arrival, Difficulty> {
        let n = z.len() - 1;
        let from = self.progress.node.z[n];
        if bound == from {
            // The first point is on it: the step leads away, unless it has come back on another sheet.
            return Err(Difficulty::OutOfBounds { lambda: z[n] });
        }
        let mut cut = h;
        for _ in 0..CUTS {
            let way = z[n] - from;
            if way * (bound - from) > 0.0 {
                cut = (cut * (bound - from) / way).min(h);
                z = self.predict(cut);
            }
        }
        z[n] = bound;
        let (condition, limit) = (Condition::lambda(n + 1, bound), self.options.corrections);
        let report = self
            .curve
            .correct(&mut z, &condition, Accuracy::Rounding, limit)?;
        if self.curve.metric.distance(&z, &self.progress.node.z) > 2.0 * h {
            return Err(Difficulty::OutOfBounds { lambda: bound });
        }
        z[n] = bound;
        Ok(Arrival {
            z,
            on_bound: true,
            report,
        })
    }

    /// The node at the end of a step h and the factor by which the next step may be longer; refused where
    /// the tangent or the second null vector turns too much.
    pub(crate) fn assess(&mut self, arrival: &Arrival, h: f64) -> Result<(Node, f64), Difficulty> {
        let report = &arrival.report;
        let mut node = Node::new(arrival.z.clone(), self.curve.corrector.null().to_vec());
        self.orient(&mut node)?;
        let angle = self.angle(&node)?;
        let mut exact = self.needs_own_tangent(&node, angle, report.drift / h);
        if exact {
            self.linearise_at(&mut node)?;
        }
        if !exact && self.departure(&node, h) > DEPARTURE {
            // The linearisation may be too old.
            self.linearise_at(&mut node)?;
            exact = true;
        }
        if exact {
            let change = self.departure(&node, h);
            if change > DEPARTURE {
                return Err(Difficulty::Departure {
                    change,
                    limit: DEPARTURE,
                });
            }
        }
        self.evaluate_events(&mut node);
        if !exact && self.near_event(&node) {
            self.linearise_at(&mut node)?;
            self.evaluate_events(&mut node);
        }
        find_seconds(self.curve, &mut node)?;
        if !exact && self.near_crossing(&node, report.drift / h) {
            self.linearise_at(&mut node)?;
            self.evaluate_events(&mut node);
            find_seconds(self.curve, &mut node)?;
        }
        let second = self.second_angle(&node, h)?;
        let turn = (angle / self.options.angle).max(second / SECOND);
        Ok((node, growth(report, h, turn)))
    }

    /// Whether the node may be on another sheet of solutions than the last one, a step h behind.
    ///
    /// The errors of a prediction of order m in place, e, and in direction, e′ = (m + 1) e / h, tell of each other,
    /// unless the corrections have led to another sheet: then the places that they tell of are as far apart as the
    /// sheets. Solutions with the same orientation and second vectors are told apart by nothing else. From the place
    /// that the direction tells of two corrections with the same linearisation lead back to the node, or to the
    /// sheet that was left; returned is by how much the distance from the node shrinks in the second one.
    fn departure(&mut self, node: &Node, h: f64) -> f64 {
        let (metric, last) = (&self.curve.metric, &self.progress.node);
        let history = self.history();
        let ahead = |a: &[f64], b: &[f64]| {
            let way: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
            metric.dot(&way, &last.tangent)
        };
        // The prediction in the plane across the last tangent in which the node lies.
        let mut s = h;
        let (mut place, mut rate) = history.predict(&last.z, &last.tangent, last.arclength, s);
        for _ in 0..ALIGNMENTS {
            s += ahead(&node.z, &place) / metric.dot(&rate, &last.tangent);
            (place, rate) = history.predict(&last.z, &last.tangent, last.arclength, s);
        }
        let growth = history.growth_of_error(last.arclength, s);
        let speeds = [&node.tangent, &rate].map(|t| metric.dot(t, &last.tangent));
        let directions = node.tangent.iter().zip(&rate);
        let error = directions.map(|(t, p)| (t / speeds[0] - p / speeds[1]) / growth);
        let told: Vec<f64> = place.iter().zip(error).map(|(p, e)| p + e).collect();
        let way: Vec<f64> = told.iter().zip(&node.z).map(|(a, b)| a - b).collect();
        let apart = metric.norm(&way);
        if apart <= APART {
            return 0.0;
        }
        let is_near = |distance: f64| distance <= APART.max(LINEAR * apart);
        match self.curve.approach(&node.z, &way, &last.tangent, is_near) {
            Ok([first, second]) => second / first,
            // There is no other sheet where G is not defined.
            Err(_) => 0.0,
        }
    }

    /// Whether something may have changed its sign on the way from the last linearisation: then its tangent
    /// will not do.
    fn needs_own_tangent(&self, node: &Node, angle: f64, share: f64) -> bool {
        let (n, last) = (node.z.len() - 1, &self.progress.node);
        let rate = self.curve.rate(&node.tangent).abs();
        let turned = node.tangent[n] * last.tangent[n] <= 0.0 || node.along != last.along;
        let doubtful = turned || rate <= 3.0 * share * angle || share > DRIFTED;
        let doubtful = doubtful || suspicion(&self.curve.metric, last, node).is_some();
        doubtful || self.progress.unoriented || last.cusp.is_some()
    }

    /// Gives a node its exact tangent.
    fn linearise_at(&mut self, node: &mut Node) -> Result<(), Difficulty> {
        node.tangent = self.curve.tangent(&node.z)?;
        self.orient(node)?;
        node.cusp = self.curve.system.cusp_function();
        Ok(())
    }

    /// Gives a node its arclength and the values of the event functions.
    fn evaluate_events(&mut self, node: &mut Node) {
        let last = &self.progress.node;
        node.arclength = last.arclength + last.length_to(node, &self.curve.metric);
        self.events.evaluate(self.curve.system, node);
    }

    /// Whether an event function changes its sign on the way to a node, or might with the exact tangent
    /// there: over the drift from the last linearisation it changes by about the same share as over the
    /// step, twice that to be sure.
    fn near_event(&self, node: &Node) -> bool {
        let mut values = self.progress.node.events.iter().zip(&node.events);
        values.any(|(before, after)| {
            before * after < 0.0 || after.abs() < 2.0 * DRIFTED * (after - before).abs()
        })
    }

    /// Whether there may be a branch point on the way from the last linearisation, this share of the step
    /// away: over it η changes by about the same share as over the step, three times that to be sure.
    fn near_crossing(&self, node: &Node, share: f64) -> bool {
        let [before, after] = [&self.progress.node, node].map(Node::eta);
        self.curve.branch_points && after.abs() <= 3.0 * share * (after - before).abs()
    }

    /// Turns the null vector of a node into the unit tangent in the direction of travel.
    fn orient(&self, node: &mut Node) -> Result<(), Difficulty> {
        let (metric, last) = (&self.curve.metric, &self.progress.node);
        if !metric.normalise(&mut node.tangent) {
            return Err(Difficulty::Singular);
        }
        let ends = node.z.iter().zip(&last.z);
        let secant: Vec<f64> = ends.map(|(b, a)| b - a).collect();
        let limit = SHARPEST * self.options.angle;
        if metric.dot(&secant, &last.tangent) <= 0.0 {
            return Err(Difficulty::Turn { angle: PI, limit });
        }
        node.along = metric.dot(&node.tangent, &secant) > 0.0;
        if !node.along {
            reverse(&mut node.tangent);
        }
        Ok(())
    }

    /// The angle by which the tangent turns.
    fn angle(&self, node: &Node) -> Result<f64, Difficulty> {
        let last = &self.progress.node;
        // Accurate at small angles, where the arc cosine is not.
        let half = 0.5 * self.curve.metric.distance(&node.tangent, &last.tangent);
        let (angle, limit) = (2.0 * half.min(1.0).asin(), SHARPEST * self.options.angle);
        let n = node.z.len() - 1;
        let turned = node.tangent[n] * last.tangent[n] < 0.0;
        let stuck = turned && self.options.parameterisation == Parameterisation::Natural;
        if angle <= limit && !stuck {
            Ok(angle)
        } else {
            Err(Difficulty::Turn { angle, limit })
        }
    }

    /// The angle by which the second null vector turns on a step h: by too much, or with an η that turns
    /// back before zero, the step may have passed two branch points.
    fn second_angle(&self, node: &Node, h: f64) -> Result<f64, Difficulty> {
        if self.progress.unoriented || !self.curve.branch_points {
            return Ok(0.0);
        }
        let last = &self.progress.node;
        let (mut angle, limit) = (last.second_angle(node, &self.curve.metric), SECOND_LIMIT);
        let eta = last.eta();
        let expected = 1.0 + self.progress.trend.unwrap_or(0.0) * h / eta;
        let reflected = expected < -REFLECTED && node.along == last.along;
        if reflected && h > TOUCHING * self.options.largest_step {
            angle = PI;
        }
        if angle <= limit || h <= UNVERIFIED * self.options.largest_step {
            Ok(angle)
        } else {
            Err(Difficulty::Turn { angle, limit })
        }
    }
}

/// The factor for the next step, from how a step went and its angle over the one wanted.
fn growth(report: &Correction, h: f64, turn: f64) -> f64 {
    let contraction = (CONTRACTION / report.contraction.max(1e-9)).sqrt();
    let prediction = (PREDICTION * h / report.first.max(1e-300)).sqrt();
    let [least, most] = CHANGE;
    contraction
        .min(prediction)
        .min(1.0 / turn.max(1e-9))
        .clamp(least, most)
}
