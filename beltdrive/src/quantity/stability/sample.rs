//! A made-up stability, for the tests of reports and figures.

use crate::results::samples::flat;
use crate::{
    AxialMode, FormStability, LinearisedForm, Onset, PulleyStability, ShapePoint, Stability,
};
use std::f64::consts::PI;

/// Modes of every form.
pub(crate) const MODES: usize = 4;

/// Modes with a shape, and points of it.
const SHAPES: usize = 3;
const POINTS: usize = 21;

const LENGTH: f64 = 0.3;

/// Belt that slips on both pulleys; on the driver a motion grows from 480 N on, which is more than its
/// load, and with the natural outlet at this load.
pub(crate) fn stability() -> Stability {
    let [thesis, natural, conservative] = LinearisedForm::ALL;
    let on = |belt_speed, transition, forms| PulleyStability {
        belt_speed,
        contact_length: LENGTH,
        transition,
        forms,
    };
    let at = |load, mode| Some(Onset::At { load, mode });
    let never = Some(Onset::Never);
    Stability {
        drive: flat::epp().drive,
        critical_speed: 1291.0,
        driver: on(
            25.05,
            0.2,
            [
                form(thesis, -40.0, -12.5, at(480.0, Some(2))),
                form(natural, 3.25, 2.0, at(150.5, None)),
                form(conservative, 1e-9, 0.0, None),
            ],
        ),
        driven: on(
            25.0125,
            0.15,
            [
                form(thesis, -128.0, -25.5, never),
                form(natural, -7.0, -3.0, never),
                form(conservative, -1e-9, 0.0, None),
            ],
        ),
        seconds: 0.25,
    }
}

/// Modes whose rates approach those of high modes, a mode at 10 000 rad/s each.
fn form(
    form: LinearisedForm,
    growth: f64,
    high_mode_limit: f64,
    onset: Option<Onset>,
) -> FormStability {
    let mode = |index: usize| {
        let number = (index + 1) as f64;
        let shape = move |point: usize| {
            let share = point as f64 / (POINTS - 1) as f64;
            let phase = (number - 0.5) * PI * share;
            ShapePoint {
                arc_length: LENGTH * share,
                value: [phase.sin(), 0.1 * phase.sin() * share],
            }
        };
        AxialMode {
            growth: high_mode_limit + (growth - high_mode_limit) / (number * number),
            frequency: 10_000.0 * number,
            difference: 2e-12,
            shape: match index < SHAPES {
                true => (0..POINTS).map(shape).collect(),
                false => Vec::new(),
            },
        }
    };
    let modes: Vec<_> = (0..MODES).map(mode).collect();
    let least_stable = (0..MODES).max_by(|&i, &j| modes[i].growth.total_cmp(&modes[j].growth));
    FormStability {
        form,
        least_stable: least_stable.unwrap(),
        modes,
        high_mode_limit,
        counted: 2 * MODES,
        within: [90.0, 45_000.0],
        onset,
    }
}
