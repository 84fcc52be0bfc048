//! Quantities along the belt on both pulleys, one figure each.

use super::axis::{Axis, Scale};
use super::panel::Panel;
use super::style::{self, Canvas, Drawn, Header, Legend, Stroke, px};
use crate::{Profile, PulleyState, SteadyState};
use plotters::prelude::*;

/// Width and height of the figures, px.
const SIZE: [f64; 2] = [900.0, 760.0];

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
            let header = Header::of(state, self.title);
            style::header(canvas, &header, &self.legend(state))?;
            let (_, below) = canvas.split_vertically(px(header.height()));
            let panels = below.split_evenly((2, 1));
            let pulleys = [("driver", &state.driver), ("driven pulley", &state.driven)];
            for (panel, (name, pulley)) in panels.iter().zip(pulleys) {
                self.panel(panel, &axes, name, pulley)?;
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
