//! Both limits of a drive as a table for a terminal.

use crate::quantity::precision::known;
use crate::report::branch::convergence;
use crate::report::{
    self, Precision,
    lines::{self, row},
    rpm, slip_arc, torque_scale, value, words,
};
use crate::{
    BeltKind, BranchEnd, Drive, Limit, Limits, PulleyErrors, PulleySummary, RangeEnd, StateErrors,
    StateSummary,
};

/// Most significant digits of a scalar.
const DIGITS: u8 = 6;

/// Both limits on lines of at most 100 columns: the reasons in words, then the states side by
/// side. No digit is shown that the estimated error does not leave.
pub fn table(limits: &Limits) -> String {
    let branch = &limits.branch;
    let key = branch.key;
    let ends = [&limits.smallest, &limits.largest];
    let mut title = report::title(&branch.drive, &[key]);
    title.push(format!("Limits of {}", key.path()));
    let reasons = [("smallest", ends[0]), ("largest", ends[1])].map(|(name, limit)| {
        let place = value::quantity(key, limit.value, limit.value_error);
        match (&branch.end, limit.reason) {
            (end @ BranchEnd::NotConverged { .. }, RangeEnd::NotFound) if name == "largest" => {
                format!("{name} {place}: {}; {end}", limit.reason)
            }
            (_, reason) => format!("{name} {place}: {reason}"),
        }
    });
    let remarks = [("smallest", ends[0]), ("largest", ends[1])]
        .into_iter()
        .flat_map(|(name, limit)| {
            let warnings = limit.warnings(&branch.drive, &key).into_iter();
            warnings.flat_map(move |remark| {
                let text = format!("{name}: {}", report::warning(&remark));
                lines::wrapped("WARNING: ", &text)
            })
        });
    let columns = ends.map(|limit| Column::of(limits, limit));
    lines::text([
        title,
        reasons
            .iter()
            .flat_map(|text| lines::wrapped("", text))
            .chain(remarks)
            .collect(),
        parameter(limits, ends),
        states(&branch.drive, &columns),
        convergence(&branch.drive, &branch.convergence),
    ])
}

fn parameter(limits: &Limits, ends: [&Limit; 2]) -> Vec<String> {
    let key = limits.branch.key;
    let errors = ends.map(|limit| match limit.value_error {
        Some(error) => value::error(key, error),
        None => "not known".to_owned(),
    });
    let kinds = ends.map(|limit| words::range_end_label(limit.reason).to_owned());
    vec![
        row("", ["smallest", "largest"].map(str::to_owned), ""),
        row(
            key.name(),
            ends.map(|limit| value::number(key, limit.value, limit.value_error)),
            key.unit(),
        ),
        row("estimated error", errors, key.unit()),
        row("reason", kinds, ""),
    ]
}

/// The state at a limit and what its errors are.
struct Column<'a> {
    state: &'a StateSummary,
    errors: Option<&'a StateErrors>,
    precision: Precision,
    /// What the error of a torque is relative to, N·m, where it is not estimated by itself.
    torque: f64,
}

impl<'a> Column<'a> {
    fn of(limits: &Limits, limit: &'a Limit) -> Self {
        let branch = &limits.branch;
        let state = &limit.state;
        let mut drive = branch.drive.clone();
        branch.key.set(&mut drive, limit.value);
        let error = state.error_estimate.unwrap_or(branch.convergence.tolerance);
        Self {
            state,
            errors: limit.errors.as_ref(),
            precision: Precision::new(error, DIGITS),
            torque: torque_scale(&drive, state.tight_tension),
        }
    }

    /// A scalar with its own error where that is estimated, else with the error of the state
    /// relative to `scale`.
    fn show(&self, value: f64, error: Option<f64>, scale: f64) -> String {
        match error {
            Some(error) => known(value, error, DIGITS.into()),
            None => self.precision.show_against(value, scale),
        }
    }

    fn driven_speed(&self, unit: fn(f64) -> f64) -> String {
        let error = self.errors.map(|errors| unit(errors.driven.angular_speed));
        let scale = unit(self.state.driver.angular_speed);
        self.show(unit(self.state.driven.angular_speed), error, scale)
    }

    fn percent(&self, share: f64, error: Option<f64>) -> String {
        self.show(100.0 * share, error.map(|error| 100.0 * error), 100.0)
    }

    fn angle(&self, angle: f64, error: Option<f64>) -> String {
        let scale = 1_f64.to_degrees();
        self.show(angle.to_degrees(), error.map(f64::to_degrees), scale)
    }

    fn tension(&self, tension: f64) -> String {
        self.show(tension, None, self.state.tight_tension)
    }
}

/// A line of the table: a scalar of both states.
fn scalar(
    columns: &[Column<'_>; 2],
    label: &str,
    unit: &str,
    show: impl Fn(&Column<'_>) -> String,
) -> String {
    row(label, columns.each_ref().map(show), unit)
}

/// The states side by side.
fn states(drive: &Drive, columns: &[Column<'_>; 2]) -> Vec<String> {
    let line = |label, unit, show: fn(&Column<'_>) -> String| scalar(columns, label, unit, show);
    let mut lines = vec![
        line("driven speed", "rad/s", |column| {
            column.driven_speed(std::convert::identity)
        }),
        line("", "rpm", |column| column.driven_speed(rpm)),
        line("speed loss", "%", |column| {
            column.percent(column.state.speed_loss, None)
        }),
        line("efficiency", "%", |column| {
            let error = column.errors.map(|errors| errors.efficiency);
            column.percent(column.state.efficiency, error)
        }),
        line("slack belt tension T", "N", |column| {
            column.tension(column.state.slack_tension)
        }),
        line("tight belt tension T", "N", |column| {
            column.tension(column.state.tight_tension)
        }),
        line("slack tractive tension F", "N", |column| {
            column.tension(column.state.slack_tractive_tension)
        }),
        line("tight tractive tension F", "N", |column| {
            column.tension(column.state.tight_tractive_tension)
        }),
    ];
    lines.extend(pulley(
        drive,
        columns,
        "driver",
        |state| &state.driver,
        |errors| &errors.driver,
    ));
    lines.extend(pulley(
        drive,
        columns,
        "driven",
        |state| &state.driven,
        |errors| &errors.driven,
    ));
    lines
}

/// One pulley in both states.
fn pulley(
    drive: &Drive,
    columns: &[Column<'_>; 2],
    name: &str,
    of: fn(&StateSummary) -> &PulleySummary,
    errors_of: fn(&StateErrors) -> &PulleyErrors,
) -> Vec<String> {
    let errors = |column: &Column<'_>| column.errors.map(errors_of).copied();
    let line = |label: &str, unit, show: &dyn Fn(&Column<'_>) -> String| {
        scalar(columns, &format!("{name}: {label}"), unit, show)
    };
    let mut lines = vec![
        line("torque", "N·m", &|column| {
            let error = errors(column).map(|errors| errors.torque);
            column.show(of(column.state).torque, error, column.torque)
        }),
        line("wrap angle", "°", &|column| {
            let error = errors(column).map(|errors| errors.wrap_angle);
            column.angle(of(column.state).wrap_angle, error)
        }),
    ];
    match drive.belt.kind {
        BeltKind::V(_) => lines.extend([
            line("penetration", "mm", &|column| {
                let error = errors(column).map(|errors| 1e3 * errors.max_penetration);
                let value = 1e3 * of(column.state).max_penetration;
                column.show(value, error, value)
            }),
            line("inclination, entry", "°", &|column| {
                let error = errors(column).map(|errors| errors.inclination[0]);
                column.angle(of(column.state).inclination[0], error)
            }),
            line("inclination, exit", "°", &|column| {
                let error = errors(column).map(|errors| errors.inclination[1]);
                column.angle(of(column.state).inclination[1], error)
            }),
        ]),
        BeltKind::Flat { .. } => lines.push(line("slip arc", "°", &|column| {
            column.angle(slip_arc(&of(column.state).zones), None)
        })),
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{lines::WIDTH, sample_branch, sample_flat};

    #[test]
    fn states_reasons_values_and_states() {
        let text = table(&sample_branch::limits());
        for needle in [
            "Limits of load.tight_tractive_tension",
            "smallest 700.00 N: both spans have the same tension",
            "largest 8221.01 N: the belt overhangs at the exit of the driver",
            "8221.01  N",
            "0.004  N",
            "fold: driver overhangs",
            "76.889  rad/s",
        ] {
            assert!(text.contains(needle), "{needle} is not in\n{text}");
        }
    }

    #[test]
    fn a_flat_belt_slips_over_an_arc() {
        let text = table(&sample_flat::limits());
        for needle in [
            "N: the belt slips grossly on the driver",
            "driver: slip arc                                     0                     161.689  °",
            "driven: slip arc",
        ] {
            assert!(text.contains(needle), "{needle} is not in\n{text}");
        }
        assert!(!text.contains("penetration") && !text.contains("inclination"));
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH));
    }

    #[test]
    fn what_is_not_estimated_is_shown_to_the_tolerance() {
        let mut limits = sample_branch::limits();
        limits.largest.errors = None;
        limits.largest.value_error = None;
        limits.branch.convergence.tolerance = 1e-3;
        let text = table(&limits);
        assert!(text.contains("not known"), "{text}");
        assert!(text.contains("77  rad/s"), "{text}");
    }
}
