//! The shapes of the vibrations of a drive along its belt.

use super::axis::{Axis, Scale};
use super::header::{Header, Mark};
use super::occupied::Frame;
use super::panel::{Panel, grid};
use super::sheet::{GREY, INK, PALETTE, Sheet, Stroke, spot};
use crate::Modes;
use crate::quantity::{Answer, modes::kind, title};
use crate::transient::VibrationMode;
use std::f64::consts::TAU;

/// Width of the figure and height of a panel, px.
const WIDTH: f64 = 1100.0;
const PANEL: f64 = 250.0;

/// Most modes that are drawn: three rows of two.
const SHOWN: usize = 6;

/// Width of the curves, px.
const CURVE: f64 = 1.8;

/// The figure: the velocity of the belt in the first modes at two times a quarter of a period apart.
pub(super) fn figure(modes: &Modes) -> String {
    let shown: Vec<_> = modes.slipping.iter().take(SHOWN).collect();
    let curves = [
        (
            "belt velocity",
            Mark::Line(Stroke::solid(PALETTE[0], CURVE)),
        ),
        (
            "a quarter of a period before",
            Mark::Line(Stroke::dashed(GREY, CURVE)),
        ),
        (
            "rim of the pulley",
            Mark::Line(Stroke::solid(INK, 2.0 * CURVE)),
        ),
    ];
    let curves = curves.map(|(label, mark)| (label.to_owned(), mark));
    let heading = Answer {
        heading: vec![title(&modes.drive)],
        ..Answer::default()
    };
    let caption = "Vibrations about the steady state with its slip zones held, along the loop";
    let header = Header::new(&heading, caption, curves, WIDTH);
    let rows = shown.len().div_ceil(2).max(1);
    let size = spot(WIDTH, header.height + PANEL * rows as f64);
    let mut sheet = Sheet::new(size);
    header.draw(&mut sheet);
    let below = Frame {
        from: spot(0.0, header.height),
        to: size,
    };
    for ((index, mode), part) in shown.iter().enumerate().zip(grid(below, 2, shown.len())) {
        panel(&mut sheet, part, modes, (index + 1, mode));
    }
    sheet.finish()
}

fn panel(sheet: &mut Sheet, part: Frame, modes: &Modes, (number, mode): (usize, &VibrationMode)) {
    let hertz = mode.angular_frequency / TAU;
    let ends = [0.0, 1e3 * modes.length];
    let panel = Panel {
        title: format!("mode {number}, {}: {hertz:.1} Hz", kind(mode)),
        axes: [
            Axis::spanning(ends.into_iter(), Scale::Decimal),
            Axis::spanning([-1.0, 1.0].into_iter(), Scale::Decimal).padded(),
        ],
        descriptions: ["along the loop in mm".to_owned(), String::new()],
    };
    let arcs = &modes.arcs;
    let shades = arcs.iter().map(|arc| (arc.map(|at| 1e3 * at), GREY));
    let chart = panel.draw(sheet, part, shades);
    for (side, stroke) in [
        (1, Stroke::dashed(GREY, CURVE)),
        (0, Stroke::solid(PALETTE[0], CURVE)),
    ] {
        let faces = modes.faces.iter().zip(&mode.velocities);
        let first = mode.velocities.first().map(|first| (ends[1] * 1e-3, first));
        let places = { faces.map(|(at, velocity)| (*at, velocity)).chain(first) }
            .map(|(at, velocity)| chart.at(1e3 * at, velocity[side]));
        sheet.line(&places.collect::<Vec<_>>(), stroke);
    }
    for (arc, rim) in arcs.iter().zip(&mode.rims) {
        let places = arc.map(|at| chart.at(1e3 * at, rim[0]));
        sheet.line(&places, Stroke::solid(INK, 2.0 * CURVE));
    }
}
