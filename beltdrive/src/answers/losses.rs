//! Where the power of a drive goes.

use crate::belt_loop::LoopState;
use crate::{BeltKind, Drive, GivenLosses};

/// Where the power of a drive goes, W.
///
/// Of the power lost between the pulleys there are two accounts, each of which adds up to it:
///
/// ```text
/// P_in − P_out = Σ f_i (v − v_i)  −  v Σ f_i         f_i = M_i/R_i,  v_i = R_i ω_i
///                speed loss          torque loss     v: circumferential speed of the driver
///              = sliding + wedging + elastic + compression
/// ```
///
/// A flat belt has no torque loss, because its tensions balance: Σ `f_i` = 0. The second account is from
/// quadrature along the contacts of a V-belt and has its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Losses {
    /// Power in less power out.
    pub total: f64,
    /// What is lost because pulleys turn more slowly than without slip.
    pub speed: f64,
    /// What is lost because pulleys take less circumferential force from the belt than others give it.
    pub torque: f64,
    /// Slip along the rims, as [`FrictionParts::sliding`](crate::belt_loop::FrictionParts::sliding).
    pub sliding: f64,
    /// Slip in and out of the grooves of a V-belt.
    pub wedging: f64,
    /// Friction below its limit (hysteresis), with a friction law that has such zones.
    pub elastic: f64,
    /// What goes into the transverse compression of a V-belt between entry and exit; of either sign.
    pub compression: f64,
    /// Bending of the belt round the pulleys, by the given numbers.
    pub bending: Option<f64>,
    /// Friction of the bearings, by the given numbers.
    pub bearings: Option<f64>,
}

impl Losses {
    /// What the given numbers add to the power lost between the pulleys, W; `None` if none is given.
    #[must_use]
    pub fn given(&self) -> Option<f64> {
        match (self.bending, self.bearings) {
            (None, None) => None,
            (bending, bearings) => Some(bending.unwrap_or(0.0) + bearings.unwrap_or(0.0)),
        }
    }
}

/// Where the power goes in a state of a drive.
pub(super) fn losses(drive: &Drive, state: &LoopState, given: &GivenLosses) -> Losses {
    let rim = drive.rim_speed();
    let pulleys = || drive.pulleys.iter().zip(&state.pulleys);
    let [mut speed, mut force] = [0.0; 2];
    for (stated, found) in pulleys() {
        let pull = found.torque / stated.radius;
        speed += pull * found.speed_loss * rim;
        force += pull;
    }
    let parts = || state.pulleys.iter().map(|pulley| pulley.friction_parts);
    let grooves = state
        .pulleys
        .iter()
        .filter_map(|pulley| pulley.groove.as_ref());
    // Each length of the belt is bent to every pulley once in a round.
    let bending = given.bending.map(|bending| {
        let energies = drive.pulleys.iter();
        let energies = energies.map(|pulley| 0.5 * bending.stiffness / pulley.radius.powi(2));
        bending.damping * energies.sum::<f64>() * state.unstretched_speed
    });
    let bearings = given.bearing_torque.map(|torque| {
        let speeds = state.pulleys.iter().map(|pulley| pulley.angular_speed);
        torque * speeds.sum::<f64>()
    });
    Losses {
        total: state.power_in - state.power_out,
        speed,
        torque: match drive.belt.kind {
            BeltKind::V(_) => -rim * force,
            BeltKind::Flat { .. } => 0.0,
        },
        sliding: parts().map(|parts| parts.sliding).sum(),
        wedging: parts().map(|parts| parts.wedging).sum(),
        elastic: parts().map(|parts| parts.elastic).sum(),
        compression: grooves.map(|groove| groove.transverse_loss).sum(),
        bending,
        bearings,
    }
}
