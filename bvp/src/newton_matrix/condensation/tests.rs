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
            let mut observed = ObservedRows::new(n);
            let all = stages.jacobians_mut().chunks_exact_mut(m * n * n);
            for (i, jacobians) in all.enumerate() {
                // Intervals far too long for these equations.
                let h = 10.0 * (1.0 + noise(trial + 31 * i));
                mesh.push(mesh[i] + h);
                let h = mesh[i + 1] - mesh[i];
                for (j, x) in jacobians.iter_mut().enumerate() {
                    *x = noise(1000 * trial + 100 * i + j);
                }
                observed.observe(jacobians, n, n);
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
