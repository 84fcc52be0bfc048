//! The time steps of a run allocate nothing: more steps between the same number of samples allocate no more.
//!
//! A program of one thread, since the thread of a test harness allocates at times of its own.

use beltdrive::transient::{
    Axle, Cells, Effort, Load, Motion, Pluck, RunOut, Schedule, Simulation, Start, Transverse,
    Until,
};
use beltdrive::{
    Belt, BeltKind, Closure, Drive, Duty, FrictionLaw, NormalForce, Pulley, Sense, simulate,
};

/// The allocator of the system, which counts.
#[global_allocator]
static ALLOCATOR: dhat::Alloc = dhat::Alloc;

/// Samples of every run after the first.
const SAMPLES: f64 = 30.0;

/// A driver at a speed and a pulley whose load changes at 5 ms, with some intervals between samples in s.
fn run(interval: f64) -> Simulation {
    let pulley = |name, x, duty| Pulley::new(name, [x, 0.0], 0.08125, 1.2, duty);
    let axial_stiffness = 80_068.0;
    let load = Load::new(Schedule::step(0.005, [30.0, 35.0]));
    Simulation {
        drive: Drive {
            title: None,
            belt: Belt {
                mass_per_length: 0.1036,
                axial_stiffness,
                kind: BeltKind::Flat {
                    normal_force: NormalForce::Exact,
                },
                ribs: 1,
            },
            law: FrictionLaw::Epp { stiffness: 2e8 },
            sense: Sense::CounterClockwise,
            turning_number: 1,
            pulleys: vec![
                pulley("driver", 0.0, Duty::Driver(120.0)),
                pulley("driven", 0.25, Duty::Torque(30.0)),
            ],
            closure: Closure::SetupTension(5.45e-3 * axial_stiffness),
        },
        axles: vec![
            Axle {
                inertia: 0.01,
                motion: Motion::Speed(Schedule::constant(120.0)),
            },
            Axle {
                inertia: 0.005,
                motion: Motion::Torques { motor: None, load },
            },
        ],
        axial_damping: 0.1,
        friction_damping: 0.0,
        transverse: None,
        start: Start::Running,
        cells: Cells::Total(60),
        until: Until::Time(SAMPLES * interval),
        interval,
        instants: vec![],
        frames: 0,
        step: None,
    }
}

/// Allocations and bytes of a run, and its work.
fn cost(simulation: &Simulation) -> ([u64; 2], Effort) {
    let counted = || {
        let stats = dhat::HeapStats::get();
        [stats.total_blocks, stats.total_bytes]
    };
    let before = counted();
    let history = simulate(simulation, &mut |_, _| true).unwrap();
    let after = counted();
    assert_eq!(history.samples.len() as f64, SAMPLES + 1.0);
    assert!(history.events.is_empty(), "{:?}", history.events);
    let cost = [after[0] - before[0], after[1] - before[1]];
    (cost, history.effort)
}

/// Costs of a short run and of one with longer intervals, for which `work` counts more steps.
#[track_caller]
fn assert_steps_allocate_nothing([short, long]: [Simulation; 2], work: impl Fn(&Effort) -> usize) {
    // What is computed once is computed here.
    cost(&short);
    let (few, few_steps) = cost(&short);
    let (many, many_steps) = cost(&long);
    assert!(
        work(&many_steps) >= work(&few_steps) + 30,
        "{few_steps:?} {many_steps:?}"
    );
    assert_eq!(few, many, "{few_steps:?} {many_steps:?}");
}

fn main() {
    let _profiler = dhat::Profiler::builder().testing().build();
    let intervals = [1e-3, 3e-3];

    assert_steps_allocate_nothing(intervals.map(run), |effort| effort.steps);

    let across = intervals.map(|interval| Simulation {
        transverse: Some(Transverse {
            damping: 1.0,
            gravity: [0.0, -9.81],
            plucks: vec![
                Some(Pluck {
                    amplitude: 1e-4,
                    mode: 1,
                }),
                None,
            ],
            run_outs: vec![
                None,
                Some(RunOut {
                    amplitude: 1e-5,
                    order: 1,
                }),
            ],
        }),
        ..run(interval)
    });
    assert_steps_allocate_nothing(across, |effort| effort.steps);

    let steady = intervals.map(|interval| Simulation {
        until: Until::Steady {
            latest: SAMPLES * interval,
        },
        ..run(interval)
    });
    assert_steps_allocate_nothing(steady.clone(), |effort| effort.implicit.steps);
    assert_steps_allocate_nothing(steady, |effort| effort.implicit.factorisations);
}
