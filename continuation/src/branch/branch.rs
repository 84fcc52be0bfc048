//! A branch as an iterator over its points.

use crate::curve::corrector::{Accuracy, Condition, Corrector};
use crate::curve::metric::Metric;
use crate::curve::predictor::History;
use crate::difficulty::Difficulty;
use crate::error::{Error, check_length};
use crate::options::Options;
use crate::point::{Kind, Point};
use crate::special_points::branch_point::column;
use crate::special_points::null_space::NullSpace;
use crate::special_points::span::Node;
use crate::stop::Stop;
use crate::system::system::System;
use std::collections::VecDeque;

/// A start whose Jacobian comes this close to a second null vector, relative to its size, is
/// refused.
const SINGULAR: f64 = 1e-11;
/// λ turns, or rests, where its rate along the unit tangent, with its range as unit, is below this.
pub(crate) const TURNING: f64 = 1e-12;
/// The most corrections of a first point.
const CORRECTIONS: usize = 50;

/// An event function of the system and a point.
pub(crate) type EventFunction<'a, S> = Box<dyn FnMut(&S, &Point) -> f64 + 'a>;

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
/// the discretisation of the last point yielded.
pub struct Branch<'a, S: System> {
    pub(crate) system: &'a mut S,
    pub(crate) options: Options,
    pub(crate) metric: Metric,
    pub(crate) corrector: Corrector,
    /// The column b of the test function for branch points.
    pub(crate) column: Vec<f64>,
    pub(crate) events: Vec<EventFunction<'a, S>>,
    /// The last accepted point and those before.
    pub(crate) node: Node,
    pub(crate) history: History,
    /// The first point and its tangent.
    pub(crate) home: Node,
    /// Whether the first point is a branch point.
    pub(crate) from_branch_point: bool,
    /// Whether orientation and rates at the last node mean nothing: it is a branch point.
    pub(crate) unoriented: bool,
    /// The rate of the height of the null space over the last step.
    pub(crate) trend: Option<f64>,
    pub(crate) step: f64,
    pub(crate) steps: usize,
    pub(crate) queue: VecDeque<Point>,
    pub(crate) stop: Option<Stop>,
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
        branch.correct_start()?;
        let rate = branch.rate(&branch.node.tangent);
        let forward = match direction {
            Direction::Increasing => rate >= 0.0 || rate.abs() < TURNING,
            Direction::Decreasing => rate < 0.0 && rate.abs() >= TURNING,
        };
        branch.set_out(forward);
        Ok(branch)
    }

    /// The branch onward from one of its points, in the direction of the point's tangent.
    ///
    /// # Errors
    /// As [`new`](Self::new); branch points are no obstacle.
    pub fn resume(system: &'a mut S, point: &Point, options: &Options) -> Result<Self, Error> {
        let mut branch = Self::at(system, &point.z, options)?;
        check_length(&point.tangent, point.z.len())?;
        branch.node.tangent.clone_from(&point.tangent);
        branch.metric.reach(&point.tangent);
        if point.kind == Kind::BranchPoint {
            (branch.unoriented, branch.from_branch_point) = (true, true);
            branch.metric.normalise(&mut branch.node.tangent);
            branch.column = column(branch.system, &branch.corrector, &branch.metric, &point.z)
                .map_err(Error::Start)?;
            branch.set_out(true);
        } else {
            branch
                .correct_across(point.tangent.clone())
                .map_err(Error::Start)?;
            branch.watch_branch_points().map_err(Error::Start)?;
            let ahead = branch.metric.dot(&branch.node.tangent, &point.tangent) >= 0.0;
            branch.set_out(ahead);
        }
        Ok(branch)
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
        let node = Node::new(z.to_vec(), vec![0.0; unknowns]);
        Ok(Self {
            metric: Metric::new(system, options, z),
            system,
            options: options.clone(),
            corrector: Corrector::within(options.bounds),
            column: Vec::new(),
            events: Vec::new(),
            home: node.clone(),
            node,
            history: History::default(),
            from_branch_point: false,
            unoriented: false,
            trend: None,
            step: options.first_step.min(options.largest_step),
            steps: 0,
            queue: VecDeque::new(),
            stop: None,
        })
    }

    /// Corrects the start at its λ, else across the curve, and finds its tangent.
    fn correct_start(&mut self) -> Result<(), Error> {
        let unknowns = self.node.z.len();
        let condition = Condition::lambda(unknowns, self.node.z[unknowns - 1]);
        let mut z = self.node.z.clone();
        match self.correct_to(&mut z, &condition) {
            Ok(()) => {
                z[unknowns - 1] = self.node.z[unknowns - 1];
                self.node.z = z;
            }
            Err(difficulty) => {
                let tangent = self
                    .corrector
                    .tangent(self.system, &self.metric, &self.node.z);
                let across = tangent.map(|tangent| self.correct_across(tangent));
                if !matches!(across, Ok(Ok(()))) {
                    return Err(Error::Start(difficulty));
                }
            }
        }
        self.metric.observe(&self.node.z);
        let (system, z) = (&mut *self.system, &self.node.z);
        let tangent = self
            .corrector
            .tangent(system, &self.metric, z)
            .map_err(Error::Start)?;
        self.metric.reach(&tangent);
        self.node.tangent = tangent;
        self.metric.normalise(&mut self.node.tangent);
        self.watch_branch_points().map_err(Error::Start)?;
        if self.node.height().abs() < SINGULAR {
            return Err(Error::SingularStart);
        }
        Ok(())
    }

    /// Corrects the node across `tangent` and finds its own tangent.
    fn correct_across(&mut self, tangent: Vec<f64>) -> Result<(), Difficulty> {
        let mut z = self.node.z.clone();
        let plane = Condition::plane(&self.metric, &tangent, &z);
        self.correct_to(&mut z, &plane)?;
        self.node.tangent = self.corrector.tangent(self.system, &self.metric, &z)?;
        self.node.z = z;
        Ok(())
    }

    /// Chooses the column for the test function for branch points and gives the node, where the system
    /// was linearised last, its second null vector.
    pub(crate) fn watch_branch_points(&mut self) -> Result<(), Difficulty> {
        self.column = column(self.system, &self.corrector, &self.metric, &self.node.z)?;
        let tangent = self.node.tangent.clone();
        let second = self.second_vector(&tangent)?;
        // The second vector is (v, −1) up to its length, with J v = b: b is enlarged until v has length
        // one. With a short v the component η outweighs it, and pairs of branch points are missed.
        let eta = second.last().map_or(1.0, |eta| eta.abs());
        let length = (1.0 - eta * eta).sqrt() / eta;
        let scale = if length > 0.0 { length.min(1.0) } else { 1.0 };
        self.column.iter_mut().for_each(|b| *b /= scale);
        self.node.second = self.second_vector(&tangent)?;
        self.trend = None;
        Ok(())
    }

    /// The second null vector of \[J b\], where the system was linearised last, for a unit tangent.
    pub(crate) fn second_vector(&mut self, tangent: &[f64]) -> Result<Vec<f64>, Difficulty> {
        NullSpace::second(self.system, &self.metric, tangent, &self.column)
            .ok_or(Difficulty::Singular)
    }

    fn correct_to(&mut self, z: &mut [f64], condition: &Condition) -> Result<(), Difficulty> {
        let accuracy = Accuracy::Rounding;
        self.corrector
            .correct(
                self.system,
                &self.metric,
                z,
                condition,
                accuracy,
                CORRECTIONS,
            )
            .map(|_| ())
    }

    /// Makes the node the first point, to be left along its tangent or against it.
    fn set_out(&mut self, along: bool) {
        if !along {
            reverse(&mut self.node.tangent);
        }
        self.node.along = along;
        self.node.cusp = self.system.cusp_function();
        self.home = self.node.clone();
        let start = self.node.point(Kind::Start);
        let turning = self.rate(&self.node.tangent).abs() < TURNING;
        if turning && !self.unoriented {
            self.queue.push_back(Point {
                kind: Kind::LimitPoint,
                ..start.clone()
            });
        }
        self.queue.push_front(start);
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
        let value = function(self.system, &self.node.point(Kind::Regular));
        self.node.events.push(value);
        self.events.push(Box::new(function));
        self
    }

    /// The system, in the discretisation of the last point yielded.
    pub fn system(&self) -> &S {
        self.system
    }

    /// Why the branch has ended; `None` while it goes on.
    pub fn stop(&self) -> Option<&Stop> {
        self.stop.as_ref().filter(|_| self.queue.is_empty())
    }

    /// Gives up the branch for the reason why it has ended.
    pub fn into_stop(self) -> Option<Stop> {
        self.stop
    }
}

impl<S: System> Iterator for Branch<'_, S> {
    type Item = Point;

    fn next(&mut self) -> Option<Point> {
        if self.queue.is_empty() && self.stop.is_none() {
            self.advance();
        }
        let point = self.queue.pop_front()?;
        Some(self.assessed(point))
    }
}

/// Turns a tangent round.
pub(crate) fn reverse(tangent: &mut [f64]) {
    tangent.iter_mut().for_each(|t| *t = -*t);
}
