//! What other friction asks for, and what a longer belt leaves.

use crate::quantity::{Measure, Quantity, Subject};
use crate::{OtherFriction, Setup, SolveError};

/// A tension of a band, or why there is none, which may have a line of a table.
fn of_band(
    accuracy: f64,
    [key, error_key]: [&'static str; 2],
    label: &'static str,
    tension: &Result<f64, SolveError>,
    has_line: bool,
) -> [Quantity; 2] {
    let value = tension.as_ref().ok().copied();
    let error = accuracy * value.unwrap_or(0.0).abs();
    let why = tension.as_ref().err().map(|error| error.kind().to_owned());
    let why_label = if has_line { "  because" } else { "" };
    [
        Quantity::number(key, label, Measure::Force, value, error),
        Quantity::word(error_key, why_label, why),
    ]
}

/// What friction other than stated asks for.
pub(super) fn friction(found: &Setup) -> Vec<Subject> {
    let column = |other: &OtherFriction| {
        let change = 100.0 * (other.factor - 1.0);
        let sign = if change < 0.0 { '−' } else { '+' };
        let [tension, error] = of_band(
            other.accuracy,
            ["tension", "error"],
            "belt tension at rest that is needed",
            &other.tension,
            true,
        );
        Subject::new(
            format!("friction {sign}{:.0} %", change.abs()),
            vec![
                Quantity::number("factor", "", Measure::Number, other.factor, 0.0),
                tension,
                error,
                margin(
                    found,
                    "slip margin of the drive as set up",
                    other.slip_margin,
                ),
            ],
        )
    };
    found.other_friction.iter().map(column).collect()
}

/// The smallest slip margin of a band.
fn margin(found: &Setup, label: &'static str, value: Option<f64>) -> Quantity {
    let error = found.accuracy * value.unwrap_or(0.0);
    Quantity::number("slip_margin", label, Measure::Number, value, error)
}

/// What a longer belt leaves.
pub(super) fn elongation(found: &Setup) -> Vec<Quantity> {
    let share = Quantity::number(
        "elongation",
        "elongation of the belt",
        Measure::Share,
        found.question.elongation,
        0.0,
    );
    let elongated = &found.elongated;
    let mut quantities = vec![share];
    quantities.extend(of_band(
        found.accuracy,
        ["tension", "error"],
        "belt tension at rest that it leaves",
        &elongated.tension,
        elongated.tension.is_err(),
    ));
    quantities.push(margin(
        found,
        "slip margin that it leaves",
        elongated.slip_margin,
    ));
    quantities.extend(of_band(
        found.accuracy,
        ["tension_before", "error_before"],
        "belt tension at rest to set with it in mind",
        &elongated.tension_before,
        elongated.tension_before.is_err(),
    ));
    quantities
}
