//! A branch as a table for a terminal.

use crate::report::{
    self,
    lines::{self, small},
    shown::Shown,
    table_columns, value, words,
};
use crate::{BeltKind, Branch, Drive, TraceConvergence};

/// About so many states are shown besides the events.
const ROWS: usize = 26;

/// The branch on lines of at most 100 columns: states at even distances along it, every event with
/// its place, and why it ends.
pub fn table(branch: &Branch) -> String {
    lines::text([
        heading(branch),
        states(branch),
        events(branch),
        vec![format!("end of the branch: {}", branch.end)],
        convergence(&branch.drive, &branch.convergence),
    ])
}

fn heading(branch: &Branch) -> Vec<String> {
    let key = branch.key;
    let ends = [branch.points.first(), branch.points.last()];
    let [first, last] = ends.map(|point| {
        point.map_or_else(String::new, |point| value::quantity(key, point.value, None))
    });
    let mut lines = report::title(&branch.drive, &[key]);
    lines.push(format!(
        "Branch over {}, from {first} to {last}: {} states",
        key.path(),
        branch.points.len()
    ));
    lines
}

fn states(branch: &Branch) -> Vec<String> {
    let unit = match branch.key.unit() {
        "" => "–",
        unit => unit,
    };
    let columns = table_columns::of_branch(&branch.drive);
    let leads = ["parameter", "", unit];
    let trails = ["", "", "event"];
    let header = (0..table_columns::HEADS).map(|place| {
        let heads = table_columns::head(columns, place);
        line(leads[place], &heads, trails[place])
    });
    let rows = branch.rows();
    let stride = rows.len().div_ceil(ROWS).max(1);
    let shown = rows.iter().enumerate();
    let shown = shown.filter(|(place, (_, event))| place % stride == 0 || event.is_some());
    let states = shown.map(|(_, (point, event))| {
        let values = [(branch.key, point.value)];
        let tolerance = branch.convergence.tolerance;
        let state = Shown::of(&branch.drive, &values, &point.state, tolerance);
        line(
            &value::cell(branch.key, point.value, None),
            &table_columns::cells(columns, &state),
            &event.map_or_else(String::new, |event| words::event_label(event.kind)),
        )
    });
    header.chain(states).collect()
}

/// A state on one line.
fn line(value: &str, scalars: &str, event: &str) -> String {
    format!("{value:>10}{scalars}  {event}")
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
        let what = words::event(event.kind, key, &branch.drive);
        format!("{place:>14} {error:<9} {:<6} {what}", key.unit())
    });
    located.collect()
}

/// What tracing took.
pub(in crate::report) fn convergence(drive: &Drive, convergence: &TraceConvergence) -> Vec<String> {
    let (steps, seconds) = (convergence.continuation_steps, convergence.seconds);
    vec![match drive.belt.kind {
        BeltKind::V(_) => format!(
            "relative tolerance {}, {steps} steps, {} factorisations, {seconds:.1} s",
            small(convergence.tolerance),
            convergence.factorisations,
        ),
        BeltKind::Flat { .. } => format!("closed form, {steps} states, {seconds:.3} s"),
    }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::Key;
    use crate::report::{lines::WIDTH, sample_branch, sample_flat};
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
    fn a_flat_belt_has_slip_arcs() {
        let mut branch = sample_flat::branch();
        branch.events[0].kind = EventKind::ZoneVanishes {
            pulley: Pulley::Driven,
            kind: ZoneKind::Adhesion,
        };
        let text = table(&branch);
        for needle in [
            "wrap   angle    slip     arc   driven",
            "161.689 161.603  69.0000  99.8160  gross slip, driver\n",
            "  +slip, driven\n",
            "  −adhesion, driven\n",
            "closed form, 41 states, 0.002 s",
        ] {
            assert!(text.contains(needle), "{needle} is not in\n{text}");
        }
        assert!(!text.contains("exit"), "{text}");
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH));
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
