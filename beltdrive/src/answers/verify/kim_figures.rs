//! Kim (2009), figures 24 to 26: the flat belt in time in place of the finite-element model of the thesis.

use super::drives::{Failure, kim_flat, state};
use super::kim_table_2::COLUMNS;
use super::{Comparison, Criterion, Published, Section, computed};
use crate::answers::simulate::{in_time, simulate};
use crate::transient::{
    Axle, Cells, Ending, Load, Motion, PulleySample, Schedule, Simulation, Start, Until,
};
use crate::{Drive, Duty};
use std::f64::consts::PI;

const TENSIONS: &str = "the belt has the length and the driven pulley the torque that the closed form \
                        has at the printed tensions, so that this is a test of the run alone";
const ARCS: &str = "printed is the solution with n = T/R; in time the inertia of the belt takes part of \
                    the pressure, n = (T − m v²/λ)/R, and expected is the closed form with that";
const SPEED: &str = "of a finite-element model whose mesh is not told; expected is the closed form, which \
                     the run has to 1e-6 with 90 cells and more";

/// Cells on every arc: the tensions are then right to 0.02 N, half a unit of the printed digits being 0.05 N. The spans,
/// which are at one tension, do with fewer.
const CELLS: Cells = Cells::Each { arc: 100, span: 20 };

/// What the ends of slip may be off, rad: a third of a cell. With 80 cells on an arc it was 1.02 thirds at 8.1e9 N/m².
const OF_ARCS: f64 = PI / 300.0;

/// What the driven speed may be off, rad/s: half a unit of the last digit of what is expected.
const OF_SPEED: f64 = 5e-4;

/// Axial damping of the belt, N·s, of which the thesis has none: it ends the waves along the belt, and moves the tensions
/// by 2 mN.
const DAMPING: f64 = 0.02;

/// When the driver has its speed, s: soon, as only the end counts, but without gross slip.
const STARTED: f64 = 0.02;

/// Moment of inertia of the driven pulley, kg·m², on which the steady state does not depend: that of the load step of
/// `docs/transient.md`.
const INERTIA: f64 = 0.005;

/// Time between samples, s: implicit steps are as long as some of them, and the state has to be steady in five.
const INTERVAL: f64 = 2e-3;

/// The latest end, s: the runs take less than one.
const LATEST: f64 = 5.0;

/// A figure.
struct Figure {
    title: &'static str,
    /// Friction stiffness, N/m².
    stiffness: f64,
    /// Transition and slip arc of the driven pulley, then of the driver, in the closed form with inertia and finite
    /// strains, rad.
    arcs: [f64; 4],
    /// Driven speed in the closed form where it is not the printed one, rad/s.
    speed: Option<f64>,
}

/// In the order of the columns of table 2.
const FIGURES: [Figure; 3] = [
    Figure {
        title: "Figure 24, k_f = 2.8e7 N/m²",
        stiffness: 2.8e7,
        arcs: [3.105_344, 0.036_249, 2.299_682, 0.841_911],
        speed: None,
    },
    Figure {
        title: "Figure 25, k_f = 2.0e8 N/m²",
        stiffness: 2.0e8,
        arcs: [2.116_444, 1.025_148, 2.040_706, 1.100_886],
        speed: Some(119.1656),
    },
    Figure {
        title: "Figure 26, k_f = 8.1e9 N/m²",
        stiffness: 8.1e9,
        arcs: [1.892_977, 1.248_616, 1.891_406, 1.250_186],
        speed: Some(119.1847),
    },
];

/// What a run ends with.
struct Reached {
    driven: PulleySample,
    driver: PulleySample,
    /// Tension of the slack and of the tight span, N.
    tensions: [f64; 2],
}

pub(super) fn sections() -> Vec<Section> {
    let of_columns = FIGURES.iter().zip(&COLUMNS);
    let sections = of_columns.map(|(figure, column)| {
        let reached = reached(figure.stiffness, column.tensions());
        let row = |quantity, unit, published, criterion, number: fn(&Reached) -> f64| {
            let number = computed(&reached, number);
            Comparison::new(quantity, unit, published, criterion, number)
        };
        let arc = |of: usize| Criterion::known(ARCS, figure.arcs[of], OF_ARCS);
        let [slack, tight] = column.printed_tensions;
        let speed = (figure.speed).map_or(Criterion::Digits, |speed| {
            Criterion::known(SPEED, speed, OF_SPEED)
        });
        Section {
            title: figure.title,
            comparisons: vec![
                row("tension T_L", "N", slack, Criterion::Digits, |end| {
                    end.tensions[0]
                })
                .remarked(TENSIONS),
                row("tension T_H", "N", tight, Criterion::Digits, |end| {
                    end.tensions[1]
                })
                .remarked(TENSIONS),
                row(
                    "transition, driven pulley",
                    "rad",
                    column.arcs[0],
                    arc(0),
                    |end| PI - end.driven.slip_arc,
                ),
                row(
                    "slip arc, driven pulley",
                    "rad",
                    column.arcs[1],
                    arc(1),
                    |end| end.driven.slip_arc,
                ),
                row("transition, driver", "rad", column.arcs[2], arc(2), |end| {
                    PI - end.driver.slip_arc
                }),
                row("slip arc, driver", "rad", column.arcs[3], arc(3), |end| {
                    end.driver.slip_arc
                }),
                row(
                    "driven speed ω₁",
                    "rad/s",
                    Published::new("119.1"),
                    speed,
                    |end| end.driven.angular_speed,
                ),
            ],
        }
    });
    sections.collect()
}

/// The end of a run from rest to the steady state, of the belt that has the tensions in N with the torque that goes with
/// them.
fn reached(stiffness: f64, tensions: [f64; 2]) -> Result<Reached, Failure> {
    let drive = in_time(&kim_flat(stiffness, tensions)?);
    let driven = state(&drive)?.driven;
    // In proportion to the speed: that ends the torsional vibration of the start-up soon.
    let per_speed = driven.torque / driven.angular_speed;
    let history = simulate(&simulation(drive, per_speed), &mut |_, _| true)?;
    if history.ending != Ending::Steady {
        return Err(Failure::Missing("the steady state of a run"));
    }
    let last = history.samples.last();
    let last = last.ok_or(Failure::Missing("the end of a run"))?;
    // The driver stands first: the span behind it is the slack one.
    let (&[driver, driven], &[slack, tight]) = (&last.pulleys[..], &last.tensions[..]) else {
        return Err(Failure::Missing("a drive of two pulleys"));
    };
    Ok(Reached {
        driven,
        driver,
        tensions: [slack, tight],
    })
}

/// A run from rest with a load per speed in N·m·s on the driven pulley.
fn simulation(drive: Drive, per_speed: f64) -> Simulation {
    let axle = |duty| match duty {
        Duty::Driver(speed) => Axle {
            inertia: INERTIA,
            motion: Motion::Speed(Schedule::ramp([0.0, STARTED], [0.0, speed])),
        },
        Duty::Torque(_) | Duty::Power(_) | Duty::Driven => Axle {
            inertia: INERTIA,
            motion: Motion::Torques {
                motor: None,
                load: Load {
                    per_speed,
                    ..Load::new(Schedule::constant(0.0))
                },
            },
        },
    };
    Simulation {
        axles: drive
            .pulleys
            .iter()
            .map(|pulley| axle(pulley.duty))
            .collect(),
        drive,
        axial_damping: DAMPING,
        friction_damping: 0.0,
        transverse: None,
        start: Start::Rest,
        cells: CELLS,
        until: Until::Steady { latest: LATEST },
        interval: INTERVAL,
        instants: vec![],
        frames: 0,
        step: None,
    }
}
