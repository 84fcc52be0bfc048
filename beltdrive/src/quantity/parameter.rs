//! What there is to tell of a number of the drive file that varies, and of how its range was traced.

use super::two_pulleys::{closed_form, is_v, time};
use super::{LOCATED, Measure, Quantity, events};
use crate::input::Key;
use crate::{BranchEnd, Drive, TraceConvergence};

/// The value of an entry. A located one has the digits that its error leaves.
pub(super) fn parameter(key: Key, value: f64, error: Option<f64>) -> Quantity {
    let error = error.unwrap_or(0.0);
    let number = Quantity::number(key.stem(), key.name(), key.measure(), value, error);
    match error > 0.0 {
        true => Quantity {
            digits: LOCATED,
            ..number
        },
        false => number,
    }
}

/// The error of a value of an entry: for programs, and for people.
pub(super) fn error(key: Key, error: Option<f64>) -> [Quantity; 2] {
    let reported = error.map(|error| key.reported(error));
    [
        Quantity::number("value_error", "", Measure::Number, reported, 0.0),
        Quantity::error("", "estimated error", key.measure(), error),
    ]
}

/// What varies, for programs.
pub(super) fn statement(key: Key) -> [Quantity; 2] {
    [
        Quantity::word("parameter", "", key.path().to_owned()),
        Quantity::word("unit", "", key.unit().to_owned()),
    ]
}

/// Why a branch or a curve ends, for programs.
pub(super) fn end(end: &BranchEnd) -> Vec<Quantity> {
    let kind = events::end_kind(end);
    vec![
        Quantity::word("reason", "", kind.to_owned()),
        Quantity::word("description", "", end.to_string()),
    ]
}

/// How a branch or a curve was traced.
pub(super) fn convergence(drive: &Drive, found: &TraceConvergence) -> Vec<Quantity> {
    let of_v = |label: &'static str| if is_v(drive) { label } else { "" };
    let error = |key, label, value: f64| Quantity::error(key, label, Measure::Number, value);
    let mut quantities = Vec::from_iter(closed_form(drive));
    quantities.extend([
        error("tolerance", of_v("relative tolerance"), found.tolerance),
        error("slip_normalisation", "", found.slip_normalisation),
        Quantity::count("continuation_steps", "states", found.continuation_steps),
        Quantity::count("newton_iterations", "", found.newton_iterations),
        Quantity::count("rhs_evaluations", "", found.rhs_evaluations),
        Quantity::count(
            "factorisations",
            of_v("factorisations"),
            found.factorisations,
        ),
    ]);
    quantities.extend(time(found.seconds));
    quantities
}
