//! The shapes of the first modes along both pulleys, in the form of the thesis.

use super::super::axis::{Axis, Scale};
use super::super::curve::draw;
use super::super::header::{Header, Mark};
use super::super::occupied::Frame;
use super::super::panel::{Panel, grid};
use super::super::sheet::{INK, PALETTE, Sheet, Stroke, spot};
use super::super::zones::color;
use super::heading;
use crate::quantity::stability::{complex, outcome};
use crate::{AxialMode, FrictionLaw, PulleyStability, ShapePoint, Stability};

/// Width of the figure and height of a row of panels, px.
const WIDTH: f64 = 1100.0;
const ROW: f64 = 240.0;

const REAL: Stroke = Stroke::solid(INK, 2.0);
const MODULUS: Stroke = Stroke::dashed(PALETTE[3], 1.5);

/// The figure: the driver on the left, the driven pulley on the right.
pub(super) fn figure(stability: &Stability) -> String {
    let drive = &stability.drive;
    let pulleys = [
        ("driver", &stability.driver, drive.pair().driver_radius),
        ("driven", &stability.driven, drive.pair().driven_radius),
    ];
    // The zone before the slip zone.
    let held = match drive.law {
        FrictionLaw::Coulomb => "adhesion",
        _ => "elastic",
    };
    let slips = pulleys
        .iter()
        .any(|(_, on, _)| on.transition < on.contact_length);
    let kinds = [Some(held), slips.then_some("slip")].into_iter().flatten();
    let shades = kinds.map(|kind| (format!("{kind} zone"), Mark::Shade(color(kind))));
    let lines = [("real part", REAL), ("modulus", MODULUS)];
    let lines = lines.map(|(label, stroke)| (label.to_owned(), Mark::Line(stroke)));
    let answer = heading(stability);
    let caption = "Axial modes, outlet f' = 0 (thesis)";
    let header = Header::new(&answer, caption, lines.into_iter().chain(shades), WIDTH);
    let rows = pulleys.iter().map(|(_, on, _)| shapes(on).count()).min();
    let rows = rows.unwrap_or(0);
    let size = spot(WIDTH, header.height + ROW * rows.max(1) as f64);
    let mut sheet = Sheet::new(size);
    header.draw(&mut sheet);
    let below = Frame {
        from: spot(0.0, header.height),
        to: size,
    };
    for (place, part) in grid(below, 2, 2 * rows).enumerate() {
        let (name, on, radius) = pulleys[place % 2];
        if let Some(mode) = shapes(on).nth(place / 2) {
            let (number, value) = (place / 2 + 1, complex(mode));
            let title = format!("{name}, mode {number}: λ = {value} 1/s, {}", outcome(mode));
            panel(&mut sheet, part, title, held, on, radius, mode);
        }
    }
    sheet.finish()
}

/// The modes of which there is a shape.
fn shapes(on: &PulleyStability) -> impl Iterator<Item = &AxialMode> {
    let modes = on.forms[0].modes.iter();
    modes.take_while(|mode| mode.shape.len() > 1)
}

fn panel(
    sheet: &mut Sheet,
    part: Frame,
    title: String,
    held: &str,
    on: &PulleyStability,
    radius: f64,
    mode: &AxialMode,
) {
    let degrees = |length: f64| (length / radius).to_degrees();
    let [end, transition] = [on.contact_length, on.transition].map(degrees);
    let transition = transition.min(end);
    let panel = Panel {
        title,
        axes: [
            Axis::spanning([0.0, end].into_iter(), Scale::Degrees),
            Axis::spanning([-1.0, 1.0].into_iter(), Scale::Decimal).padded(),
        ],
        descriptions: ["angle φ from the entry in degrees", "motion f / max |f|"]
            .map(str::to_owned),
    };
    let shades = [
        ([0.0, transition], color(held)),
        ([transition, end], color("slip")),
    ];
    let chart = panel.draw(sheet, part, shades);
    let mut line = |stroke, of: fn(&ShapePoint) -> f64| {
        let points = mode.shape.iter();
        let places = points.map(|point| chart.at(degrees(point.arc_length), of(point)));
        draw(sheet, &places.collect::<Vec<_>>(), stroke);
    };
    line(REAL, |point| point.value[0]);
    line(MODULUS, |point| point.value[0].hypot(point.value[1]));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::stability::sample;

    #[test]
    fn every_shape_has_a_panel_with_its_eigenvalue() {
        let text = figure(&sample::stability());
        crate::plot::tests::check(&text);
        assert_eq!(text.matches("decays").count(), 6);
        assert!(text.contains("driver, mode 1: λ = −40.0000 + 10000.0 i 1/s, decays"));
        assert!(text.contains("driven, mode 3") && !text.contains("mode 4"));
        assert!(text.contains("elastic zone") && text.contains("slip zone"));
    }

    #[test]
    fn a_belt_that_adheres_need_not_slip() {
        let mut stability = sample::stability();
        stability.drive.law = FrictionLaw::Coulomb;
        for on in [&mut stability.driver, &mut stability.driven] {
            on.transition = on.contact_length;
            on.forms[0].modes.truncate(1);
        }
        let text = figure(&stability);
        assert!(text.contains("adhesion zone") && !text.contains("slip zone"));
        assert!(!text.contains("mode 2"));
    }
}
