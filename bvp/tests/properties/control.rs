//! What the mesh is chosen for.

use crate::exact::{Exact, bratu, chirp, exponential, limit_cycle, swing, three_point, wavenumber};
use crate::honesty::true_error;
use bvp::{Control, Options, Solution, solve};
use std::f64::consts::PI;

fn solved(problem: &Exact, options: &Options) -> Solution {
    solve(&*problem.equations, problem, options)
        .unwrap_or_else(|error| panic!("{}: {error}", problem.name))
}

fn intervals(solution: &Solution) -> usize {
    let segments = 0..solution.segments().len();
    segments
        .map(|segment| solution.mesh(segment).len() - 1)
        .sum()
}

#[test]
fn chosen_for_the_error_the_error_is_near_the_tolerance_on_fewer_intervals() {
    let problems = [
        exponential(1.0),
        exponential(1000.0),
        bratu(11.0),
        wavenumber(3.0),
        chirp(20.0),
        limit_cycle(2.0),
        three_point(5.0 * PI),
        swing(1.0),
    ];
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let by_error = Options::to(tolerance);
        let by_defect = Options {
            control: Control::Defect,
            ..by_error.clone()
        };
        let [mut few, mut many] = [0, 0];
        for problem in &problems {
            let solution = solved(problem, &by_error);
            let (estimate, error) = (
                solution.error_estimate().unwrap(),
                true_error(problem, &solution),
            );
            let case = format!("{} {tolerance:e}", problem.name);
            assert!(estimate <= tolerance, "{case}: {estimate:e}");
            assert!(error <= 1.5 * tolerance, "{case}: {error:e}");
            few += intervals(&solution);
            many += intervals(&solved(problem, &by_defect));
        }
        assert!(few < many, "{tolerance:e}: {few} of {many}");
    }
}

#[test]
fn without_estimates_the_defect_is_controlled() {
    let problem = exponential(50.0);
    let options = Options {
        control: Control::Defect,
        ..Options::to(1e-6)
    };
    let solution = solved(&problem, &options);
    assert!(solution.defect() <= 1e-6 && solution.error_estimate().is_none());
}

#[test]
fn work_of_a_boundary_layer() {
    let work = [1e-3, 1e-6, 1e-9].map(|tolerance| {
        let solution = solved(&exponential(1000.0), &Options::to(tolerance));
        let stats = solution.stats();
        [stats.factorisations, stats.meshes, intervals(&solution)]
    });
    assert_eq!(work, [[3, 3, 11], [3, 3, 17], [4, 4, 30]]);
}
