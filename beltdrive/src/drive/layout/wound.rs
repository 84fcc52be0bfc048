//! The spans and wraps of a belt round pulleys, whatever these are in the way of.

use super::{PlacedPulley, Sense, Span, tangent};
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// The spans and wraps of a belt.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Wound {
    pub(super) spans: Vec<Span>,
    /// Modulo 2π.
    pub(super) wraps: Vec<f64>,
}

impl Wound {
    /// Winds the belt round pulleys, of which one, or all, are new at their places; the indices of two that
    /// overlap are an error.
    pub(super) fn lay(
        &mut self,
        sense: Sense,
        pulleys: &[PlacedPulley],
        moved: Option<usize>,
    ) -> Result<(), [usize; 2]> {
        let count = pulleys.len();
        let span = |index: usize| {
            let next = (index + 1) % count;
            let ends = [index, next].map(|end| Circle::new(sense, &pulleys[end]));
            between(ends).ok_or([index, next])
        };
        let Some(moved) = moved else {
            self.spans = (0..count).map(span).collect::<Result<_, _>>()?;
            self.wraps = (0..count)
                .map(|index| self.wrap(sense, pulleys, index))
                .collect();
            return Ok(());
        };
        let behind = (moved + count - 1) % count;
        for index in [behind, moved] {
            self.spans[index] = span(index)?;
        }
        for index in [behind, moved, (moved + 1) % count] {
            self.wraps[index] = self.wrap(sense, pulleys, index);
        }
        Ok(())
    }

    /// Wrap angle on a pulley, rad.
    fn wrap(&self, sense: Sense, pulleys: &[PlacedPulley], index: usize) -> f64 {
        let entering = &self.spans[(index + pulleys.len() - 1) % pulleys.len()];
        wrap(pulleys[index].turns(sense), entering, &self.spans[index])
    }

    pub(super) fn length(&self, pulleys: &[PlacedPulley]) -> f64 {
        let spans: f64 = self.spans.iter().map(|span| span.length).sum();
        let arcs = pulleys.iter().zip(&self.wraps);
        spans + arcs.map(|(pulley, wrap)| pulley.radius * wrap).sum::<f64>()
    }

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
        let point = Circle {
            centre: middle + deflection * inward,
            turned_radius: 0.0,
        };
        let next = (span + 1) % count;
        let [from, to] = [span, next].map(|end| Circle::new(sense, &pulleys[end]));
        let [arriving, leaving] = [between([from, point])?, between([point, to])?];
        let [behind, before] = [(span + count - 1) % count, next].map(|other| &wound.spans[other]);
        // The belt runs round the point with its back.
        let turning = -sense.sign();
        let turns = [span, next].map(|end| pulleys[end].turns(sense));
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
            across: (arriving.tangent - leaving.tangent).dot(&inward),
        })
    }
}

/// A circle that the belt runs round.
#[derive(Clone, Copy)]
struct Circle {
    centre: Vector2<f64>,
    /// σ R, m.
    turned_radius: f64,
}

impl Circle {
    fn new(sense: Sense, pulley: &PlacedPulley) -> Self {
        Self {
            centre: pulley.centre.into(),
            turned_radius: pulley.turns(sense) * pulley.radius,
        }
    }
}

/// The span between two circles; `None` if these overlap too much.
fn between([from, to]: [Circle; 2]) -> Option<Span> {
    let along = to.centre - from.centre;
    let [leaves, arrives] = [from, to].map(|circle| circle.turned_radius);
    if along.norm() <= (arrives - leaves).abs() {
        return None;
    }
    let [length, direction] = tangent(along.into(), leaves, arrives);
    let direction = positive(direction);
    let (sine, cosine) = direction.sin_cos();
    let normal = Vector2::new(-sine, cosine);
    Some(Span {
        length,
        direction,
        start: (from.centre - leaves * normal).into(),
        end: (to.centre - arrives * normal).into(),
        tangent: Vector2::new(cosine, sine),
    })
}

/// The wrap on a pulley that turns in a sense, rad, in [0, 2π).
fn wrap(turns: f64, entering: &Span, leaving: &Span) -> f64 {
    positive(turns * (leaving.direction - entering.direction))
}

/// An angle above −2π modulo 2π.
fn positive(angle: f64) -> f64 {
    match angle < 0.0 {
        true => angle + TAU,
        false => angle,
    }
}
