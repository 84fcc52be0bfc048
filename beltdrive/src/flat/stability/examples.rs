//! Belts for tests: that of Kim (2009), and a rod.

use super::{AxialMotion, LinearisedForm};
use std::f64::consts::PI;

/// All forms.
pub(super) const FORMS: [LinearisedForm; 3] = [
    LinearisedForm::Thesis,
    LinearisedForm::NaturalOutlet,
    LinearisedForm::Conservative,
];

/// Pitch radius, m.
const RADIUS: f64 = 0.08125;
/// Coefficient of friction.
const FRICTION: f64 = 1.2;
/// Slack tension, N.
const SLACK: f64 = 200.0;

/// The belt before its transition is known, at an angular speed of the pulley.
fn belt(angular_speed: f64, slip_rate: f64) -> AxialMotion {
    AxialMotion {
        mass_per_length: 0.1036,
        axial_stiffness: 80_068.0,
        speed: angular_speed * RADIUS,
        length: PI * RADIUS,
        transition: PI * RADIUS,
        elastic: Some(8.1e7),
        slip_rate,
    }
}

/// The belt with the transition at which `excess`(s*) changes its sign, if it does.
fn with_transition(belt: AxialMotion, excess: impl Fn(f64) -> f64) -> AxialMotion {
    let (mut low, mut high) = (0.0, belt.length);
    let sign = excess(low).signum();
    if excess(high).signum() == sign {
        return belt;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if excess(middle).signum() == sign {
            low = middle;
        } else {
            high = middle;
        }
    }
    AxialMotion {
        transition: 0.5 * (low + high),
        ..belt
    }
}

/// The rate a of the tension in slip, and that w of elastic friction, 1/m.
fn rates(belt: &AxialMotion) -> (f64, f64) {
    let stiffness = belt.moving_stiffness();
    let slip = belt.slip_rate.abs() * belt.axial_stiffness / stiffness;
    (
        slip,
        (belt.elastic.unwrap_or(f64::INFINITY) / stiffness).sqrt(),
    )
}

/// The driven pulley with the tight tension `tight`, N.
pub(super) fn driven(tight: f64) -> AxialMotion {
    let belt = belt(119.1, FRICTION / RADIUS);
    let (a, w) = rates(&belt);
    with_transition(belt, |s| {
        let elastic = 1.0 - a / w * (0.5 * w * s).tanh();
        SLACK - tight * (-a * (belt.length - s)).exp() * elastic
    })
}

/// The driver with the tight tension `tight`, N, at an angular speed, rad/s.
pub(super) fn driver(tight: f64, angular_speed: f64) -> AxialMotion {
    let belt = belt(angular_speed, -FRICTION / RADIUS);
    let (a, w) = rates(&belt);
    with_transition(belt, |s| {
        let elastic = 1.0 + a / w * (0.5 * w * s).tanh();
        tight - SLACK * (a * (belt.length - s)).exp() * elastic
    })
}

/// A belt at rest that slips without friction beyond a rigid zone: a rod.
pub(super) fn coulomb_at_rest() -> AxialMotion {
    AxialMotion {
        speed: 0.0,
        elastic: None,
        slip_rate: 0.0,
        transition: 0.1,
        ..belt(0.0, 0.0)
    }
}

impl AxialMotion {
    /// Stiffness of the moving belt D = EA − m v², N.
    pub(super) fn moving_stiffness(&self) -> f64 {
        self.axial_stiffness - self.mass_per_length * self.speed * self.speed
    }
}
