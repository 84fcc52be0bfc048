//! Which quantities along the belt have a figure, by kind of belt.

use super::axis::Scale;
use super::style::{self, Stroke};
use crate::{Belt, BeltKind, Profile};

/// A figure: one or two quantities of one unit.
pub(super) struct Figure {
    /// Name of the file.
    pub(super) file: &'static str,
    /// What the figure shows.
    pub(super) title: &'static str,
    /// What the vertical axis measures.
    pub(super) axis: &'static str,
    /// Its scale.
    pub(super) scale: Scale,
    /// Whether the spans have these quantities as well.
    pub(super) on_spans: bool,
    /// The quantities.
    pub(super) curves: &'static [Curve],
}

/// A quantity along the belt.
pub(super) struct Curve {
    /// What it is.
    pub(super) label: &'static str,
    /// Its values along a pulley with a coefficient of friction, in the unit of the figure.
    pub(super) values: fn(f64, &Profile) -> Vec<f64>,
    /// How it is drawn.
    pub(super) stroke: Stroke,
}

/// The pieces of a curve through points, parted where a value is missing or an angle jumps by a full turn.
pub(super) fn pieces(scale: Scale, points: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
    let pieces = points.chunk_by(|(_, before), (_, after)| {
        let jump = (after - before).abs();
        jump.is_finite() && (scale == Scale::Decimal || jump < 180.0)
    });
    let pieces = pieces.filter(|piece| piece.len() > 1);
    pieces.map(<[_]>::to_vec).collect()
}

const FIRST: Stroke = Stroke::solid(style::INK, 2.0);
const SECOND: Stroke = Stroke::dashed(style::WINE, 2.0);

/// The figures of a belt.
pub(super) fn of(belt: &Belt) -> &'static [Figure] {
    match belt.kind {
        BeltKind::V(_) => &V_BELT,
        BeltKind::Flat { .. } => &FLAT_BELT,
    }
}

fn in_degrees(angles: &[f64]) -> Vec<f64> {
    angles.iter().map(|angle| angle.to_degrees()).collect()
}

fn in_millimetres(lengths: &[f64]) -> Vec<f64> {
    lengths.iter().map(|length| length * 1e3).collect()
}

const TENSION: Figure = Figure {
    file: "tension.svg",
    title: "Tension along the belt",
    axis: "tension in N",
    scale: Scale::Decimal,
    on_spans: true,
    curves: &[
        Curve {
            label: "belt tension T",
            values: |_, profile| profile.tension.clone(),
            stroke: FIRST,
        },
        Curve {
            label: "tractive tension F",
            values: |_, profile| profile.tractive_tension.clone(),
            stroke: SECOND,
        },
    ],
};

const V_BELT: [Figure; 5] = [
    TENSION,
    Figure {
        file: "inclination.svg",
        title: "Inclination of the belt, positive outward",
        axis: "inclination θ in degrees",
        scale: Scale::Degrees,
        on_spans: false,
        curves: &[Curve {
            label: "inclination θ",
            values: |_, profile| in_degrees(&profile.inclination),
            stroke: FIRST,
        }],
    },
    Figure {
        file: "penetration.svg",
        title: "Penetration of the belt into the groove",
        axis: "penetration x in mm",
        scale: Scale::Decimal,
        on_spans: false,
        curves: &[Curve {
            label: "penetration x",
            values: |_, profile| in_millimetres(&profile.penetration),
            stroke: FIRST,
        }],
    },
    Figure {
        file: "sliding_angle.svg",
        title: "Slip direction: 0° outward, 90° forward",
        axis: "sliding angle γ in degrees",
        scale: Scale::Degrees,
        on_spans: false,
        curves: &[Curve {
            label: "sliding angle γ",
            values: |_, profile| in_degrees(&profile.sliding_angle),
            stroke: FIRST,
        }],
    },
    Figure {
        file: "normal_and_friction_force.svg",
        title: "Forces on each groove face",
        axis: "force per length in N/m",
        scale: Scale::Decimal,
        on_spans: false,
        curves: &[
            Curve {
                label: "normal force p",
                values: |_, profile| profile.normal_force.clone(),
                stroke: FIRST,
            },
            Curve {
                label: "friction force f",
                values: |_, profile| profile.friction_force.clone(),
                stroke: SECOND,
            },
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
        on_spans: false,
        curves: &[
            Curve {
                label: "friction force f",
                values: |_, profile| profile.friction_force.clone(),
                stroke: FIRST,
            },
            Curve {
                label: "its limit μ n",
                values: |coefficient, profile| {
                    let normal = profile.normal_force.iter();
                    normal.map(|n| coefficient * n).collect()
                },
                stroke: SECOND,
            },
        ],
    },
    Figure {
        file: "normal_force.svg",
        title: "Normal force of the belt",
        axis: "force per length in N/m",
        scale: Scale::Decimal,
        on_spans: false,
        curves: &[Curve {
            label: "normal force n",
            values: |_, profile| profile.normal_force.clone(),
            stroke: FIRST,
        }],
    },
    Figure {
        file: "displacement.svg",
        title: "Displacement of the belt against the rim",
        axis: "displacement u in mm",
        scale: Scale::Decimal,
        on_spans: false,
        curves: &[Curve {
            label: "displacement u, positive forward",
            values: |_, profile| in_millimetres(&profile.displacement),
            stroke: FIRST,
        }],
    },
];
