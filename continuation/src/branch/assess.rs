//! The discretisation error of labelled points.

use crate::branch::discretisation::{CORRECTIONS, Discretisation};
use crate::branch::events::Events;
use crate::branch::progress::Progress;
use crate::curve::corrector::Condition;
use crate::curve::curve::{Curve, ahead, reverse};
use crate::curve::metric::Metric;
use crate::difficulty::Difficulty;
use crate::options::Options;
use crate::point::{DiscretisationError, Kind, Point};
use crate::special_points::branch_point::{branch_point, set_borders};
use crate::special_points::node::Node;
use crate::stop::Stop;
use crate::system::system::System;

/// The most refinements for one labelled point.
const REFINEMENTS: usize = 4;
/// First step of the secant method, in the arclength norm.
const SECANT: f64 = 1e-4;
/// The most steps of the secant method.
const SECANT_STEPS: usize = 15;

/// What the discretisation error of a labelled point is found with.
pub(crate) struct Assessment<'s, 'a, S> {
    pub(crate) curve: &'s mut Curve<'a, S>,
    pub(crate) events: &'s mut Events<'a, S>,
    pub(crate) progress: &'s mut Progress,
    pub(crate) options: &'s Options,
    /// The kinds of points whose error is not asked for.
    pub(crate) unassessed: &'s [Kind],
}

impl<S: System> Assessment<'_, '_, S> {
    /// Gives a labelled point its discretisation error: the same point is located on the refined
    /// system. Where the error exceeds the tolerance of the system, the branch goes over to the
    /// refined one; where it stays so, that is a reason to stop.
    pub(crate) fn assessed(&mut self, mut point: Point) -> (Point, Option<Stop>) {
        let is_asked_for = point.kind != Kind::Regular && !self.unassessed.contains(&point.kind);
        if !is_asked_for || point.approximate {
            return (point, None);
        }
        let tolerance = self.curve.system.tolerance();
        // A branch that sets out from a branch point has no other place for it.
        let crossing = point.kind == Kind::Start && self.progress.unoriented;
        let kind = if crossing {
            Kind::BranchPoint
        } else {
            point.kind
        };
        for _ in 0..REFINEMENTS {
            let mut vectors = self.progress.take_vectors();
            vectors.push(point.z.clone());
            vectors.push(point.tangent.clone());
            vectors.extend(point.other.clone());
            let coarse = vectors.clone();
            let Some(mut fine) = self.curve.system.refined(&mut vectors) else {
                self.progress.put_vectors(coarse);
                break;
            };
            let other = point.other.as_ref().and_then(|_| vectors.pop());
            let tangent = vectors.pop().unwrap_or_default();
            let z = vectors.pop().unwrap_or_default();
            let mut metric = self.curve.metric.clone();
            metric.regroup(&fine);
            let near = Point {
                arclength: point.arclength,
                ..Node::new(z, tangent).point(kind)
            };
            let Ok(refined) = self.relocate(&mut fine, &metric, &near) else {
                self.progress.put_vectors(coarse);
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
                self.progress.put_vectors(coarse);
                return (point, None);
            }
            if crossing {
                vectors[0].clone_from(&refined);
            }
            let mut discretisation = Discretisation {
                accuracy: self.curve.accuracy(self.options.accuracy),
                curve: &mut *self.curve,
                progress: &mut *self.progress,
            };
            let outcome = discretisation.exchange(fine, vectors, coarse, f64::INFINITY);
            if outcome.is_err() {
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
        let error = point
            .error
            .map_or(0.0, |error| self.relative(&error, point.lambda()));
        let stop = (error > tolerance).then_some(Stop::Inaccurate { error, tolerance });
        (point, stop)
    }

    /// The larger of both errors, that of λ relative to λ (but to no less than a thousandth of its
    /// range).
    fn relative(&self, error: &DiscretisationError, lambda: f64) -> f64 {
        let scale = lambda.abs().max(1e-3 * self.curve.metric.range());
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
        let mut curve = Curve::new(system, metric.clone(), self.options.bounds);
        curve.location = self.options.location;
        let accuracy = curve.located();
        let to = |curve: &mut Curve<'_, S>, condition: &Condition| {
            let mut z = z.to_vec();
            curve
                .correct(&mut z, condition, accuracy, CORRECTIONS)
                .map(|_| z)
        };
        let at_lambda = Condition::lambda(n + 1, z[n]);
        let across = Condition::plane(metric, tangent, z);
        match kind {
            Kind::Target | Kind::Bound => to(&mut curve, &at_lambda),
            // A limit point is not determined by its λ.
            Kind::Start => to(&mut curve, &at_lambda).or_else(|_| to(&mut curve, &across)),
            Kind::Regular | Kind::Closed => to(&mut curve, &across),
            Kind::BranchPoint => {
                set_borders(&mut curve, z)?;
                branch_point(&mut curve, z).map(|found| found.z)
            }
            Kind::LimitPoint | Kind::Cusp | Kind::Event(_) => {
                let unit = metric.dot(tangent, tangent);
                let mut value = |curve: &mut Curve<'_, S>, s: f64, z: Vec<f64>| {
                    let mut tangent_here = curve.tangent(&z)?;
                    if metric.dot(&tangent_here, tangent) < 0.0 {
                        reverse(&mut tangent_here);
                    }
                    let rate = tangent_here[n];
                    let mut node = Node::new(z, tangent_here);
                    node.arclength = point.arclength + s * unit.sqrt();
                    let value = match kind {
                        Kind::Event(index) => self.events.value(index, curve.system, &node),
                        Kind::Cusp => curve.system.cusp_function().unwrap_or(rate),
                        _ => rate,
                    };
                    Ok(Place { s, node, value })
                };
                let first = to(&mut curve, &across)?;
                let first = value(&mut curve, 0.0, first)?;
                let onward = |from: &Place, s: f64| {
                    let here = &from.node;
                    let way = (s - from.s) * unit / metric.dot(&here.tangent, tangent);
                    let mut next = ahead(&here.z, &here.tangent, way);
                    let plane = Condition::plane(metric, tangent, &ahead(z, tangent, s));
                    curve.locate_nearby(&mut next, &plane, CORRECTIONS)?;
                    value(&mut curve, s, next)
                };
                secant(first, onward, self.options.location)
            }
        }
    }
}

/// A place of a branch on the refined system.
struct Place {
    /// How far it is along the tangent of the point that is sought.
    s: f64,
    node: Node,
    /// The function whose zero is sought.
    value: f64,
}

/// The place where the value is zero near that at s = 0, by the secant method down to steps of this length or rounding.
fn secant(
    mut here: Place,
    mut onward: impl FnMut(&Place, f64) -> Result<Place, Difficulty>,
    length: f64,
) -> Result<Vec<f64>, Difficulty> {
    let mut s = here.s + SECANT;
    let mut last = f64::INFINITY;
    for _ in 0..SECANT_STEPS {
        if here.value == 0.0 {
            return Ok(here.node.z);
        }
        let next = onward(&here, s)?;
        let before = std::mem::replace(&mut here, next);
        if here.value.is_nan() {
            break;
        }
        let step = -here.value * (here.s - before.s) / (here.value - before.value);
        if !step.is_finite() || step.abs() <= length || step.abs() >= 0.5 * last && last < SECANT {
            return Ok(here.node.z);
        }
        s = here.s + step;
        last = step.abs();
    }
    Err(Difficulty::NoConvergence {
        correction: last,
        steps: SECANT_STEPS,
        limit: SECANT,
    })
}
