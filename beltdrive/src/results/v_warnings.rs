//! What a user must know of a state of a V-belt that is none for practice.

use crate::{Drive, Pulley, StateSummary, SteadyState, Warning};
use std::f64::consts::FRAC_PI_2;

/// Strain from which the stiffness per length of the stretched belt and that of the unstretched one, which
/// the model does not tell apart, differ by as much as coefficients of friction are uncertain.
const LARGE_STRETCH: f64 = 0.05;

/// The remarks on a state.
pub(crate) fn warnings(state: &SteadyState) -> Vec<Warning> {
    let pulleys = [
        (Pulley::Driven, &state.driven),
        (Pulley::Driver, &state.driver),
    ];
    let overhangs = pulleys.into_iter().filter_map(|(pulley, on)| {
        let steepest = on.profile.inclination.iter().copied();
        let inclination = steepest.fold(0.0, |m: f64, theta| m.max(theta.abs()));
        (inclination > FRAC_PI_2).then_some(Warning::Overhang {
            pulley,
            inclination,
        })
    });
    let beyond = beyond_model(&state.drive, &StateSummary::from(state));
    overhangs.chain(beyond).collect()
}

/// Remarks on a state that the model is not for, of which the scalars tell: a belt below its groove, or
/// stretched too far.
pub(crate) fn beyond_model(drive: &Drive, state: &StateSummary) -> Vec<Warning> {
    let height = drive.belt.v().height.unwrap_or(f64::INFINITY);
    let pulleys = [
        (Pulley::Driven, &state.driven),
        (Pulley::Driver, &state.driver),
    ];
    let sunk = pulleys.into_iter().filter_map(|(pulley, on)| {
        let penetration = on.max_penetration;
        (penetration > height).then_some(Warning::Sunk {
            pulley,
            penetration,
            height,
        })
    });
    let strain = state.tight_tension / drive.belt.axial_stiffness;
    let stretch = (strain > LARGE_STRETCH).then_some(Warning::LargeStretch { strain });
    sunk.chain(stretch).collect()
}
