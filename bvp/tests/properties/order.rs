//! Measured orders of convergence, at the nodes and between them.

use crate::exact::{Exact, bratu, chirp, exponential, limit_cycle, swing, three_point, wavenumber};
use bvp::{Control, Guess, Options, Scheme, Solution, solve};
use std::f64::consts::PI;

/// Interval counts to choose four from, about a tenth apart.
pub(crate) const COUNTS: [usize; 34] = [
    4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 16, 18, 20, 22, 25, 28, 32, 36, 40, 45, 50, 56, 64, 72, 80,
    90, 100, 112, 128, 144, 160, 180, 200, 224,
];
/// Errors outside this range are rounding or not yet asymptotic.
const SMALLEST: f64 = 1e-12;
const LARGEST: f64 = 1e-2;
/// Places per interval at which the continuous solution is measured.
const PLACES: usize = 12;

/// The solution on `intervals` equal intervals per segment; `None` if they are too few to tell.
/// The loosest tolerance and no room for another mesh keep the mesh; the second call polishes what
/// so loose a tolerance leaves of Newton's iteration.
pub(crate) fn on_uniform_mesh(
    problem: &Exact,
    scheme: Scheme,
    intervals: usize,
) -> Option<Solution> {
    let options = Options {
        tolerance: 1e-1,
        scheme: Some(scheme),
        initial_intervals: intervals,
        max_intervals: intervals * problem.equations.shape().segments.len(),
        control: Control::Defect,
        ..Options::default()
    };
    let solve = |guess: &dyn Guess| match solve(&*problem.equations, guess, &options) {
        Ok(solution) => (solution.stats().meshes == 1).then_some(solution),
        Err(_) => None,
    };
    solve(&solve(problem)?)
}

/// The errors at the nodes (with those of the parameters) and between them, root mean square: a
/// maximum would jump with the place of the nodes.
pub(crate) fn errors(problem: &Exact, solution: &Solution) -> [f64; 2] {
    let (mut nodes, mut between) = (Vec::new(), Vec::new());
    for (segment, states) in solution.segments().iter().enumerate() {
        let mut exact = vec![0.0; states.states];
        let mut found = exact.clone();
        let mesh = solution.mesh(segment);
        for (i, &s) in mesh.iter().enumerate() {
            problem.state(segment, s, &mut exact);
            let pairs = exact.iter().zip(solution.node(segment, i));
            nodes.extend(pairs.map(|(a, b)| a - b));
        }
        for pair in mesh.windows(2) {
            for place in 0..PLACES {
                let theta = (place as f64 + 0.5) / PLACES as f64;
                let s = pair[0] + theta * (pair[1] - pair[0]);
                problem.state(segment, s, &mut exact);
                solution.state(segment, s, &mut found);
                between.extend(exact.iter().zip(&found).map(|(a, b)| a - b));
            }
        }
    }
    let parameters = solution.parameters().iter().zip(&problem.parameters);
    let parameters: f64 = parameters
        .map(|(a, b)| (a - b).abs() / (1.0 + b.abs()))
        .sum();
    let mean = |errors: &[f64]| {
        let squares: f64 = errors.iter().map(|e| e * e).sum();
        (squares / errors.len() as f64).sqrt()
    };
    [mean(&nodes) + parameters, mean(&between)]
}

/// The slope of ln error over ln h by least squares, over the four finest meshes whose errors are
/// neither rounding nor too coarse.
pub(crate) fn slope(measured: &[(usize, f64)]) -> f64 {
    let useful: Vec<_> = measured
        .iter()
        .take_while(|(_, error)| *error > SMALLEST)
        .filter(|(_, error)| *error < LARGEST)
        .map(|&(n, error)| (-(n as f64).ln(), error.ln()))
        .collect();
    assert!(useful.len() >= 4, "too few useful meshes: {measured:?}");
    let last = &useful[useful.len() - 4..];
    let mean = |f: fn(&(f64, f64)) -> f64| last.iter().map(f).sum::<f64>() / 4.0;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = last.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    covariance / last.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

/// The problems, stretched so that a scheme of this order has visible errors. Waves accumulate
/// them; without waves the highest orders are rounding before they are asymptotic.
fn problems(order: usize) -> Vec<Exact> {
    let w = order as f64;
    let mut problems = vec![
        wavenumber(w / 2.0),
        chirp(2.0 * w - 3.0),
        limit_cycle(w - 1.0),
        three_point((w - 1.0) * PI),
        swing(w - 1.0),
    ];
    if order <= 10 {
        problems.push(exponential(2.0 * w + 0.3));
        problems.push(bratu(if order <= 4 { 1.5 } else { 11.0 }));
    }
    problems
}

#[test]
fn every_scheme_converges_at_its_order() {
    let mut schemes = vec![
        Scheme::LobattoIIIA { stages: 3 },
        Scheme::LobattoIIIA { stages: 4 },
    ];
    schemes.extend((1..=7).map(|stages| Scheme::Gauss { stages }));
    let mut wrong = Vec::new();
    println!("order at the nodes / between them: theory, then measured");
    let names: Vec<_> = problems(2)
        .iter()
        .map(|p| format!("{:12}", p.name))
        .collect();
    println!("{:22} | {}", "", names.join(" | "));
    for scheme in schemes {
        let theory = [scheme.order() as f64, scheme.dense_order() as f64];
        let name = format!("{scheme:?}")
            .replace(" { stages: ", " ")
            .replace(" }", "");
        print!("{name:14} {:2} / {:2} ", theory[0], theory[1]);
        for problem in problems(scheme.order()) {
            let measured: Vec<_> = COUNTS
                .iter()
                .filter_map(|&n| {
                    Some((n, errors(&problem, &on_uniform_mesh(&problem, scheme, n)?)))
                })
                .collect();
            let slopes = [0, 1].map(|kind| {
                let column: Vec<_> = measured.iter().map(|(n, e)| (*n, e[kind])).collect();
                slope(&column)
            });
            print!(" | {:5.2} / {:4.2}", slopes[0], slopes[1]);
            if (0..2).any(|kind| (slopes[kind] - theory[kind]).abs() > 0.2) {
                wrong.push((scheme, problem.name, slopes));
            }
        }
        println!();
    }
    assert!(wrong.is_empty(), "slopes off by more than 0.2: {wrong:#?}");
}
