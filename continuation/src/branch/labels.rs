//! The labelled points of a step.

use crate::branch::branch::Branch;
use crate::branch::branch::TURNING;
use crate::error::Difficulty;
use crate::point::{Kind, Point};
use crate::special_points::span::{Located, Node, RESOLVED, Span};
use crate::system::system::System;

/// Where λ turns more slowly than this at a branch point or cusp, it turns because of it.
const COINCIDENT: f64 = 1e-5;
/// A closed curve is noticed after so many steps, ...
const FEWEST_STEPS: usize = 3;
/// ... when the start lies within this share of a step from the secant, ...
const NEAR: f64 = 0.3;
/// ... and is met with this accuracy, or to that of the discretisation.
const MET: f64 = 1e-6;
/// Labelled points this close to the first point, as a share of the step, are those at the first one.
const AT_HOME: f64 = 1e-6;

/// A labelled point of a step.
pub(crate) struct Found {
    pub(crate) at: Located,
    pub(crate) kind: Kind,
    pub(crate) other: Option<Vec<f64>>,
}

impl Found {
    fn new(at: Located, kind: Kind) -> Self {
        let other = None;
        Self { at, kind, other }
    }
}

impl<S: System> Branch<'_, S> {
    /// All labelled points on the step to `to`, in order. Where a point is indicated but not found,
    /// an error if `strict`; else it is passed over.
    pub(crate) fn specials(&mut self, to: &Node, strict: bool) -> Result<Vec<Found>, Difficulty> {
        let pass = |outcome: Result<Vec<Found>, Difficulty>| match outcome {
            Err(difficulty) if strict => Err(difficulty),
            outcome => Ok(outcome.unwrap_or_default()),
        };
        let mut found = pass(self.branch_points(to))?;
        found.extend(pass(self.cusps(to))?);
        let limits = pass(self.limit_points(to, &found))?;
        found.extend(limits);
        for index in 0..self.events.len() {
            found.extend(pass(self.event_points(index, to))?);
        }
        let mut corners = vec![self.node.clone()];
        let turns = found.iter().filter(|found| found.kind == Kind::LimitPoint);
        corners.extend(turns.map(|found| Node::new(found.at.z.clone(), found.at.tangent.clone())));
        corners.push(to.clone());
        for target in self.options.targets.clone() {
            found.extend(pass(self.target_points(target, &corners, to))?);
        }
        if let Some(home) = self.home_on(to) {
            found.retain(|found| found.at.u < home.u - AT_HOME);
            found.push(Found::new(home, Kind::Closed));
        }
        found.sort_by(|a, b| a.at.u.total_cmp(&b.at.u));
        Ok(found)
    }

    /// The unit tangent's component along λ, with the range of λ as unit.
    pub(crate) fn rate(&self, tangent: &[f64]) -> f64 {
        tangent[tangent.len() - 1] / self.metric.range()
    }

    /// A branch point, where the system turns the orientation of its null vector.
    fn branch_points(&mut self, to: &Node) -> Result<Vec<Found>, Difficulty> {
        if self.unoriented || to.along == self.node.along {
            return Ok(Vec::new());
        }
        let (at, crossing) = self.span(to).crossing()?;
        let aligned = |t: &[f64]| self.metric.dot(t, &at.tangent).abs();
        let least = |[a, b]: [Vec<f64>; 2]| if aligned(&a) < aligned(&b) { a } else { b };
        let other = crossing.tangents.map(least);
        let kind = Kind::BranchPoint;
        Ok(vec![Found { at, kind, other }])
    }

    /// A cusp, where the cusp function of the system changes its sign.
    fn cusps(&mut self, to: &Node) -> Result<Vec<Found>, Difficulty> {
        match (self.node.cusp, to.cusp) {
            (Some(before), Some(after)) if before * after < 0.0 => {
                let mut cusp = |system: &mut S, _: &[f64], _: &[f64]| {
                    system.cusp_function().unwrap_or(f64::NAN)
                };
                let at = self.span(to).zero(&mut cusp, [before, after], RESOLVED)?;
                Ok(vec![Found::new(at, Kind::Cusp)])
            }
            _ => Ok(Vec::new()),
        }
    }

    /// Limit points. At the branch points and cusps `found` on the step, and at a branch point at its
    /// beginning, the rate of λ may change its sign without a limit point.
    fn limit_points(&mut self, to: &Node, found: &[Found]) -> Result<Vec<Found>, Difficulty> {
        let turned = found
            .iter()
            .any(|found| self.rate(&found.at.tangent).abs() < COINCIDENT);
        let [before, after] = [&self.node, to].map(|node| self.rate(&node.tangent).abs());
        let at_rest = before.max(after) < TURNING;
        if turned || at_rest || self.unoriented && before < COINCIDENT {
            return Ok(Vec::new());
        }
        let limits = self.span(to).limit_points()?;
        Ok(limits
            .into_iter()
            .map(|at| Found::new(at, Kind::LimitPoint))
            .collect())
    }

    /// A zero of an event function. Where the function changes its sign through a pole, or is
    /// undefined, is none.
    fn event_points(&mut self, index: usize, to: &Node) -> Result<Vec<Found>, Difficulty> {
        let values = [self.node.events[index], to.events[index]];
        if !(values[0] * values[1] < 0.0 || values[1] == 0.0 && values[0] != 0.0) {
            return Ok(Vec::new());
        }
        let mut events = std::mem::take(&mut self.events);
        let event = &mut events[index];
        let (from, metric) = (self.node.clone(), self.metric.clone());
        let mut value = |system: &mut S, z: &[f64], tangent: &[f64]| {
            let mut node = Node::new(z.to_vec(), tangent.to_vec());
            node.arclength = from.arclength + from.length_to(&node, &metric);
            event(system, &node.point(Kind::Regular))
        };
        let outcome = self.span(to).zero(&mut value, values, RESOLVED);
        let least = outcome
            .as_ref()
            .map_or(0.0, |at| value(self.system, &at.z, &at.tangent).abs());
        self.events = events;
        let at = outcome?;
        let zero = least <= values[0].abs().max(values[1].abs());
        Ok(if zero {
            vec![Found::new(at, Kind::Event(index))]
        } else {
            Vec::new()
        })
    }

    /// Points with a target value of λ, on every piece of the step, between `corners`, where λ is
    /// monotonic.
    fn target_points(
        &mut self,
        target: f64,
        corners: &[Node],
        to: &Node,
    ) -> Result<Vec<Found>, Difficulty> {
        let n = to.z.len() - 1;
        let mut found = Vec::new();
        for pair in corners.windows(2) {
            let [before, after] = [&pair[0], &pair[1]].map(|node| node.z[n] - target);
            if before * after < 0.0 || after == 0.0 {
                let mut piece = Span {
                    from: &pair[0],
                    ..self.span(&pair[1])
                };
                let mut at = piece.at_lambda(target)?;
                at.u = self.span(to).place(&at.z);
                found.push(Found::new(at, Kind::Target));
            }
        }
        Ok(found)
    }

    /// The first point, if the step passes it in the direction in which it was left.
    fn home_on(&mut self, to: &Node) -> Option<Located> {
        if self.steps < FEWEST_STEPS {
            return None;
        }
        let home = self.home.clone();
        let mut span = self.span(to);
        let u = span.place(&home.z);
        if !(u > 0.0 && u <= 1.0) {
            return None;
        }
        let ends = span.from.z.iter().zip(&to.z);
        let secant: Vec<f64> = ends.clone().map(|(a, b)| b - a).collect();
        let near: Vec<f64> = ends.map(|(a, b)| a + u * (b - a)).collect();
        let length = span.metric.norm(&secant);
        let ahead = span.metric.dot(&home.tangent, &secant) > 0.5 * length;
        if !ahead || span.metric.distance(&near, &home.z) > NEAR * length {
            return None;
        }
        let met = span.across(&near, &home.tangent, &home.z).ok()?;
        let missed = span.metric.distance(&met, &home.z);
        let tolerance = span.system.tolerance();
        let allowed = if tolerance.is_finite() {
            MET.max(10.0 * tolerance)
        } else {
            MET
        };
        let (z, tangent) = (home.z, home.tangent);
        (missed <= allowed).then_some(Located { u, z, tangent })
    }

    /// A labelled point as it is yielded.
    pub(crate) fn labelled(&self, found: Found) -> Point {
        let Found { at, kind, other } = found;
        let mut node = Node::new(at.z, at.tangent);
        node.arclength = self.node.arclength + self.node.length_to(&node, &self.metric);
        Point {
            other,
            ..node.point(kind)
        }
    }
}
