//! Plane geometry of the two pulleys and the two free spans.
//!
//! At the swept angle φ on a pulley whose entry point has the polar angle α, the belt points in
//! the direction α + φ + π/2 − θ. A free span is straight and continues the belt at both ends,
//! where it lies on the pitch circles. With the tight span (driven exit to driver entry) along
//! the first axis and Lₜ its length,
//!
//! ```text
//! C₂ − C₁ = (R₁ sin θ₁ₒ + Lₜ − R₂ sin θ₂ᵢ,  R₂ cos θ₂ᵢ − R₁ cos θ₁ₒ)
//! ```
//!
//! (i entry, o exit). Its length is the centre distance C, which gives Lₜ, and the line of centres
//! is turned from the span by δₜ, sin δₜ = (R₂ cos θ₂ᵢ − R₁ cos θ₁ₒ)/C. The same holds with the
//! pulleys exchanged for the slack span and δₛ. Following the direction of the belt around,
//!
//! ```text
//! φ₁ − (θ₁ₒ − θ₁ᵢ) = π + δₛ − δₜ        φ₂ − (θ₂ₒ − θ₂ᵢ) = π + δₜ − δₛ
//! ```
//!
//! These two conditions close the drive; the span lengths follow and need not be unknowns.

use super::{DRIVEN, DRIVER, Over};
use bvp::Real;
use nalgebra::{Rotation2, Vector2};
use std::f64::consts::PI;

/// Inclination θ of the belt where it enters and where it leaves a pulley, rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct EndAngles<T> {
    /// θ where the belt enters.
    pub(crate) entry: T,
    /// θ where the belt leaves.
    pub(crate) exit: T,
}

/// Where the pulleys are, in any unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layout<S = f64> {
    /// Pitch radii of the driven pulley and of the driver.
    pub(crate) radius: [S; 2],
    /// Distance of the centres; greater than the sum of the radii.
    pub(crate) centre_distance: S,
}

impl<S: Real> Layout<S> {
    /// Angles that the belt must sweep on both pulleys for the drive to close, rad.
    pub(crate) fn wraps<T: Over<S>>(&self, ends: [EndAngles<T>; 2]) -> [T; 2] {
        let [tight, slack] = [DRIVEN, DRIVER].map(|from| self.tilt_sine(from, ends).asin());
        let turned = ends.map(|ends| ends.exit - ends.entry);
        [
            turned[DRIVEN] + (slack - tight) + PI,
            turned[DRIVER] + (tight - slack) + PI,
        ]
    }

    /// Length of the free span that leaves pulley `from`: the tight span from the driven pulley,
    /// the slack span from the driver.
    pub(crate) fn span<T: Over<S>>(&self, from: usize, ends: [EndAngles<T>; 2]) -> T {
        let to = 1 - from;
        let sine = self.tilt_sine(from, ends);
        let along = ((T::from_f64(1.0) - sine) * (sine + 1.0)).sqrt() * self.centre_distance;
        along + ends[to].entry.sin() * self.radius[to] - ends[from].exit.sin() * self.radius[from]
    }

    /// Sine of the angle δ from the span that leaves pulley `from` to the line of centres.
    fn tilt_sine<T: Over<S>>(&self, from: usize, ends: [EndAngles<T>; 2]) -> T {
        let to = 1 - from;
        let across =
            ends[to].entry.cos() * self.radius[to] - ends[from].exit.cos() * self.radius[from];
        across / self.centre_distance
    }
}

impl Layout {
    /// Lays the drive out in the plane from the inclinations and the angles swept, span after
    /// span: the driven pulley at the origin, the tight span along the first axis.
    pub(crate) fn plan(&self, ends: [EndAngles<f64>; 2], swept: [f64; 2]) -> Plan {
        let outward = |polar: f64| Rotation2::new(polar) * Vector2::x();
        let tangent = |polar: f64, theta: f64| outward(polar + PI / 2.0 - theta);
        let arc = |centre: Vector2<f64>, pulley: usize, entry_polar: f64| {
            let polar = [entry_polar, entry_polar + swept[pulley]];
            let theta = [ends[pulley].entry, ends[pulley].exit];
            Arc {
                centre,
                points: polar.map(|polar| centre + outward(polar) * self.radius[pulley]),
                tangents: [tangent(polar[0], theta[0]), tangent(polar[1], theta[1])],
            }
        };
        let exit_polar = ends[DRIVEN].exit - PI / 2.0;
        let driven = arc(Vector2::zeros(), DRIVEN, exit_polar - swept[DRIVEN]);
        let entry_polar = ends[DRIVER].entry - PI / 2.0;
        let landing = driven.points[1] + driven.tangents[1] * self.span(DRIVEN, ends);
        let centre = landing - outward(entry_polar) * self.radius[DRIVER];
        let driver = arc(centre, DRIVER, entry_polar);
        let slack_end = driver.points[1] + driver.tangents[1] * self.span(DRIVER, ends);
        Plan {
            arcs: [driven, driver],
            slack_end,
        }
    }
}

/// A drive laid out in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plan {
    /// The contact of the belt with the driven pulley and with the driver.
    pub(crate) arcs: [Arc; 2],
    /// Where the slack span ends: at the entry of the driven pulley if the belt closes.
    pub(crate) slack_end: Vector2<f64>,
}

impl Plan {
    /// How far the belt is from closing: gap of the slack span, angle between its ends (as the
    /// distance of the unit tangents) and excess of the distance of the centres over `layout`'s.
    pub(crate) fn misfit(&self, layout: &Layout) -> [f64; 3] {
        let [driven, driver] = &self.arcs;
        [
            (self.slack_end - driven.points[0]).norm(),
            (driver.tangents[1] - driven.tangents[0]).norm(),
            (driver.centre - driven.centre).norm() - layout.centre_distance,
        ]
    }
}

/// The contact of the belt with one pulley in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arc {
    /// Centre of the pulley.
    pub(crate) centre: Vector2<f64>,
    /// Points of the pitch circle where the belt enters and leaves.
    pub(crate) points: [Vector2<f64>; 2],
    /// Unit vectors of the motion of the belt there.
    pub(crate) tangents: [Vector2<f64>; 2],
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn spans_continue_the_belt_and_centres_keep_their_distance(
            theta in prop::array::uniform4(-1.6..1.6_f64),
            radius in prop::array::uniform2(0.05..0.6_f64),
            gap in 0.1..2.0_f64,
        ) {
            let layout = Layout { radius, centre_distance: radius[0] + radius[1] + gap };
            let ends = [
                EndAngles { entry: theta[0], exit: theta[1] },
                EndAngles { entry: theta[2], exit: theta[3] },
            ];
            let plan = layout.plan(ends, layout.wraps(ends));
            let [driven, driver] = plan.arcs;
            prop_assert!((driver.tangents[0] - driven.tangents[1]).norm() < 1e-13);
            for misfit in plan.misfit(&layout) {
                prop_assert!(misfit.abs() < 1e-13);
            }
            // Sweeping further than the condition says opens the belt.
            let [swept, other] = layout.wraps(ends);
            prop_assert!(layout.plan(ends, [swept + 0.1, other]).misfit(&layout)[1] > 0.09);
        }
    }

    #[test]
    fn the_wraps_of_an_open_belt() {
        let layout = Layout {
            radius: [0.1, 0.3],
            centre_distance: 0.5,
        };
        let ends = [EndAngles {
            entry: 0.0,
            exit: 0.0,
        }; 2];
        let half = (0.2_f64 / 0.5).asin();
        let [driven, driver] = layout.wraps(ends);
        assert!((driven - (PI - 2.0 * half)).abs() < 1e-15);
        assert!((driver - (PI + 2.0 * half)).abs() < 1e-15);
        let span = (0.5_f64.powi(2) - 0.2_f64.powi(2)).sqrt();
        assert!((layout.span(DRIVEN, ends) - span).abs() < 1e-15);
        assert!((layout.span(DRIVER, ends) - span).abs() < 1e-15);
    }
}
