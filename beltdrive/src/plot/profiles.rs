//! Quantities along the belt on both pulleys, one figure each.

use super::axis::{Axis, Scale};
use super::header::{Header, Legend};
use super::panel::Panel;
use super::profile_figures::{self, Figure, pieces};
use super::style::{self, Canvas, Drawn, px};
use crate::{Drive, PulleyState, SteadyState};
use plotters::prelude::*;

/// Width and height of the figures, px.
const SIZE: [f64; 2] = [900.0, 760.0];

/// The figures of all quantities, each with the name of its file.
pub(super) fn figures(state: &SteadyState) -> impl Iterator<Item = (&'static str, String)> {
    profile_figures::of(&state.drive.belt)
        .iter()
        .map(|figure| (figure.file, figure.draw(state)))
}

impl Figure {
    /// The figure: the driver above the driven pulley, on the same axes.
    fn draw(&self, state: &SteadyState) -> String {
        let profiles = [&state.driver.profile, &state.driven.profile];
        let angles = profiles
            .into_iter()
            .flat_map(|profile| degrees(&profile.angle));
        let values: Vec<_> = profiles
            .into_iter()
            .flat_map(|profile| {
                let curves = self.curves.iter();
                curves.flat_map(|curve| (curve.values)(state.drive.friction_coefficient, profile))
            })
            .collect();
        let axes = [
            Axis::spanning(angles, Scale::Degrees),
            Axis::spanning(values.iter().copied(), self.scale).padded(),
        ];
        style::render(SIZE, |canvas| {
            let header = Header::of(state, self.title);
            header.draw(canvas, &self.legend(state))?;
            let (_, below) = canvas.split_vertically(px(header.height(SIZE[0])));
            let panels = below.split_evenly((2, 1));
            let pulleys = [("driver", &state.driver), ("driven pulley", &state.driven)];
            for (panel, (name, pulley)) in panels.iter().zip(pulleys) {
                self.panel(panel, &axes, name, &state.drive, pulley)?;
            }
            Ok(())
        })
    }

    fn legend(&self, state: &SteadyState) -> Vec<Legend> {
        let curves = self
            .curves
            .iter()
            .map(|curve| Legend::Line(curve.label, curve.stroke));
        let zones =
            style::kinds(state).map(|kind| Legend::Shade(style::zone(kind).0, style::tint(kind)));
        curves.chain(zones).collect()
    }

    /// The curves along one pulley over its shaded zones.
    fn panel(
        &self,
        canvas: &Canvas<'_>,
        axes: &[Axis; 2],
        name: &str,
        drive: &Drive,
        pulley: &PulleyState,
    ) -> Drawn {
        let panel = Panel {
            title: name,
            axes,
            descriptions: ["angle φ from the entry in degrees", self.axis],
        };
        let [angle, value] = axes;
        let zones = pulley.zones.iter().map(|zone| {
            let [from, to] =
                [zone.from, zone.to].map(|end| end.to_degrees().clamp(angle.from, angle.to));
            Rectangle::new([(from, value.from), (to, value.to)], style::tint(zone.kind))
        });
        let chart = panel.draw(canvas, zones)?;
        for curve in self.curves {
            let values = (curve.values)(drive.friction_coefficient, &pulley.profile);
            let points: Vec<_> = degrees(&pulley.profile.angle).zip(values).collect();
            for piece in pieces(self.scale, &points) {
                curve.stroke.draw(chart.plotting_area(), piece)?;
            }
        }
        Ok(())
    }
}

fn degrees(angles: &[f64]) -> impl Iterator<Item = f64> + Clone + '_ {
    angles.iter().map(|angle| angle.to_degrees())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    #[test]
    fn a_curve_is_parted_where_it_jumps() {
        let state = sample::loaded();
        let mut profile = state.driver.profile;
        let [tension, inclination, ..] = profile_figures::of(&state.drive.belt) else {
            panic!("five figures");
        };
        profile.inclination[100..].fill(4.0);
        profile.tension[3] = f64::NAN;
        let pieces = |figure: &Figure| {
            let values = (figure.curves[0].values)(1.0, &profile);
            let points: Vec<_> = degrees(&profile.angle).zip(values).collect();
            pieces(figure.scale, &points)
        };
        assert_eq!(pieces(inclination).len(), 2);
        assert_eq!(pieces(tension).len(), 2);
    }
}
