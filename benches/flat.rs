//! How long does the steady state of a flat-belt drive take, in closed form, with its profiles and
//! checks, and as a boundary value problem?

use beltdrive::flat::{BoundaryValue, ClosedForm};
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

fn boundary_value(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("flat, boundary value problem");
    let options = SolveOptions::default();
    for statement in DRIVES {
        let (drive, name) = (drive(statement), name(statement));
        group.bench_function(name, |b| {
            b.iter(|| BoundaryValue::new(black_box(&drive), &options).expect("a solution"));
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

fn name((law, convention, entry): (&str, &str, &str)) -> BenchmarkId {
    BenchmarkId::new(format!("{law}, {convention}"), entry)
}

criterion::criterion_group!(benches, closed_form, boundary_value, state, whole_range);
criterion::criterion_main!(benches);
