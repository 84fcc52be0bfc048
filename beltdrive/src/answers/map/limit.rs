//! The largest load on a line of a map, beyond which no state is sought.

use crate::vbelt::belt_loop::Top;
use crate::{Closure, Drive, SolveError};

/// A load above the limit of its line by this share has no state: the limit is known to about 1e-4. Nearer to it each
/// load is tried.
const BEYOND: f64 = 1e-3;

/// The largest load on a line.
pub(super) struct Limit {
    /// A drive of the line.
    pub(super) of: Drive,
    /// The factor on its torques.
    pub(super) top: Top,
}

impl Limit {
    /// The limit for which the load of a drive was refused.
    pub(super) fn refusing((stated, factor): &(Drive, f64), error: &SolveError) -> Option<Self> {
        let SolveError::Overloaded {
            pulley,
            load_factor,
            overhangs,
        } = error
        else {
            return None;
        };
        if stated.two_pulleys().is_some() {
            return None;
        }
        let mut of = stated.clone();
        of.multiply_load(*factor);
        let top = Top {
            factor: *load_factor,
            pulley: of.pulleys.iter().position(|of| of.name == *pulley)?,
            overhangs: *overhangs,
            is_last: true,
            error: 0.0,
        };
        Some(Self { of, top })
    }
}

/// Why a drive has no state: its load is above the limit of the line, or above one that was refused because of a limit.
pub(super) fn beyond(
    (stated, factor): &(Drive, f64),
    limit: Option<&Limit>,
    refused: Option<&(Drive, SolveError)>,
) -> Option<SolveError> {
    if stated.two_pulleys().is_some() {
        let (drive, error) = refused?;
        return heavier(stated, drive, error);
    }
    let Limit { of, top } = limit?;
    let mut closed = stated.clone();
    closed.multiply_load(*factor);
    let load_factor = top.factor / closed.load_factor_over(of)?;
    (load_factor * (1.0 + BEYOND) < 1.0).then(|| SolveError::Overloaded {
        pulley: stated.pulleys[top.pulley].name.clone(),
        load_factor,
        overhangs: top.overhangs,
    })
}

/// The refusal of a drive by the limit of the tight tension for which another one with a lower tension is refused.
fn heavier(stated: &Drive, refused: &Drive, error: &SolveError) -> Option<SolveError> {
    let (Closure::BothSpans(load), Closure::BothSpans(lower)) = (stated.closure, refused.closure)
    else {
        return None;
    };
    let tight = load.tight.value();
    if tight < lower.tight.value()
        || refused.with_load(load) != *stated
        || load.slack != lower.slack
    {
        return None;
    }
    let mut error = error.clone();
    match &mut error {
        SolveError::NoSteadyState { asked, .. } => {
            *asked = tight;
            Some(error)
        }
        _ => None,
    }
}
