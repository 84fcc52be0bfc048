use super::*;
use crate::Scheme;
use faer::Mat;

/// Numbers in [−1, 1) without a pattern.
fn noise(i: usize) -> f64 {
    let x = (i as f64 + 0.5) * 0.754_877_666_246_692_8;
    2.0 * (x - x.floor()) - 1.0
}

#[test]
fn the_sign_of_all_stage_determinants_is_known_in_small_and_large_systems() {
    let mut seen = [false; 2];
    for (n, m) in [(1, 3), (2, 4), (3, 1), (5, 7), (9, 4)] {
        let t = Tableau::new(Scheme::Gauss { stages: m });
        for trial in 0..20 {
            let intervals = 3;
            let mut stages = Condensation::new(n, 0, m);
            stages.resize(intervals);
            let mut sign = 1.0;
            let mut mesh = vec![0.0];
            let mut observed = ObservedJacobians::new(n);
            let all = stages.jacobians_mut().chunks_exact_mut(m * n * n);
            for (i, jacobians) in all.enumerate() {
                // Intervals far too long for these equations.
                let h = 10.0 * (1.0 + noise(trial + 31 * i));
                mesh.push(mesh[i] + h);
                let h = mesh[i + 1] - mesh[i];
                for (j, x) in jacobians.iter_mut().enumerate() {
                    *x = noise(1000 * trial + 100 * i + j);
                }
                observed.observe(h, jacobians, [n, n]);
                let matrix = Mat::from_fn(m * n, m * n, |row, column| {
                    let a = t.a[row / n * m + column / n];
                    let identity = if row == column { 1.0 } else { 0.0 };
                    identity - h * a * jacobians[row * n + column % n]
                });
                sign *= matrix.determinant().signum();
            }
            stages.reduce_order(&observed);
            let transitions = &mut vec![0.0; intervals * n * n];
            stages.condense(&t, &mesh, transitions).unwrap();
            let even = stages.negative().is_multiple_of(2);
            assert_eq!(even, sign > 0.0, "n = {n}, m = {m}, trial {trial}");
            seen[usize::from(even)] = true;
        }
    }
    assert_eq!(seen, [true, true]);
}

/// Corrections and transition blocks of two intervals with two parameters, with or without the structure of the
/// Jacobians.
fn condensed(
    n: usize,
    m: usize,
    is_structured: bool,
    entry: impl Fn(usize, usize) -> Option<f64>,
) -> Vec<f64> {
    let (k, mesh) = (2, [0.0, 0.3, 1.0]);
    let t = Tableau::new(Scheme::Gauss { stages: m });
    let mut condensation = Condensation::new(n, k, m);
    condensation.resize(2);
    let mut observed = ObservedJacobians::new(n);
    let columns = n + k;
    for (i, slope) in condensation.jacobians_mut().iter_mut().enumerate() {
        let (row, column) = (i / columns % n, i % columns);
        *slope = entry(row, column).unwrap_or_else(|| noise(i));
    }
    observed.observe(0.7, condensation.jacobians(), [n, columns]);
    if !is_structured {
        observed.observe(0.7, &vec![0.7; n * columns], [n, columns]);
    }
    condensation.reduce_order(&observed);
    let mut transitions = vec![0.0; 2 * n * columns];
    condensation.condense(&t, &mesh, &mut transitions).unwrap();
    let numbers = |count: usize, from: usize| (from..from + count).map(noise).collect::<Vec<_>>();
    let residual = SegmentIterate {
        nodes: numbers(3 * n, 100),
        stages: numbers(2 * m * n, 200),
    };
    let mut nodes = vec![0.0; 3 * n];
    condensation.reduce(&residual, &mut nodes);
    let mut correction = SegmentIterate {
        nodes: numbers(3 * n, 300),
        stages: vec![0.0; 2 * m * n],
    };
    condensation.recover(&t, &mesh, &residual, &mut correction, &[0.4, -1.3]);
    [transitions, nodes, correction.stages].concat()
}

#[test]
fn quadratures_derivative_states_and_followers_change_no_result() {
    for (n, m) in [(2, 4), (3, 5), (4, 1), (5, 6), (7, 5), (8, 7), (9, 4)] {
        // Of the states, in order: a quadrature, a derivative state, and one from n = 5 on that is a quadrature again
        // and depends on the derivative state.
        let entry = |row: usize, column: usize| match (row, column) {
            (_, 0) => Some(0.0),
            (_, 4) if n > 4 => Some(0.0),
            (1, 2) if n > 2 => Some(2.0),
            (1, column) if n > 2 && column < n => Some(0.0),
            _ => None,
        };
        let plain = condensed(n, m, false, entry);
        let found = condensed(n, m, true, entry);
        for (one, other) in plain.iter().zip(&found) {
            assert!(
                (one - other).abs() < 1e-11 * (1.0 + one.abs()),
                "n = {n}, m = {m}: {one} {other}"
            );
        }
    }
    for (n, m) in [(2, 4), (3, 5), (4, 1), (5, 6), (6, 6), (8, 7), (9, 4)] {
        // The first state follows the second; from n = 4 on the third does so, too, and the fourth is a quadrature; from
        // n = 6 on the sixth is the derivative of the fifth.
        let entry = |row: usize, column: usize| match (row, column) {
            (0, column) if column != 1 && column < n => Some(0.0),
            (2, column) if n > 3 && column != 1 && column < n => Some(0.0),
            (_, 3) if n > 3 => Some(0.0),
            (4, 5) if n > 5 => Some(2.0),
            (4, column) if n > 5 && column < n => Some(0.0),
            _ => None,
        };
        let plain = condensed(n, m, false, entry);
        let found = condensed(n, m, true, entry);
        for (one, other) in plain.iter().zip(&found) {
            assert!(
                (one - other).abs() < 1e-11 * (1.0 + one.abs()),
                "n = {n}, m = {m}: {one} {other}"
            );
        }
    }
}
