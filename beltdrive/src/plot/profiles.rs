//! Quantities along the belt on both pulleys, one figure each.

use super::axis::{Axis, Scale};
use super::style::{self, Canvas, Drawn, Key, Stroke, px};
use crate::{Profile, PulleyState, SteadyState};
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

/// Width and height of the figures, px.
const SIZE: [f64; 2] = [900.0, 760.0];

/// Where the vertical axis stands and where its description may begin, px.
const LEFT: f64 = 84.0;
const EDGE: f64 = 16.0;

/// A figure: one or two quantities of one unit.
struct Figure {
    file: &'static str,
    title: &'static str,
    axis: &'static str,
    scale: Scale,
    curves: &'static [Curve],
}

/// A quantity along the belt.
struct Curve {
    label: &'static str,
    quantity: fn(&Profile) -> &[f64],
    unit: fn(f64) -> f64,
    stroke: Stroke,
}

const FIRST: Stroke = Stroke::solid(style::INK, 2.0);
const SECOND: Stroke = Stroke::dashed(style::WINE, 2.0);

const FIGURES: [Figure; 5] = [
    Figure {
        file: "tension.svg",
        title: "Tension along the belt",
        axis: "tension in N",
        scale: Scale::Decimal,
        curves: &[
            Curve {
                label: "belt tension T",
                quantity: |profile| &profile.tension,
                unit: std::convert::identity,
                stroke: FIRST,
            },
            Curve {
                label: "tractive tension F",
                quantity: |profile| &profile.tractive_tension,
                unit: std::convert::identity,
                stroke: SECOND,
            },
        ],
    },
    Figure {
        file: "inclination.svg",
        title: "Inclination of the belt, positive outward",
        axis: "inclination θ in degrees",
        scale: Scale::Degrees,
        curves: &[Curve {
            label: "inclination θ",
            quantity: |profile| &profile.inclination,
            unit: f64::to_degrees,
            stroke: FIRST,
        }],
    },
    Figure {
        file: "penetration.svg",
        title: "Penetration of the belt into the groove",
        axis: "penetration x in mm",
        scale: Scale::Decimal,
        curves: &[Curve {
            label: "penetration x",
            quantity: |profile| &profile.penetration,
            unit: |metres| metres * 1e3,
            stroke: FIRST,
        }],
    },
    Figure {
        file: "sliding_angle.svg",
        title: "Slip direction: 0° outward, 90° forward",
        axis: "sliding angle γ in degrees",
        scale: Scale::Degrees,
        curves: &[Curve {
            label: "sliding angle γ",
            quantity: |profile| &profile.sliding_angle,
            unit: f64::to_degrees,
            stroke: FIRST,
        }],
    },
    Figure {
        file: "normal_and_friction_force.svg",
        title: "Forces on each groove face",
        axis: "force per length in N/m",
        scale: Scale::Decimal,
        curves: &[
            Curve {
                label: "normal force p",
                quantity: |profile| &profile.normal_force,
                unit: std::convert::identity,
                stroke: FIRST,
            },
            Curve {
                label: "friction force f",
                quantity: |profile| &profile.friction_force,
                unit: std::convert::identity,
                stroke: SECOND,
            },
        ],
    },
];

/// The figures of all quantities, each with the name of its file.
pub(super) fn figures(state: &SteadyState) -> impl Iterator<Item = (&'static str, String)> {
    FIGURES
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
        let values = profiles
            .into_iter()
            .flat_map(|profile| self.curves.iter().flat_map(|curve| curve.values(profile)));
        let axes = [
            Axis::spanning(angles, Scale::Degrees),
            Axis::spanning(values, self.scale).padded(),
        ];
        style::render(SIZE, |canvas| {
            style::header(canvas, state, self.title, &self.legend(state))?;
            let (_, below) = canvas.split_vertically(px(style::header_height(state)));
            let panels = below.split_evenly((2, 1));
            let pulleys = [("driver", &state.driver), ("driven pulley", &state.driven)];
            for (panel, (name, pulley)) in panels.iter().zip(pulleys) {
                self.panel(panel, &axes, name, pulley)?;
            }
            Ok(())
        })
    }

    fn legend(&self, state: &SteadyState) -> Vec<Key> {
        let curves = self
            .curves
            .iter()
            .map(|curve| Key::Line(curve.label, curve.stroke));
        let zones =
            style::kinds(state).map(|kind| Key::Shade(style::zone(kind).0, style::tint(kind)));
        curves.chain(zones).collect()
    }

    /// The curves along one pulley over its shaded zones.
    fn panel(
        &self,
        panel: &Canvas<'_>,
        [angle, value]: &[Axis; 2],
        name: &str,
        pulley: &PulleyState,
    ) -> Drawn {
        let label = |color| style::face(style::SMALL, color, HPos::Center);
        style::write(
            panel,
            name,
            &style::face(style::BODY, style::INK, HPos::Left),
            [LEFT, 12.0],
        )?;
        let mut chart = ChartBuilder::on(panel)
            .margin_top(px(24.0))
            .margin_left(px(EDGE))
            .margin_right(px(style::MARGIN))
            .margin_bottom(px(10.0))
            .set_label_area_size(LabelAreaPosition::Left, px(LEFT - EDGE))
            .set_label_area_size(LabelAreaPosition::Bottom, px(46.0))
            .build_cartesian_2d(angle.clone(), value.clone())?;
        chart.draw_series(pulley.zones.iter().map(|zone| {
            let [from, to] =
                [zone.from, zone.to].map(|end| end.to_degrees().clamp(angle.from, angle.to));
            Rectangle::new([(from, value.from), (to, value.to)], style::tint(zone.kind))
        }))?;
        chart
            .configure_mesh()
            .bold_line_style(style::INK.mix(0.15).stroke_width(px(0.6).unsigned_abs()))
            .axis_style(Stroke::solid(style::INK, 1.0).shape())
            .set_all_tick_mark_size(px(5.0))
            .label_style(label(style::INK))
            .axis_desc_style(style::face(style::BODY, style::INK, HPos::Center))
            .x_desc("angle φ from the entry in degrees")
            .y_desc(self.axis)
            .draw()?;
        for curve in self.curves {
            for piece in self.pieces(curve, &pulley.profile) {
                curve.stroke.draw(chart.plotting_area(), piece)?;
            }
        }
        Ok(())
    }

    /// The points of a curve, parted where a value is missing or an angle jumps by a full turn.
    fn pieces(&self, curve: &Curve, profile: &Profile) -> Vec<Vec<(f64, f64)>> {
        let points: Vec<_> = degrees(&profile.angle).zip(curve.values(profile)).collect();
        points
            .chunk_by(|(_, before), (_, after)| {
                let jump = (after - before).abs();
                jump.is_finite() && (self.scale == Scale::Decimal || jump < 180.0)
            })
            .filter(|piece| piece.len() > 1)
            .map(<[_]>::to_vec)
            .collect()
    }
}

impl Curve {
    /// The values along a pulley in the unit of the figure.
    fn values<'a>(&'a self, profile: &'a Profile) -> impl Iterator<Item = f64> + Clone + 'a {
        (self.quantity)(profile)
            .iter()
            .map(|&value| (self.unit)(value))
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
        let mut profile = sample::loaded().driver.profile;
        let [inclination, tension] = [&FIGURES[1], &FIGURES[0]];
        profile.inclination[100..].fill(4.0);
        profile.tension[3] = f64::NAN;
        assert_eq!(
            inclination.pieces(&inclination.curves[0], &profile).len(),
            2
        );
        assert_eq!(tension.pieces(&tension.curves[0], &profile).len(), 2);
    }
}
