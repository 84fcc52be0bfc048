//! Loops of any number of pulleys, against the closed form of their steady state.

use super::{driver, follow, from_rest, loaded};
use beltdrive::belt_loop::solve;
use beltdrive::transient::{Load, Schedule, Start};
use beltdrive::{Drive, examples, input};

pub(crate) fn example(name: &str, changes: &[&str]) -> Drive {
    let example = examples::find(name).expect("a shipped example");
    let changes: Vec<_> = changes.iter().map(|change| (*change).to_owned()).collect();
    input::parse(example.name, example.text, &changes).unwrap()
}

/// Starts a drive in its steady state and looks whether it is one in time as well; the last numbers of the shares that
/// may be missed belong to spans, torques and hub loads.
fn stays(drive: Drive, cells: usize, allowed: [f64; 3]) {
    let known = solve(&drive).unwrap();
    let axles = drive.pulleys.iter().zip(&known.pulleys);
    let axles = axles.map(|(pulley, known)| match pulley.duty {
        beltdrive::Duty::Driver(speed) => driver(Schedule::constant(speed)),
        _ => loaded(2e-3, Load::new(Schedule::constant(known.torque))),
    });
    let mut simulation = from_rest(drive.clone(), axles.collect(), cells, 0.02);
    simulation.start = Start::Running;
    let history = follow(&simulation);
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |a: f64, b| a.max(b.abs()));
    let torque = largest(&mut known.pulleys.iter().map(|pulley| pulley.torque));
    let hub = largest(&mut known.pulleys.iter().flat_map(|pulley| pulley.hub_load));
    let mut missed = [0.0_f64; 3];
    for sample in &history.samples {
        for (tension, span) in sample.tensions.iter().zip(&known.spans) {
            missed[0] = missed[0].max((tension / span.tension - 1.0).abs());
        }
        for (pulley, known) in sample.pulleys.iter().zip(&known.pulleys) {
            missed[1] = missed[1].max((pulley.torque - known.torque).abs() / torque);
            for (found, known) in pulley.hub_load.iter().zip(known.hub_load) {
                missed[2] = missed[2].max((found - known).abs() / hub);
            }
            assert!((pulley.angular_speed / known.angular_speed - 1.0).abs() < 1e-3);
        }
    }
    println!("missed {missed:?} of {allowed:?}, {:?}", history.effort);
    for (missed, allowed) in missed.iter().zip(allowed) {
        assert!(*missed < allowed, "{missed:e}");
    }
}

/// What makes friction elastic/perfectly-plastic in an example.
const EPP: [&str; 2] = ["friction.law = epp", "friction.stiffness = 1e8 N/m^2"];

#[test]
fn a_crossed_belt_is_steady_where_the_closed_form_is() {
    stays(example("crossed", &EPP), 240, [2e-3, 1e-2, 2e-3]);
}

#[test]
fn a_loop_with_an_idler_on_the_back_is_steady_where_the_closed_form_is() {
    stays(example("back-side-idler", &EPP), 240, [2e-3, 1e-2, 2e-3]);
}

#[test]
fn a_loop_with_an_idler_reaches_its_steady_state_from_rest() {
    let drive = example("back-side-idler", &EPP);
    let known = solve(&drive).unwrap();
    let axles = drive
        .pulleys
        .iter()
        .zip(&known.pulleys)
        .map(|(pulley, known)| {
            // The idler is light and turns without any load; elsewhere the load also rises with the speed, which ends the vibration.
            let per_speed = 0.01 * f64::from(known.torque != 0.0);
            let load = Load {
                torque: Schedule::ramp(
                    [0.1, 0.15],
                    [0.0, known.torque - per_speed * known.angular_speed],
                ),
                per_speed,
                is_one_way: true,
            };
            match pulley.duty {
                beltdrive::Duty::Driver(speed) => driver(Schedule::ramp([0.0, 0.1], [0.0, speed])),
                _ => loaded(if known.torque == 0.0 { 1e-4 } else { 1e-3 }, load),
            }
        });
    let axles = axles.collect();
    let mut simulation = from_rest(drive, axles, 120, 1.0);
    simulation.axial_damping = 0.3;
    let history = follow(&simulation);
    let last = history.samples.last().unwrap();
    for (tension, span) in last.tensions.iter().zip(&known.spans) {
        assert!((tension / span.tension - 1.0).abs() < 5e-3, "{last:?}");
    }
    for (pulley, known) in last.pulleys.iter().zip(&known.pulleys) {
        assert!(
            (pulley.angular_speed / known.angular_speed - 1.0).abs() < 1e-4,
            "{last:?}"
        );
        assert!((pulley.torque - known.torque).abs() < 0.1, "{last:?}");
    }
    println!("{last:?} {:?}", history.effort);
    assert!(history.events.is_empty(), "{:?}", history.events);
}
