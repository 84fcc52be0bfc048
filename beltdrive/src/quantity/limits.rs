//! What there is to tell of the range of a load that a drive with two pulleys carries.

use super::events as reasons;
use super::parameter::{self, parameter};
use super::scalars::Scalars;
use super::two_pulleys;
use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value, warning, words};
use crate::{BranchEnd, Limit, Limits, PulleyErrors, RangeEnd, StateErrors};

/// Both ends of the range beside each other.
pub fn answer(limits: &Limits) -> Answer {
    let branch = &limits.branch;
    let key = branch.key;
    let ends = [("smallest", &limits.smallest), ("largest", &limits.largest)];
    let mut heading = words::title(&branch.drive, &[key]);
    heading.push(format!("Limits of {}", key.path()));
    heading.extend(ends.map(|(name, limit)| match (&branch.end, limit.reason) {
        (end @ BranchEnd::NotConverged { .. }, RangeEnd::NotFound) if name == "largest" => {
            format!("{name}: {}; {end}", limit.reason)
        }
        (_, reason) => format!("{name}: {reason}"),
    }));
    let remarks = ends.into_iter().flat_map(|(name, limit)| {
        let warnings = warning::messages(&limit.warnings(&branch.drive, &key));
        warnings
            .into_iter()
            .map(move |remark| format!("{name}: {remark}"))
    });
    let mut statement = two_pulleys::statement(&branch.drive);
    statement.extend(parameter::statement(key));
    let subjects = ends.map(|(name, limit)| Subject::new(name, self::limit(limits, name, limit)));
    let convergence = parameter::convergence(&branch.drive, &branch.convergence);
    Answer {
        remarks: remarks.collect(),
        heading,
        groups: vec![
            Group::single("", statement),
            Group::new("", Layout::Named, subjects.to_vec()),
            Group::single("convergence", convergence),
        ],
        notes: Vec::from_iter(words::speed_loss(branch.drive.belt.kind).1),
    }
}

/// An end of the range.
fn limit(limits: &Limits, name: &str, limit: &Limit) -> Vec<Quantity> {
    let branch = &limits.branch;
    let key = branch.key;
    let pulley = reasons::range_end_pulley(limit.reason).map(words::pulley);
    let warnings = limit.warnings(&branch.drive, &key);
    let warnings = warnings.iter().map(warning::subject).collect();
    let mut drive = branch.drive.clone();
    key.set(&mut drive, limit.value);
    let tolerance = branch.convergence.tolerance;
    let scalars = Scalars::of(&drive, &limit.state, tolerance, limit.errors.as_ref());
    let mut quantities = vec![
        Quantity::word("limit", "", name.to_owned()),
        parameter(key, limit.value, limit.value_error),
    ];
    quantities.extend(parameter::error(key, limit.value_error));
    quantities.extend([
        Quantity::word(
            "reason",
            "",
            reasons::range_end_kind(limit.reason).to_owned(),
        ),
        Quantity::word(
            "",
            "reason",
            reasons::range_end_label(limit.reason).to_owned(),
        ),
        Quantity::word("pulley", "", pulley.map(str::to_owned)),
        Quantity::word("description", "", limit.reason.to_string()),
        Quantity::json("value", key.reported(limit.value)),
        Quantity::data("warnings", Measure::Number, Value::List(warnings)),
    ]);
    quantities.extend(scalars.all());
    quantities.extend([
        Quantity::number(
            "error_estimate",
            "",
            Measure::Number,
            limit.state.error_estimate,
            0.0,
        ),
        errors(limit.errors.as_ref()),
    ]);
    quantities.extend(two_pulleys::convention(&drive));
    quantities
}

/// The estimated errors of a state, for programs.
pub(super) fn errors(errors: Option<&StateErrors>) -> Quantity {
    let number = |key, measure, error| Quantity::number(key, "", measure, error, 0.0);
    let object = |key, object| Quantity::data(key, Measure::Number, Value::Object(object));
    let pulley = |errors: &PulleyErrors| {
        let degrees = errors.inclination.map(f64::to_degrees);
        Some(vec![
            number("angular_speed", Measure::AngularSpeed, errors.angular_speed),
            number("torque", Measure::Torque, errors.torque),
            number("wrap_angle", Measure::Angle, errors.wrap_angle),
            number("max_penetration", Measure::Length, errors.max_penetration),
            Quantity::json("inclination_deg", degrees.to_vec()),
        ])
    };
    let all = errors.map(|errors| {
        vec![
            number("efficiency", Measure::Number, errors.efficiency),
            object("driver", pulley(&errors.driver)),
            object("driven", pulley(&errors.driven)),
        ]
    });
    object("errors", all)
}
