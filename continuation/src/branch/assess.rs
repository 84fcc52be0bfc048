//! The discretisation error of labelled points.

use crate::branch::branch::Branch;
use crate::branch::branch::reverse;
use crate::curve::corrector::{Accuracy, Condition, Corrector};
use crate::curve::metric::Metric;
use crate::difficulty::Difficulty;
use crate::point::{DiscretisationError, Kind, Point};
use crate::special_points::branch_point::{branch_point, column};
use crate::special_points::span::Node;
use crate::stop::Stop;
use crate::system::system::System;

/// The most refinements for one labelled point.
const REFINEMENTS: usize = 4;
/// The most corrections of a point on the refined system.
const CORRECTIONS: usize = 30;
/// A tangent from this near a point is that of the point.
const DRIFT: f64 = 1e-6;
/// First step of the secant method, in the arclength norm.
const SECANT: f64 = 1e-4;
/// The most steps of the secant method.
const SECANT_STEPS: usize = 15;

impl<S: System> Branch<'_, S> {
    /// Gives a labelled point its discretisation error: the same point is located on the refined
    /// system. Where the error exceeds the tolerance of the system, the branch goes over to the
    /// refined one.
    pub(crate) fn assessed(&mut self, mut point: Point) -> Point {
        if point.kind == Kind::Regular || point.approximate {
            return point;
        }
        let tolerance = self.system.tolerance();
        // A branch that sets out from a branch point has no other place for it.
        let crossing = point.kind == Kind::Start && self.unoriented;
        let kind = if crossing {
            Kind::BranchPoint
        } else {
            point.kind
        };
        for _ in 0..REFINEMENTS {
            let mut vectors = self.take_vectors();
            vectors.push(point.z.clone());
            vectors.push(point.tangent.clone());
            vectors.extend(point.other.clone());
            let coarse = vectors.clone();
            let Some(mut fine) = self.system.refined(&mut vectors) else {
                self.put_vectors(coarse);
                break;
            };
            let other = point.other.as_ref().and_then(|_| vectors.pop());
            let tangent = vectors.pop().unwrap_or_default();
            let z = vectors.pop().unwrap_or_default();
            let mut metric = self.metric.clone();
            metric.regroup(&fine);
            let near = Point {
                arclength: point.arclength,
                ..Node::new(z, tangent).point(kind)
            };
            let Ok(refined) = self.relocate(&mut fine, &metric, &near) else {
                self.put_vectors(coarse);
                let (lambda, states) = (f64::INFINITY, f64::INFINITY);
                point.error = Some(DiscretisationError { lambda, states });
                break;
            };
            let Point { z, tangent, .. } = near;
            let n = z.len() - 1;
            let error = DiscretisationError {
                lambda: (refined[n] - z[n]).abs(),
                states: metric.largest_difference(&refined, &z),
            };
            point.error = Some(error);
            if self.relative(&error, refined[n]) <= tolerance {
                self.put_vectors(coarse);
                return point;
            }
            if crossing {
                vectors[0].clone_from(&refined);
            }
            if self.exchange(fine, vectors, coarse, f64::INFINITY).is_err() {
                break;
            }
            // The refined point is the better one; its own error is asked for next.
            point = Point {
                z: refined,
                tangent,
                other,
                ..point
            };
        }
        if let Some(error) = point.error {
            let error = self.relative(&error, point.lambda());
            if error > tolerance {
                self.stop = Some(Stop::Inaccurate { error, tolerance });
                self.queue.clear();
            }
        }
        point
    }

    /// The larger of both errors, that of λ relative to λ (but to no less than a thousandth of its
    /// range).
    fn relative(&self, error: &DiscretisationError, lambda: f64) -> f64 {
        let scale = lambda.abs().max(1e-3 * self.metric.range());
        error.states.max(error.lambda / scale)
    }

    /// The same labelled point on another system, from what is known of it there.
    fn relocate(
        &mut self,
        system: &mut S,
        metric: &Metric,
        point: &Point,
    ) -> Result<Vec<f64>, Difficulty> {
        let (z, tangent, kind) = (&point.z[..], &point.tangent[..], point.kind);
        let n = z.len() - 1;
        let bounded = Corrector::within(self.options.bounds);
        let mut corrector = bounded.clone();
        let mut to = |system: &mut S, mut z: Vec<f64>, condition: &Condition| {
            let accuracy = Accuracy::Rounding;
            corrector
                .correct(system, metric, &mut z, condition, accuracy, CORRECTIONS)
                .map(|_| z)
        };
        let mut events = std::mem::take(&mut self.events);
        let outcome = match kind {
            Kind::Target | Kind::Bound => {
                let condition = Condition::lambda(n + 1, z[n]);
                to(system, z.to_vec(), &condition)
            }
            // A limit point is not determined by its λ.
            Kind::Start => to(system, z.to_vec(), &Condition::lambda(n + 1, z[n]))
                .or_else(|_| to(system, z.to_vec(), &Condition::plane(metric, tangent, z))),
            Kind::Regular | Kind::Closed => {
                to(system, z.to_vec(), &Condition::plane(metric, tangent, z))
            }
            Kind::BranchPoint => column(system, &bounded, metric, z).and_then(|column| {
                let mut corrector = bounded.clone();
                branch_point(system, &mut corrector, metric, z, &column).map(|found| found.z)
            }),
            Kind::LimitPoint | Kind::Cusp | Kind::Event(_) => {
                let mut tangents = Corrector::anywhere();
                let mut value = |system: &mut S, s: f64, place: &[f64]| {
                    let mut t = tangents.tangent(system, metric, place)?;
                    if metric.dot(&t, tangent) < 0.0 {
                        reverse(&mut t);
                    }
                    if let Kind::Event(index) = kind {
                        let mut node = Node::new(place.to_vec(), t);
                        node.arclength = point.arclength + s * metric.norm(tangent);
                        return Ok(events[index](system, &node.point(Kind::Regular)));
                    }
                    let cusp = system.cusp_function().filter(|_| kind == Kind::Cusp);
                    Ok(cusp.unwrap_or(t[n]))
                };
                let mut at = |system: &mut S, s: f64| -> Result<(Vec<f64>, f64), Difficulty> {
                    let near: Vec<f64> = z.iter().zip(tangent).map(|(z, t)| z + s * t).collect();
                    let plane = Condition::plane(metric, tangent, &near);
                    let found = to(system, near, &plane)?;
                    let value = value(system, s, &found)?;
                    Ok((found, value))
                };
                secant(|s| at(system, s))
            }
        };
        self.events = events;
        outcome
    }

    /// Brings the last node back to the curve after the system has changed, by `limit` at most.
    pub(crate) fn settle(&mut self, limit: f64) -> Result<(), Difficulty> {
        self.metric.regroup(self.system);
        self.metric.normalise(&mut self.home.tangent);
        if self.unoriented && self.history.arclengths.is_empty() {
            // A branch point, located already.
            self.metric.normalise(&mut self.node.tangent);
            self.column = column(self.system, &self.corrector, &self.metric, &self.node.z)?;
            return Ok(());
        }
        let mut z = self.node.z.clone();
        let plane = Condition::plane(&self.metric, &self.node.tangent, &z);
        let accuracy = Accuracy::Length(self.accuracy());
        let (system, metric) = (&mut *self.system, &self.metric);
        let report =
            self.corrector
                .correct(system, metric, &mut z, &plane, accuracy, CORRECTIONS)?;
        let distance = metric.distance(&z, &self.node.z);
        if distance > limit {
            return Err(Difficulty::Shift { distance, limit });
        }
        let mut tangent = self.corrector.null().to_vec();
        if report.drift > DRIFT || !metric.normalise(&mut tangent) {
            tangent = self.corrector.tangent(system, metric, &z)?;
        }
        self.node.along = metric.dot(&tangent, &self.node.tangent) > 0.0;
        if !self.node.along {
            reverse(&mut tangent);
        }
        self.node.cusp = self.system.cusp_function();
        self.node.z = z;
        self.node.tangent = tangent;
        self.watch_branch_points()
    }
}

/// The place where the value is zero near s = 0, by the secant method down to rounding.
fn secant(
    mut at: impl FnMut(f64) -> Result<(Vec<f64>, f64), Difficulty>,
) -> Result<Vec<f64>, Difficulty> {
    let (mut s, (mut place, mut value)) = (0.0, at(0.0)?);
    let (mut other, (_, mut before)) = (SECANT, at(SECANT)?);
    let mut last = f64::INFINITY;
    for _ in 0..SECANT_STEPS {
        let step = -value * (s - other) / (value - before);
        if value.is_nan() {
            break;
        }
        if !step.is_finite() || step.abs() >= 0.5 * last && last < SECANT {
            return Ok(place);
        }
        (other, before) = (s, value);
        s += step;
        (place, value) = at(s)?;
        last = step.abs();
        if value == 0.0 {
            return Ok(place);
        }
    }
    Err(Difficulty::NoConvergence {
        correction: last,
        steps: SECANT_STEPS,
        limit: SECANT,
    })
}
