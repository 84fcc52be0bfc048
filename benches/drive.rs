//! How long does the steady state of a drive take, from nothing but the drive file?

use beltdrive::{Drive, SolveOptions, examples, input, solve};
use criterion::{BenchmarkId, Criterion};
use std::hint::black_box;

/// Friction law and tight tractive tension in N. The thesis carries 700 N; 105 N is just above the
/// slack tension, 7781.2 N close to the limit of the Coulomb drive.
const LOADS: [(&str, f64); 6] = [
    ("coulomb", 105.0),
    ("coulomb", 700.0),
    ("coulomb", 3000.0),
    ("coulomb", 7781.2),
    ("epp", 700.0),
    ("bristle", 700.0),
];

/// The drive of the thesis with a friction law and a load.
fn drive(law: &str, tight: f64) -> Drive {
    let text = examples::find("kim2009").expect("a shipped example").text;
    let overrides = [
        format!("friction.law={law}"),
        format!("load.tight_tractive_tension={tight} N"),
    ];
    input::parse("kim2009.toml", text, &overrides).expect("a valid drive file")
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("drive, cold");
    for (law, tight) in LOADS {
        let (drive, options) = (drive(law, tight), SolveOptions { tolerance: 1e-6 });
        group.bench_function(BenchmarkId::new(law, format!("{tight} N")), |b| {
            b.iter(|| solve(black_box(&drive), &options).expect("a load that the drive carries"));
        });
    }
    group.finish();
    criterion.final_summary();
}
