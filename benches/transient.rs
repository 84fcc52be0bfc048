//! How long does a second of a flat belt in time take, start-up and load step included? How long its way from rest to
//! the steady state? How long a tenth of a second of a V-belt with a load step?

use beltdrive::input::DriveFile;
use beltdrive::transient::{Cells, Ending, History, Load, Motion, Schedule, Simulation, Until};
use beltdrive::{examples, simulate};
use criterion::{BenchmarkId, Criterion};
use std::hint::black_box;

/// The drive of Kim (2009), table 2, at a setup strain of 5.45e-3.
const DRIVE: &str = include_str!("exudyn/load-step.toml");

/// Tight tension in N and speed of the driven pulley in rad/s of its steady state at 45 N·m: the closed form.
const STEADY: [f64; 2] = [728.282_801_3, 119.177_200_5];

/// The drive with a speed of the driver in rad/s and a load of the driven pulley in N·m over time.
fn simulation(speed: Schedule, torque: Schedule) -> Simulation {
    let file = DriveFile::read("load-step.toml", DRIVE, &[]).expect("a valid drive file");
    let mut simulation = file.simulation(None).expect("a drive in time");
    simulation.interval = 1e-3;
    simulation.axles[0].motion = Motion::Speed(speed);
    simulation.axles[1].motion = Motion::Torques {
        motor: None,
        load: Load::new(torque),
    };
    simulation
}

fn follow(simulation: &Simulation) -> History {
    let history = simulate(black_box(simulation), &mut |_, _| true);
    history.expect("a drive that runs")
}

/// Start-up in 0.2 s, 30 N·m from 0.5 s, end at 1 s.
fn load_step(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("flat in time, load step over 1 s");
    group.sample_size(10);
    for cells in [240, 120] {
        let mut simulation = simulation(
            Schedule::ramp([0.01, 0.21], [0.0, 120.0]),
            Schedule::step(0.5, [0.0, 30.0]),
        );
        simulation.cells = Cells::Total(cells);
        simulation.until = Until::Time(1.0);
        group.bench_function(
            BenchmarkId::new("explicit", format!("{cells} cells")),
            |b| {
                b.iter(|| follow(&simulation));
            },
        );
    }
    group.finish();
}

/// Start-up in 20 ms, then up to 45 N·m in 10 ms, then on until nothing changes: 180 cells have the tight tension to 1e-4.
fn steady(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("flat in time, from rest to the steady state");
    group.sample_size(10);
    let mut simulation = simulation(
        Schedule::ramp([0.0, 0.02], [0.0, 120.0]),
        Schedule::ramp([0.02, 0.03], [0.0, 45.0]),
    );
    simulation.cells = Cells::Each { arc: 60, span: 30 };
    // Of the tensions it takes less than 2 mN.
    simulation.axial_damping = 0.02;
    simulation.until = Until::Steady { latest: 5.0 };
    group.bench_function(
        BenchmarkId::new("explicit, then implicit", "180 cells"),
        |b| {
            b.iter(|| {
                let history = follow(&simulation);
                assert_eq!(history.ending, Ending::Steady);
                let last = history.samples.last().expect("a sample at the end");
                let found = [last.tensions[1], last.pulleys[1].angular_speed];
                for ((found, known), error) in found.iter().zip(STEADY).zip([1e-4, 1e-6]) {
                    assert!((found / known - 1.0).abs() < error, "{found} {known}");
                }
                history
            });
        },
    );
    group.finish();
}

/// The example `v-load-step`, whose load falls by a fifth at 50 ms, up to 0.1 s.
fn v_belt(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("V-belt in time, load step over 0.1 s");
    group.sample_size(10);
    let example = examples::find("v-load-step").expect("a shipped example");
    let file = DriveFile::read(example.name, example.text, &[]).expect("a valid drive file");
    let mut simulation = file.simulation(None).expect("a drive in time");
    simulation.until = Until::Time(0.1);
    for cells in [240, 120] {
        simulation.cells = Cells::Total(cells);
        group.bench_function(
            BenchmarkId::new("explicit", format!("{cells} cells")),
            |b| {
                b.iter(|| follow(&simulation));
            },
        );
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    load_step(&mut criterion);
    steady(&mut criterion);
    v_belt(&mut criterion);
    criterion.final_summary();
}
