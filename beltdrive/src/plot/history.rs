//! A drive over time, and its belt along the loop at instants.

use super::axis::{Axis, Scale};
use super::header::{Header, Mark};
use super::occupied::Frame;
use super::panel::{Chart, Panel, grid};
use super::sheet::{Anchor, GREY, PALETTE, SMALL, Sheet, Stroke, spot};
use crate::Drive;
use crate::quantity::transient::{event_words, spans};
use crate::quantity::{Answer, Measure, UnitSystem, title};
use crate::transient::{BeltAlongLoop, History, PulleySample, Sample};

/// Width of the figures and height of a panel, px.
const WIDTH: f64 = 1100.0;
const PANEL: f64 = 230.0;

/// Height of the panels along the loop, px.
const ALONG: f64 = 330.0;

const EVENT: Stroke = Stroke::dashed(GREY, 1.2);

/// Width of the curves, px.
const CURVE: f64 = 1.6;

/// What a panel over time shows.
struct Quantities {
    title: &'static str,
    measure: Measure,
    names: Vec<String>,
    /// The values of a sample, SI, in the order of the names.
    values: fn(&Sample) -> Vec<f64>,
}

/// The figure over time: speeds, tensions, torques and slip arcs, with the events as lines.
pub(super) fn figure(drive: &Drive, history: &History) -> String {
    let pulleys = || history.pulleys.clone();
    let spans = spans(history)
        .into_iter()
        .map(|[from, to]| format!("{from} to {to}"));
    let mut panels = vec![
        Quantities {
            title: "speed of the pulleys",
            measure: Measure::AngularSpeed,
            names: pulleys(),
            values: |sample| of_pulleys(sample, |pulley| pulley.angular_speed),
        },
        Quantities {
            title: "tension in the middle of the spans",
            measure: Measure::Force,
            names: spans.collect(),
            values: |sample| sample.tensions.clone(),
        },
        Quantities {
            title: "torque of the belt on the pulleys",
            measure: Measure::Torque,
            names: pulleys(),
            values: |sample| of_pulleys(sample, |pulley| pulley.torque),
        },
        Quantities {
            title: "arc on which the belt slips",
            measure: Measure::Angle,
            names: pulleys(),
            values: |sample| of_pulleys(sample, |pulley| pulley.slip_arc),
        },
    ];
    if (history.samples.first()).is_some_and(|first| !first.amplitudes.is_empty()) {
        panels.push(Quantities {
            title: "largest displacement of the spans across between two samples",
            measure: Measure::Length,
            names: pulleys(),
            values: |sample| sample.amplitudes.clone(),
        });
    }
    let color = |index: usize| PALETTE[index % PALETTE.len()];
    let curves = history.pulleys.iter().enumerate().map(|(index, name)| {
        let stroke = Stroke::solid(color(index), CURVE);
        (format!("{name}, span behind it"), Mark::Line(stroke))
    });
    let events = (!history.events.is_empty()).then(|| ("event".to_owned(), Mark::Line(EVENT)));
    let heading = Answer {
        heading: vec![title(drive)],
        ..Answer::default()
    };
    let header = Header::new(
        &heading,
        "History of the drive",
        curves.chain(events),
        WIDTH,
    );
    let size = spot(WIDTH, header.height + PANEL * panels.len() as f64);
    let mut sheet = Sheet::new(size);
    header.draw(&mut sheet);
    let below = Frame {
        from: spot(0.0, header.height),
        to: size,
    };
    for (index, part) in grid(below, 1, panels.len()).enumerate() {
        let chart = over_time(&mut sheet, part, &panels[index], history);
        mark_events(&mut sheet, &chart, history, index == 0);
    }
    sheet.finish()
}

/// A number of every pulley of a sample.
fn of_pulleys(sample: &Sample, number: fn(&PulleySample) -> f64) -> Vec<f64> {
    sample.pulleys.iter().map(number).collect()
}

fn over_time(sheet: &mut Sheet, part: Frame, panel: &Quantities, history: &History) -> Chart {
    let unit = panel.measure.shown(UnitSystem::Engineering);
    let samples = history.samples.iter();
    let rows = samples.map(|sample| (sample.time, (panel.values)(sample)));
    let rows: Vec<_> = rows.collect();
    let times = rows.iter().map(|(time, _)| *time);
    let values = rows
        .iter()
        .flat_map(|(_, values)| values)
        .map(|value| value * unit.factor);
    let scale = match panel.measure {
        Measure::Angle => Scale::Degrees,
        _ => Scale::Decimal,
    };
    let drawn = Panel {
        title: panel.title.to_owned(),
        axes: [
            Axis::spanning(times, Scale::Decimal),
            Axis::spanning(values, scale).padded(),
        ],
        descriptions: ["time in s".to_owned(), format!("in {}", unit.symbol)],
    };
    let chart = drawn.draw(sheet, part, []);
    for index in 0..panel.names.len() {
        let places = rows
            .iter()
            .map(|(time, values)| chart.at(*time, values[index] * unit.factor));
        let stroke = Stroke::solid(PALETTE[index % PALETTE.len()], CURVE);
        sheet.line(&places.collect::<Vec<_>>(), stroke);
    }
    chart
}

/// Marks the events with lines, and in one panel with words.
fn mark_events(sheet: &mut Sheet, chart: &Chart, history: &History, has_words: bool) {
    let Frame { from, to } = chart.frame;
    // Words stand at those that are far enough from the one before.
    let mut free = f64::NEG_INFINITY;
    for event in &history.events {
        let at = chart.at(event.time, 0.0).x;
        sheet.line(&[spot(at, from.y), spot(at, to.y)], EVENT);
        let (kind, pulley) = event_words(history, event.kind);
        if has_words && at > free {
            let text = match pulley {
                Some(pulley) => format!("{kind}, {pulley}"),
                None => kind.to_owned(),
            };
            sheet.text(
                &text,
                SMALL,
                GREY,
                Anchor::Start,
                spot(at + 4.0, to.y - 10.0),
            );
            free = at + 8.0 + super::sheet::text_width(&text, SMALL);
        }
    }
}

/// The figure along the loop at the instants of a run, if there are any: tension and friction.
pub(super) fn along_loop(drive: &Drive, history: &History) -> Option<String> {
    let first = history.belts.first()?;
    let color = |index: usize| PALETTE[index % PALETTE.len()];
    let curves = history.belts.iter().enumerate().map(|(index, belt)| {
        let stroke = Stroke::solid(color(index), CURVE);
        (format!("at {:.6} s", belt.time), Mark::Line(stroke))
    });
    let heading = Answer {
        heading: vec![title(drive)],
        ..Answer::default()
    };
    let names = history.pulleys.join(", ");
    let caption = format!(
        "Belt along the loop from where it meets {}; pulleys: {names}",
        history.pulleys[0]
    );
    let header = Header::new(&heading, &caption, curves, WIDTH);
    type Values = fn(&BeltAlongLoop) -> &[f64];
    let mut panels: Vec<(&str, &str, f64, Values)> = vec![
        ("belt tension", "T in N", 1.0, |belt| &belt.tension),
        (
            "friction on the belt against its motion",
            "in N/mm",
            1e-3,
            |belt| &belt.friction,
        ),
    ];
    if !first.displacement.is_empty() {
        panels.push((
            "displacement across, away from the inside of the loop",
            "w in mm",
            1e3,
            |belt| &belt.displacement,
        ));
    }
    let size = spot(WIDTH, header.height + ALONG * panels.len() as f64);
    let mut sheet = Sheet::new(size);
    header.draw(&mut sheet);
    let below = Frame {
        from: spot(0.0, header.height),
        to: size,
    };
    let rows = grid(below, 1, panels.len());
    for ((name, unit, factor, values), part) in panels.into_iter().zip(rows) {
        let all = history
            .belts
            .iter()
            .flat_map(values)
            .map(|value| value * factor);
        let all: Vec<_> = all.collect();
        let panel = Panel {
            title: name.to_owned(),
            axes: [
                Axis::spanning(first.position.iter().map(|at| 1e3 * at), Scale::Decimal),
                Axis::spanning(all.into_iter(), Scale::Decimal).padded(),
            ],
            descriptions: ["along the loop in mm".to_owned(), unit.to_owned()],
        };
        let chart = panel.draw(&mut sheet, part, []);
        for (index, belt) in history.belts.iter().enumerate() {
            let places = belt.position.iter().zip(values(belt));
            let places = places.map(|(at, value)| chart.at(1e3 * at, value * factor));
            sheet.line(
                &places.collect::<Vec<_>>(),
                Stroke::solid(color(index), CURVE),
            );
        }
    }
    Some(sheet.finish())
}
