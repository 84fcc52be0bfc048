//! Plane geometry of a V-belt that is laid round pulleys.
//!
//! A belt that leaves pulley i, at its pitch radius and with the inclination θ, is tangent to the circle
//! R cos θ and has passed the point of tangency by −R sin θ; one that arrives is short of it by −R sin θ. A
//! span is therefore the common tangent of two such circles,
//!
//! ```text
//! ℓ = ℓ(tangent of the circles) − R_i sin θ_out,i + R_j sin θ_in,j
//! ```
//!
//! and between its entry and its exit the belt turns by φ − (`θ_out` − `θ_in`) = σ (`ϑ_i` − ϑ_{i−1}). On a flat
//! pulley θ is 0.

use super::super::EndAngles;
use crate::drive::layout::{Layout, Side, tangent};
use crate::{Drive, Mount};
use bvp::Real;
use std::f64::consts::TAU;

/// A pulley in the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// What holds it.
    pub(super) mount: Mount,
    /// Pitch radius, m.
    pub(super) radius: f64,
    /// Sense of rotation: +1 counter-clockwise, −1 clockwise.
    pub(super) turns: f64,
    /// About how far the belt turns round it, rad: the wrap of the pitch line.
    pub(super) wrap: f64,
}

/// The pulleys in belt order.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    pub(super) spots: Vec<Spot>,
}

/// A belt laid round the pulleys.
#[derive(Clone, Debug)]
pub(super) struct Laid<T> {
    /// Length of each span, m; span i leaves pulley i.
    pub(super) lengths: Vec<T>,
    /// Length of the tangent of the circles R cos θ that a span lies on, m.
    pub(super) tangents: Vec<T>,
    /// Direction ϑ of each span, rad.
    pub(super) directions: Vec<T>,
    /// How far the belt turns between its entry and its exit of each pulley, rad.
    pub(super) turned: Vec<T>,
}

impl Plane {
    /// The pulleys of a loop whose pitch line is laid out in `layout`.
    pub(super) fn new(drive: &Drive, layout: &Layout) -> Self {
        let pulleys = drive.pulleys.iter().zip(layout.wraps());
        let spots = pulleys.map(|(pulley, &wrap)| Spot {
            mount: pulley.mount,
            radius: pulley.radius,
            turns: match pulley.side {
                Side::Inside => drive.sense.sign(),
                Side::Outside => -drive.sense.sign(),
            },
            wrap,
        });
        Self {
            spots: spots.collect(),
        }
    }

    /// The span that arrives at a pulley.
    pub(super) fn arriving(&self, pulley: usize) -> usize {
        (pulley + self.spots.len() - 1) % self.spots.len()
    }

    /// Lays the belt round the pulleys, the tensioner at a coordinate, with inclinations at both ends of
    /// every contact.
    pub(super) fn lay<T: Real>(&self, coordinate: T, ends: &[EndAngles<T>]) -> Laid<T> {
        let count = self.spots.len();
        let centre = |spot: &Spot| match &spot.mount {
            Mount::Fixed(centre) => centre.map(T::from_f64),
            Mount::Tensioner(tensioner) => tensioner.guide.centre(coordinate)[0],
        };
        let centres: Vec<_> = self.spots.iter().map(centre).collect();
        let span = |from: usize| {
            let to = (from + 1) % count;
            let between = [0, 1].map(|axis| centres[to][axis] - centres[from][axis]);
            let [leaves, arrives] = [(from, ends[from].exit), (to, ends[to].entry)];
            let circle = |(pulley, theta): (usize, T)| {
                let Spot { radius, turns, .. } = self.spots[pulley];
                theta.cos() * (turns * radius)
            };
            let past = |(pulley, theta): (usize, T)| theta.sin() * self.spots[pulley].radius;
            let [length, direction] = tangent(between, circle(leaves), circle(arrives));
            (length, length - past(leaves) + past(arrives), direction)
        };
        let mut laid = Laid {
            lengths: Vec::with_capacity(count),
            tangents: Vec::with_capacity(count),
            directions: Vec::with_capacity(count),
            turned: Vec::with_capacity(count),
        };
        for (tangent, length, direction) in (0..count).map(span) {
            laid.tangents.push(tangent);
            laid.lengths.push(length);
            laid.directions.push(direction);
        }
        for (pulley, Spot { turns, wrap, .. }) in self.spots.iter().enumerate() {
            let turned = laid.directions[pulley] - laid.directions[self.arriving(pulley)];
            let turned = turned * *turns;
            let whole = ((wrap - turned.value()) / TAU).round();
            laid.turned.push(turned + TAU * whole);
        }
        laid
    }
}

impl<T: Real> Laid<T> {
    /// Unit tangent of a span along the motion of the belt.
    pub(super) fn tangent(&self, span: usize) -> [T; 2] {
        let (sine, cosine) = self.directions[span].sin_cos();
        [cosine, sine]
    }

    /// Load of the belt on the hub of a pulley, where `tractive` are the tractive tensions behind and
    /// before it, in their unit.
    pub(super) fn hub_load(&self, plane: &Plane, pulley: usize, tractive: [T; 2]) -> [T; 2] {
        let entering = self.tangent(plane.arriving(pulley));
        let leaving = self.tangent(pulley);
        [0, 1].map(|axis| leaving[axis] * tractive[1] - entering[axis] * tractive[0])
    }
}
