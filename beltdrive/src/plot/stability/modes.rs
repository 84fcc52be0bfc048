//! The shapes of the first modes along both pulleys, in the form of the thesis.

use super::super::axis::{Axis, Scale};
use super::super::header::{Header, Legend};
use super::super::panel::Panel;
use super::super::style::{self, Canvas, Drawn, Stroke, px};
use crate::quantity::stability::{complex, outcome};
use crate::{AxialMode, Drive, FrictionLaw, PulleyStability, ShapePoint, Stability, ZoneKind};
use plotters::prelude::*;

/// Width of the figure and height of a row of panels, px.
const WIDTH: f64 = 1100.0;
const ROW: f64 = 240.0;

const REAL: Stroke = Stroke::solid(style::INK, 2.0);
const MODULUS: Stroke = Stroke::dashed(style::WINE, 1.5);

/// The figure: the driver on the left, the driven pulley on the right.
pub(super) fn figure(stability: &Stability) -> String {
    let drive = &stability.drive;
    let header = Header::new(drive, &[], "Axial modes, outlet f' = 0 (thesis)");
    let pulleys = [
        ("driver", &stability.driver, drive.driver_radius),
        ("driven", &stability.driven, drive.driven_radius),
    ];
    let rows = pulleys.iter().map(|(_, on, _)| shapes(on).count()).min();
    let rows = rows.unwrap_or(0);
    let top = header.height(WIDTH);
    style::render([WIDTH, top + ROW * rows.max(1) as f64], |canvas| {
        header.draw(canvas, &legend(drive, pulleys.map(|(_, on, _)| on)))?;
        let (_, below) = canvas.split_vertically(px(top));
        let panels = below.split_evenly((rows.max(1), 2));
        for (column, (name, on, radius)) in pulleys.into_iter().enumerate() {
            for (row, mode) in shapes(on).take(rows).enumerate() {
                let title = format!(
                    "{name}, mode {}: λ = {} 1/s, {}",
                    row + 1,
                    complex(mode),
                    outcome(mode)
                );
                let view = View {
                    title,
                    held: held(drive),
                    on,
                    radius,
                };
                view.draw(&panels[2 * row + column], mode)?;
            }
        }
        Ok(())
    })
}

/// The modes of which there is a shape.
fn shapes(on: &PulleyStability) -> impl Iterator<Item = &AxialMode> {
    let modes = on.forms[0].modes.iter();
    modes.take_while(|mode| mode.shape.len() > 1)
}

/// The zone before the slip zone.
fn held(drive: &Drive) -> ZoneKind {
    match drive.law {
        FrictionLaw::Coulomb => ZoneKind::Adhesion,
        _ => ZoneKind::Elastic,
    }
}

fn legend(drive: &Drive, pulleys: [&PulleyStability; 2]) -> Vec<Legend> {
    let slips = pulleys.iter().any(|on| on.transition < on.contact_length);
    let lines = [
        Legend::Line("real part", REAL),
        Legend::Line("modulus", MODULUS),
    ];
    let kinds = [Some(held(drive)), slips.then_some(ZoneKind::Slip)];
    let shades = kinds.into_iter().flatten();
    let shades = shades.map(|kind| Legend::Shade(style::zone(kind).0, style::tint(kind)));
    lines.into_iter().chain(shades).collect()
}

/// A panel.
struct View<'a> {
    title: String,
    held: ZoneKind,
    on: &'a PulleyStability,
    radius: f64,
}

impl View<'_> {
    fn draw(&self, canvas: &Canvas<'_>, mode: &AxialMode) -> Drawn {
        let degrees = |length: f64| (length / self.radius).to_degrees();
        let [end, transition] = [self.on.contact_length, self.on.transition].map(degrees);
        let axes = [
            Axis::spanning([0.0, end].into_iter(), Scale::Degrees),
            Axis::spanning([-1.0, 1.0].into_iter(), Scale::Decimal).padded(),
        ];
        let [_, up] = &axes;
        let shade =
            |from, to, kind| Rectangle::new([(from, up.from), (to, up.to)], style::tint(kind));
        let shades = [
            shade(0.0, transition.min(end), self.held),
            shade(transition.min(end), end, ZoneKind::Slip),
        ];
        let panel = Panel {
            title: &self.title,
            axes: &axes,
            descriptions: ["angle φ from the entry in degrees", "motion f / max |f|"],
        };
        let chart = panel.draw(canvas, shades.into_iter())?;
        let area = chart.plotting_area();
        let line = |of: fn(&ShapePoint) -> f64| {
            let points = mode.shape.iter();
            points
                .map(|point| (degrees(point.arc_length), of(point)))
                .collect()
        };
        REAL.draw(area, line(|point| point.value[0]))?;
        MODULUS.draw(area, line(|point| point.value[0].hypot(point.value[1])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::stability::sample;

    #[test]
    fn every_shape_has_a_panel_with_its_eigenvalue() {
        let text = figure(&sample::stability());
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
