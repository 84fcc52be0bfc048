//! How long does a reference problem take, from its stated guess to the tolerance?

use bvp::{Options, solve};
use criterion::{BenchmarkId, Criterion};
use reference_problems::case;
use std::hint::black_box;

/// A linear layer, a turning point, the hardest oscillation, a shock, a nonlinear layer, boundary
/// layers of a fluid, a singular coefficient, an eigenvalue, a limit cycle, three points, a free
/// final time and thirty equations.
const CASES: [&str; 12] = [
    "T01b", "T06c", "T16c", "T24c", "T23c", "T32c", "E03", "E07a", "E15", "E18", "E31", "E25",
];

fn reference_problems(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("reference problems");
    for id in CASES {
        let case = case(id).expect("a case of the reference problems");
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let options = Options {
                tolerance,
                ..Options::default()
            };
            group.bench_function(BenchmarkId::new(id, format!("{tolerance:e}")), |b| {
                b.iter(|| {
                    let solution = solve(&*case.equations, black_box(&case), &options);
                    solution.expect("the reference problems are solved")
                });
            });
        }
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    reference_problems(&mut criterion);
    criterion.final_summary();
}
