//! The drive that is rated.

use crate::answers::belt_loop::{closed_once, solve_to};
use crate::answers::tension::with_length;
use crate::model::model;
use crate::{BeltKind, Closure, Drive, Duty, SolveError, SolveOptions};
use std::borrow::Cow;

/// A drive that keeps its torques and its belt at other speeds: with torques in place of powers, and with the belt
/// length of its state in place of the tensions of both spans.
pub(in crate::answers) fn kept(
    stated: &Drive,
    options: &SolveOptions,
) -> Result<Drive, SolveError> {
    let mut drive = closed_once(stated, options)?.into_owned();
    if stated.two_pulleys().is_some() {
        let length = solve_to(&drive, options)?.unstretched_length;
        drive.closure = Closure::UnstretchedLength(length);
    }
    let rim = drive.rim_speed();
    for pulley in &mut drive.pulleys {
        if let Duty::Power(power) = pulley.duty {
            pulley.duty = Duty::Torque(power * pulley.radius / rim);
        }
    }
    Ok(drive)
}

/// A drive with torques in place of powers, closed by what does not depend on its load.
pub(super) fn rated(stated: &Drive, options: &SolveOptions) -> Result<Drive, SolveError> {
    let drive = kept(stated, options)?;
    if drive.is_idle() {
        return Err(SolveError::Statement {
            subject: "load".to_owned(),
            problem: Cow::Borrowed(
                "no pulley has a torque or a power, so that there is none to raise; state those of the driven \
                 pulleys in their ratio",
            ),
        });
    }
    let is_of_rest = matches!(
        drive.closure,
        Closure::SetupTension(_) | Closure::RestCoordinate(_)
    );
    match drive.belt.kind {
        // The belt at rest is solved once for all speeds.
        BeltKind::V(_) if is_of_rest => {
            let rest = model(drive.belt.kind).at_rest(&drive, options)?;
            Ok(with_length(
                &drive,
                rest.unstretched_length,
                rest.coordinate,
            ))
        }
        _ => Ok(drive),
    }
}
