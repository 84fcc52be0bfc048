//! How long does the steady state of a drive take, cold from nothing but the drive file, and warm
//! from that of a neighbouring load? How long a branch of them, and both limits of the load? How long a
//! V-belt round three pulleys?

use beltdrive::belt_loop;
use beltdrive::input::Key;
use beltdrive::{
    Belt, BeltKind, Closure, Drive, Duty, EventKind, FrictionLaw, Pulley, RangeEnd, Sense,
    SolveOptions, VBelt, examples, input, limits, solve, solve_from, trace,
};
use criterion::{BenchmarkId, Criterion};
use std::hint::black_box;

/// Friction law and tight tractive tension in N. The thesis carries 700 N; 105 N is just above the
/// slack tension, 7781.2 N close to the limit of the Coulomb drive.
const COLD: [(&str, f64); 6] = [
    ("coulomb", 105.0),
    ("coulomb", 700.0),
    ("coulomb", 3000.0),
    ("coulomb", 7781.2),
    ("epp", 700.0),
    ("bristle", 700.0),
];

/// The same for warm starts; the neighbour carries 2 % less.
const WARM: [(&str, f64); 5] = [
    ("coulomb", 700.0),
    ("coulomb", 3000.0),
    ("coulomb", 7700.0),
    ("epp", 700.0),
    ("bristle", 700.0),
];

/// Friction law and smallest tight tension in N of a branch: 1.02 times the slack tension with
/// bristles; three times with Coulomb friction.
const BRANCHES: [(&str, f64); 2] = [("bristle", 102.0), ("coulomb", 310.0)];
/// Where a branch would end, in N, beyond its limit point.
const BEYOND: f64 = 9000.0;

const OPTIONS: SolveOptions = SolveOptions { tolerance: 1e-6 };

/// The drive of the thesis with a friction law and a load.
fn drive(law: &str, tight: f64) -> Drive {
    let text = examples::find("kim2009").expect("a shipped example").text;
    let overrides = [
        format!("friction.law={law}"),
        format!("load.tight_tractive_tension={tight} N"),
    ];
    input::parse("kim2009.toml", text, &overrides).expect("a valid drive file")
}

fn cold(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("drive, cold");
    for (law, tight) in COLD {
        let drive = drive(law, tight);
        group.bench_function(BenchmarkId::new(law, format!("{tight} N")), |b| {
            b.iter(|| solve(black_box(&drive), &OPTIONS).expect("a load that the drive carries"));
        });
    }
    group.finish();
}

fn warm(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("drive, warm");
    for (law, tight) in WARM {
        let neighbour = solve(&drive(law, 0.98 * tight), &OPTIONS);
        let neighbour = neighbour.expect("a load that the drive carries");
        let drive = drive(law, tight);
        group.bench_function(BenchmarkId::new(law, format!("{tight} N")), |b| {
            b.iter(|| {
                let state = solve_from(&neighbour, black_box(&drive), &OPTIONS);
                state.expect("a load that the drive carries")
            });
        });
    }
    group.finish();
}

/// From little load around the limit point; behind it the branch comes back by a quarter of its way.
fn branch(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("drive, branch");
    group.sample_size(10);
    for (law, from) in BRANCHES {
        let drive = drive(law, 700.0);
        let key = Key::load(&drive);
        group.bench_function(BenchmarkId::new(law, format!("from {from} N")), |b| {
            b.iter(|| {
                let range = [from, BEYOND];
                let branch = trace(black_box(&drive), &key, range, &OPTIONS, &mut |_, _| {});
                let branch = branch.expect("a load that the drive carries");
                let mut events = branch.events.iter();
                assert!(events.any(|event| event.kind == EventKind::LimitPoint));
                branch
            });
        });
    }
    group.finish();
}

/// The smallest and the largest load.
fn both_limits(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("drive, limits");
    group.sample_size(10);
    for (law, _) in BRANCHES {
        let drive = drive(law, 700.0);
        let key = Key::load(&drive);
        group.bench_function(BenchmarkId::new(law, "tight tension"), |b| {
            b.iter(|| {
                let limits = limits(black_box(&drive), &key, &OPTIONS, &mut |_, _| {});
                let limits = limits.expect("a load that the drive carries");
                assert!(matches!(limits.largest.reason, RangeEnd::Limit(_)));
                limits
            });
        });
    }
    group.finish();
}

/// A driver, a fan and an alternator, set up with 500 N.
fn accessories(law: FrictionLaw) -> Drive {
    let pulley = |name, centre, radius, duty| Pulley::new(name, centre, radius, 0.4, duty);
    Drive {
        title: None,
        belt: Belt {
            mass_per_length: 0.1,
            axial_stiffness: 60e3,
            ribs: 1,
            kind: BeltKind::V(VBelt {
                radial_stiffness: 3e7,
                half_angle: 18_f64.to_radians(),
                height: None,
            }),
        },
        law,
        sense: Sense::Clockwise,
        turning_number: 1,
        pulleys: vec![
            pulley("driver", [0.0, 0.0], 0.08, Duty::Driver(200.0)),
            pulley("alternator", [-0.15, 0.3], 0.035, Duty::Torque(4.0)),
            pulley("fan", [0.2, 0.35], 0.06, Duty::Torque(8.0)),
        ],
        closure: Closure::SetupTension(500.0),
    }
}

/// Three pulleys, cold.
fn three_pulleys(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("loop, cold");
    for law in [
        FrictionLaw::Bristle { stiffness: 1500.0 },
        FrictionLaw::Coulomb,
    ] {
        let drive = accessories(law);
        group.bench_function(BenchmarkId::new(law.name(), "3 pulleys"), |b| {
            b.iter(|| {
                let state = belt_loop::solve_to(black_box(&drive), &OPTIONS);
                state.expect("a load that the loop carries")
            });
        });
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    cold(&mut criterion);
    warm(&mut criterion);
    branch(&mut criterion);
    both_limits(&mut criterion);
    three_pulleys(&mut criterion);
    criterion.final_summary();
}
