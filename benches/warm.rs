//! How long does a steady state take from that of a neighbouring load?

use beltdrive::{Drive, SolveOptions, examples, input, solve, solve_from};
use criterion::{BenchmarkId, Criterion};
use std::hint::black_box;

/// Friction law and tight tractive tension in N; the neighbour carries 2 % less.
const LOADS: [(&str, f64); 5] = [
    ("coulomb", 700.0),
    ("coulomb", 3000.0),
    ("coulomb", 7700.0),
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
    let mut group = criterion.benchmark_group("drive, warm");
    for (law, tight) in LOADS {
        let options = SolveOptions { tolerance: 1e-6 };
        let neighbour = solve(&drive(law, 0.98 * tight), &options);
        let neighbour = neighbour.expect("a load that the drive carries");
        let drive = drive(law, tight);
        group.bench_function(BenchmarkId::new(law, format!("{tight} N")), |b| {
            b.iter(|| {
                let state = solve_from(&neighbour, black_box(&drive), &options);
                state.expect("a load that the drive carries")
            });
        });
    }
    group.finish();
    criterion.final_summary();
}
