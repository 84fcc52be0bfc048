//! The drive in its plane: centres at rest, pulleys on a horizontal line with the driver on the
//! left, the belt running counterclockwise.

use crate::belt_loop::{BeltLoop, LoopState};
use crate::{PulleyState, SteadyState};
use nalgebra::{Rotation2, Vector2};
use std::f64::consts::{FRAC_PI_2, PI};

/// A point or direction in the plane, x to the right and y upwards, m.
pub(super) type Point = Vector2<f64>;

/// Where the pulleys are and where the belt meets them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Geometry {
    /// The driver.
    pub(super) driver: Circle,
    /// The driven pulley.
    pub(super) driven: Circle,
}

/// A pulley and the belt's ends on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Circle {
    /// Centre of the pulley.
    pub(super) centre: Point,
    /// Pitch radius, m.
    pub(super) radius: f64,
    /// Sense in which it turns: +1 counter-clockwise, −1 clockwise.
    pub(super) sense: f64,
    /// Polar angle of the entry seen from the centre, rad.
    entry: f64,
    /// Polar angle of the exit, rad.
    exit: f64,
}

impl Geometry {
    /// The geometry of a state.
    ///
    /// Seen along the tight span, from the exit of the driven pulley 1 to the entry of the driver
    /// 2, the belt meets a pulley at polar angle −π/2 + θ, where θ is its inclination. With the
    /// span's length L the centre of the driver is then from that of the driven pulley at
    ///
    /// ```text
    /// (R₁ sin θ₁ + L − R₂ sin θ₂, R₂ cos θ₂ − R₁ cos θ₁)
    /// ```
    ///
    /// The whole is turned until this vector points to the left.
    pub(super) fn of(state: &SteadyState) -> Self {
        let (driver_radius, driven_radius) = (state.drive.driver_radius, state.drive.driven_radius);
        let driven_exit = polar(state.driven.inclination[1] - FRAC_PI_2, driven_radius);
        let driver_entry = polar(state.driver.inclination[0] - FRAC_PI_2, driver_radius);
        let centres = driven_exit + Point::new(state.tight_span, 0.0) - driver_entry;
        let turn = PI - centres.y.atan2(centres.x);
        let circle = |pulley: &PulleyState, radius, centre, entry: f64| Circle {
            centre,
            radius,
            sense: 1.0,
            entry: entry + turn,
            exit: entry + turn + pulley.wrap_angle,
        };
        let driver_angle = state.driver.inclination[0] - FRAC_PI_2;
        let driven_angle = state.driven.inclination[1] - FRAC_PI_2 - state.driven.wrap_angle;
        Self {
            driver: circle(&state.driver, driver_radius, Point::zeros(), driver_angle),
            driven: circle(
                &state.driven,
                driven_radius,
                Point::new(centres.norm(), 0.0),
                driven_angle,
            ),
        }
    }

    /// The tight span from its beginning to its end.
    pub(super) fn tight_span(&self) -> [Point; 2] {
        [self.driven.exit(), self.driver.entry()]
    }

    /// The slack span from its beginning to its end.
    pub(super) fn slack_span(&self) -> [Point; 2] {
        [self.driver.exit(), self.driven.entry()]
    }
}

/// The pulleys of a loop, in belt order.
///
/// Where the belt runs in the direction ϑ with the inclination θ on a pulley that turns in the sense σ, it
/// is at the polar angle ϑ − σ (π/2 − θ).
pub(super) fn circles(belt_loop: &BeltLoop, state: &LoopState) -> Vec<Circle> {
    let count = state.pulleys.len();
    let circle = |index: usize| {
        let pulley = &state.pulleys[index];
        let placed = &state.layout.pulleys()[index];
        let sense = placed.turns(belt_loop.sense);
        let inclination = pulley
            .groove
            .as_ref()
            .map_or(0.0, |groove| groove.inclination[0]);
        let direction = state.spans[(index + count - 1) % count].direction;
        let entry = direction - sense * (FRAC_PI_2 - inclination);
        Circle {
            centre: pulley.centre.into(),
            radius: placed.radius,
            sense,
            entry,
            exit: entry + sense * pulley.wrap,
        }
    };
    (0..count).map(circle).collect()
}

impl Circle {
    /// The point at an angle φ swept from the entry and a penetration x into the groove.
    pub(super) fn point(&self, swept: f64, penetration: f64) -> Point {
        self.centre + polar(self.entry + self.sense * swept, self.radius - penetration)
    }

    /// The point where the belt enters.
    pub(super) fn entry(&self) -> Point {
        self.point(0.0, 0.0)
    }

    /// The point where the belt leaves.
    pub(super) fn exit(&self) -> Point {
        self.centre + polar(self.exit, self.radius)
    }
}

/// The point at a polar angle and radius.
pub(super) fn polar(angle: f64, radius: f64) -> Point {
    Rotation2::new(angle) * Point::new(radius, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    /// Direction of a belt at a polar angle, turned outward by its inclination.
    fn tangent(angle: f64, inclination: f64) -> Point {
        polar(angle + FRAC_PI_2 - inclination, 1.0)
    }

    #[test]
    fn spans_join_the_belt_on_both_pulleys() {
        for state in [sample::loaded(), sample::idle(), sample::overhanging()] {
            let geometry = Geometry::of(&state);
            let Geometry { driver, driven } = geometry;
            let [slack, tight] = [geometry.slack_span(), geometry.tight_span()];
            for (span, length, exit, entry) in [
                (
                    tight,
                    state.tight_span,
                    tangent(driven.exit, state.driven.inclination[1]),
                    tangent(driver.entry, state.driver.inclination[0]),
                ),
                (
                    slack,
                    state.slack_span,
                    tangent(driver.exit, state.driver.inclination[1]),
                    tangent(driven.entry, state.driven.inclination[0]),
                ),
            ] {
                let belt = span[1] - span[0];
                assert!((belt - exit * length).norm() < 1e-6, "{belt} along {exit}");
                assert!(
                    (belt - entry * length).norm() < 1e-6,
                    "{belt} along {entry}"
                );
            }
            let distance = (driven.centre - driver.centre).norm();
            assert!((distance - state.drive.centre_distance).abs() < 1e-9);
        }
    }

    #[test]
    fn a_point_is_seated_in_the_groove() {
        let driver = Geometry::of(&sample::loaded()).driver;
        let radius = (driver.point(1.0, 0.01) - driver.centre).norm();
        assert!((radius - (driver.radius - 0.01)).abs() < 1e-12);
    }
}
