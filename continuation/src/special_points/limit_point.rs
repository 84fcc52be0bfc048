//! Limit points between two accepted points.

use crate::difficulty::Difficulty;
use crate::special_points::node::{Located, Node};
use crate::special_points::span::{RESOLVED, Span};
use crate::system::system::System;

/// Where the rate of λ seems to fall below this share of that at both nodes, it is evaluated in between, ...
const SUSPICIOUS: f64 = 0.25;
/// ... at most this many times.
const TRIALS: usize = 4;
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

/// A point between nodes with the same sign of the rate of λ where it has the other one. It is
/// sought where the cubic through both nodes with their tangents suggests that the rate
/// becomes small, then at the vertex of the parabola through the rates.
fn turned_between<S: System>(span: &mut Span<'_, '_, S>) -> Result<Option<Located>, Difficulty> {
    let n = span.from.z.len() - 1;
    let length = span.curve.metric.norm(&span.secant());
    let mean = (span.to.z[n] - span.from.z[n]) / length;
    let [before, after] = [span.from, span.to].map(|node| node.tangent[n]);
    let [from, to] = span.ends();
    let Some((mut u, least)) = cubic_vertex(before, after, mean) else {
        return Ok(None);
    };
    if least / before > SUSPICIOUS * (after / before).min(1.0) {
        return Ok(None);
    }
    let mut near = if u < 0.5 { from } else { to };
    for _ in 0..TRIALS {
        near = span.at(u, &near)?;
        let rate = near.tangent[n];
        if rate * before < 0.0 {
            return Ok(Some(near));
        }
        // The vertex of the parabola through the three rates.
        let (p, q) = ((rate - before) / u, (after - rate) / (1.0 - u));
        u = 0.5 * (u - p / (q - p));
        if !(u > 0.0 && u < 1.0) {
            break;
        }
    }
    Ok(None)
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
    (u > 0.0 && u < 1.0).then_some((u, rate))
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
