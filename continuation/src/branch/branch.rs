//! A branch as an iterator over its points.

use crate::branch::assess::Assessment;
use crate::branch::discretisation::Discretisation;
use crate::branch::events::Events;
use crate::branch::labels::Labels;
use crate::branch::progress::Progress;
use crate::branch::start::{TURNING, correct_across, correct_start, set_out};
use crate::branch::step::{Step, Stepper};
use crate::branch::switching::{HalfBranch, SHORTEST, first_step};
use crate::curve::curve::{Curve, reverse};
use crate::curve::metric::{FARTHEST, FARTHEST_ACROSS, Metric};
use crate::difficulty::Difficulty;
use crate::error::{Error, check_length};
use crate::options::Options;
use crate::point::{Kind, Point};
use crate::special_points::branch_point::{choose_border, set_borders};
use crate::special_points::node::Node;
use crate::stop::Stop;
use crate::system::system::System;

/// A step that fails is repeated with this share of its length, ...
const SHORTER: f64 = 0.5;
/// ... or with this where the system is not defined: its domain may be far away.
const SHORTER_UNDEFINED: f64 = 0.25;
/// The most changes of the discretisation at one point.
const ADAPTATIONS: usize = 3;

/// Where a trace sets out from the first point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// λ increases.
    Increasing,
    /// λ decreases.
    Decreasing,
}

/// A curve of solutions of a [`System`], point by point.
///
/// The iterator yields the start, every accepted step and every special point in between, in order,
/// and ends with a reason ([`stop`](Self::stop)). It keeps the last few points only. While points
/// are drawn by `while let Some(point) = branch.next()`, [`system`](Self::system) is the system in
/// the discretisation of the last point yielded. A `for` loop takes the branch, and its reason with it: write
/// `for point in branch.by_ref()` to ask for that. The system is borrowed until the branch is dropped.
pub struct Branch<'a, S: System> {
    curve: Curve<'a, S>,
    events: Events<'a, S>,
    progress: Progress,
    options: Options,
    /// The length of the next step.
    step: f64,
    /// The kinds of points whose discretisation error is not asked for.
    unassessed: Vec<Kind>,
    stop: Option<Stop>,
}

impl<'a, S: System> Branch<'a, S> {
    /// A branch from an approximate point `start` = (x, λ), which is corrected at its λ — or across
    /// the curve, if it is a limit point.
    ///
    /// # Errors
    /// Settings out of range, a start outside the bounds or of the wrong length, no solution near
    /// it, or a start at which more than one branch leads on.
    pub fn new(
        system: &'a mut S,
        start: &[f64],
        direction: Direction,
        options: &Options,
    ) -> Result<Self, Error> {
        let mut branch = Self::at(system, start, options)?;
        correct_start(&mut branch.curve, &mut branch.progress.node)?;
        let rate = branch.curve.rate(&branch.progress.node.tangent);
        let forward = match direction {
            Direction::Increasing => rate >= 0.0 || rate.abs() < TURNING,
            Direction::Decreasing => rate < 0.0 && rate.abs() >= TURNING,
        };
        set_out(&branch.curve, &mut branch.progress, forward);
        Ok(branch)
    }

    /// The branch onward from one of its points, in the direction of the point's tangent.
    ///
    /// # Errors
    /// As [`new`](Self::new); branch points are no obstacle.
    pub fn resume(system: &'a mut S, point: &Point, options: &Options) -> Result<Self, Error> {
        let mut branch = Self::at(system, &point.z, options)?;
        check_length(&point.tangent, point.z.len())?;
        let Self {
            curve, progress, ..
        } = &mut branch;
        let node = &mut progress.node;
        node.tangent.clone_from(&point.tangent);
        let farthest = match point.kind {
            Kind::BranchPoint => FARTHEST_ACROSS,
            _ => FARTHEST,
        };
        curve.metric.reach(&point.tangent, farthest);
        let mut ahead = true;
        if point.kind == Kind::BranchPoint {
            (progress.unoriented, progress.from_branch_point) = (true, true);
            curve.metric.normalise(&mut node.tangent);
            set_borders(curve, &point.z).map_err(Error::Start)?;
        } else {
            correct_across(curve, node, &point.tangent).map_err(Error::Start)?;
            choose_border(curve, node).map_err(Error::Start)?;
            ahead = curve.metric.dot(&node.tangent, &point.tangent) >= 0.0;
        }
        set_out(curve, progress, ahead);
        Ok(branch)
    }

    /// One half of the other branch at a branch point. Its first point off the branch point is found
    /// before the branch is returned, and verified to lie in the direction of the other branch.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`Error::NoSecondBranch`] and [`Error::Switch`].
    pub fn switch(
        system: &'a mut S,
        point: &Point,
        half: HalfBranch,
        options: &Options,
    ) -> Result<Self, Error> {
        let Some(other) = &point.other else {
            return Err(Error::NoSecondBranch);
        };
        let mut onward = point.clone();
        onward.tangent.clone_from(other);
        if half == HalfBranch::Backward {
            reverse(&mut onward.tangent);
        }
        onward.kind = Kind::BranchPoint;
        let mut branch = Self::resume(system, &onward, options)?;
        let (old, longest) = (&point.tangent, branch.step);
        let first = branch.first_step(old, longest);
        // An unknown that is zero at the branch point has no size of its own: how short the first step must be tells it.
        let share = first.as_ref().map_or(SHORTEST, |step| step / longest);
        if share < 1.0 && branch.curve.metric.shrink(share) {
            let Self {
                curve, progress, ..
            } = &mut branch;
            curve.metric.normalise(&mut progress.node.tangent);
            set_borders(curve, &point.z).map_err(Error::Start)?;
            branch.step = branch.first_step(old, longest)?;
        } else {
            branch.step = first?;
        }
        Ok(branch)
    }

    /// The length of a first step from the branch point at which the branch stands, at most `longest`.
    fn first_step(&mut self, old: &[f64], longest: f64) -> Result<f64, Error> {
        let (curve, node) = (&mut self.curve, &self.progress.node);
        let accuracy = curve.accuracy(self.options.accuracy);
        first_step(curve, &node.z, [old, &node.tangent], longest, accuracy)
    }

    /// A branch that stands at `z`, not yet corrected.
    fn at(system: &'a mut S, z: &[f64], options: &Options) -> Result<Self, Error> {
        let unknowns = system.unknowns();
        options.validate(unknowns)?;
        check_length(z, unknowns)?;
        let (lambda, [low, high]) = (z[unknowns - 1], options.bounds);
        if !(low..=high).contains(&lambda) {
            return Err(Error::StartOutside { lambda, low, high });
        }
        system.set_bounds(options.bounds);
        let metric = Metric::new(system, options, z);
        let mut curve = Curve::new(system, metric, options.bounds);
        curve.location = options.location;
        curve.branch_points = options.branch_points;
        Ok(Self {
            curve,
            events: Events::none(),
            progress: Progress::at(Node::new(z.to_vec(), vec![0.0; unknowns])),
            options: options.clone(),
            step: options.first_step.min(options.largest_step),
            unassessed: Vec::new(),
            stop: None,
        })
    }

    /// Adds a function of the system and a point, whose zeros along the branch are located and yielded
    /// as [`Kind::Event`] with the number of the function: 0 for the first one added. The point has its
    /// unknowns, tangent and arclength, and is [`Kind::Regular`] wherever it lies. A zero at the first
    /// point is not reported. Where the function is NaN it has no zeros.
    ///
    /// ```
    /// use continuation::{Branch, DenseSystem, Direction, Kind, Options};
    ///
    /// // x (1 + λ²) = 1 has the slope −1/2 twice, at λ = 1 the second time.
    /// let bell = |x: &[f64], p: &[f64], g: &mut [f64]| g[0] = x[0] * (1.0 + p[0] * p[0]) - 1.0;
    /// let mut system = DenseSystem::new(1, &[0.0], 0, bell);
    /// let options = Options::within(0.0, 3.0);
    /// let branch = Branch::new(&mut system, &[1.0, 0.0], Direction::Increasing, &options)?
    ///     .event(|_, point| point.tangent[0] / point.tangent[1] + 0.5);
    /// let found: Vec<f64> = branch
    ///     .filter(|point| point.kind == Kind::Event(0))
    ///     .map(|point| point.lambda())
    ///     .collect();
    /// assert!(found.len() == 2 && (found[1] - 1.0).abs() < 1e-12);
    /// # Ok::<(), continuation::Error>(())
    /// ```
    #[must_use]
    pub fn event(mut self, mut function: impl FnMut(&S, &Point) -> f64 + 'a) -> Self {
        let node = &mut self.progress.node;
        let value = function(self.curve.system, &node.point(Kind::Regular));
        node.events.push(value);
        self.events.push(function);
        self
    }

    /// As [`event`](Self::event), numbered with these, but its points are [unassessed](Self::unassessed): for a place at
    /// which the caller goes over to another system.
    #[must_use]
    pub fn change(self, function: impl FnMut(&S, &Point) -> f64 + 'a) -> Self {
        let index = self.events.count();
        self.event(function).unassessed(&[Kind::Event(index)])
    }

    /// Asks for no discretisation errors of points of these kinds: [`Point::error`] is `None` there, which saves locating
    /// them a second time on a finer discretisation, and the branch does not go over to that one after them. To be
    /// called before the first point is drawn, for instance for the start of a branch that goes on from the last point
    /// of another one.
    #[must_use]
    pub fn unassessed(mut self, kinds: &[Kind]) -> Self {
        self.unassessed.extend_from_slice(kinds);
        self
    }

    /// The system, in the discretisation of the last point yielded.
    pub fn system(&self) -> &S {
        self.curve.system
    }

    /// Why the branch has ended; `None` while it goes on.
    pub fn stop(&self) -> Option<&Stop> {
        self.stop
            .as_ref()
            .filter(|_| self.progress.queue.is_empty())
    }

    /// Gives up the branch for the reason why it has ended.
    pub fn into_stop(self) -> Option<Stop> {
        self.stop
    }

    /// The first point.
    pub(crate) fn start(&self) -> Point {
        self.progress.first.point(Kind::Start)
    }

    /// Takes one step and queues its points, or finds the reason to stop.
    fn advance(&mut self) {
        self.stop = self.end();
        while self.stop.is_none() {
            let step = self.attempt(self.step);
            let Err(difficulty) = step.and_then(|step| self.accept(step)) else {
                return;
            };
            self.step *= match difficulty {
                Difficulty::NotFinite { .. } | Difficulty::Linearisation(_) => SHORTER_UNDEFINED,
                _ => SHORTER,
            };
            if self.step < self.options.smallest_step {
                let step = self.step;
                self.stop = Some(Stop::StepTooSmall { step, difficulty });
            }
        }
    }

    /// A step of length h: predicted, corrected, assessed, and searched for labelled points.
    fn attempt(&mut self, h: f64) -> Result<Step, Difficulty> {
        let mut stepper = Stepper {
            curve: &mut self.curve,
            events: &mut self.events,
            progress: &self.progress,
            options: &self.options,
        };
        let predicted = stepper.predict(h);
        let arrival = stepper.correct(predicted, h)?;
        let (node, growth) = stepper.assess(&arrival, h)?;
        let mut labels = Labels {
            curve: &mut self.curve,
            events: &mut self.events,
            progress: &self.progress,
            options: &self.options,
        };
        let found = labels.on_step(&node, h / self.options.largest_step)?;
        Ok(Step {
            node,
            found,
            on_bound: arrival.on_bound,
            growth,
        })
    }

    /// Moves on to the end of a step and queues its points; fails, with nothing changed, if the
    /// system cannot adapt its discretisation to the new point.
    fn accept(&mut self, step: Step) -> Result<(), Difficulty> {
        let (progress, metric) = (&mut self.progress, &mut self.curve.metric);
        let closed = step.found.iter().any(|found| found.kind == Kind::Closed);
        let points = step.found.into_iter();
        let points: Vec<Point> = points
            .map(|found| found.point(&progress.node, metric))
            .collect();
        progress.queue.extend(points);
        let mut node = step.node;
        if closed {
            self.stop = Some(Stop::Closed);
        } else if step.on_bound {
            let point = node.point(Kind::Bound);
            let lambda = point.lambda();
            progress.queue.push_back(point);
            self.stop = Some(Stop::Bound { lambda });
        } else {
            metric.observe(&node.z);
            metric.normalise(&mut node.tangent);
            self.move_to(node)?;
            self.step = (self.step * step.growth).min(self.options.largest_step);
            self.progress.yield_node(Kind::Regular);
        }
        self.progress.steps += 1;
        Ok(())
    }

    /// Makes `node` the last point, in a discretisation that suits it.
    fn move_to(&mut self, node: Node) -> Result<(), Difficulty> {
        let progress = &mut self.progress;
        let length = node.arclength - progress.node.arclength;
        let trend = (node.eta() - progress.node.eta()) / length;
        let trend = (!progress.unoriented).then_some(trend);
        let old_trend = std::mem::replace(&mut progress.trend, trend);
        let left = std::mem::replace(&mut progress.node, node);
        let history = progress.history.clone();
        progress.history.push(left.z.clone(), left.arclength);
        let mut discretisation = Discretisation {
            accuracy: self.curve.accuracy(self.options.accuracy),
            curve: &mut self.curve,
            progress: &mut self.progress,
        };
        for adaptation in 0..ADAPTATIONS {
            match discretisation.adapt(length) {
                Ok(true) => {}
                Err(difficulty) if adaptation == 0 => {
                    (self.progress.node, self.progress.history) = (left, history);
                    self.progress.trend = old_trend;
                    self.progress.queue.clear();
                    return Err(difficulty);
                }
                // The discretisation suits the point, or is better than it was; the next step asks again.
                Ok(false) | Err(_) => break,
            }
        }
        // Rates along a branch begin to mean something with the first step off a branch point.
        self.progress.unoriented = false;
        Ok(())
    }

    /// The reason to stop at the last point, if there is one.
    fn end(&self) -> Option<Stop> {
        let Progress { node, steps, .. } = &self.progress;
        if *steps >= self.options.steps {
            return Some(Stop::Steps { steps: *steps });
        }
        let n = node.z.len() - 1;
        let (rate, lambda) = (node.tangent[n], node.z[n]);
        let [low, high] = self.options.bounds;
        if lambda == high && rate > 0.0 || lambda == low && rate < 0.0 {
            return Some(Stop::Bound { lambda });
        }
        let bound = if rate > 0.0 { high } else { low };
        let asymptote = self.is_asymptote(bound);
        asymptote.then_some(Stop::Asymptote { lambda: bound })
    }

    /// Whether λ can no longer be told from a bound at the accuracy of the points, but would be there
    /// only many steps ahead.
    fn is_asymptote(&self, bound: f64) -> bool {
        let Node { z, tangent, .. } = &self.progress.node;
        let n = z.len() - 1;
        let gap = (bound - z[n]).abs();
        let ahead = gap / tangent[n].abs();
        let accuracy = self.curve.accuracy(self.options.accuracy);
        gap <= accuracy * self.curve.metric.range() && ahead > self.step
    }
}

impl<S: System> Iterator for Branch<'_, S> {
    type Item = Point;

    fn next(&mut self) -> Option<Point> {
        if self.progress.queue.is_empty() && self.stop.is_none() {
            self.advance();
        }
        let point = self.progress.queue.pop_front()?;
        let mut assessment = Assessment {
            curve: &mut self.curve,
            events: &mut self.events,
            progress: &mut self.progress,
            options: &self.options,
            unassessed: &self.unassessed,
        };
        let (point, stop) = assessment.assessed(point);
        if stop.is_some() {
            self.progress.queue.clear();
            self.stop = stop;
        }
        Some(point)
    }
}
