//! The readings of a calibration against its model.

use super::axis::{Axis, Scale};
use super::header::{Header, Mark, Sign};
use super::occupied::Frame;
use super::panel::{Panel, grid};
use super::sheet::{GREY, INK, PALETTE, Sheet, Stroke, spot};
use crate::Calibration;
use crate::calibrate::Residual;

/// Width of the figure and height of a row of panels, px.
const WIDTH: f64 = 1100.0;
const PANELS: f64 = 360.0;

/// Panels beside each other.
const COLUMNS: usize = 2;

/// Half of the interval in which 95 of 100 normal errors lie, in standard deviations.
const USUAL: f64 = 1.96;

const ZERO: Stroke = Stroke::solid(INK, 1.5);
const BAND: Stroke = Stroke::dashed(GREY, 1.2);

/// A panel for each measured quantity: (y − f)/σ of its readings, or y − f without standard deviations, over the lines of
/// the file.
pub(super) fn figure(heading: &str, calibration: &Calibration) -> String {
    let mut names: Vec<&str> = Vec::new();
    for residual in &calibration.residuals {
        let name = residual.measured.name();
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let legend = [
        (
            "reading less model".to_owned(),
            Mark::Sign(Sign::Dot, PALETTE[1]),
        ),
        ("95 of 100 normal errors".to_owned(), Mark::Line(BAND)),
    ];
    let heading = crate::quantity::Answer {
        heading: vec![heading.to_owned()],
        ..Default::default()
    };
    let caption = "Residuals of the calibration";
    let header = Header::new(&heading, caption, legend, WIDTH);
    let columns = names.len().clamp(1, COLUMNS);
    let rows = names.len().div_ceil(columns).max(1);
    let size = spot(WIDTH, header.height + PANELS * rows as f64);
    let mut sheet = Sheet::new(size);
    header.draw(&mut sheet);
    let below = Frame {
        from: spot(0.0, header.height),
        to: size,
    };
    for (name, part) in names.iter().zip(grid(below, columns, names.len())) {
        let readings = calibration.residuals.iter();
        let readings = readings.filter(|residual| residual.measured.name() == *name);
        panel(&mut sheet, part, name, &readings.collect::<Vec<_>>());
    }
    sheet.finish()
}

fn panel(sheet: &mut Sheet, part: Frame, name: &str, readings: &[&Residual]) {
    let places = readings.iter().map(|residual| {
        let difference = residual.value - residual.model;
        let over = residual
            .deviation
            .map_or(difference, |deviation| difference / deviation);
        (residual.line as f64, over)
    });
    let places: Vec<_> = places.collect();
    let is_relative = readings.iter().all(|residual| residual.deviation.is_some());
    let band = [-USUAL, USUAL].into_iter().filter(|_| is_relative);
    let across = places.iter().map(|(line, _)| *line);
    let up: Vec<_> = places
        .iter()
        .map(|(_, over)| *over)
        .chain(band.clone())
        .chain([0.0])
        .collect();
    let panel = Panel {
        title: name.to_owned(),
        axes: [
            Axis::spanning(across, Scale::Decimal).padded(),
            Axis::spanning(up.into_iter(), Scale::Decimal).padded(),
        ],
        descriptions: [
            "line of the data".to_owned(),
            match is_relative {
                true => "(reading − model)/σ".to_owned(),
                false => "reading − model, SI".to_owned(),
            },
        ],
    };
    let chart = panel.draw(sheet, part, []);
    let Frame { from, to } = chart.frame;
    let level = |sheet: &mut Sheet, at: f64, stroke| {
        let at = chart.at(0.0, at).y;
        sheet.line(&[spot(from.x, at), spot(to.x, at)], stroke);
    };
    level(sheet, 0.0, ZERO);
    for end in band {
        level(sheet, end, BAND);
    }
    for (line, over) in places {
        Sign::Dot.draw(sheet, chart.at(line, over), PALETTE[1]);
    }
}
