//! Branch points in crowds: several in a step, and in equations that hide them from a bordering vector.

use crate::{assert_close, of, trace};
use continuation::Direction::Increasing;
use continuation::{DenseSystem, Kind, Options};

/// xᵢ (λ − aᵢ − xᵢ²) = 0: decoupled pitchforks.
fn pitchforks(at: &[f64]) -> DenseSystem {
    let at = at.to_vec();
    DenseSystem::new(at.len(), &[0.0], 0, move |x, p, g| {
        for ((g, x), a) in g.iter_mut().zip(x).zip(&at) {
            *g = x * (p[0] - a - x * x);
        }
    })
}

#[test]
fn three_branch_points_in_a_step_are_all_found() {
    // From end to end they look like one.
    let options = Options::within(-1.0, 1.0);
    for gap in [0.1, 0.03, 1e-2, 1e-3] {
        for i in 0..60 {
            let a = -0.9 + 0.0271 * f64::from(i);
            let share = 0.3 + 0.7 * (0.618 * f64::from(i)).fract();
            let exact = [a, a + share * gap, a + share * gap + gap];
            let start = [0.0, 0.0, 0.0, -1.0];
            let (points, _) = trace(&mut pitchforks(&exact), &start, Increasing, &options);
            let found = of(&points, Kind::BranchPoint);
            let found: Vec<f64> = found.iter().map(|point| point.lambda()).collect();
            assert_close(&found, &exact, 1e-8);
        }
    }
}

/// The rotation by these angles about the three axes.
fn rotated([a, b, c]: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    let turn = |angle: f64, x: f64, y: f64| {
        let (sine, cosine) = angle.sin_cos();
        [cosine * x - sine * y, sine * x + cosine * y]
    };
    let [x, y, z] = v;
    let [x, y] = turn(a, x, y);
    let [y, z] = turn(b, y, z);
    let [z, x] = turn(c, z, x);
    [x, y, z]
}

#[test]
fn a_pair_of_branch_points_is_found_in_equations_mixed_at_random() {
    // A single bordering vector overlooked 2 of these pairs.
    let options = Options::within(-1.0, 1.0);
    for (i, soft) in (0..200).flat_map(|i| [0.1, 0.03].map(|soft| (i, soft))) {
        let angle = |k: i32| std::f64::consts::TAU * (0.618_034 * f64::from(3 * i + k)).fract();
        let angles = [angle(0), angle(1), angle(2)];
        let a = -0.8 + 1.6 * (0.754_878 * f64::from(i)).fract();
        let mut system = DenseSystem::new(3, &[0.0], 0, move |x, p, g| {
            let [u, v, w] = rotated(angles, [x[0], x[1], x[2]]);
            let own = [
                u * (p[0] - a - u * u),
                v * (p[0] - a - 0.01 - v * v),
                soft * (3.0 * w - (2.0 * p[0]).sin()),
            ];
            g.copy_from_slice(&rotated(angles.map(|angle| 1.7 * angle), own));
        });
        let w = (-2.0f64).sin() / 3.0;
        let back = |k: usize| {
            let mut unit = [0.0; 3];
            unit[k] = 1.0;
            rotated(angles, unit)[2] * w
        };
        let start = [back(0), back(1), back(2), -1.0];
        let (points, _) = trace(&mut system, &start, Increasing, &options);
        let found = of(&points, Kind::BranchPoint);
        let found: Vec<f64> = found.iter().map(|point| point.lambda()).collect();
        assert_close(&found, &[a, a + 0.01], 1e-7);
    }
}
