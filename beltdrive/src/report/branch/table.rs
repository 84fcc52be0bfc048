//! A branch as a table for a terminal.

use crate::report::{
    Precision, heading, law,
    lines::{self, small},
    torque_scale, value, words,
};
use crate::{Branch, BranchEvent, PulleySummary, TraceConvergence, TracePoint};

/// About so many states are shown besides the events.
const ROWS: usize = 26;

/// Most significant digits of a scalar.
const DIGITS: u8 = 6;

/// The branch on lines of at most 100 columns: states at even distances along it, every event with
/// its place, and why it ends.
pub fn table(branch: &Branch) -> String {
    lines::text([
        title(branch),
        states(branch),
        events(branch),
        vec![format!("end of the branch: {}", branch.end)],
        convergence(&branch.convergence),
    ])
}

fn title(branch: &Branch) -> Vec<String> {
    let key = branch.key;
    let ends = [branch.points.first(), branch.points.last()];
    let [first, last] = ends.map(|point| {
        point.map_or_else(String::new, |point| value::quantity(key, point.value, None))
    });
    vec![
        heading(&branch.drive),
        law(&branch.drive, &[key]),
        format!(
            "Branch over {}, from {first} to {last}: {} states",
            key.path(),
            branch.points.len()
        ),
    ]
}

fn states(branch: &Branch) -> Vec<String> {
    let unit = match branch.key.unit() {
        "" => "–",
        unit => unit,
    };
    let header = [
        [
            "parameter",
            "driven",
            "speed",
            "wrap",
            "angle",
            "driven",
            "effi-",
            "exit of",
            "",
        ],
        [
            "", "speed", "loss", "driver", "driven", "torque", "ciency", "driver", "",
        ],
        [unit, "rad/s", "%", "°", "°", "N·m", "%", "°", "event"],
    ];
    let header = header.map(|cells| line(cells.map(str::to_owned)));
    let rows = branch.rows();
    let stride = rows.len().div_ceil(ROWS).max(1);
    let shown = rows.iter().enumerate();
    let shown = shown.filter(|(place, (_, event))| place % stride == 0 || event.is_some());
    header
        .into_iter()
        .chain(shown.map(|(_, (point, event))| state(branch, point, *event)))
        .collect()
}

/// A state on one line.
fn state(branch: &Branch, point: &TracePoint, event: Option<&BranchEvent>) -> String {
    let state = &point.state;
    let error = state.error_estimate.unwrap_or(branch.convergence.tolerance);
    let precision = Precision::new(error, DIGITS);
    let percent = |share: f64| precision.show_against(100.0 * share, 100.0);
    let angle = |value: f64| precision.show_against(value.to_degrees(), 1_f64.to_degrees());
    let wrap = |pulley: &PulleySummary| angle(pulley.wrap_angle);
    let mut drive = branch.drive.clone();
    branch.key.set(&mut drive, point.value);
    let torque = torque_scale(&drive, state.tight_tension);
    line([
        value::cell(branch.key, point.value, None),
        // The speed may be that of a pulley about to stop.
        precision.show_against(state.driven.angular_speed, state.driver.angular_speed),
        percent(state.speed_loss),
        wrap(&state.driver),
        wrap(&state.driven),
        precision.show_against(state.driven.torque, torque),
        percent(state.efficiency),
        angle(state.driver.inclination[1]),
        event.map_or_else(String::new, |event| words::event_label(event.kind)),
    ])
}

fn line(
    [
        value,
        speed,
        loss,
        driver,
        driven,
        torque,
        efficiency,
        exit,
        event,
    ]: [String; 9],
) -> String {
    format!(
        "{value:>10}{speed:>10}{loss:>9}{driver:>9}{driven:>9}{torque:>9}{efficiency:>9}{exit:>9}  {event}"
    )
}

/// The events in words, with the digits of their places that are known.
fn events(branch: &Branch) -> Vec<String> {
    let key = branch.key;
    let located = branch.events.iter().map(|event| {
        let place = value::number(key, event.point.value, event.value_error);
        let error = match event.value_error {
            Some(error) if error > 0.0 => format!("± {}", value::error(key, error)),
            _ => String::new(),
        };
        let what = words::event(event.kind, key);
        format!("{place:>14} {error:<9} {:<6} {what}", key.unit())
    });
    located.collect()
}

/// What tracing took.
pub(in crate::report) fn convergence(convergence: &TraceConvergence) -> Vec<String> {
    vec![format!(
        "relative tolerance {}, {} steps, {} factorisations, {:.1} s",
        small(convergence.tolerance),
        convergence.continuation_steps,
        convergence.factorisations,
        convergence.seconds
    )]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Key;
    use crate::report::{lines::WIDTH, sample_branch};
    use crate::{BranchEnd, EventKind, Pulley, ZoneKind};

    #[test]
    fn shows_states_events_and_the_end() {
        let text = table(&sample_branch::folded());
        for needle in [
            "from 700 N to 7750.95 N: 61 states",
            "   8221.01    76.889",
            "  fold\n",
            "  90°, driver\n",
            "       8221.01 ± 0.004   N      limit point: the tight tractive tension turns back",
            "end of the branch: the parameter reached the value asked for",
            "64 steps",
        ] {
            assert!(text.contains(needle), "{needle} is not in\n{text}");
        }
        assert!(text.lines().count() < 50);
    }

    #[test]
    fn is_no_wider_than_a_terminal() {
        let mut branch = sample_branch::folded();
        branch.key = Key::all(&branch.drive).next().unwrap();
        branch.end = BranchEnd::NotConverged {
            cause: "a cause ".repeat(20),
        };
        branch.events[0].kind = EventKind::ZoneVanishes {
            pulley: Pulley::Driver,
            kind: ZoneKind::Elastic,
        };
        let point = &mut branch.points[0];
        point.value = -1.234_567e-9;
        point.state.driven.torque = -1.234_567_8e6;
        point.state.driven.angular_speed = -1.2e-11;
        let text = table(&branch);
        for line in text.lines() {
            assert!(line.chars().count() <= WIDTH, "{line}");
        }
        assert!(!text.contains("torque…"), "{text}");
    }
}
