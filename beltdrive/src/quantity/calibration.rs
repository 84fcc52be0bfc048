//! What there is to tell of a calibration.

use super::{Answer, Group, Layout, Measure, Quantity, Subject, UnitSystem, words};
use crate::Drive;
use crate::calibrate::{Ambiguity, Calibration, Parameter, Residual, Scatter};
use crate::quantity::precision::six_digits;
use serde_json::json;
use std::borrow::Cow;

/// Digits of what is estimated, and of its standard error.
const FOUND: u8 = 5;
const OF_ERROR: u8 = 3;

/// The parameters with their intervals, and every reading beside the model.
pub fn answer(drive: &Drive, calibration: &Calibration) -> Answer {
    let rows = calibration.residuals.iter().map(|residual| residual.line);
    let mut rows: Vec<_> = rows.collect();
    rows.dedup();
    let heading = vec![
        words::heading(drive),
        format!(
            "Calibrated with {} readings in {} rows, weighted least squares",
            calibration.residuals.len(),
            rows.len()
        ),
    ];
    let mut groups = vec![
        Group::single("", statement(calibration, rows.len())),
        parameters(&calibration.parameters),
        Group::single("", scatter(calibration)),
        Group::new("residuals", Layout::Rows, residuals(calibration)),
    ];
    groups.extend(tables(calibration));
    let search = [
        Quantity::count("steps", "steps of the search", calibration.steps),
        Quantity::count("states", "steady states", calibration.states),
    ];
    groups.push(Group::single("search", search.into()));
    Answer {
        heading,
        remarks: remarks(calibration),
        groups,
        notes: vec!["Intervals are those of the problem linearised at the solution, in the logarithms of positive numbers.".to_owned()],
    }
}

/// What was found, for programs.
fn statement(calibration: &Calibration, rows: usize) -> Vec<Quantity> {
    let parameter = |parameter: &Parameter| {
        let (_, factor) = parameter.key.measure().stored();
        json!({
            "key": parameter.key.path(),
            "unit": parameter.key.measure().shown(UnitSystem::Si).symbol,
            "start": parameter.start * factor,
            "value": parameter.value * factor,
            "standard_error": parameter.standard_error.map(|error| error * factor),
            "low": parameter.interval.map(|[low, _]| low * factor),
            "high": parameter.interval.map(|[_, high]| high * factor),
        })
    };
    let ambiguity = |ambiguity: &Ambiguity| {
        let combination = ambiguity.combination.iter();
        let combination =
            combination.map(|(key, change)| json!({ "key": key, "relative_change": change }));
        json!({
            "combination": combination.collect::<Vec<_>>(),
            "correlation": ambiguity.correlation,
            "effect": ambiguity.effect,
        })
    };
    let parameters: Vec<_> = calibration.parameters.iter().map(parameter).collect();
    let ambiguities: Vec<_> = calibration.ambiguities.iter().map(ambiguity).collect();
    vec![
        Quantity::json("parameters", parameters),
        Quantity::json("correlation", json!(calibration.correlation)),
        Quantity::json("singular_values", json!(calibration.singular_values)),
        Quantity::json("ambiguities", ambiguities),
        Quantity::json("rows", rows),
        Quantity::json("readings", calibration.residuals.len()),
        Quantity::json("degrees_of_freedom", calibration.degrees_of_freedom),
        Quantity::json("sum_of_squares", calibration.sum_of_squares),
    ]
}

/// The parameters, for people.
fn parameters(parameters: &[Parameter]) -> Group {
    type Part = fn(&Parameter) -> Option<f64>;
    let parts: [(&str, u8, Part); 5] = [
        ("found", FOUND, |parameter| Some(parameter.value)),
        ("σ", OF_ERROR, |parameter| parameter.standard_error),
        ("95 % from", FOUND, |parameter| {
            parameter.interval.map(|[low, _]| low)
        }),
        ("to", FOUND, |parameter| {
            parameter.interval.map(|[_, high]| high)
        }),
        ("start", FOUND, |parameter| Some(parameter.start)),
    ];
    let subjects = parts.map(|(head, digits, part)| {
        let quantities = parameters.iter().map(|parameter| {
            let label: Cow<'static, str> = parameter.key.path().to_owned().into();
            let number = Quantity::number("", label, parameter.key.measure(), part(parameter), 0.0);
            Quantity { digits, ..number }
        });
        Subject::new(head, quantities.collect())
    });
    Group::new("", Layout::Columns, subjects.into())
}

/// How far the model is from the readings, for people.
fn scatter(calibration: &Calibration) -> Vec<Quantity> {
    let number = |label: &'static str, measure, value| Quantity {
        digits: OF_ERROR + 1,
        ..Quantity::number("", label, measure, value, 0.0)
    };
    let freedom = Quantity::count("", "degrees of freedom", calibration.degrees_of_freedom);
    let mut quantities = vec![freedom];
    match calibration.scatter {
        Scatter::Stated(reduced) => {
            let value = reduced.map(|(value, _)| value);
            quantities.push(number("S/(n − m)", Measure::Number, value));
            let ends = ["  expected from", "  to"].into_iter().enumerate();
            quantities.extend(ends.map(|(index, label)| {
                let end = reduced.map(|(_, range)| range[index]);
                number(label, Measure::Number, end)
            }));
        }
        Scatter::Estimated(deviation) => {
            let measured = calibration
                .residuals
                .first()
                .map(|first| first.measured.measure());
            quantities.push(number(
                "estimated scatter",
                measured.unwrap_or(Measure::Number),
                deviation,
            ));
        }
    }
    quantities
}

/// Every reading beside the model, for programs.
fn residuals(calibration: &Calibration) -> Vec<Subject> {
    let subject = |residual: &Residual| {
        let measure = residual.measured.measure();
        let (suffix, factor) = measure.stored();
        let number = |key, value: Option<f64>| {
            Quantity::number(
                key,
                "",
                Measure::Number,
                value.map(|value| value * factor),
                0.0,
            )
        };
        let unit = suffix.trim_start_matches('_').to_owned();
        let quantities = vec![
            Quantity::count("line", "", residual.line),
            Quantity::word("quantity", "", residual.measured.name().to_owned()),
            Quantity::word("unit", "", unit),
            number("reading", Some(residual.value)),
            number("model", Some(residual.model)),
            number("difference", Some(residual.value - residual.model)),
            number("standard_deviation", residual.deviation),
        ];
        Subject::new("", quantities)
    };
    calibration.residuals.iter().map(subject).collect()
}

/// Every reading beside the model, for people: a table for each measured quantity.
fn tables(calibration: &Calibration) -> Vec<Group> {
    let mut names: Vec<&str> = Vec::new();
    for residual in &calibration.residuals {
        let name = residual.measured.name();
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let table = |name: &str| {
        let of_table = calibration.residuals.iter();
        let of_table = of_table.filter(|residual| residual.measured.name() == name);
        let rows = of_table.map(|residual| {
            let measure = residual.measured.measure();
            let number = |label: &'static str, value: Option<f64>, digits| Quantity {
                digits,
                ..Quantity::number("", label, measure, value, 0.0)
            };
            let difference = residual.value - residual.model;
            let title = residual.measured.name().to_owned();
            let over = residual.deviation.map(|deviation| difference / deviation);
            let line = Quantity::count("", "line", residual.line);
            let quantities = vec![
                Quantity {
                    label: title.into(),
                    ..line
                },
                number("reading", Some(residual.value), 6),
                number("model", Some(residual.model), 6),
                number("difference", Some(difference), OF_ERROR),
                Quantity {
                    digits: OF_ERROR,
                    ..Quantity::number("", "over σ", Measure::Number, over, 0.0)
                },
            ];
            Subject::new("", quantities)
        });
        Group::new("", Layout::Rows, rows.collect())
    };
    names.into_iter().map(table).collect()
}

/// What to beware of.
fn remarks(calibration: &Calibration) -> Vec<String> {
    let mut remarks: Vec<_> = calibration.ambiguities.iter().map(ambiguity).collect();
    if let Scatter::Stated(Some((reduced, [low, high]))) = calibration.scatter {
        let expected = format!(
            "S/(n − m) is {}, and would lie within {} and {} if the model were right and so were the standard \
             deviations",
            six_digits(rounded(reduced)),
            six_digits(rounded(low)),
            six_digits(rounded(high))
        );
        if reduced > high {
            remarks.push(format!(
                "the readings are farther from the model than their standard deviations say: {expected}; the \
                 intervals are too narrow"
            ));
        } else if reduced < low {
            remarks.push(format!(
                "the readings are closer to the model than their standard deviations say: {expected}"
            ));
        }
    }
    remarks
}

/// A number to three digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// What the rows cannot tell apart, in words.
fn ambiguity(ambiguity: &Ambiguity) -> String {
    let changes = ambiguity.combination.iter().map(|(key, change)| {
        let word = if *change > 0.0 { "raised" } else { "lowered" };
        let percent = six_digits(rounded(100.0 * change.abs()));
        format!("`{key}` {word} by {percent} %")
    });
    let changes = changes.collect::<Vec<_>>().join(" and ");
    let keys: Vec<_> = ambiguity
        .combination
        .iter()
        .map(|(key, _)| format!("`{key}`"))
        .collect();
    match (&keys[..], ambiguity.correlation) {
        ([key], None) => {
            format!("the rows say nothing of {key}: at the value found no reading depends on it")
        }
        (_, None) => format!(
            "the rows cannot tell {} apart: {changes} together change no reading",
            keys.join(" and ")
        ),
        (_, Some(correlation)) => {
            let effect = ambiguity.effect.map_or_else(String::new, |effect| {
                let effect = six_digits(rounded(effect));
                format!(": {changes} together change all readings by {effect} standard deviations in all")
            });
            format!(
                "the rows hardly tell {} apart, correlation {correlation:.3}{effect}",
                keys.join(" and ")
            )
        }
    }
}
