//! Bad statements, each refused for what is wrong with it.

use super::{driver, from_rest, kim, loaded};
use beltdrive::transient::{
    Cells, Load, Motion, Motor, Pluck, Schedule, Simulation, Start, StepBound, TransientError,
    Transverse, Until,
};
use beltdrive::{BeltKind, Closure, FrictionLaw, VBelt, simulate};

fn right() -> Simulation {
    let axles = vec![
        driver(Schedule::ramp([0.0, 0.01], [0.0, 10.0])),
        loaded(0.005, Load::new(Schedule::constant(1.0))),
    ];
    from_rest(kim(2.0e8, 5.45e-3, 1.0), axles, 40, 0.002)
}

#[track_caller]
fn error(change: impl FnOnce(&mut Simulation)) -> TransientError {
    let mut simulation = right();
    change(&mut simulation);
    simulate(&simulation, &mut |_, _| true).unwrap_err()
}

fn load(simulation: &mut Simulation) -> (&mut Option<Motor>, &mut Load) {
    match &mut simulation.axles[1].motion {
        Motion::Torques { motor, load } => (motor, load),
        Motion::Speed(_) => panic!("a load"),
    }
}

#[test]
fn what_is_out_of_range_is_refused_with_its_reason() {
    simulate(&right(), &mut |_, _| true).unwrap();
    type Change = fn(&mut Simulation);
    let cases: [(Change, &str); 23] = [
        (
            |wrong| wrong.axles[1].inertia = -0.005,
            "driven: the moment of inertia",
        ),
        (
            |wrong| wrong.axles[1].inertia = 0.0,
            "driven: the moment of inertia",
        ),
        (
            |wrong| wrong.axles[0].inertia = -1.0,
            "driver: the moment of inertia must not be negative",
        ),
        (|wrong| drop(wrong.axles.pop()), "one for every pulley"),
        (|wrong| wrong.axial_damping = -0.1, "axial damping"),
        (|wrong| wrong.cells = Cells::Total(0), "cells"),
        (
            |wrong| wrong.cells = Cells::Each { arc: 3, span: 10 },
            "cells",
        ),
        (|wrong| wrong.until = Until::Time(0.0), "end"),
        (|wrong| wrong.interval = -1.0, "interval"),
        (|wrong| wrong.interval = 1e-12, "interval"),
        (|wrong| wrong.instants = vec![1.0], "instants"),
        (|wrong| wrong.step = Some(0.0), "step"),
        (
            |wrong| wrong.axles[0] = driver(Schedule::step(0.001, [0.0, 10.0])),
            "driver: its speed must not jump, as it does at 0.001 s",
        ),
        (
            |wrong| wrong.axles[0] = driver(Schedule::constant(10.0)),
            "driver: a drive at rest cannot start with a speed of 10 rad/s",
        ),
        (
            |wrong| wrong.start = Start::Running,
            "driver: its speed starts with 0 rad/s, but the running drive has 120 rad/s",
        ),
        (
            |wrong| *load(wrong).0 = Some(Motor::Characteristic(Schedule::step(50.0, [10.0, 0.0]))),
            "driven: the torque of its motor must not jump over the speed, as it does at 50 rad/s",
        ),
        (
            |wrong| load(wrong).1.per_speed = -1.0,
            "driven: the torque per speed",
        ),
        (
            |wrong| load(wrong).1.torque = Schedule::constant(f64::NAN),
            "driven: the points of what it is given",
        ),
        (
            |wrong| load(wrong).1.torque = Schedule::pulse([2.0, 1.0], [0.0, 1.0]),
            "driven: the points of what it is given",
        ),
        (
            |wrong| *load(wrong).0 = Some(Motor::line(f64::INFINITY, 100.0)),
            "driven: the points of what it is given",
        ),
        (
            |wrong| wrong.axles[0] = driver(Schedule::ramp([1.0, 0.0], [0.0, 10.0])),
            "driver: the points of what it is given",
        ),
        (
            |wrong| (wrong.until, wrong.interval) = (Until::Time(1e6), 1e-3),
            "interval: 1e9 samples, one every 1e-3 s up to 1000000 s, are more than 1e6",
        ),
        (
            |wrong| {
                let mut across = Transverse::free(2);
                across.plucks[1] = Some(Pluck {
                    amplitude: 1e-6,
                    mode: 100,
                });
                wrong.transverse = Some(across);
            },
            "driven: 100 half waves of a pluck need two cells each",
        ),
    ];
    for (change, words) in cases {
        let found = error(change);
        assert!(matches!(found, TransientError::Statement { .. }), "{found}");
        assert!(found.to_string().contains(words), "{found}\n{words}");
    }
}

#[test]
fn what_is_not_modelled_is_refused() {
    let found = error(|wrong| {
        wrong.drive.law = FrictionLaw::CreepRate { velocity: 0.1 };
        wrong.friction_damping = 1.0;
    });
    assert!(found.to_string().contains("has no bristles"), "{found}");
    let found = error(|wrong| wrong.drive.law = FrictionLaw::Coulomb);
    assert!(found.to_string().contains("`epp`"), "{found}");
    let found = error(|wrong| {
        wrong.drive.belt.kind = BeltKind::V(VBelt {
            radial_stiffness: 1e6,
            half_angle: 0.3,
            height: None,
        });
    });
    assert!(found.to_string().contains("`bristle`"), "{found}");
}

#[test]
fn a_slack_belt_and_an_unstable_step_are_refused() {
    let found = error(|wrong| wrong.drive.closure = Closure::UnstretchedLength(1.02));
    assert!(matches!(found, TransientError::Start(_)), "{found}");
    assert!(found.to_string().contains("slack at rest"), "{found}");
    let found = error(|wrong| wrong.step = Some(1e-15));
    let TransientError::TooManySteps { steps, bound, .. } = found else {
        panic!("{found}")
    };
    assert!((steps / 2e12 - 1.0).abs() < 1e-9, "{steps}");
    assert_eq!(bound, StepBound::Asked);
    let found = error(|wrong| wrong.step = Some(1e-4));
    let TransientError::Unstable { stable, .. } = found else {
        panic!("{found}")
    };
    let mut shorter = right();
    shorter.step = Some(0.5 * stable);
    let history = simulate(&shorter, &mut |_, _| true).unwrap();
    assert!(history.effort.step[1] <= 0.5 * stable);
}

#[test]
fn tables_are_read_in_order() {
    assert_eq!(
        Schedule::table(vec![[0.0, 1.0], [2.0, 3.0], [1.0, 2.0]]),
        None
    );
    assert_eq!(Schedule::table(vec![]), None);
    assert_eq!(Schedule::table(vec![[0.0, f64::NAN]]), None);
    let table = Schedule::table(vec![[1.0, 1.0], [2.0, 3.0], [2.0, 5.0]]).unwrap();
    let at = |time| table.at(time);
    assert_eq!(
        [0.0, 1.5, 1.75, 2.0, 9.0].map(at),
        [1.0, 2.0, 2.5, 5.0, 5.0]
    );
    assert_eq!(table.first_jump(), Some(2.0));
    let pulse = Schedule::pulse([1.0, 2.0], [3.0, 4.0]);
    assert_eq!(
        [0.5, 1.0, 1.5, 2.0].map(|time| pulse.at(time)),
        [3.0, 4.0, 4.0, 3.0]
    );
}
