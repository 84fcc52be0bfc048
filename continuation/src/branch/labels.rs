//! The labelled points of a step.

use crate::branch::closing::Closing;
use crate::branch::events::Events;
use crate::branch::found::{CERTAIN_REST, Found, REST, UNVERIFIED};
use crate::branch::progress::Progress;
use crate::curve::curve::Curve;
use crate::difficulty::Difficulty;
use crate::options::Options;
use crate::point::Kind;
use crate::special_points::branch_point::crossing;
use crate::special_points::limit_point::limit_points;
use crate::special_points::neighbour::distance_to_next;
use crate::special_points::node::{Located, Node};
use crate::special_points::span::{RESOLVED, Span};
use crate::system::system::System;
use std::f64::consts::FRAC_PI_2;

/// On steps that are this share of the largest, limit points that cannot be verified are approximate, and
/// other labelled points that cannot be found are passed over.
const PASSED: f64 = 1e-4;
/// Where its rate is below this at both ends of a step, with its range as unit, λ is constant but for
/// rounding, as on the branches of linear eigenproblems: the signs of 1e-11 were taken for limit points
/// there.
const CONSTANT: f64 = 1e-9;
/// The cusp function of a cusp is this share of that at the ends of the step, at most.
const CUSP: f64 = 1e-4;
/// Labelled points this close to the first point, as a share of the step, are those at the first one.
const AT_FIRST: f64 = 1e-6;

/// What the labelled points of a step are sought with.
pub(crate) struct Labels<'s, 'a, S> {
    pub(crate) curve: &'s mut Curve<'a, S>,
    pub(crate) events: &'s mut Events<'a, S>,
    pub(crate) progress: &'s Progress,
    pub(crate) options: &'s Options,
}

impl<'a, S: System> Labels<'_, 'a, S> {
    /// All labelled points on the step to `to`, in order; the step is this `share` of the largest. Where
    /// a point is indicated but not verified, the step is to be repeated shorter; on the shortest ones a
    /// limit point or branch point is then approximate, and others are passed over.
    pub(crate) fn on_step(&mut self, to: &Node, share: f64) -> Result<Vec<Found>, Difficulty> {
        let strict = share > PASSED;
        let pass = |outcome: Result<Vec<Found>, Difficulty>| match outcome {
            Err(difficulty) if strict => Err(difficulty),
            outcome => Ok(outcome.unwrap_or_default()),
        };
        let mut found = self.branch_points(to, share)?;
        found.extend(pass(self.cusps(to))?);
        let limits = self.limit_points(to, &found, share)?;
        found.extend(limits);
        for index in 0..self.events.count() {
            found.extend(pass(self.event_points(index, to))?);
        }
        let mut ends = vec![self.progress.node.clone()];
        let turns = found.iter().filter(|found| found.kind == Kind::LimitPoint);
        ends.extend(turns.map(Found::node));
        ends.push(to.clone());
        for target in self.options.targets.clone() {
            found.extend(pass(self.target_points(target, &ends, to))?);
        }
        let mut closing = Closing {
            curve: &mut *self.curve,
            progress: self.progress,
        };
        if let Some(first) = closing.among(&found).or_else(|| closing.on_step(to)) {
            found.retain(|found| found.at.u < first.u - AT_FIRST);
            found.push(Found::new(first, Kind::Closed));
        }
        found.sort_by(|a, b| a.at.u.total_cmp(&b.at.u));
        Ok(found)
    }

    fn span<'b>(&'b mut self, to: &'b Node) -> Span<'b, 'a, S> {
        Span {
            curve: self.curve,
            from: &self.progress.node,
            to,
        }
    }

    /// A branch point, where the orientation of the null vector changes. On the shortest steps
    /// also one of even multiplicity, where it does not but the second vector turns over.
    fn branch_points(&mut self, to: &Node, share: f64) -> Result<Vec<Found>, Difficulty> {
        if self.progress.unoriented || !self.curve.branch_points {
            return Ok(Vec::new());
        }
        let kind = Kind::BranchPoint;
        let [before, after] = [&self.progress.node, to].map(|node| node.eta().abs());
        let u = before / (before + after);
        if to.along == self.progress.node.along {
            let turned = self.progress.node.second_angle(to, &self.curve.metric) > FRAC_PI_2;
            let even = turned && share <= UNVERIFIED;
            let found = even.then(|| Found::approximate(&self.progress.node, to, u, kind));
            return Ok(found.into_iter().collect());
        }
        let (at, crossing) = match crossing(&mut self.span(to)) {
            Ok(found) => found,
            Err(_) if share <= UNVERIFIED => {
                return Ok(vec![Found::approximate(&self.progress.node, to, u, kind)]);
            }
            Err(difficulty) => return Err(difficulty),
        };
        let aligned = |t: &[f64]| self.curve.metric.dot(t, &at.tangent).abs();
        let least = |[a, b]: [Vec<f64>; 2]| if aligned(&a) < aligned(&b) { a } else { b };
        let other = crossing.tangents.map(least);
        if share > UNVERIFIED {
            self.is_the_only_crossing(to, &at)?;
        }
        Ok(vec![Found {
            other,
            rest: crossing.doubt.clamp(CERTAIN_REST, REST),
            ..Found::new(at, kind)
        }])
    }

    /// Refuses a step with further branch points on either side of the one located there, if the next one
    /// may be as near as an end of the step: behind three branch points everything looks as behind one.
    fn is_the_only_crossing(&mut self, to: &Node, at: &Located) -> Result<(), Difficulty> {
        let metric = &self.curve.metric;
        let ends = [&self.progress.node, to].map(|end| metric.distance(&end.z, &at.z));
        let gap = distance_to_next(self.curve, &at.z, &at.tangent)?;
        if gap > ends[0].max(ends[1]) {
            Ok(())
        } else {
            Err(Difficulty::Imperfect { gap })
        }
    }

    /// A cusp, where the cusp function of the system changes its sign.
    fn cusps(&mut self, to: &Node) -> Result<Vec<Found>, Difficulty> {
        match (self.progress.node.cusp, to.cusp) {
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
        // Every point with the rate of λ that is none there.
        let start = if self.progress.unoriented { REST } else { 0.0 };
        let mut from = (self.progress.node.clone(), start);
        let mut ends: Vec<_> = found.iter().map(|f| (f.node(), f.rest)).collect();
        ends.push((to.clone(), 0.0));
        let mut limits = Vec::new();
        for end in ends {
            let rates = [&from, &end].map(|(node, _)| self.curve.rate(&node.tangent));
            let at_rest = rates[0].abs() < from.1 || rates[1].abs() < end.1;
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
        match limit_points(&mut piece) {
            Ok(limits) => Ok(limits.into_iter().map(|at| Found::new(at, kind)).collect()),
            Err(difficulty) if share > PASSED => Err(difficulty),
            Err(_) => {
                let [before, after] = [from, to].map(|node| self.curve.rate(&node.tangent));
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
        let (Some(before), Some(after)) = (self.progress.node.cusp, to.cusp) else {
            return Ok(());
        };
        self.curve.tangent(&limit.at.z)?;
        let value = self.curve.system.cusp_function().unwrap_or(f64::NAN);
        if value.abs() <= CUSP * before.abs().max(after.abs()) {
            limit.kind = Kind::Cusp;
        }
        Ok(())
    }

    /// A zero of an event function. Where the function changes its sign through a pole, or is
    /// undefined, is none.
    fn event_points(&mut self, index: usize, to: &Node) -> Result<Vec<Found>, Difficulty> {
        let values = [self.progress.node.events[index], to.events[index]];
        if !(values[0] * values[1] < 0.0 || values[1] == 0.0 && values[0] != 0.0) {
            return Ok(Vec::new());
        }
        let (progress, metric) = (self.progress, self.curve.metric.clone());
        let Self { curve, events, .. } = self;
        let mut value = |system: &mut S, z: &[f64], tangent: &[f64]| {
            events.value_behind(index, system, &progress.node, &metric, [z, tangent])
        };
        let mut span = Span {
            curve,
            from: &progress.node,
            to,
        };
        let at = span.zero(&mut value, values, RESOLVED)?;
        let least = value(self.curve.system, &at.z, &at.tangent).abs();
        let zero = least <= values[0].abs().max(values[1].abs());
        Ok(if zero {
            vec![Found::new(at, Kind::Event(index))]
        } else {
            Vec::new()
        })
    }

    /// Points with a target value of λ, on every piece of the step, between these ends, where λ is
    /// monotonic.
    fn target_points(
        &mut self,
        target: f64,
        ends: &[Node],
        to: &Node,
    ) -> Result<Vec<Found>, Difficulty> {
        let n = to.z.len() - 1;
        let mut found = Vec::new();
        for pair in ends.windows(2) {
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
}
