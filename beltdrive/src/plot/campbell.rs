//! The Campbell diagram: frequencies of vibration over the speed, beside those of the excitation.

use super::axis::{Axis, Scale};
use super::curve;
use super::header::{Header, Mark, Sign};
use super::occupied::Frame;
use super::panel::Panel;
use super::sheet::{Color, DOT, PALETTE, Sheet, Stroke, spot};
use crate::quantity::{Answer, Measure, UnitSystem, title};
use crate::transient::VibrationMode;
use crate::{Modes, ModesAtSpeed};
use std::f64::consts::TAU;

/// Size of the figure below its header, px.
const WIDTH: f64 = 1100.0;
const HEIGHT: f64 = 560.0;

/// Width of the curves, px.
const CURVE: f64 = 1.8;

const TORSIONAL: Color = PALETTE[0];
const AXIAL: Color = PALETTE[1];

/// Height of the diagram over the highest frequency that belongs in it.
const ROOM: f64 = 1.2;

/// What excites: its name, and its frequency at a speed in Hz.
type Excitation = (String, Box<dyn Fn(&ModesAtSpeed) -> f64>);

/// The figure, if modes were sought over a range of speeds.
pub(super) fn figure(modes: &Modes) -> Option<String> {
    let points = &modes.over_speed[..];
    if points.len() < 2 {
        return None;
    }
    let unit = Measure::AngularSpeed.shown(UnitSystem::Engineering);
    let excitations = excitations(modes);
    let spans = Stroke::solid(PALETTE[2], CURVE);
    let excited = |index: usize| Stroke::dashed(PALETTE[(3 + index) % PALETTE.len()], 1.2);
    let legend = [
        ("torsional", Mark::Sign(Sign::Dot, TORSIONAL)),
        ("axial", Mark::Sign(Sign::Dot, AXIAL)),
        ("span across, first", Mark::Line(spans)),
    ];
    let legend = legend.map(|(label, mark)| (label.to_owned(), mark));
    let dashed = excitations.iter().enumerate();
    let dashed = dashed.map(|(index, (name, _))| (name.clone(), Mark::Line(excited(index))));
    let heading = Answer {
        heading: vec![title(&modes.drive)],
        ..Answer::default()
    };
    let caption =
        "Frequencies of vibration over speed, slip zones held; what excites them is dashed";
    let header = Header::new(&heading, caption, legend.into_iter().chain(dashed), WIDTH);
    let size = spot(WIDTH, header.height + HEIGHT);
    let mut sheet = Sheet::new(size);
    header.draw(&mut sheet);
    let below = Frame {
        from: spot(0.0, header.height),
        to: size,
    };
    let hertz = |mode: &VibrationMode| mode.angular_frequency / TAU;
    // Axial modes far above all that excites them are left to the files.
    let shown = points.iter().flat_map(|point| {
        let torsional = point.modes.iter().filter(|mode| mode.is_torsional());
        let spans = point.state.spans.iter().map(|span| span.frequency);
        let excited = excitations.iter().map(|(_, frequency)| frequency(point));
        torsional.map(hertz).chain(spans).chain(excited)
    });
    let highest = ROOM * shown.fold(0.0, f64::max);
    let speeds = points.iter().map(|point| point.speed * unit.factor);
    let panel = Panel {
        title: String::new(),
        axes: [
            Axis::spanning(speeds, Scale::Decimal),
            Axis::spanning([0.0, highest].into_iter(), Scale::Decimal),
        ],
        descriptions: [
            format!("speed of the driver in {}", unit.symbol),
            "frequency in Hz".to_owned(),
        ],
    };
    let chart = panel.draw(&mut sheet, below, []);
    let line = |of: &dyn Fn(&ModesAtSpeed) -> Option<f64>| -> Vec<_> {
        let values = points.iter().filter_map(|point| Some((point, of(point)?)));
        values
            .filter(|(_, value)| *value <= highest)
            .map(|(point, value)| chart.at(point.speed * unit.factor, value))
            .collect()
    };
    for (index, (_, frequency)) in excitations.iter().enumerate() {
        curve::draw(
            &mut sheet,
            &line(&|point| Some(frequency(point))),
            excited(index),
        );
    }
    for span in 0..modes.state.spans.len() {
        let places = line(&|point| Some(point.state.spans[span].frequency));
        curve::draw(&mut sheet, &places, spans);
    }
    for point in points {
        for mode in point.modes.iter().filter(|mode| hertz(mode) <= highest) {
            let color = if mode.is_torsional() {
                TORSIONAL
            } else {
                AXIAL
            };
            let at = chart.at(point.speed * unit.factor, hertz(mode));
            sheet.disc(at, DOT, color);
        }
    }
    Some(sheet.finish())
}

/// Once a turn of every pulley, twice a turn of the driver, once a round of the belt.
fn excitations(modes: &Modes) -> Vec<Excitation> {
    let state = &modes.state;
    let mut excitations: Vec<Excitation> = Vec::new();
    for (index, pulley) in state.pulleys.iter().enumerate() {
        excitations.push((
            format!("1 × {}", pulley.name),
            Box::new(move |point| point.state.pulleys[index].angular_speed / TAU),
        ));
    }
    let driver = modes.drive.driver();
    excitations.push((
        format!("2 × {}", state.pulleys[driver].name),
        Box::new(move |point| 2.0 * point.state.pulleys[driver].angular_speed / TAU),
    ));
    excitations.push((
        "rounds of the belt".to_owned(),
        Box::new(|point| point.state.unstretched_speed / point.state.unstretched_length),
    ));
    excitations
}
