//! How a tensioner is held by a V-belt.

use super::plane::{Laid, Plane};
use super::rest::{Known, Rest, RestProblem};
use super::rest_guess::RestNear;
use super::solve::Search;
use crate::mechanics::tensioner::Held;
use crate::{Guide, Tensioner};
use bvp::Real;

/// Share of the tension over which the compliance of the belt is a difference.
const DIFFERENCE: f64 = 1e-3;

/// Unit of the coordinate of a tensioner whose idler has a radius: rad, or that radius in m.
pub(super) fn coordinate_unit(tensioner: &Tensioner, radius: f64) -> f64 {
    match tensioner.guide {
        Guide::Rotary { .. } => 1.0,
        Guide::Translating { .. } => radius,
    }
}

/// Load of a tensioner and its idler along the coordinate, in units of a force; 0 in equilibrium.
pub(super) fn unbalanced<T: Real>(
    tensioner: &Tensioner,
    force: f64,
    coordinate: T,
    hub_load: [T; 2],
) -> T {
    let arm = match tensioner.guide {
        Guide::Rotary { arm_length, .. } => arm_length,
        Guide::Translating { .. } => 1.0,
    };
    let [_, velocity, _] = tensioner.guide.centre(coordinate);
    let [load, _] = tensioner.load_at(coordinate);
    (hub_load[0] * velocity[0] + hub_load[1] * velocity[1]) / arm + load / (arm * force)
}

/// First and second derivative of the length of the belt with the coordinate at held tension: its
/// inclinations at the ends of the contacts then stay as they are.
pub(super) fn length_derivatives(
    plane: &Plane,
    laid: &Laid<f64>,
    (pulley, tensioner): (usize, &Tensioner),
    coordinate: f64,
) -> [f64; 2] {
    let [_, velocity, acceleration] = tensioner.guide.centre(coordinate);
    // Tension 1 on both sides pulls the hub by −dL/dC.
    let pull = laid.hub_load(plane, pulley, [1.0; 2]);
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let turning = [plane.arriving(pulley), pulley].map(|span| {
        let [cosine, sine] = laid.tangent(span);
        let across = dot([-sine, cosine], velocity);
        across * across / laid.tangents[span]
    });
    [
        -dot(pull, velocity),
        turning[0] + turning[1] - dot(pull, acceleration),
    ]
}

impl Search<'_> {
    /// Tension of the belt at rest per length of the loop that is taken up, N/m, the tensioner held:
    /// EA/`L_0` of a belt that does not sink into grooves.
    pub(super) fn stiffness(&mut self, problem: &RestProblem, rest: &Rest) -> Option<f64> {
        let lengths = [-DIFFERENCE, DIFFERENCE].map(|change| {
            let tension = rest.tension * (1.0 + change);
            let near = problem.clone().with(Known::Tension(tension));
            let near = near.held(rest.coordinate);
            let guess = RestNear {
                problem: &near,
                rest,
                first_length: problem.first_length(),
            };
            let solved = near.solve(&guess, self);
            solved.ok().map(|solved| solved.unstretched)
        });
        let [slacker, tighter] = lengths;
        let per_tension = (slacker? - tighter?) / (2.0 * DIFFERENCE * rest.tension);
        let axial = self.drive.belt.axial_stiffness;
        Some(1.0 / (per_tension * (1.0 + rest.tension / axial)))
    }
}

/// The tensioner in equilibrium with a belt of a stiffness in N/m, at a tractive tension in N.
pub(super) fn held(
    plane: &Plane,
    laid: &Laid<f64>,
    carried: (usize, &Tensioner),
    coordinate: f64,
    tractive: f64,
    stiffness: f64,
) -> Held {
    let derivatives = length_derivatives(plane, laid, carried, coordinate);
    let [_, load_slope] = carried.1.load_at(coordinate);
    Held::by(derivatives, load_slope, tractive, stiffness)
}
