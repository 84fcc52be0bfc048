//! V-belts in time against the steady state of the boundary value problem.

use super::super::axle::{Axle, Load, Motion};
use super::super::explicit::{Explicit, SAFETY, STABLE};
use super::super::schedule::Schedule;
use super::super::simulation::{Cells, Simulation, Start, Until};
use super::initial;
use super::rates::Rates;
use crate::belt_loop::LoopState;
use crate::{BeltKind, Closure, Drive, belt_loop, examples, input};

fn drive() -> Drive {
    let example = examples::find("kim2009-bristle").expect("a shipped example");
    input::parse(example.name, example.text, &[]).expect("a drive")
}

fn simulation(drive: &Drive, cells: usize, speed: Schedule, load: Schedule) -> Simulation {
    let axle = |name: &str| match name {
        "driver" => Axle {
            inertia: 0.1,
            motion: Motion::Speed(speed.clone()),
        },
        _ => Axle {
            inertia: 0.05,
            motion: Motion::Torques {
                motor: None,
                load: Load::new(load.clone()),
            },
        },
    };
    Simulation {
        axles: { drive.pulleys.iter() }
            .map(|pulley| axle(&pulley.name))
            .collect(),
        drive: drive.clone(),
        axial_damping: 1.0,
        start: Start::Running,
        cells: Cells::Total(cells),
        until: Until::Time(1.0),
        interval: 1e-3,
        instants: vec![],
        frames: 0,
        step: None,
        transverse: None,
    }
}

/// What a run ends with.
#[derive(Debug)]
struct End {
    /// Tension of the slack and the tight span, N.
    tensions: [f64; 2],
    /// Speed of the driven pulley, rad/s, and the torques of the belt on both, N·m.
    speed: f64,
    torques: [f64; 2],
    /// Energy that is not accounted for and work of all axles without regard to sign, J.
    residual: f64,
    turnover: f64,
    /// Relative change of the unstretched length.
    lost: f64,
}

fn run(found: &LoopState, simulation: &Simulation, end: f64) -> End {
    let drive = &simulation.drive;
    let BeltKind::V(belt) = drive.belt.kind else {
        panic!("a V-belt was expected");
    };
    let system = initial::system(simulation, drive, &belt, found).expect("a system");
    let mut rates = Rates::new(&system);
    let start = match simulation.start {
        Start::Rest => initial::at_rest(&mut rates, found),
        Start::Running => initial::running(&mut rates, found),
    };
    let mut state = start.expect("a state");
    let parts = &system.parts;
    let mut explicit = Explicit::with_room(parts.len());
    rates.begin(0.0);
    explicit.rates(&mut rates, 0.0, &mut state);
    let energy = system.energy(&state, &rates.lengths);
    let length = system.unstretched_length(&state);
    let mut time = 0.0;
    while time < end {
        let corners = system
            .wheels
            .iter()
            .map(|wheel| wheel.axle.next_corner(time));
        let stop = corners.fold(end, f64::min);
        let step = (SAFETY * STABLE / rates.fastest(&state)).min(stop - time);
        explicit.step(&mut rates, time, step, &mut state);
        time = if step < stop - time {
            time + step
        } else {
            stop
        };
        rates.begin(time);
        explicit.rates(&mut rates, time, &mut state);
    }
    let stored = system.energy(&state, &rates.lengths) - energy;
    let work: f64 = state[parts.work.clone()].iter().sum();
    let spent = state[parts.damped] + state[parts.friction] + state[parts.compression];
    let driven = drive
        .pulleys
        .iter()
        .position(|pulley| pulley.name == "driven");
    let driven = driven.expect("a driven pulley");
    let tension = |span: usize| {
        let span = &system.mesh.spans[span];
        system.tension(rates.stretches()[(span.start + span.end) / 2])
    };
    let mut tensions = [0, 1].map(tension);
    tensions.sort_by(f64::total_cmp);
    let end = End {
        tensions,
        speed: state[parts.speed.start + driven],
        torques: [rates.torque[driven], rates.torque[1 - driven]],
        residual: work - stored - spent,
        turnover: energy + state[parts.turnover],
        lost: system.unstretched_length(&state) / length - 1.0,
    };
    println!("{} cells: {end:?}", system.mesh.cells());
    end
}

/// Torque that the driven pulley takes in a steady state, N·m, and the speed of the driver, rad/s.
fn known(found: &LoopState) -> [f64; 2] {
    let find = |name: &str| found.pulleys.iter().find(|pulley| pulley.name == name);
    let [driven, driver] = ["driven", "driver"].map(|name| find(name).expect("a pulley"));
    [driven.torque, driver.angular_speed]
}

fn steady(cells: usize, end: f64) -> [f64; 2] {
    let drive = drive();
    let found = belt_loop::solve(&drive).expect("a steady state");
    let [torque, speed] = known(&found);
    let [speed, load] = [speed, torque].map(Schedule::constant);
    let ended = run(&found, &simulation(&drive, cells, speed, load), end);
    assert!((ended.torques[0] / torque - 1.0).abs() < 1e-6);
    assert!(ended.residual.abs() < 1e-7 * ended.turnover && ended.lost.abs() < 1e-12);
    let tight = found
        .spans
        .iter()
        .map(|span| span.tension)
        .fold(0.0, f64::max);
    let slowest = found
        .pulleys
        .iter()
        .map(|pulley| pulley.angular_speed)
        .fold(f64::INFINITY, f64::min);
    [ended.tensions[1] - tight, ended.speed - slowest]
}

#[test]
fn a_running_belt_stays_near_the_steady_state_and_loses_no_energy() {
    let [tension, speed] = steady(120, 0.3);
    // 771.4 N and 102.6 rad/s.
    assert!(
        tension.abs() < 5.0 && speed.abs() < 0.13,
        "{tension} {speed}"
    );
}

#[test]
#[ignore = "a minute"]
fn the_steady_state_is_that_of_the_boundary_value_problem_to_second_order() {
    let [coarse, fine] = [240, 480].map(|cells| steady(cells, 0.35));
    println!("{coarse:?} {fine:?}");
    assert!(coarse[0].abs() < 0.3 && fine[0].abs() < 0.25 * coarse[0].abs());
}

#[test]
fn a_step_of_the_load_ends_with_the_torque_asked_for() {
    let drive = drive();
    let found = belt_loop::solve(&drive).expect("a steady state");
    let [torque, speed] = known(&found);
    let load = Schedule::step(0.05, [torque, 0.8 * torque]);
    let asked = simulation(&drive, 120, Schedule::constant(speed), load);
    let ended = run(&found, &asked, 0.35);
    assert!((ended.torques[0] / torque - 0.8).abs() < 1e-4);
    assert!(ended.residual.abs() < 1e-7 * ended.turnover && ended.lost.abs() < 1e-12);
}

#[test]
#[ignore = "ten seconds"]
fn from_rest_the_belt_comes_to_the_state_in_which_a_running_one_stays() {
    let drive = drive();
    let found = belt_loop::solve(&drive).expect("a steady state");
    let [torque, speed] = known(&found);
    let constant = |load| simulation(&drive, 120, Schedule::constant(speed), load);
    let running = run(&found, &constant(Schedule::constant(torque)), 0.5);
    let load = Schedule::ramp([0.2, 0.3], [0.0, torque]);
    let from_rest = Simulation {
        start: Start::Rest,
        ..simulation(&drive, 120, Schedule::ramp([0.0, 0.2], [0.0, speed]), load)
    };
    let ended = run(&found, &from_rest, 1.0);
    assert!((ended.speed / running.speed - 1.0).abs() < 1e-6);
    assert!((ended.tensions[1] / running.tensions[1] - 1.0).abs() < 1e-5);
    assert!(ended.residual.abs() < 1e-6 * ended.turnover && ended.lost.abs() < 1e-12);
}

#[test]
#[ignore = "half a minute"]
fn holding_the_ends_of_the_contacts_costs_what_the_distance_of_the_load_makes_it() {
    let drive = drive();
    let found = belt_loop::solve(&drive).expect("a steady state");
    let [torque, speed] = known(&found);
    let off = [0.8, 0.5].map(|share| {
        let load = Schedule::constant(share * torque);
        let asked = simulation(&drive, 240, Schedule::constant(speed), load);
        let ended = run(&found, &asked, 0.3);
        let free = Drive {
            closure: Closure::UnstretchedLength(found.unstretched_length),
            ..drive.as_loop(share * torque, 100.0)
        };
        let free = belt_loop::solve(&free).expect("a steady state");
        let tension = |of: fn(f64, f64) -> f64| {
            let tensions = free.spans.iter().map(|span| span.tension);
            tensions.reduce(of).expect("a span")
        };
        let speeds = free.pulleys.iter().map(|pulley| pulley.angular_speed);
        let slowest = speeds.fold(f64::INFINITY, f64::min);
        let free = [tension(f64::min), tension(f64::max), slowest];
        let off = [ended.tensions[0], ended.tensions[1], ended.speed];
        let off = [0, 1, 2].map(|index| off[index] - free[index]);
        println!("{share} of the load: {free:?}, off by {off:?}");
        off
    });
    assert!(
        off.iter()
            .all(|off| off[0].abs() < 5.0 && off[1].abs() < 5.0 && off[2].abs() < 0.03)
    );
}
