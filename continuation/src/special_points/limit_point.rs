//! Limit points between two accepted points.

use crate::curve::metric::Metric;
use crate::difficulty::Difficulty;
use crate::special_points::node::{Located, Node};
use crate::special_points::span::{RESOLVED, Span};
use crate::system::system::System;

/// Where the rate of λ seems to fall below this share of that at both nodes, it is evaluated in between, ...
const SUSPICIOUS: f64 = 0.25;
/// ... or below this share of that at either, which is about the error of the cubic: one of the nodes may lie
/// between two limit points or right beside them, ...
const RESTING: f64 = 0.05;
/// ... and the place of the smallest rate, as a share of the step, is uncertain by this, ...
const OUTSIDE: f64 = 0.1;
/// ... and sought at least this far inside, ...
const BESIDE: f64 = 0.01;
/// ... at most this many times: parabolas settle in two or three, except where the rate all but touches zero.
const TRIALS: usize = 12;
/// At a limit point the rate of λ is at most this share of that at the nodes. It is located to
/// rounding; noise in G of 1e-8 leaves about 1e-6.
const AT_REST: f64 = 1e-4;

/// The limit points: one where the rate of λ changes its sign from node to node, two where it does
/// so in between.
pub(crate) fn limit_points<S: System>(
    span: &mut Span<'_, '_, S>,
) -> Result<Vec<Located>, Difficulty> {
    let n = span.from.z.len() - 1;
    let [before, after] = [span.from, span.to].map(|node| node.tangent[n]);
    let mut rate = |_: &mut S, _: &[f64], tangent: &[f64]| tangent[n];
    if before * after < 0.0 {
        let at = span.zero(&mut rate, [before, after], RESOLVED)?;
        return Ok(vec![verified(span, at, before.abs().max(after.abs()))?]);
    }
    let Some(between) = turned_between(span)? else {
        return Ok(Vec::new());
    };
    let mut middle = Node::new(between.z, between.tangent);
    middle.along = between.along;
    let mut found = Vec::new();
    for [from, to] in [[span.from, &middle], [&middle, span.to]] {
        let mut half = Span {
            curve: &mut *span.curve,
            from,
            to,
        };
        let values = [from, to].map(|node| node.tangent[n]);
        let at = half.zero(&mut rate, values, RESOLVED)?;
        let largest = before.abs().max(after.abs());
        let mut at = verified(&half, at, largest)?;
        at.u = span.place(&at.z);
        found.push(at);
    }
    Ok(found)
}

/// A located limit point, if it is one of this branch: the rate of λ is zero there, not only of
/// another sign on either side, and the tangent leads from node to node.
fn verified<S: System>(
    span: &Span<'_, '_, S>,
    at: Located,
    largest: f64,
) -> Result<Located, Difficulty> {
    let rate = at.tangent[at.tangent.len() - 1].abs();
    if rate <= AT_REST * largest && span.leads_through(&at.tangent) {
        Ok(at)
    } else {
        let angle = (rate / largest).min(1.0).asin();
        let limit = AT_REST;
        Err(Difficulty::Turn { angle, limit })
    }
}

/// Where the cubic through both nodes with their tangents suggests that the rate of λ, of the same sign at
/// both, becomes small or changes its sign in between: a place u on the secant.
pub(crate) fn suspicion(metric: &Metric, from: &Node, to: &Node) -> Option<f64> {
    let n = from.z.len() - 1;
    let mean = (to.z[n] - from.z[n]) / metric.distance(&to.z, &from.z);
    let [before, after] = [from, to].map(|node| node.tangent[n]);
    let (u, least) = cubic_vertex(before, after, mean)?;
    let share = after / before;
    let suspicious = least / before <= (SUSPICIOUS * share.min(1.0)).max(RESTING * share.max(1.0));
    suspicious.then_some(u.clamp(BESIDE, 1.0 - BESIDE))
}

/// A point between nodes with the same sign of the rate of λ where it has the other one: the least rate in
/// that direction is sought from the place of [`suspicion`] on, by parabolas through three rates.
fn turned_between<S: System>(span: &mut Span<'_, '_, S>) -> Result<Option<Located>, Difficulty> {
    let n = span.from.z.len() - 1;
    let Some(mut u) = suspicion(&span.curve.metric, span.from, span.to) else {
        return Ok(None);
    };
    let [from, to] = span.ends();
    let sign = from.tangent[n].signum();
    let rates = [&from, &to].map(|end| sign * end.tangent[n]);
    let mut known = vec![from, to];
    // The least rate, between two larger ones, each with its place.
    let [mut below, mut above] = [(0.0, rates[0]), (1.0, rates[1])];
    let mut least: Option<(f64, f64)> = None;
    for _ in 0..TRIALS {
        let found = span.at(u, &known)?;
        let here = (u, sign * found.tangent[n]);
        if here.1 < 0.0 {
            return Ok(Some(found));
        }
        known.push(found);
        let (outer, inner) = match least {
            Some(least) if least.1 <= here.1 => (here, least),
            Some(least) => (least, here),
            None => (here, here),
        };
        if outer.0 < inner.0 {
            below = outer;
        } else if outer.0 > inner.0 {
            above = outer;
        }
        if inner.1 >= below.1.min(above.1) {
            break;
        }
        least = Some(inner);
        let (place, value) = vertex([below, inner, above]);
        // What is left after a parabola that hardly falls any more is positive.
        if value > 0.5 * inner.1 || !(below.0..=above.0).contains(&place) || place == inner.0 {
            break;
        }
        u = place;
    }
    Ok(None)
}

/// The vertex of the parabola through three points: place and value.
fn vertex([a, b, c]: [(f64, f64); 3]) -> (f64, f64) {
    let [p, q] = [(a, b), (b, c)].map(|(a, b)| (b.1 - a.1) / (b.0 - a.0));
    let curvature = (q - p) / (c.0 - a.0);
    // The slope at the middle point.
    let slope = p + curvature * (b.0 - a.0);
    let step = -0.5 * slope / curvature;
    (b.0 + step, b.1 + 0.5 * slope * step)
}

/// Where the rate of the cubic with rates `before` and `after` at its ends and this mean rate is
/// stationary between them, and the rate there.
fn cubic_vertex(before: f64, after: f64, mean: f64) -> Option<(f64, f64)> {
    let (slope, curvature) = (
        6.0 * mean - 4.0 * before - 2.0 * after,
        before + after - 2.0 * mean,
    );
    let u = -slope / (6.0 * curvature);
    let rate = before + u * (slope + 3.0 * curvature * u);
    (u > -OUTSIDE && u < 1.0 + OUTSIDE).then_some((u, rate))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rate_of_a_cubic_is_stationary_at_its_vertex() {
        // (u − a)(u − b) is the rate.
        let case = |a: f64, b: f64| {
            cubic_vertex(
                a * b,
                (1.0 - a) * (1.0 - b),
                1.0 / 3.0 - 0.5 * (a + b) + a * b,
            )
        };
        let (u, rate) = case(0.4, 0.41).unwrap();
        assert!((u - 0.405).abs() < 1e-12 && (rate + 2.5e-5).abs() < 1e-14);
        assert_eq!(case(-0.4, -0.3), None);
        assert_eq!(case(1.1, 1.2), None);
        assert_eq!(cubic_vertex(1.0, 1.0, 1.0), None);
    }
}
