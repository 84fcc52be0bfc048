//! Kim (2009), the numbers in the text of the chapter on flat belts.

use super::drives::{Failure, kim_flat, state};
use super::kim_table_2::{SOFTEST, STIFFEST, slip_arc, smallest_stiffness, transition_angle};
use super::{Comparison, Criterion, Published, Section, computed};
use crate::input::Key;
use crate::{Drive, EventKind, FrictionLaw, Role, SolveOptions, ZoneKind, limits, trace};
use std::f64::consts::{FRAC_PI_2, PI};

const PLOT: &str = "read off a plot, as a multiple of 10 N";
const FULL_SLIP: &str = "with the exponent μπ EA/(EA − m v²) of the thesis and v = 119.1 rad/s · R; \
                         without inertia T_L exp(μπ) = 8675.24, and with π cut to 3.1415 it is 8674.28";
const DRIVE_ENDS: &str = "the whole drive ends before its pulleys slip over their whole arcs: the belt \
                          lags so far behind the driver that the driven pulley stops";
const JOHNSON: &str = "cut off, not rounded; with the inertia of the belt in the normal force, which \
                       the thesis leaves out, the arc is 1.2883";

const DEGREES: &str = "1.93 rad, rounded, in degrees, and what is left of 180°";

/// The slack tension of the text, N.
const SLACK: f64 = 200.0;

pub(super) fn section() -> Section {
    let row = |quantity, unit, text, criterion, computed| {
        Comparison::new(quantity, unit, Published::new(text), criterion, computed)
    };
    let driven = slip_begins(Role::Driven);
    let driver = slip_begins(Role::Driver);
    let full = |number: &Result<f64, Failure>| computed(number, |number| *number);
    Section {
        title: "Text; T_L = 200 N and k_f = 8.1e7 N/m² where nothing else is said",
        comparisons: vec![
            row(
                "smallest k_f, T_L, T_H of table 2",
                "N/m²",
                "2.8e7",
                Criterion::Digits,
                full(&smallest_stiffness(SOFTEST.tensions())),
            ),
            row(
                "T_H at 180° transition, driven pulley",
                "N",
                "380",
                Criterion::known(PLOT, 373.205, 1e-3),
                full(&driven),
            ),
            row(
                "T_H at 180° transition, driver",
                "N",
                "310",
                Criterion::known(PLOT, 292.820, 1e-3),
                full(&driver),
            ),
            row(
                "T_H at 90° transition, driven pulley",
                "N",
                "2390",
                Criterion::known(PLOT, 2389.4686, 1e-3),
                full(&half_slips()),
            ),
            row(
                "T_H at full slip, pulley alone",
                "N",
                "8674",
                Criterion::known(FULL_SLIP, 8679.206, 1e-3),
                full(&capstan()),
            ),
            row(
                "T_H at full slip, drive",
                "N",
                "8674",
                Criterion::known(DRIVE_ENDS, 8672.914, 1e-3),
                full(&largest()),
            ),
            row(
                "slip arc after Johnson, k_f → ∞",
                "rad",
                "1.24",
                Criterion::known(JOHNSON, 1.2471, 1e-4),
                full(&slip_of_stiffest(true)),
            ),
            row(
                "slip arc, k_f = 8.1e9 N/m²",
                "rad",
                "1.21",
                Criterion::Digits,
                full(&slip_of_stiffest(false)),
            ),
            row(
                "transition, k_f = 8.1e9 N/m²",
                "°",
                "110.6",
                Criterion::known(DEGREES, 110.8176, 1e-3),
                full(&slip_of_stiffest(false).map(|slip| 180.0 - slip.to_degrees())),
            ),
            row(
                "slip arc, k_f = 8.1e9 N/m²",
                "°",
                "69.4",
                Criterion::known(DEGREES, 69.1824, 1e-3),
                full(&slip_of_stiffest(false).map(f64::to_degrees)),
            ),
        ],
    }
}

fn drive(tight: f64) -> Result<Drive, Failure> {
    kim_flat(8.1e7, [SLACK, tight])
}

/// The tight tension at which a pulley begins to slip, N.
fn slip_begins(on: Role) -> Result<f64, Failure> {
    let start = drive(210.0)?;
    let key = Key::load(&start);
    let options = SolveOptions::default();
    let branch = trace(&start, &key, [210.0, 500.0], &options, &mut |_, _| {})?;
    let begins = EventKind::ZoneAppears {
        pulley: on,
        kind: ZoneKind::Slip,
    };
    let event = branch.events.iter().find(|event| event.kind == begins);
    let event = event.ok_or(Failure::Missing("the onset of slip"))?;
    Ok(event.point.value)
}

/// The tight tension at which half the arc of the driven pulley slips, N: by bisection.
fn half_slips() -> Result<f64, Failure> {
    let mut between = [500.0, 8000.0];
    for _ in 0..60 {
        let middle = 0.5 * (between[0] + between[1]);
        let solved = state(&drive(middle)?)?;
        let later = transition_angle(&solved.driven) > FRAC_PI_2;
        between[usize::from(!later)] = middle;
    }
    Ok(between[0])
}

/// The tight tension of a pulley that slips over its whole arc, in the convention of the thesis, N.
fn capstan() -> Result<f64, Failure> {
    let drive = drive(800.0)?;
    let speed = 119.1 * drive.pair().driven_radius;
    let axial = drive.belt.axial_stiffness;
    let stiffness = axial - drive.belt.mass_per_length * speed * speed;
    Ok(SLACK * (drive.pair().friction_coefficient * PI * axial / stiffness).exp())
}

/// The largest tight tension of the drive, N.
fn largest() -> Result<f64, Failure> {
    let drive = drive(800.0)?;
    let options = SolveOptions::default();
    Ok(
        limits(&drive, &Key::load(&drive), &options, &mut |_, _| {})?
            .largest
            .value,
    )
}

/// The slip arc of the driven pulley in the column of table 2 with the greatest stiffness, or with a
/// rigid one in its place, rad.
fn slip_of_stiffest(rigid: bool) -> Result<f64, Failure> {
    let (column, stiffness) = STIFFEST;
    let mut drive = kim_flat(stiffness, column.tensions())?;
    if rigid {
        drive.law = FrictionLaw::Coulomb;
    }
    Ok(slip_arc(&state(&drive)?.driven))
}
