//! Which scalars of the states of a branch are drawn, by kind of belt.

use super::axis::Scale;
use super::style;
use crate::report::slip_arc;
use crate::{BeltKind, Drive, PulleySummary, StateSummary};
use plotters::prelude::*;

/// A panel: one or two scalars of one unit.
pub(super) struct Diagram {
    /// Written above the panel.
    pub(super) title: &'static str,
    /// What the vertical axis measures.
    pub(super) axis: &'static str,
    /// Its scale.
    pub(super) scale: Scale,
    /// The scalars.
    pub(super) curves: &'static [Curve],
}

/// A scalar of the states.
pub(super) struct Curve {
    /// Its colour.
    pub(super) color: RGBColor,
    /// Its width, px.
    pub(super) width: f64,
    /// The scalar in the unit of the axis.
    pub(super) quantity: fn(&StateSummary) -> f64,
}

/// The colour of the driver.
pub(super) const DRIVER: RGBColor = style::VERMILION;
/// The colour of the driven pulley.
pub(super) const DRIVEN: RGBColor = style::BLUE;

/// The width of a curve, and of one that another curve may cover.
const THIN: f64 = 2.0;
const BELOW: f64 = 4.0;

/// The panels of a branch of states of a drive.
pub(super) fn of(drive: &Drive) -> &'static [Diagram; 4] {
    match drive.belt.kind {
        BeltKind::V(_) => &V_BELT,
        BeltKind::Flat { .. } => &FLAT_BELT,
    }
}

const V_BELT: [Diagram; 4] = [SPEED, EFFICIENCY, WRAP, INCLINATION];
const FLAT_BELT: [Diagram; 4] = [SPEED, EFFICIENCY, TORQUE, SLIP];

const SPEED: Diagram = Diagram {
    title: "Speed of the driven pulley",
    axis: "angular speed in rad/s",
    scale: Scale::Decimal,
    curves: &[Curve {
        color: DRIVEN,
        width: THIN,
        quantity: |state| state.driven.angular_speed,
    }],
};

const EFFICIENCY: Diagram = Diagram {
    title: "Efficiency",
    axis: "efficiency in %",
    scale: Scale::Decimal,
    curves: &[Curve {
        color: style::INK,
        width: THIN,
        quantity: |state| 100.0 * state.efficiency,
    }],
};

const WRAP: Diagram = Diagram {
    title: "Wrap angles",
    axis: "wrap angle in degrees",
    scale: Scale::Degrees,
    curves: &[
        Curve {
            color: DRIVER,
            width: THIN,
            quantity: |state| state.driver.wrap_angle.to_degrees(),
        },
        Curve {
            color: DRIVEN,
            width: THIN,
            quantity: |state| state.driven.wrap_angle.to_degrees(),
        },
    ],
};

const INCLINATION: Diagram = Diagram {
    title: "Inclination of the belt at the exit, positive outward",
    axis: "inclination in degrees",
    scale: Scale::Degrees,
    curves: &[
        Curve {
            color: DRIVER,
            width: THIN,
            quantity: |state| state.driver.inclination[1].to_degrees(),
        },
        Curve {
            color: DRIVEN,
            width: THIN,
            quantity: |state| state.driven.inclination[1].to_degrees(),
        },
    ],
};

const TORQUE: Diagram = Diagram {
    title: "Torque",
    axis: "torque in N·m",
    scale: Scale::Decimal,
    curves: &[
        Curve {
            color: DRIVER,
            width: BELOW,
            quantity: |state| state.driver.torque,
        },
        Curve {
            color: DRIVEN,
            width: THIN,
            quantity: |state| state.driven.torque,
        },
    ],
};

const SLIP: Diagram = Diagram {
    title: "Slip arcs",
    axis: "slip arc in degrees",
    scale: Scale::Degrees,
    curves: &[
        Curve {
            color: DRIVER,
            width: BELOW,
            quantity: |state| slip_degrees(&state.driver),
        },
        Curve {
            color: DRIVEN,
            width: THIN,
            quantity: |state| slip_degrees(&state.driven),
        },
    ],
};

fn slip_degrees(pulley: &PulleySummary) -> f64 {
    slip_arc(&pulley.zones).to_degrees()
}
