//! The labelled points of a step.

use crate::span::{Located, Node};
use crate::{Branch, Difficulty, Kind, Point, System};

/// Where λ turns more slowly than this at a branch point or cusp, it turns because of it.
const COINCIDENT: f64 = 1e-5;
/// A closed curve is noticed after so many steps, ...
const FEWEST_STEPS: usize = 3;
/// ... when the start lies within this share of a step from the secant, ...
const NEAR: f64 = 0.3;
/// ... and is met with this accuracy.
const MET: f64 = 1e-6;

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

    fn node(&self) -> Node {
        Node {
            z: self.at.z.clone(),
            tangent: self.at.tangent.clone(),
            along: true,
            arclength: 0.0,
            events: Vec::new(),
            cusp: None,
        }
    }
}

impl<S: System> Branch<'_, S> {
    /// All labelled points on the step to `to`, in order; an error where a point is indicated but
    /// not found.
    pub(crate) fn specials(&mut self, to: &Node) -> Result<Vec<Found>, Difficulty> {
        let mut found = self.turning_points(to)?;
        self.event_points(to, &mut found);
        self.target_points(to, &mut found)?;
        if let Some(home) = self.home_on(to) {
            found.retain(|found| found.at.u <= home.u);
            found.push(Found::new(home, Kind::Closed));
        }
        found.sort_by(|a, b| a.at.u.total_cmp(&b.at.u));
        Ok(found)
    }

    /// The unit tangent's component along λ, with the range of λ as unit.
    fn rate(&self, tangent: &[f64]) -> f64 {
        tangent[tangent.len() - 1] / self.metric.range()
    }

    /// Branch points, cusps and limit points. At the first two the rate of λ may change its sign
    /// without a limit point.
    fn turning_points(&mut self, to: &Node) -> Result<Vec<Found>, Difficulty> {
        let mut found = Vec::new();
        if self.unoriented {
            return Ok(found);
        }
        if to.along != self.node.along {
            let (at, crossing) = self.span(to).crossing()?;
            let aligned = |t: &[f64]| self.metric.dot(t, &at.tangent).abs();
            let least = |[a, b]: [Vec<f64>; 2]| if aligned(&a) < aligned(&b) { a } else { b };
            let other = crossing.tangents.map(least);
            let kind = Kind::BranchPoint;
            found.push(Found { at, kind, other });
        }
        if let (Some(before), Some(after)) = (self.node.cusp, to.cusp)
            && before * after < 0.0
        {
            let mut cusp = |system: &mut S, _: &[f64], _: &[f64]| {
                system.cusp_function().unwrap_or(f64::NAN)
            };
            let at = self.span(to).zero(&mut cusp, [before, after], 0.0)?;
            found.push(Found::new(at, Kind::Cusp));
        }
        let [before, after] = [&self.node, to].map(|node| self.rate(&node.tangent));
        let turned = found.iter().any(|found| self.rate(&found.at.tangent).abs() < COINCIDENT);
        if before * after < 0.0 && !turned {
            let n = to.z.len() - 1;
            let mut rate = |_: &mut S, _: &[f64], tangent: &[f64]| tangent[n];
            let at = self.span(to).zero(&mut rate, [before, after], 0.0)?;
            found.push(Found::new(at, Kind::LimitPoint));
        }
        Ok(found)
    }

    /// Zeros of the event functions.
    fn event_points(&mut self, to: &Node, found: &mut Vec<Found>) {
        let mut events = std::mem::take(&mut self.events);
        for (index, event) in events.iter_mut().enumerate() {
            let values = [self.node.events[index], to.events[index]];
            let crossed = values[0] * values[1] < 0.0 || values[1] == 0.0 && values[0] != 0.0;
            let mut value = |system: &mut S, z: &[f64], _: &[f64]| event(system, z);
            if crossed && let Ok(at) = self.span(to).zero(&mut value, values, 0.0) {
                found.push(Found::new(at, Kind::Event(index)));
            }
        }
        self.events = events;
    }

    /// Target values of λ, on every piece of the step where λ is monotonic.
    fn target_points(&mut self, to: &Node, found: &mut Vec<Found>) -> Result<(), Difficulty> {
        if self.options.targets.is_empty() {
            return Ok(());
        }
        let n = to.z.len() - 1;
        let turns = found.iter().filter(|found| found.kind == Kind::LimitPoint);
        let mut corners: Vec<Node> = turns.map(Found::node).collect();
        corners.insert(0, self.node.clone());
        corners.push(to.clone());
        for pair in corners.windows(2) {
            for target in self.options.targets.clone() {
                let [before, after] = [pair[0].z[n] - target, pair[1].z[n] - target];
                if before * after < 0.0 || after == 0.0 {
                    let mut whole = self.span(to);
                    whole.from = &pair[0];
                    whole.to = &pair[1];
                    let mut at = whole.at_lambda(target)?;
                    at.u = self.span(to).place(&at.z);
                    found.push(Found::new(at, Kind::Target));
                }
            }
        }
        Ok(())
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
        let (z, tangent) = (home.z, home.tangent);
        (missed <= MET).then_some(Located { u, z, tangent })
    }

    /// A labelled point as it is yielded, on a step of so much arclength from the last node.
    pub(crate) fn labelled(&self, found: Found, length: f64) -> Point {
        let Found { at, kind, other } = found;
        Point {
            arclength: self.node.arclength + at.u.clamp(0.0, 1.0) * length,
            z: at.z,
            tangent: at.tangent,
            kind,
            other,
            error: None,
        }
    }
}
