//! How long does the steady state of a flat-belt drive take, in closed form, and with its profiles and
//! checks? And that of a loop of many pulleys?

use beltdrive::belt_loop;
use beltdrive::flat::ClosedForm;
use beltdrive::input::Key;
use beltdrive::{
    Belt, BeltKind, Closure, Drive, Duty, FrictionLaw, Guide, Mount, NormalForce, Pulley, Sense,
    Side, SolveOptions, Tensioner, TensionerLoad, examples, input, limits, solve, stability,
};
use criterion::{BenchmarkId, Criterion};
use std::hint::black_box;

/// Friction law, convention, and what else is other than in the drive of the thesis.
const DRIVES: [(&str, &str, &str); 7] = [
    ("epp", "thesis", "load.tight_tension=800 N"),
    ("epp", "inertia", "load.tight_tension=800 N"),
    ("epp", "exact", "load.tight_tension=800 N"),
    ("epp", "inertia", "load.tight_tension=8 kN"),
    ("epp", "inertia", "friction.stiffness=8.1e9 N/m^2"),
    ("coulomb", "inertia", "load.tight_tension=800 N"),
    ("creep-rate", "inertia", "load.tight_tension=800 N"),
];

/// The flat-belt drive of the thesis with a friction law, a convention and an entry.
fn drive((law, convention, entry): (&str, &str, &str)) -> Drive {
    let text = examples::find("kim2009-flat")
        .expect("a shipped example")
        .text;
    let overrides = [
        format!("friction.law={law}"),
        format!("model.normal_force={convention}"),
        entry.to_owned(),
    ];
    input::parse("kim2009-flat.toml", text, &overrides).expect("a valid drive file")
}

fn closed_form(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("flat, closed form");
    for statement in DRIVES {
        let (drive, name) = (drive(statement), name(statement));
        group.bench_function(name, |b| {
            b.iter(|| ClosedForm::new(black_box(&drive)).expect("a load that the drive carries"));
        });
    }
    group.finish();
}

fn state(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("flat, with profiles and checks");
    for statement in [DRIVES[1], DRIVES[4]] {
        let (drive, name) = (drive(statement), name(statement));
        let options = SolveOptions::default();
        group.bench_function(name, |b| {
            b.iter(|| solve(black_box(&drive), &options).expect("a load that the drive carries"));
        });
    }
    group.finish();
}

fn whole_range(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("flat, whole range");
    group.sample_size(10);
    let drive = drive(DRIVES[1]);
    let (key, options) = (Key::load(&drive), SolveOptions::default());
    group.bench_function("limits", |b| {
        b.iter(|| limits(black_box(&drive), &key, &options, &mut |_, _| {}).expect("a range"));
    });
    group.bench_function("stability, 12 modes", |b| {
        b.iter(|| stability(black_box(&drive), 12, &mut |_, _| {}).expect("a spectrum"));
    });
    group.finish();
}

/// Eight pulleys on a circle, two of them idlers on the back of the belt, one of these on a tensioner: radius,
/// distance from the middle, both in m, and torque in N·m.
const PULLEYS: [[f64; 3]; 8] = [
    [0.08, 0.3, 0.0],
    [0.03, 0.25, 0.0],
    [0.04, 0.3, 8.0],
    [0.05, 0.3, 3.0],
    [0.06, 0.3, 12.0],
    [0.035, 0.27, 0.0],
    [0.045, 0.3, 2.0],
    [0.05, 0.3, 5.0],
];
const IDLERS: [usize; 2] = [1, 5];

/// A loop of eight pulleys that is closed by where its tensioner rests.
fn eight_pulleys(law: FrictionLaw, normal_force: NormalForce) -> Drive {
    let mut angle: f64 = 0.0;
    let pulley = |(index, [radius, distance, torque]): (usize, [f64; 3])| {
        let centre = [distance * angle.cos(), distance * angle.sin()];
        angle += std::f64::consts::FRAC_PI_4;
        let duty = match index {
            0 => Duty::Driver(300.0),
            _ => Duty::Torque(torque),
        };
        Pulley {
            side: match IDLERS.contains(&index) {
                true => Side::Outside,
                false => Side::Inside,
            },
            ..Pulley::new(&format!("pulley {index}"), centre, radius, 0.8, duty)
        }
    };
    let mut pulleys: Vec<_> = PULLEYS.into_iter().enumerate().map(pulley).collect();
    let rest = -std::f64::consts::FRAC_PI_4;
    let length = 0.08;
    let [tensioner, _] = IDLERS;
    if let Mount::Fixed([x, y]) = pulleys[tensioner].mount {
        pulleys[tensioner].mount = Mount::Tensioner(Tensioner {
            guide: Guide::Rotary {
                pivot: [x - length * rest.cos(), y - length * rest.sin()],
                arm_length: length,
            },
            load: TensionerLoad::Spring {
                stiffness: 40.0,
                free_coordinate: rest - 0.6,
            },
            start_coordinate: rest,
            travel: None,
        });
    }
    Drive {
        title: None,
        belt: Belt {
            ribs: 1,
            mass_per_length: 0.12,
            axial_stiffness: 1e5,
            kind: BeltKind::Flat { normal_force },
        },
        law,
        sense: Sense::CounterClockwise,
        turning_number: 1,
        pulleys,
        closure: Closure::RestCoordinate(rest),
    }
}

/// Eight pulleys by torques and tensioner, with their load limit and checks.
fn loops(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("flat, loop of 8 pulleys with tensioner");
    let laws = [
        ("coulomb", FrictionLaw::Coulomb),
        ("epp", FrictionLaw::Epp { stiffness: 1e8 }),
        ("creep-rate", FrictionLaw::CreepRate { velocity: 0.03 }),
    ];
    for (name, law) in laws {
        for normal_force in [NormalForce::Inertia, NormalForce::Exact] {
            let drive = eight_pulleys(law, normal_force);
            group.bench_function(BenchmarkId::new(name, normal_force.name()), |b| {
                b.iter(|| belt_loop::solve(black_box(&drive)).expect("a load that it carries"));
            });
        }
    }
    let thesis = eight_pulleys(FrictionLaw::Coulomb, NormalForce::Thesis);
    group.bench_function(BenchmarkId::new("coulomb", "thesis"), |b| {
        b.iter(|| belt_loop::solve(black_box(&thesis)).expect("a load that it carries"));
    });
    group.finish();
}

fn name((law, convention, entry): (&str, &str, &str)) -> BenchmarkId {
    BenchmarkId::new(format!("{law}, {convention}"), entry)
}

criterion::criterion_group!(benches, closed_form, state, loops, whole_range);
criterion::criterion_main!(benches);
