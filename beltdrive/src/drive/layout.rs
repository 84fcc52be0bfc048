//! Plane geometry of a belt that is laid round pulleys: tangents, wraps and the length of the loop.
//!
//! With the sense o = ±1 of the loop, σ = o on a pulley inside the loop and σ = −o on one outside, and
//! the vector D between the centres of the pulleys i and j = i + 1 of a span:
//!
//! ```text
//! q = σ_j R_j − σ_i R_i     length ℓ = sqrt(|D|² − q²)     direction ϑ = atan2(D_y, D_x) − atan2(q, ℓ)
//! wrap φ_i = σ_i (ϑ_i − ϑ_{i−1}) mod 2π                    turning  Σ σ_i φ_i = 2π o ν
//! ```

mod error;
mod tangent;
mod wound;

pub use error::LayoutError;
pub(crate) use tangent::tangent;
pub(crate) use wound::{Circle, Wound};

use nalgebra::Vector2;
use std::f64::consts::TAU;
use wound::Deflected;

/// On which side of the belt a pulley lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Inside the loop: it turns with the loop.
    Inside,
    /// Outside the loop, on the back of the belt: it turns against the loop.
    Outside,
}

impl Side {
    /// Sense of rotation of a pulley in a loop of a sense: +1 counter-clockwise, −1 clockwise.
    pub(crate) fn turns(self, sense: Sense) -> f64 {
        match self {
            Self::Inside => sense.sign(),
            Self::Outside => -sense.sign(),
        }
    }
}

/// Sense in which the belt runs round the loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    /// Positive in the plane with x to the right and y upwards.
    CounterClockwise,
    /// Negative.
    Clockwise,
}

impl Sense {
    /// Its word in drive files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Clockwise => "clockwise",
            Self::CounterClockwise => "counter-clockwise",
        }
    }

    /// +1 counter-clockwise, −1 clockwise.
    pub fn sign(self) -> f64 {
        match self {
            Self::CounterClockwise => 1.0,
            Self::Clockwise => -1.0,
        }
    }
}

/// A pulley at its place.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedPulley {
    /// The name in messages.
    pub name: String,
    /// Centre, m.
    pub centre: [f64; 2],
    /// Radius R of the centre line of the belt, m; positive.
    pub radius: f64,
    /// On which side of the belt it lies.
    pub side: Side,
}

impl PlacedPulley {
    /// Sense of rotation in a loop of a sense: +1 counter-clockwise, −1 clockwise.
    pub(crate) fn turns(&self, sense: Sense) -> f64 {
        self.side.turns(sense)
    }

    /// The circle that the belt runs round in a loop of a sense.
    fn circle(&self, sense: Sense) -> Circle {
        Circle {
            centre: self.centre,
            radius: self.radius,
            turns: self.turns(sense),
        }
    }
}

/// A free span of the belt; `S` is the scalar of its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Span<S = f64> {
    /// Length ℓ, m.
    pub length: S,
    /// Direction ϑ of the motion of the belt, rad, counter-clockwise from x, in [0, 2π).
    pub direction: S,
    /// Where the belt leaves the pulley behind the span, m.
    pub start: [S; 2],
    /// Where it arrives at the next pulley, m.
    pub end: [S; 2],
    /// Unit tangent t along the motion of the belt.
    pub(crate) tangent: [S; 2],
}

impl Span {
    /// Unit tangent t along the motion of the belt.
    pub(crate) fn tangent(&self) -> Vector2<f64> {
        self.tangent.into()
    }

    /// Unit normal N, to the left of the motion.
    pub(crate) fn normal(&self) -> Vector2<f64> {
        let [x, y] = self.tangent;
        Vector2::new(-y, x)
    }
}

/// A belt laid round pulleys. Span i runs from pulley i to pulley i + 1, the last one to the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    sense: Sense,
    turning_number: u32,
    pulleys: Vec<PlacedPulley>,
    wound: Wound,
}

impl Layout {
    /// The belt round `pulleys` in the order in which it meets them.
    ///
    /// `turning_number` is ν: 1 for a plain loop, 0 for a crossed belt round two pulleys. Spans may cross
    /// each other ([`Self::crossing_spans`]).
    ///
    /// # Errors
    /// In this order: pulleys that are none, pulleys that overlap, a wrap below zero, a span that runs
    /// through a pulley.
    pub fn new(
        sense: Sense,
        turning_number: u32,
        pulleys: Vec<PlacedPulley>,
    ) -> Result<Self, LayoutError> {
        let mut layout = Self {
            sense,
            turning_number,
            pulleys,
            wound: Wound::default(),
        };
        layout.lay(None)?;
        Ok(layout)
    }

    /// The same belt with a pulley at another centre, m; as [`Self::new`] without allocations and without a
    /// look at what stays. After an error the spans and wraps mean nothing until this pulley is moved again.
    ///
    /// # Panics
    /// If there is no such pulley.
    pub(crate) fn move_pulley(
        &mut self,
        pulley: usize,
        centre: [f64; 2],
    ) -> Result<(), LayoutError> {
        self.pulleys[pulley].centre = centre;
        self.lay(Some(pulley))
    }

    /// Lays the belt round the pulleys, of which one, or all, are new at their places.
    fn lay(&mut self, moved: Option<usize>) -> Result<(), LayoutError> {
        let Self {
            sense,
            turning_number,
            ref pulleys,
            ref mut wound,
        } = *self;
        let count = pulleys.len();
        if count < 2 {
            return Err(LayoutError::TooFewPulleys { count });
        }
        let is_new = |index: usize| moved.is_none_or(|moved| moved == index);
        let is_pulley = |pulley: &PlacedPulley| {
            let [x, y] = pulley.centre;
            let largest = x.abs().max(y.abs()).max(pulley.radius);
            pulley.radius > 0.0 && [x, y].iter().all(|part| part.is_finite()) && largest < 1e100
        };
        if let Some(pulley) = pulleys.iter().find(|pulley| !is_pulley(pulley)) {
            let pulley = pulley.name.clone();
            return Err(LayoutError::NoPulley { pulley });
        }
        for (index, one) in pulleys.iter().enumerate() {
            for (next, other) in pulleys.iter().enumerate().skip(index + 1) {
                if !is_new(index) && !is_new(next) {
                    continue;
                }
                let distance = (Vector2::from(one.centre) - Vector2::from(other.centre)).norm();
                if distance <= one.radius + other.radius {
                    return Err(overlap(one, other));
                }
            }
        }
        wound
            .lay(pulleys.len(), |index| pulleys[index].circle(sense), moved)
            .map_err(|[one, other]| overlap(&pulleys[one], &pulleys[other]))?;
        let excess = wound.turns(sense, pulleys) - i64::from(turning_number);
        if excess != 0 {
            return Err(miscounted(sense, turning_number, pulleys, wound, excess));
        }
        for (index, span) in wound.spans.iter().enumerate() {
            let ends = [index, (index + 1) % count];
            let is_span_new = ends.into_iter().any(is_new);
            for (other, pulley) in pulleys.iter().enumerate() {
                let is_looked_at = !ends.contains(&other) && (is_span_new || is_new(other));
                if is_looked_at && distance_to(span, pulley.centre) < pulley.radius {
                    return Err(LayoutError::SpanThroughPulley {
                        from: pulleys[ends[0]].name.clone(),
                        to: pulleys[ends[1]].name.clone(),
                        pulley: pulley.name.clone(),
                    });
                }
            }
        }
        Ok(())
    }

    /// Sense in which the belt runs.
    pub fn sense(&self) -> Sense {
        self.sense
    }

    /// The pulleys in belt order.
    pub fn pulleys(&self) -> &[PlacedPulley] {
        &self.pulleys
    }

    /// The spans and wraps.
    pub(crate) fn wound(&self) -> &Wound {
        &self.wound
    }

    /// The free spans; span i leaves pulley i.
    pub fn spans(&self) -> &[Span] {
        &self.wound.spans
    }

    /// Wrap angle φ of each pulley, rad, in [0, 2π).
    pub fn wraps(&self) -> &[f64] {
        &self.wound.wraps
    }

    /// Length L = Σ ℓ + Σ R φ of the loop, m.
    pub fn length(&self) -> f64 {
        self.wound
            .length(self.pulleys.iter().map(|pulley| pulley.radius))
    }

    /// Derivative ∂L/∂C of the length with the centre of a pulley: the tangent of the span behind it less
    /// that of the span before it. Exact: contact points slide along the tangents and do not count.
    ///
    /// # Panics
    /// If there is no such pulley.
    pub fn length_gradient(&self, pulley: usize) -> [f64; 2] {
        self.wound.length_gradient(pulley)
    }

    /// The spans where the belt enters and where it leaves a pulley.
    pub(crate) fn spans_of(&self, pulley: usize) -> [&Span; 2] {
        self.wound.spans_of(pulley)
    }

    /// Pairs of spans that cross each other; a crossed belt has one.
    pub fn crossing_spans(&self) -> Vec<[usize; 2]> {
        let spans = &self.wound.spans;
        let pairs = (0..spans.len()).flat_map(|i| (i + 1..spans.len()).map(move |j| [i, j]));
        pairs
            .filter(|&[i, j]| crosses(&spans[i], &spans[j]))
            .collect()
    }

    /// The loop with the midpoint of a span displaced by δ > 0 towards the inside: its length in m, and
    /// the part of `t_in` − `t_out` at that point across the span. `None` if the belt then leaves a pulley.
    pub(crate) fn deflected(&self, span: usize, deflection: f64) -> Option<[f64; 2]> {
        let deflected = Deflected::new(self.sense, &self.pulleys, &self.wound, span, deflection)?;
        let turns = self.wound.turns_with(self.sense, &self.pulleys, &deflected);
        (turns == i64::from(self.turning_number))
            .then_some([self.length() + deflected.lengthening, deflected.across])
    }
}

fn overlap(one: &PlacedPulley, other: &PlacedPulley) -> LayoutError {
    LayoutError::Overlap {
        one: one.name.clone(),
        other: other.name.clone(),
        distance: (Vector2::from(one.centre) - Vector2::from(other.centre)).norm(),
        radii: one.radius + other.radius,
    }
}

/// A wrap below zero has folded to one just below 2π, which adds a turn in the sense of its pulley.
fn miscounted(
    sense: Sense,
    stated: u32,
    pulleys: &[PlacedPulley],
    wound: &Wound,
    excess: i64,
) -> LayoutError {
    let folded = |pulley: &PlacedPulley| (pulley.side == Side::Inside) == (excess > 0);
    let candidates = pulleys.iter().zip(&wound.wraps);
    let candidates = candidates.filter(|(pulley, _)| folded(pulley));
    match candidates.max_by(|(_, one), (_, other)| one.total_cmp(other)) {
        Some((pulley, wrap)) => LayoutError::NegativeWrap {
            pulley: pulley.name.clone(),
            wrap: wrap - TAU,
        },
        None => LayoutError::TurningNumber {
            stated,
            found: wound.turns(sense, pulleys),
        },
    }
}

/// Distance of a point from a span, m.
fn distance_to(span: &Span, point: [f64; 2]) -> f64 {
    let from_start = Vector2::from(point) - Vector2::from(span.start);
    let along = from_start.dot(&span.tangent()).clamp(0.0, span.length);
    (from_start - along * span.tangent()).norm()
}

/// Whether two spans cross between their ends.
fn crosses(one: &Span, other: &Span) -> bool {
    let is_parted = |span: &Span, by: &Span| {
        let [start, end] = [span.start, span.end].map(|end| {
            by.normal()
                .dot(&(Vector2::from(end) - Vector2::from(by.start)))
        });
        start * end < 0.0
    };
    is_parted(one, other) && is_parted(other, one)
}
