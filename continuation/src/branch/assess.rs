//! The discretisation error of labelled points.

use crate::branch::discretisation::{CORRECTIONS, Discretisation};
use crate::branch::events::Events;
use crate::branch::progress::Progress;
use crate::curve::corrector::{Accuracy, Condition};
use crate::curve::curve::{Curve, reverse};
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
}

impl<S: System> Assessment<'_, '_, S> {
    /// Gives a labelled point its discretisation error: the same point is located on the refined
    /// system. Where the error exceeds the tolerance of the system, the branch goes over to the
    /// refined one; where it stays so, that is a reason to stop.
    pub(crate) fn assessed(&mut self, mut point: Point) -> (Point, Option<Stop>) {
        let is_asked_for = match point.kind {
            Kind::Regular => false,
            Kind::Event(index) => self.events.is_assessed(index),
            _ => true,
        };
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
        let to = |curve: &mut Curve<'_, S>, mut z: Vec<f64>, condition: &Condition| {
            curve
                .correct(&mut z, condition, Accuracy::Rounding, CORRECTIONS)
                .map(|_| z)
        };
        match kind {
            Kind::Target | Kind::Bound => {
                let condition = Condition::lambda(n + 1, z[n]);
                to(&mut curve, z.to_vec(), &condition)
            }
            // A limit point is not determined by its λ.
            Kind::Start => {
                to(&mut curve, z.to_vec(), &Condition::lambda(n + 1, z[n])).or_else(|_| {
                    to(
                        &mut curve,
                        z.to_vec(),
                        &Condition::plane(metric, tangent, z),
                    )
                })
            }
            Kind::Regular | Kind::Closed => to(
                &mut curve,
                z.to_vec(),
                &Condition::plane(metric, tangent, z),
            ),
            Kind::BranchPoint => {
                set_borders(&mut curve, z)?;
                branch_point(&mut curve, z).map(|found| found.z)
            }
            Kind::LimitPoint | Kind::Cusp | Kind::Event(_) => {
                let mut value = |curve: &mut Curve<'_, S>, s: f64, place: &[f64]| {
                    let mut t = curve.tangent(place)?;
                    if metric.dot(&t, tangent) < 0.0 {
                        reverse(&mut t);
                    }
                    if let Kind::Event(index) = kind {
                        let mut node = Node::new(place.to_vec(), t);
                        node.arclength = point.arclength + s * metric.norm(tangent);
                        return Ok(self.events.value(index, curve.system, &node));
                    }
                    let cusp = curve.system.cusp_function().filter(|_| kind == Kind::Cusp);
                    Ok(cusp.unwrap_or(t[n]))
                };
                let mut at = |curve: &mut Curve<'_, S>,
                              s: f64|
                 -> Result<(Vec<f64>, f64), Difficulty> {
                    let near: Vec<f64> = z.iter().zip(tangent).map(|(z, t)| z + s * t).collect();
                    let plane = Condition::plane(metric, tangent, &near);
                    let found = to(curve, near, &plane)?;
                    let value = value(curve, s, &found)?;
                    Ok((found, value))
                };
                secant(|s| at(&mut curve, s))
            }
        }
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
