//! The labelled points of a step.

use crate::branch::branch::Branch;
use crate::difficulty::Difficulty;
use crate::point::{Kind, Point};
use crate::special_points::span::{Located, Node, RESOLVED, Span};
use crate::system::system::System;
use std::f64::consts::FRAC_PI_2;

/// Where λ turns more slowly than this at a branch point or cusp, it turns because of it.
const COINCIDENT: f64 = 1e-5;
/// A closed curve is noticed after so many steps, ...
const FEWEST_STEPS: usize = 3;
/// ... when the start lies within this share of a step from the secant, ...
const NEAR: f64 = 0.3;
/// ... and is met with this accuracy, or to that of the discretisation.
const MET: f64 = 1e-6;
/// On steps that are this share of the largest, limit points that cannot be verified are approximate, and
/// other labelled points that cannot be found are passed over.
const PASSED: f64 = 1e-4;
/// On steps that are this share of the largest, branch points that cannot be verified are approximate. It is
/// as small as steps can well be, because the same signs tell of a jump to another branch.
pub(crate) const UNVERIFIED: f64 = 1e-6;
/// Where its rate is below this at both ends of a step, with its range as unit, λ is constant but for
/// rounding, as on the branches of linear eigenproblems: the signs of 1e-11 were taken for limit points
/// there.
const CONSTANT: f64 = 1e-9;
/// The cusp function of a cusp is this share of that at the ends of the step, at most.
const CUSP: f64 = 1e-4;
/// Labelled points this close to the first point, as a share of the step, are those at the first one.
const AT_HOME: f64 = 1e-6;

/// A labelled point of a step.
pub(crate) struct Found {
    pub(crate) at: Located,
    pub(crate) kind: Kind,
    pub(crate) other: Option<Vec<f64>>,
    /// Whether its defining conditions could not be verified.
    pub(crate) approximate: bool,
}

impl Found {
    fn new(at: Located, kind: Kind) -> Self {
        Self {
            at,
            kind,
            other: None,
            approximate: false,
        }
    }

    /// The point as a node, with the orientation behind it.
    fn node(&self) -> Node {
        let mut node = Node::new(self.at.z.clone(), self.at.tangent.clone());
        node.along = self.at.along;
        node
    }

    /// A point that is indicated at 0 ≤ u ≤ 1 of the secant of a short step, but not verified.
    fn approximate(from: &Node, to: &Node, u: f64, kind: Kind) -> Self {
        let between = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| a + u * (b - a)).collect()
        };
        let z = between(&from.z, &to.z);
        let tangent = between(&from.tangent, &to.tangent);
        Self {
            approximate: true,
            ..Self::new(
                Located {
                    u,
                    z,
                    tangent,
                    along: to.along,
                },
                kind,
            )
        }
    }
}

impl<S: System> Branch<'_, S> {
    /// All labelled points on the step to `to`, in order; the step is this `share` of the largest. Where
    /// a point is indicated but not verified, the step is to be repeated shorter; on the shortest ones a
    /// limit point or branch point is then approximate, and others are passed over.
    pub(crate) fn specials(&mut self, to: &Node, share: f64) -> Result<Vec<Found>, Difficulty> {
        let strict = share > PASSED;
        let pass = |outcome: Result<Vec<Found>, Difficulty>| match outcome {
            Err(difficulty) if strict => Err(difficulty),
            outcome => Ok(outcome.unwrap_or_default()),
        };
        let mut found = self.branch_points(to, share)?;
        found.extend(pass(self.cusps(to))?);
        let limits = self.limit_points(to, &found, share)?;
        found.extend(limits);
        for index in 0..self.events.len() {
            found.extend(pass(self.event_points(index, to))?);
        }
        let mut corners = vec![self.node.clone()];
        let turns = found.iter().filter(|found| found.kind == Kind::LimitPoint);
        corners.extend(turns.map(Found::node));
        corners.push(to.clone());
        for target in self.options.targets.clone() {
            found.extend(pass(self.target_points(target, &corners, to))?);
        }
        if let Some(home) = self.home_among(&found).or_else(|| self.home_on(to)) {
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

    /// A branch point, where the orientation of the null vector changes. On the shortest steps
    /// also one of even multiplicity, where it does not but the second vector turns over.
    fn branch_points(&mut self, to: &Node, share: f64) -> Result<Vec<Found>, Difficulty> {
        if self.unoriented {
            return Ok(Vec::new());
        }
        let kind = Kind::BranchPoint;
        let [before, after] = [&self.node, to].map(|node| node.height().abs());
        let u = before / (before + after);
        if to.along == self.node.along {
            let turned = self.node.second_angle(to, &self.metric) > FRAC_PI_2;
            let even = turned && share <= UNVERIFIED;
            let found = even.then(|| Found::approximate(&self.node, to, u, kind));
            return Ok(found.into_iter().collect());
        }
        let (at, crossing) = match self.span(to).crossing() {
            Ok(found) => found,
            Err(_) if share <= UNVERIFIED => {
                return Ok(vec![Found::approximate(&self.node, to, u, kind)]);
            }
            Err(difficulty) => return Err(difficulty),
        };
        let aligned = |t: &[f64]| self.metric.dot(t, &at.tangent).abs();
        let least = |[a, b]: [Vec<f64>; 2]| if aligned(&a) < aligned(&b) { a } else { b };
        let other = crossing.tangents.map(least);
        Ok(vec![Found {
            other,
            ..Found::new(at, kind)
        }])
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

    /// Limit points, between the branch points and cusps `found` on the step. At these, and at a branch
    /// point at its beginning, the rate of λ may change its sign without a limit point.
    fn limit_points(
        &mut self,
        to: &Node,
        found: &[Found],
        share: f64,
    ) -> Result<Vec<Found>, Difficulty> {
        let rest = |rate: f64, special: bool| special && rate.abs() < COINCIDENT;
        let mut from = (self.node.clone(), self.unoriented);
        let mut ends: Vec<(Node, bool)> = found.iter().map(|found| (found.node(), true)).collect();
        ends.push((to.clone(), false));
        let mut limits = Vec::new();
        for end in ends {
            let rates = [&from, &end].map(|(node, _)| self.rate(&node.tangent));
            let at_rest = rest(rates[0], from.1) || rest(rates[1], end.1);
            let largest = rates[0].abs().max(rates[1].abs());
            if !at_rest && largest >= CONSTANT {
                limits.extend(self.limit_points_between(&from.0, &end.0, share)?);
            }
            from = end;
        }
        for limit in &mut limits {
            limit.at.u = self.span(to).place(&limit.at.z);
            self.recognise_cusp(limit, to)?;
        }
        Ok(limits)
    }

    /// Limit points between two points of a step, with the place between these.
    fn limit_points_between(
        &mut self,
        from: &Node,
        to: &Node,
        share: f64,
    ) -> Result<Vec<Found>, Difficulty> {
        // Up to a branch point the orientation is that before it.
        let mut end = to.clone();
        end.along = from.along;
        let to = &end;
        let kind = Kind::LimitPoint;
        let mut piece = Span {
            from,
            ..self.span(to)
        };
        match piece.limit_points() {
            Ok(limits) => Ok(limits.into_iter().map(|at| Found::new(at, kind)).collect()),
            Err(difficulty) if share > PASSED => Err(difficulty),
            Err(_) => {
                let [before, after] = [from, to].map(|node| self.rate(&node.tangent));
                let u = before / (before - after);
                let indicated = before * after < 0.0;
                let found = indicated.then(|| Found::approximate(from, to, u, kind));
                Ok(found.into_iter().collect())
            }
        }
    }

    /// Tells a cusp from a limit point where two of them share a step, at whose ends the cusp
    /// function then has the same sign.
    fn recognise_cusp(&mut self, limit: &mut Found, to: &Node) -> Result<(), Difficulty> {
        let (Some(before), Some(after)) = (self.node.cusp, to.cusp) else {
            return Ok(());
        };
        let (system, metric) = (&mut *self.system, &self.metric);
        self.corrector.tangent(system, metric, &limit.at.z)?;
        let value = self.system.cusp_function().unwrap_or(f64::NAN);
        if value.abs() <= CUSP * before.abs().max(after.abs()) {
            limit.kind = Kind::Cusp;
        }
        Ok(())
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

    /// The first point, if it is a branch point and among the ones `found`, met in the direction in
    /// which it was left.
    fn home_among(&mut self, found: &[Found]) -> Option<Located> {
        if self.steps < FEWEST_STEPS || !self.from_branch_point {
            return None;
        }
        let (home, metric) = (&self.home, &self.metric);
        let allowed = self.met();
        let mut crossings = found.iter().filter(|found| found.kind == Kind::BranchPoint);
        let same = crossings.find(|found| {
            metric.distance(&found.at.z, &home.z) <= allowed
                && metric.dot(&found.at.tangent, &home.tangent) > 0.5 * metric.norm(&home.tangent)
        });
        same.map(|found| Located {
            u: found.at.u,
            z: home.z.clone(),
            tangent: home.tangent.clone(),
            along: home.along,
        })
    }

    /// How far from the first point a closed curve may end.
    fn met(&self) -> f64 {
        let tolerance = Some(self.system.tolerance()).filter(|t| t.is_finite());
        MET.max(10.0 * tolerance.unwrap_or(0.0))
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
        let start = span.cubic(u);
        let ahead = 0.5 * length * span.metric.norm(&home.tangent);
        let ahead = span.metric.dot(&home.tangent, &secant) > ahead;
        if !ahead || span.metric.distance(&near, &home.z) > NEAR * length {
            return None;
        }
        let met = span.across(&start, &home.tangent, &home.z).ok()?;
        let missed = span.metric.distance(&met, &home.z);
        let allowed = self.met();
        let (z, tangent, along) = (home.z, home.tangent, home.along);
        let at = Located {
            u,
            z,
            tangent,
            along,
        };
        (missed <= allowed).then_some(at)
    }

    /// A labelled point as it is yielded.
    pub(crate) fn labelled(&self, found: Found) -> Point {
        let Found {
            at,
            kind,
            other,
            approximate,
        } = found;
        let mut node = Node::new(at.z, at.tangent);
        node.arclength = self.node.arclength + self.node.length_to(&node, &self.metric);
        Point {
            other,
            approximate,
            ..node.point(kind)
        }
    }
}
