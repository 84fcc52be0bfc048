//! Parts of the messages of errors.

use crate::problem::unknown::Unknown;

/// The other count that is allowed.
pub(super) fn and_parameters(states: usize, parameters: usize) -> String {
    match parameters {
        0 => String::new(),
        _ => format!(", or also for every parameter, {}", states + parameters),
    }
}

/// What too few conditions may mean.
pub(super) fn hint(conditions: usize, unknowns: usize) -> &'static str {
    if conditions < unknowns {
        "; with fewer, the solutions form a Family"
    } else {
        ""
    }
}

/// An error estimate that may not be known.
pub(super) fn estimate(error: f64) -> String {
    if error.is_finite() {
        format!("{error:.1e}")
    } else {
        "not known".to_owned()
    }
}

/// What rounding does to a solution.
pub(super) fn amplified(rounding: f64, condition: f64) -> String {
    // From the size of the solution on an estimate of the rounding error is the rounding of the estimate
    // itself.
    if rounding < 1.0 {
        format!(
            "rounding errors change the solution by {rounding:.1e} relative to 1 + |y| (amplified {condition:.0e} times)"
        )
    } else {
        "rounding errors leave no digit of the solution".to_owned()
    }
}

/// Whose correction it is.
pub(super) fn of(unknown: Option<&Unknown>) -> String {
    unknown.map_or_else(String::new, |unknown| format!(" of {unknown}"))
}

/// The most conditions that a message names.
const NAMED: usize = 4;

/// Which conditions fail to determine what.
pub(super) fn undetermined(conditions: &[usize], free: Option<&Unknown>, shift: bool) -> String {
    if shift {
        return ": a shift of s takes it to others of a family of solutions; put a condition on the phase in the place of one that follows from the others".to_owned();
    }
    let named: Vec<_> = conditions
        .iter()
        .take(NAMED)
        .map(usize::to_string)
        .collect();
    let named = named.join(", ");
    let dependent = match conditions.len() {
        0 => String::new(),
        1 => format!(
            "; replace condition {named}, which follows from the equations and the other conditions"
        ),
        2..=NAMED => format!("; replace one of the conditions {named}, which depend on each other"),
        _ => format!("; replace one of the conditions {named}, …, which depend on each other"),
    };
    match free {
        Some(unknown) if conditions.is_empty() => {
            format!(": {unknown} is free along a family of solutions")
        }
        Some(unknown) => format!("; {unknown} is free{dependent}"),
        None => dependent,
    }
}
