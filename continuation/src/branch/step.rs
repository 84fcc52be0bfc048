//! From one point of a branch to the next.

use crate::branch::branch::Branch;
use crate::branch::branch::reverse;
use crate::branch::labels::{Found, UNVERIFIED};
use crate::curve::corrector::{Accuracy, Condition, Correction};
use crate::curve::predictor::History;
use crate::difficulty::Difficulty;
use crate::options::{Parameterisation, Predictor};
use crate::point::Kind;
use crate::special_points::span::{Node, Span};
use crate::stop::Stop;
use crate::system::system::System;
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
/// Angle by which the second null vector should turn per step, rad; by less than twice as much it
/// must. Between two branch points it turns by about a right angle.
const SECOND: f64 = 0.6;
/// A step on which the height of the null space should have changed its sign, and by more than this
/// share of it, but has not, may have passed two branch points.
const REFLECTED: f64 = 0.5;
/// It is not shortened below this share of the largest, where the height only touches zero.
const TOUCHING: f64 = 1.0 / 64.0;
/// A linearisation further than this share of the step from a point gives no tangent there.
const DRIFTED: f64 = 0.05;
/// A change of the discretisation may move a point by this share of the step that led there, or by
/// ten times the tolerance of the system. Further away may be another branch: far up its curve Bratu's
/// problem then fell back to the trivial one.
const SHIFT: f64 = 0.1;
/// Points are corrected to this share of the tolerance of the system, so that what is left of the
/// corrections is no defect: with the accuracy 1e-9 and the tolerance 1e-10 the mesh of a boundary value problem
/// grew to 240 000 unknowns, where 341 do.
const SHARE_OF_TOLERANCE: f64 = 0.01;
/// The most changes of the discretisation at one point.
const ADAPTATIONS: usize = 3;

/// A step that has succeeded.
struct Taken {
    node: Node,
    found: Vec<Found>,
    landed: bool,
    /// The factor by which the next step may be longer.
    growth: f64,
}

impl<S: System> Branch<'_, S> {
    /// Takes one step and queues its points, or finds the reason to stop.
    pub(crate) fn advance(&mut self) {
        if self.steps >= self.options.steps {
            self.stop = Some(Stop::Steps { steps: self.steps });
            return;
        }
        let n = self.node.z.len() - 1;
        let (rate, lambda) = (self.node.tangent[n], self.node.z[n]);
        let [low, high] = self.options.bounds;
        if lambda == high && rate > 0.0 || lambda == low && rate < 0.0 {
            self.stop = Some(Stop::Bound { lambda });
            return;
        }
        let bound = if rate > 0.0 { high } else { low };
        if self.is_asymptote(bound) {
            self.stop = Some(Stop::Asymptote { lambda: bound });
            return;
        }
        loop {
            let taken = self.attempt(self.step);
            let Err(difficulty) = taken.and_then(|taken| self.accept(taken)) else {
                return;
            };
            self.step *= match difficulty {
                Difficulty::NotFinite { .. } | Difficulty::Linearisation(_) => 0.25,
                _ => 0.5,
            };
            if self.step < self.options.smallest_step {
                let step = self.step;
                self.stop = Some(Stop::StepTooSmall { step, difficulty });
                return;
            }
        }
    }

    /// Whether λ can no longer be told from a bound at the accuracy of the points, but would be there
    /// only many steps ahead.
    fn is_asymptote(&self, bound: f64) -> bool {
        let n = self.node.z.len() - 1;
        let gap = (bound - self.node.z[n]).abs();
        let ahead = gap / self.node.tangent[n].abs();
        gap <= self.accuracy() * self.metric.range() && ahead > self.step
    }

    /// The accuracy of regular points: [`Options::accuracy`], or finer where the tolerance of the
    /// system is.
    pub(crate) fn accuracy(&self) -> f64 {
        let finest = SHARE_OF_TOLERANCE * self.system.tolerance();
        self.options.accuracy.min(finest)
    }

    /// Goes over to a better discretisation of the last point, reached by a step of this length, where
    /// the system has one; returns whether it has.
    fn adapt(&mut self, h: f64) -> Result<bool, Difficulty> {
        let kept = self.take_vectors();
        let mut vectors = kept.clone();
        match self.system.adapted(&mut vectors) {
            Ok(Some(system)) => {
                let tolerance = Some(self.system.tolerance()).filter(|t| t.is_finite());
                let limit = (SHIFT * h).max(10.0 * tolerance.unwrap_or(0.0));
                self.exchange(system, vectors, kept, limit)?;
                Ok(true)
            }
            outcome => {
                self.put_vectors(kept);
                outcome.map(|_| false).map_err(Difficulty::Adaptation)
            }
        }
    }

    /// Replaces the system by another discretisation, in which `vectors` are expressed, and brings
    /// the last point to its curve. If that fails or moves the point by more than `limit`, everything
    /// is as before, with the vectors that were `kept`.
    pub(crate) fn exchange(
        &mut self,
        system: S,
        vectors: Vec<Vec<f64>>,
        kept: Vec<Vec<f64>>,
        limit: f64,
    ) -> Result<(), Difficulty> {
        let old = std::mem::replace(self.system, system);
        let (metric, column) = (self.metric.clone(), self.column.clone());
        let (node, trend) = (self.node.clone(), self.trend);
        self.put_vectors(vectors);
        let outcome = self.settle(limit);
        if outcome.is_err() {
            *self.system = old;
            (self.metric, self.column) = (metric, column);
            (self.node, self.trend) = (node, trend);
            self.put_vectors(kept);
        }
        outcome
    }

    /// All vectors that depend on the discretisation.
    pub(crate) fn take_vectors(&mut self) -> Vec<Vec<f64>> {
        let own = [&mut self.node.z, &mut self.node.tangent];
        let home = [&mut self.home.z, &mut self.home.tangent];
        let mut vectors: Vec<_> = own.into_iter().chain(home).map(std::mem::take).collect();
        vectors.append(&mut self.history.points);
        for point in &mut self.queue {
            vectors.push(std::mem::take(&mut point.z));
            vectors.push(std::mem::take(&mut point.tangent));
            vectors.extend(point.other.as_mut().map(std::mem::take));
        }
        vectors
    }

    /// Puts them back.
    pub(crate) fn put_vectors(&mut self, vectors: Vec<Vec<f64>>) {
        let mut vectors = vectors.into_iter();
        let mut next = || vectors.next().unwrap_or_default();
        self.node.z = next();
        self.node.tangent = next();
        self.home.z = next();
        self.home.tangent = next();
        self.history.points = self.history.arclengths.iter().map(|_| next()).collect();
        for point in &mut self.queue {
            point.z = next();
            point.tangent = next();
            if let Some(other) = &mut point.other {
                *other = next();
            }
        }
    }

    /// A step of length h, with everything that lies on it.
    fn attempt(&mut self, h: f64) -> Result<Taken, Difficulty> {
        let (z, landed, report) = self.land_or_correct(h)?;
        let mut node = Node::new(z, self.corrector.null().to_vec());
        self.orient(&mut node)?;
        let angle = self.angle(&node)?;
        // The tangent of the last linearisation, on the way to the point, will do unless something
        // may have changed its sign since.
        let n = node.z.len() - 1;
        let share = report.drift / h;
        let rate = self.rate(&node.tangent).abs();
        let turned = node.tangent[n] * self.node.tangent[n] <= 0.0 || node.along != self.node.along;
        let doubtful = turned || self.unoriented || rate <= 3.0 * share * angle || share > DRIFTED;
        let exact = doubtful || self.node.cusp.is_some();
        if exact {
            self.linearise_at(&mut node)?;
        }
        self.evaluate_events(&mut node);
        if !exact && self.near_event(&node) {
            self.linearise_at(&mut node)?;
            self.evaluate_events(&mut node);
        }
        node.second = self.second_vector(&node.tangent)?;
        let second = self.second_angle(&node, h)?;
        let found = self.specials(&node, h / self.options.largest_step)?;
        let turn = (angle / self.options.angle).max(second / SECOND);
        let growth = growth(&report, h, turn);
        Ok(Taken {
            node,
            found,
            landed,
            growth,
        })
    }

    /// Gives a node its exact tangent.
    fn linearise_at(&mut self, node: &mut Node) -> Result<(), Difficulty> {
        node.tangent = self.corrector.tangent(self.system, &self.metric, &node.z)?;
        self.orient(node)?;
        node.cusp = self.system.cusp_function();
        Ok(())
    }

    /// Gives a node its arclength and the values of the event functions.
    fn evaluate_events(&mut self, node: &mut Node) {
        node.arclength = self.node.arclength + self.node.length_to(node, &self.metric);
        let point = node.point(Kind::Regular);
        let events = self.events.iter_mut();
        node.events = events.map(|event| event(self.system, &point)).collect();
    }

    /// Whether an event function changes its sign on the way to a node, or might with the exact tangent
    /// there: over the drift from the last linearisation it changes by about the same share as over the
    /// step, twice that to be sure.
    fn near_event(&self, node: &Node) -> bool {
        let mut values = self.node.events.iter().zip(&node.events);
        values.any(|(before, after)| {
            before * after < 0.0 || after.abs() < 2.0 * DRIFTED * (after - before).abs()
        })
    }

    /// The corrected point a step h ahead, or on the bound of λ that it would cross.
    fn land_or_correct(&mut self, h: f64) -> Result<(Vec<f64>, bool, Correction), Difficulty> {
        let n = self.node.z.len() - 1;
        let mut predicted = Vec::with_capacity(n + 1);
        self.predict(h, &mut predicted);
        let from = self.node.z[n];
        let [low, high] = self.options.bounds;
        let wall = |lambda: f64| lambda.clamp(low, high);
        let mut bound = wall(predicted[n]);
        let mut outside = bound != predicted[n];
        if !outside {
            let condition = match self.options.parameterisation {
                Parameterisation::Natural => Condition::lambda(n + 1, predicted[n]),
                Parameterisation::Pseudoarclength => {
                    Condition::plane(&self.metric, &self.node.tangent, &predicted)
                }
            };
            let mut z = predicted.clone();
            match self.correct(&mut z, &condition, Accuracy::Length(self.accuracy())) {
                Ok(report) if report.first <= MISSED * h => return Ok((z, false, report)),
                Ok(report) => {
                    return Err(Difficulty::NoConvergence {
                        correction: report.first,
                        steps: 1,
                        limit: MISSED * h,
                    });
                }
                Err(Difficulty::OutOfBounds { lambda }) => {
                    (bound, outside) = (wall(lambda), true);
                }
                Err(difficulty) => return Err(difficulty),
            }
        }
        // The step is cut so that the prediction lies on the bound.
        let mut cut = h;
        for _ in 0..8 {
            let way = predicted[n] - from;
            if outside && way * (bound - from) > 0.0 {
                cut = (cut * (bound - from) / way).min(h);
                self.predict(cut, &mut predicted);
            }
        }
        predicted[n] = bound;
        let condition = Condition::lambda(n + 1, bound);
        let report = self.correct(&mut predicted, &condition, Accuracy::Rounding)?;
        let moved = self.metric.distance(&predicted, &self.node.z);
        if moved > 2.0 * h {
            let lambda = bound;
            return Err(Difficulty::OutOfBounds { lambda });
        }
        predicted[n] = bound;
        Ok((predicted, true, report))
    }

    fn predict(&self, h: f64, to: &mut Vec<f64>) {
        let (z, t, s) = (&self.node.z, &self.node.tangent, self.node.arclength);
        match self.options.predictor {
            Predictor::Polynomial => self.history.predict(z, t, s, h, to),
            Predictor::Tangent => History::default().predict(z, t, s, h, to),
        }
        if self.options.parameterisation == Parameterisation::Natural {
            // A polynomial would pass limit points now and then.
            let n = z.len() - 1;
            to[n] = z[n] + h * t[n];
        }
    }

    fn correct(
        &mut self,
        z: &mut [f64],
        to: &Condition,
        accuracy: Accuracy,
    ) -> Result<Correction, Difficulty> {
        let limit = self.options.corrections;
        self.corrector
            .correct(self.system, &self.metric, z, to, accuracy, limit)
    }

    /// Turns the null vector of a node into the unit tangent in the direction of travel.
    fn orient(&self, node: &mut Node) -> Result<(), Difficulty> {
        if !self.metric.normalise(&mut node.tangent) {
            return Err(Difficulty::Singular);
        }
        let ends = node.z.iter().zip(&self.node.z);
        let secant: Vec<f64> = ends.map(|(b, a)| b - a).collect();
        let limit = SHARPEST * self.options.angle;
        if self.metric.dot(&secant, &self.node.tangent) <= 0.0 {
            return Err(Difficulty::Turn { angle: PI, limit });
        }
        node.along = self.metric.dot(&node.tangent, &secant) > 0.0;
        if !node.along {
            reverse(&mut node.tangent);
        }
        Ok(())
    }

    /// The angle by which the tangent turns.
    fn angle(&self, node: &Node) -> Result<f64, Difficulty> {
        // Accurate at small angles, where the arc cosine is not.
        let half = 0.5 * self.metric.distance(&node.tangent, &self.node.tangent);
        let (angle, limit) = (2.0 * half.min(1.0).asin(), SHARPEST * self.options.angle);
        let n = node.z.len() - 1;
        let turned = node.tangent[n] * self.node.tangent[n] < 0.0;
        let stuck = turned && self.options.parameterisation == Parameterisation::Natural;
        if angle <= limit && !stuck {
            Ok(angle)
        } else {
            Err(Difficulty::Turn { angle, limit })
        }
    }

    /// The angle by which the second null vector turns on a step h: by too much, or with a height
    /// that turns back before zero, the step may have passed two branch points.
    fn second_angle(&self, node: &Node, h: f64) -> Result<f64, Difficulty> {
        if self.unoriented {
            return Ok(0.0);
        }
        let (mut angle, limit) = (self.node.second_angle(node, &self.metric), 2.0 * SECOND);
        let height = self.node.height();
        let expected = 1.0 + self.trend.unwrap_or(0.0) * h / height;
        let reflected = expected < -REFLECTED && node.along == self.node.along;
        if reflected && h > TOUCHING * self.options.largest_step {
            angle = PI;
        }
        if angle <= limit || h <= UNVERIFIED * self.options.largest_step {
            Ok(angle)
        } else {
            Err(Difficulty::Turn { angle, limit })
        }
    }

    pub(crate) fn span<'b>(&'b mut self, to: &'b Node) -> Span<'b, S> {
        Span {
            system: self.system,
            corrector: &mut self.corrector,
            metric: &self.metric,
            column: &self.column,
            from: &self.node,
            to,
        }
    }

    /// Moves on to the end of a step and queues its points; fails, with nothing changed, if the
    /// system cannot adapt its discretisation to the new point.
    fn accept(&mut self, taken: Taken) -> Result<(), Difficulty> {
        let Taken {
            mut node,
            found,
            landed,
            growth,
        } = taken;
        let closed = found.iter().any(|found| found.kind == Kind::Closed);
        let length = node.arclength - self.node.arclength;
        for found in found {
            let point = self.labelled(found);
            self.queue.push_back(point);
        }
        if closed || landed {
            self.steps += 1;
            if closed {
                self.stop = Some(Stop::Closed);
                return Ok(());
            }
            let point = node.point(Kind::Bound);
            let lambda = point.lambda();
            self.queue.push_back(point);
            self.stop = Some(Stop::Bound { lambda });
            return Ok(());
        }
        self.metric.observe(&node.z);
        self.metric.normalise(&mut node.tangent);
        let mut trend = (!self.unoriented).then(|| (node.height() - self.node.height()) / length);
        let left = std::mem::replace(&mut self.node, node);
        let history = self.history.clone();
        self.history.push(left.z.clone(), left.arclength);
        for adaptation in 0..ADAPTATIONS {
            match self.adapt(length) {
                // Heights on different meshes do not compare.
                Ok(true) => trend = None,
                Ok(false) => break,
                Err(difficulty) if adaptation == 0 => {
                    (self.node, self.history) = (left, history);
                    self.queue.clear();
                    return Err(difficulty);
                }
                // The discretisation is better than it was; the next step asks again.
                Err(_) => break,
            }
        }
        self.steps += 1;
        self.trend = trend;
        // Rates along a branch begin to mean something with the first step off a branch point.
        self.unoriented = false;
        self.step = (self.step * growth).min(self.options.largest_step);
        let point = self.node.point(Kind::Regular);
        self.queue.push_back(point);
        Ok(())
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
