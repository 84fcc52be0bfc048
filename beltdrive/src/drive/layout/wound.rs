//! The spans and wraps of a belt round pulleys, whatever these are in the way of.

use super::{PlacedPulley, Sense, Span, tangent};
use bvp::Real;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// The spans and wraps of a belt.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Wound<S = f64> {
    pub(crate) spans: Vec<Span<S>>,
    /// Modulo 2π.
    pub(crate) wraps: Vec<S>,
}

impl<S: Real> Wound<S> {
    /// The belt round circles; the indices of two that overlap are an error.
    pub(crate) fn new(circles: &[Circle<S>]) -> Result<Self, [usize; 2]> {
        let mut wound = Self {
            spans: vec![],
            wraps: vec![],
        };
        wound.lay(circles.len(), |index| circles[index], None)?;
        Ok(wound)
    }

    /// Winds the belt round circles, of which one, or all, are new at their places; the indices of two that
    /// overlap are an error.
    pub(super) fn lay(
        &mut self,
        count: usize,
        circle: impl Fn(usize) -> Circle<S>,
        moved: Option<usize>,
    ) -> Result<(), [usize; 2]> {
        let span = |index: usize| {
            let ends = [index, (index + 1) % count];
            between(ends.map(&circle)).ok_or(ends)
        };
        let Some(moved) = moved else {
            self.spans = (0..count).map(span).collect::<Result<_, _>>()?;
            self.wraps = (0..count)
                .map(|index| self.wrap(index, circle(index).turns))
                .collect();
            return Ok(());
        };
        let behind = (moved + count - 1) % count;
        for index in [behind, moved] {
            self.spans[index] = span(index)?;
        }
        for index in [behind, moved, (moved + 1) % count] {
            self.wraps[index] = self.wrap(index, circle(index).turns);
        }
        Ok(())
    }

    /// Wrap angle on a pulley that turns in a sense, rad.
    fn wrap(&self, index: usize, turns: f64) -> S {
        let [entering, leaving] = self.spans_of(index);
        wrap(turns, entering, leaving)
    }

    /// The spans where the belt enters and where it leaves a pulley.
    pub(crate) fn spans_of(&self, pulley: usize) -> [&Span<S>; 2] {
        let count = self.spans.len();
        [(pulley + count - 1) % count, pulley].map(|span| &self.spans[span])
    }

    /// Length of the loop, with the radii of the pulleys.
    pub(crate) fn length(&self, radii: impl Iterator<Item = S>) -> S {
        let spans: S = self.spans.iter().map(|span| span.length).sum();
        let arcs = radii.zip(&self.wraps);
        spans + arcs.map(|(radius, &wrap)| radius * wrap).sum::<S>()
    }

    /// As [`Layout::length_gradient`](super::Layout::length_gradient).
    pub(crate) fn length_gradient(&self, pulley: usize) -> [S; 2] {
        let [behind, before] = self.spans_of(pulley);
        std::array::from_fn(|part| behind.tangent[part] - before.tangent[part])
    }
}

impl Wound {
    /// Turning number in the sense of the loop.
    pub(super) fn turns(&self, sense: Sense, pulleys: &[PlacedPulley]) -> i64 {
        self.counted(sense, pulleys, 0.0)
    }

    /// Turning number of the deflected belt.
    pub(super) fn turns_with(
        &self,
        sense: Sense,
        pulleys: &[PlacedPulley],
        deflected: &Deflected,
    ) -> i64 {
        self.counted(sense, pulleys, deflected.turned)
    }

    /// Turning number with a further angle, rad, counter-clockwise.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "at most half the number of pulleys"
    )]
    fn counted(&self, sense: Sense, pulleys: &[PlacedPulley], further: f64) -> i64 {
        let turned = pulleys.iter().zip(&self.wraps);
        let turned: f64 = turned
            .map(|(pulley, wrap)| pulley.turns(sense) * wrap)
            .sum();
        (sense.sign() * (turned + further) / TAU).round() as i64
    }
}

/// What changes if the midpoint of a span is displaced towards the inside of the loop.
pub(super) struct Deflected {
    /// By how much the belt gets longer, m.
    pub(super) lengthening: f64,
    /// By how much it turns further, rad, counter-clockwise: a multiple of 2π.
    turned: f64,
    /// The part of `t_in` − `t_out` at the displaced point across the span, inwards.
    pub(super) across: f64,
}

impl Deflected {
    /// `None` if the point reaches a pulley.
    pub(super) fn new(
        sense: Sense,
        pulleys: &[PlacedPulley],
        wound: &Wound,
        span: usize,
        deflection: f64,
    ) -> Option<Self> {
        let count = pulleys.len();
        let straight = &wound.spans[span];
        let inward = sense.sign() * straight.normal();
        let middle = 0.5 * (Vector2::from(straight.start) + Vector2::from(straight.end));
        // The belt runs round the point with its back.
        let point = Circle {
            centre: (middle + deflection * inward).into(),
            radius: 0.0,
            turns: -sense.sign(),
        };
        let next = (span + 1) % count;
        let [from, to] = [span, next].map(|end| pulleys[end].circle(sense));
        let [arriving, leaving] = [between([from, point])?, between([point, to])?];
        let [behind, before] = [(span + count - 1) % count, next].map(|other| &wound.spans[other]);
        let (turning, turns) = (point.turns, [from, to].map(|circle| circle.turns));
        let wraps = [
            wrap(turns[0], behind, &arriving),
            wrap(turning, &arriving, &leaving),
            wrap(turns[1], &leaving, before),
        ];
        let [first, last] = [wraps[0] - wound.wraps[span], wraps[2] - wound.wraps[next]];
        let spans = (arriving.length + leaving.length) - straight.length;
        Some(Self {
            lengthening: spans + pulleys[span].radius * first + pulleys[next].radius * last,
            turned: turns[0] * first + turning * wraps[1] + turns[1] * last,
            across: (arriving.tangent() - leaving.tangent()).dot(&inward),
        })
    }
}

/// A circle that the belt runs round.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle<S = f64> {
    pub(crate) centre: [S; 2],
    /// R, m.
    pub(crate) radius: S,
    /// σ.
    pub(crate) turns: f64,
}

/// The span between two circles; `None` if these overlap too much.
fn between<S: Real>([from, to]: [Circle<S>; 2]) -> Option<Span<S>> {
    let along = [0, 1].map(|part| to.centre[part] - from.centre[part]);
    let [leaves, arrives] = [from, to].map(|circle| circle.radius * circle.turns);
    let [x, y] = along;
    if (x * x + y * y).sqrt() <= (arrives - leaves).abs() {
        return None;
    }
    let [length, direction] = tangent(along, leaves, arrives);
    let direction = positive(direction);
    let (sine, cosine) = direction.sin_cos();
    let normal = [-sine, cosine];
    let reached = |circle: Circle<S>, turned: S| {
        std::array::from_fn(|part| circle.centre[part] - turned * normal[part])
    };
    Some(Span {
        length,
        direction,
        start: reached(from, leaves),
        end: reached(to, arrives),
        tangent: [cosine, sine],
    })
}

/// The wrap on a pulley that turns in a sense, rad, in [0, 2π).
fn wrap<S: Real>(turns: f64, entering: &Span<S>, leaving: &Span<S>) -> S {
    positive((leaving.direction - entering.direction) * turns)
}

/// An angle above −2π modulo 2π.
fn positive<S: Real>(angle: S) -> S {
    match angle < 0.0 {
        true => angle + TAU,
        false => angle,
    }
}
