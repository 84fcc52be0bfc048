//! Quantities along the belt on the pulleys: a figure for each, with a panel for each pulley.

use super::axis::{Axis, Scale};
use super::curve::draw;
use super::header::{Header, Mark};
use super::occupied::Frame;
use super::panel::{Panel, grid};
use super::sheet::{INK, PALETTE, Sheet, Stroke, spot};
use super::zones;
use crate::quantity::{Answer, Subject};

/// A figure: one or two quantities of one unit.
struct Figure {
    /// Name of the file.
    file: &'static str,
    /// What the figure shows.
    title: &'static str,
    /// What the vertical axis measures.
    axis: &'static str,
    /// Its scale.
    scale: Scale,
    /// What a value in SI units is multiplied with.
    factor: f64,
    /// The quantities.
    curves: &'static [Curve],
}

/// A quantity along the belt.
struct Curve {
    /// What it is.
    label: &'static str,
    /// Its key.
    key: &'static str,
    /// Key of a number of the pulley that it is multiplied with.
    times: Option<&'static str>,
}

impl Curve {
    const fn of(key: &'static str, label: &'static str) -> Self {
        Self {
            label,
            key,
            times: None,
        }
    }
}

const STROKES: [Stroke; 2] = [Stroke::solid(INK, 2.0), Stroke::dashed(PALETTE[3], 2.0)];
const DEGREES: f64 = 180.0 / std::f64::consts::PI;
const MILLI: f64 = 1e3;

const TENSION: Figure = Figure {
    file: "tension.svg",
    title: "Tension along the belt",
    axis: "tension in N",
    scale: Scale::Decimal,
    factor: 1.0,
    curves: &[
        Curve::of("tension", "belt tension T"),
        Curve::of("tractive_tension", "tractive tension F"),
    ],
};

const V_BELT: [Figure; 5] = [
    TENSION,
    Figure {
        file: "inclination.svg",
        title: "Inclination of the belt, positive outward",
        axis: "inclination θ in degrees",
        scale: Scale::Degrees,
        factor: DEGREES,
        curves: &[Curve::of("inclination", "inclination θ")],
    },
    Figure {
        file: "penetration.svg",
        title: "Penetration of the belt into the groove",
        axis: "penetration x in mm",
        scale: Scale::Decimal,
        factor: MILLI,
        curves: &[Curve::of("penetration", "penetration x")],
    },
    Figure {
        file: "sliding_angle.svg",
        title: "Slip direction: 0° outward, 90° forward",
        axis: "sliding angle γ in degrees",
        scale: Scale::Degrees,
        factor: DEGREES,
        curves: &[Curve::of("sliding_angle", "sliding angle γ")],
    },
    Figure {
        file: "normal_and_friction_force.svg",
        title: "Forces on each groove face",
        axis: "force per length in N/m",
        scale: Scale::Decimal,
        factor: 1.0,
        curves: &[
            Curve::of("normal_force", "normal force p"),
            Curve::of("friction_force", "friction force f"),
        ],
    },
];

const FLAT_BELT: [Figure; 4] = [
    TENSION,
    Figure {
        file: "friction_force.svg",
        title: "Friction force of the belt",
        axis: "force per length in N/m",
        scale: Scale::Decimal,
        factor: 1.0,
        curves: &[
            Curve::of("friction_force", "friction force f"),
            Curve {
                label: "its limit μ n",
                key: "normal_force",
                times: Some("friction_coefficient"),
            },
        ],
    },
    Figure {
        file: "normal_force.svg",
        title: "Normal force of the belt",
        axis: "force per length in N/m",
        scale: Scale::Decimal,
        factor: 1.0,
        curves: &[Curve::of("normal_force", "normal force n")],
    },
    Figure {
        file: "displacement.svg",
        title: "Displacement of the belt against the rim",
        axis: "displacement u in mm",
        scale: Scale::Decimal,
        factor: MILLI,
        curves: &[Curve::of(
            "displacement",
            "displacement u, positive forward",
        )],
    },
];

/// The figures of the profiles of an answer, each with the name of its file.
pub(super) fn figures(answer: &Answer) -> impl Iterator<Item = (&'static str, String)> {
    let statement = answer.subjects("").first();
    let belt = statement.and_then(|subject| subject.word("belt_type"));
    let figures = match belt {
        Some("v") => &V_BELT[..],
        _ => &FLAT_BELT[..],
    };
    let figures = figures.iter();
    figures.map(|figure| (figure.file, figure.draw(answer)))
}

/// Columns of panels, width of the sheet and height of a panel, px, by the number of pulleys.
fn arrangement(pulleys: usize) -> (usize, f64, f64) {
    match pulleys {
        0..=2 => (1, 900.0, 330.0),
        3..=8 => (2, 1100.0, 290.0),
        _ => (3, 1400.0, 270.0),
    }
}

impl Figure {
    fn draw(&self, answer: &Answer) -> String {
        let pulleys = answer.subjects("pulleys");
        let (columns, width, height) = arrangement(pulleys.len());
        let curves = self.curves.iter().zip(STROKES);
        let curves = curves.map(|(curve, stroke)| (curve.label.to_owned(), Mark::Line(stroke)));
        let legend = curves.chain(zones::legend(answer, Mark::Shade));
        let header = Header::new(answer, self.title, legend, width);
        let rows = pulleys.len().div_ceil(columns).max(1) as f64;
        let size = spot(width, header.height + rows * height);
        let mut sheet = Sheet::new(size);
        header.draw(&mut sheet);
        let values = pulleys.iter().flat_map(|pulley| self.curves(pulley));
        let values: Vec<_> = values.flatten().map(|(_, value)| value).collect();
        let up = Axis::spanning(values.into_iter(), self.scale).padded();
        let below = Frame {
            from: spot(0.0, header.height),
            to: size,
        };
        for (pulley, part) in pulleys.iter().zip(grid(below, columns, pulleys.len())) {
            self.panel(&mut sheet, part, up.clone(), pulley);
        }
        sheet.finish()
    }

    /// The curves along a pulley over its shaded zones.
    fn panel(&self, sheet: &mut Sheet, part: Frame, up: Axis, pulley: &Subject) {
        let curves = self.curves(pulley);
        let angles = curves.iter().flatten().map(|(angle, _)| *angle);
        let across = Axis::spanning([0.0].into_iter().chain(angles), Scale::Degrees);
        let zones = zones::along(pulley).into_iter();
        let zones = zones.map(|(kind, ends)| (ends.map(f64::to_degrees), zones::color(kind)));
        let mut zones: Vec<_> = zones.collect();
        // Where the belt overhangs, the angle goes beyond that of the exit.
        zones
            .iter_mut()
            .rev()
            .take(1)
            .for_each(|([_, to], _)| *to = across.to);
        let panel = Panel {
            title: pulley.head.clone(),
            axes: [across, up],
            descriptions: ["angle φ from the entry in degrees", self.axis].map(str::to_owned),
        };
        let chart = panel.draw(sheet, part, zones.iter().copied());
        for (points, stroke) in curves.iter().zip(STROKES) {
            let ends: Vec<_> = zones.iter().map(|([_, to], _)| *to).collect();
            for piece in pieces(self.scale, points, &ends) {
                let places = piece.iter().map(|(angle, value)| chart.at(*angle, *value));
                draw(sheet, &places.collect::<Vec<_>>(), stroke);
            }
        }
    }

    /// The curves of a pulley as points: angle in degrees, and value in the unit of the figure.
    fn curves(&self, pulley: &Subject) -> Vec<Vec<(f64, f64)>> {
        let angles = pulley.series("angle");
        let curves = self.curves.iter().map(|curve| {
            let factor = curve.times.map_or(Some(1.0), |key| pulley.number(key));
            let factor = self.factor * factor.unwrap_or(f64::NAN);
            let points = angles.iter().zip(pulley.series(curve.key));
            points
                .map(|(angle, value)| (angle.to_degrees(), factor * value))
                .collect()
        });
        curves.collect()
    }
}

/// The pieces of a curve through points, parted where a value is missing or an angle jumps by a full turn, and
/// where a zone ends: there it may have a corner.
fn pieces<'a>(
    scale: Scale,
    points: &'a [(f64, f64)],
    ends: &[f64],
) -> impl Iterator<Item = &'a [(f64, f64)]> {
    let goes_on = |before: usize| {
        let jump = (points[before + 1].1 - points[before].1).abs();
        jump.is_finite() && (scale == Scale::Decimal || jump < 180.0)
    };
    let is_end = |angle: f64| ends.iter().any(|end| (end - angle).abs() < 1e-9);
    let mut pieces = Vec::new();
    let mut start = 0;
    for (index, (angle, _)) in points.iter().enumerate() {
        let is_last = index + 1 == points.len() || !goes_on(index);
        if is_last || is_end(*angle) {
            pieces.push(&points[start..=index]);
            start = if is_last { index + 1 } else { index };
        }
    }
    pieces.into_iter().filter(|piece| piece.len() > 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_parted_where_it_jumps_and_where_a_zone_ends() {
        let points: Vec<_> = (0..200_u32).map(|at| (f64::from(at), 2.0)).collect();
        let mut turned = points.clone();
        turned[100..].iter_mut().for_each(|point| point.1 = 230.0);
        assert_eq!(pieces(Scale::Degrees, &turned, &[]).count(), 2);
        assert_eq!(pieces(Scale::Decimal, &turned, &[]).count(), 1);
        turned[3].1 = f64::NAN;
        let found: Vec<_> = pieces(Scale::Decimal, &turned, &[150.0]).collect();
        assert_eq!(
            found.iter().map(|piece| piece.len()).collect::<Vec<_>>(),
            [3, 147, 50]
        );
        assert_eq!(found[1].last(), found[2].first());
    }
}
