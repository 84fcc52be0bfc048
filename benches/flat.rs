//! How long does the steady state of a flat-belt drive take, in closed form, and with its profiles and
//! checks? And that of a loop of many pulleys?

use beltdrive::belt_loop;
use beltdrive::flat::ClosedForm;
use beltdrive::input::Key;
use beltdrive::{Drive, SolveOptions, examples, input, limits, solve, stability};
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

/// A loop of eight pulleys that is closed by where its tensioner rests, with a friction law and its parameter, and a
/// convention.
fn eight_pulleys(law: &str, parameter: Option<&str>, convention: &str) -> Drive {
    let text = include_str!("../beltdrive/tests/drives/eight-pulleys.toml");
    let friction = [format!("law={law}")].into_iter();
    let friction = friction.chain(parameter.map(str::to_owned));
    let overrides = friction.map(|entry| format!("friction.{entry}"));
    let overrides: Vec<_> = overrides
        .chain([format!("model.normal_force={convention}")])
        .collect();
    input::parse("eight-pulleys.toml", text, &overrides).expect("a valid drive file")
}

/// Eight pulleys by torques and tensioner, with their load limit and checks.
fn loops(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("flat, loop of 8 pulleys with tensioner");
    let laws = [
        ("coulomb", None),
        ("epp", Some("stiffness=1e8 N/m^2")),
        ("creep-rate", Some("velocity=0.03 m/s")),
    ];
    let conventions = laws.map(|law| [(law, "inertia"), (law, "exact")]);
    let thesis = (laws[0], "thesis");
    for ((law, parameter), convention) in conventions.into_iter().flatten().chain([thesis]) {
        let drive = eight_pulleys(law, parameter, convention);
        group.bench_function(BenchmarkId::new(law, convention), |b| {
            b.iter(|| belt_loop::solve(black_box(&drive)).expect("a load that it carries"));
        });
    }
    group.finish();
}

fn name((law, convention, entry): (&str, &str, &str)) -> BenchmarkId {
    BenchmarkId::new(format!("{law}, {convention}"), entry)
}

criterion::criterion_group!(benches, closed_form, state, loops, whole_range);
criterion::criterion_main!(benches);
