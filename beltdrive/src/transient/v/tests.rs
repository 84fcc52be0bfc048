//! A V-belt on the mesh keeps its length.

use super::super::axle::{Axle, Load, Motion};
use super::super::dynamics::Dynamics;
use super::super::explicit::{Explicit, stable_step};
use super::super::schedule::Schedule;
use super::super::simulation::{Cells, Simulation, Start, Until};
use super::initial;
use super::rates::Rates;
use crate::{BeltKind, belt_loop, examples, input};

#[test]
fn the_unstretched_length_is_kept_while_a_load_rises_from_rest() {
    let example = examples::find("kim2009-bristle").expect("a shipped example");
    let drive = input::parse(example.name, example.text, &[]).expect("a drive");
    let BeltKind::V(belt) = drive.belt.kind else {
        panic!("a V-belt was expected");
    };
    let load = Load::new(Schedule::ramp([0.0, 0.05], [0.0, 100.0]));
    let motor = None;
    let axles = [
        Motion::Speed(Schedule::ramp([0.0, 0.05], [0.0, 50.0])),
        Motion::Torques { motor, load },
    ];
    let simulation = Simulation {
        axles: axles
            .map(|motion| Axle {
                inertia: 0.1,
                motion,
            })
            .into(),
        axial_damping: 1.0,
        friction_damping: 0.0,
        start: Start::Rest,
        cells: Cells::Total(60),
        until: Until::Time(0.1),
        interval: 1e-3,
        instants: vec![],
        frames: 0,
        step: None,
        transverse: None,
        drive,
    };
    let found = belt_loop::solve(&simulation.drive).expect("a steady state");
    let system = initial::system(&simulation, &belt, &found).expect("a system");
    let mut rates = Rates::new(&system);
    let mut state = initial::at_rest(&mut rates, &found).expect("a state");
    let length = |state: &[f64]| system.unstretched_length(state);
    assert!((length(&state) / found.unstretched_length - 1.0).abs() < 1e-13);
    let mut explicit = Explicit::new(state.len());
    rates.begin(0.0);
    let mut time = 0.0;
    while time < 0.1 {
        explicit.rates(&mut rates, time, &mut state);
        let step = stable_step(&rates, &state);
        explicit.step(&mut rates, time, step, &mut state);
        time += step;
    }
    assert!((length(&state) / found.unstretched_length - 1.0).abs() < 1e-12);
    assert!(
        rates
            .axles()
            .torque
            .iter()
            .any(|torque| torque.abs() > 50.0)
    );
}
