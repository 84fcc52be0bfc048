//! Families of solutions: their linear algebra and the direction of their tangents.

use crate::family::{Bratu, dot, loaded, neumann, small};
use bvp::{Family, Options};
use faer::Mat;

/// Numbers in [−1, 1): Knuth's multiplicative congruential generator.
fn random(seed: &mut u64) -> f64 {
    *seed = seed
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// The Jacobian by central differences.
fn differenced(family: &mut Family<'_>, z: &[f64]) -> Mat<f64> {
    let n = z.len() - 1;
    let mut j = Mat::zeros(n, n + 1);
    let (mut z, mut right, mut left) = (z.to_vec(), vec![0.0; n], vec![0.0; n]);
    for column in 0..=n {
        let kept = z[column];
        let step = 6e-6 * (1.0 + kept.abs());
        z[column] = kept + step;
        family.residual(&z, &mut right);
        z[column] = kept - step;
        family.residual(&z, &mut left);
        z[column] = kept;
        for row in 0..n {
            j[(row, column)] = (right[row] - left[row]) / (2.0 * step);
        }
    }
    j
}

/// Checks J v = r and J t = 0 at points around `z` against differences, and that det \[J; tᵀ\] keeps
/// its sign.
fn check_linear_algebra(mut family: Family<'_>, z: &[f64]) {
    let n = family.unknowns() - 1;
    assert_eq!(z.len(), n + 1);
    let mut seed = 7;
    let (mut v, mut t) = (vec![f64::NAN; n + 1], vec![f64::NAN; n + 1]);
    let mut sign = 0.0;
    for _ in 0..40 {
        let z: Vec<f64> = z.iter().map(|z| z + 2.0 * random(&mut seed)).collect();
        let r: Vec<f64> = (0..n).map(|_| random(&mut seed)).collect();
        let j = differenced(&mut family, &z);
        family.linearise(&z).unwrap();
        family.null_vector(&mut t);
        family.particular(&r, &mut v);
        let length = dot(&t, &t).sqrt();
        let size = dot(&v, &v).sqrt();
        for row in 0..n {
            let product = |x: &[f64]| -> f64 { (0..=n).map(|c| j[(row, c)] * x[c]).sum() };
            assert!(product(&t).abs() < 1e-7 * length, "row {row}");
            assert!(
                (product(&v) - r[row]).abs() < 1e-7 * (1.0 + size),
                "row {row}"
            );
        }
        let whole = Mat::from_fn(n + 1, n + 1, |i, c| if i < n { j[(i, c)] } else { t[c] });
        let here = whole.determinant().signum();
        assert!(sign * here >= 0.0, "the direction of a null vector");
        sign = here;
    }
}

#[test]
fn particular_and_null_vectors_are_those_of_the_differenced_system() {
    for nodes in [&[0.0, 1.0][..], &[0.0, 0.3, 1.0], &[0.0, 0.3, 0.5, 1.0]] {
        let bratu = Bratu::new(nodes);
        let (family, z) = bratu.family(&small());
        check_linear_algebra(family, &z);
    }
    for (parameter, held) in [(0, [1]), (2, [1]), (2, [0]), (1, [2])] {
        let (family, z) = loaded(parameter, &held, &small());
        check_linear_algebra(family, &z);
    }
    let (family, z) = neumann(&small());
    check_linear_algebra(family, &z);
}

#[test]
fn the_null_vector_turns_around_where_curves_cross_and_nowhere_else() {
    let (mut family, mut z) = neumann(&Options::default());
    let n = family.unknowns() - 1;
    let mut t = vec![0.0; n + 1];
    let mut direction = |lambda: f64| {
        z[n] = lambda;
        family.linearise(&z).unwrap();
        family.null_vector(&mut t);
        assert!(t[..n].iter().all(|x| x.abs() < 1e-12 * t[n].abs()));
        t[n].signum()
    };
    // The trivial solution is crossed at λ = (iπ)²: 0, 9.87, 39.5, 88.8.
    let between = [5.0, 9.0, 9.869, 9.87, 11.0, 12.0, 35.0, 45.0, 85.0, 95.0];
    let directions = between.map(&mut direction);
    let first = directions[0];
    let expected = [1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0, 1.0, 1.0, -1.0];
    assert_eq!(directions, expected.map(|sign| sign * first));
    // At the crossing J has a defect of rank, to rounding.
    z[n] = std::f64::consts::PI.powi(2);
    family.linearise(&z).unwrap();
    family.null_vector(&mut t);
    let mut v = vec![0.0; n + 1];
    family.particular(&vec![1.0; n], &mut v);
    assert!(t.iter().chain(&v).all(|x| x.is_finite()) && dot(&t, &t) > 0.0);
}
