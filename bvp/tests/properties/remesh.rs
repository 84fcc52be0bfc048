//! The mesh of a family follows the solution.

use crate::family::{Bratu, correct, dot};
use bvp::{Control, Error, Family, Options, Table};

/// Walks along Bratu's curve by u'(0), which is unknown 1, up to a value; returns the changes of
/// the mesh.
fn climb(family: &mut Family<'_>, z: &mut Vec<f64>, to: f64) -> Result<usize, Error> {
    let mut changes = 0;
    while z[1] < to {
        z[1] += 0.25;
        correct(family, z, 1);
        let mut point = vec![z.clone()];
        while let Some(adapted) = family.adapted(&mut point)? {
            changes += 1;
            *family = adapted;
            z.clone_from(&point[0]);
            let sizes = correct(family, z, 1);
            assert!(sizes.len() <= 3 && sizes[0] < 1e-2, "{sizes:?}");
            point[0].clone_from(z);
        }
    }
    Ok(changes)
}

/// λ of the member of Bratu's family with this u'(0): θ² / (2 cosh²(θ/4)) with θ tanh(θ/4) = u'(0).
fn exact(slope: f64) -> f64 {
    let (mut below, mut above) = (0.0, slope + 4.0);
    for _ in 0..200 {
        let theta: f64 = 0.5 * (below + above);
        match theta * (0.25 * theta).tanh() < slope {
            true => below = theta,
            false => above = theta,
        }
    }
    0.5 * (below / (0.25 * below).cosh()).powi(2)
}

#[test]
fn a_mesh_for_the_error_keeps_it_on_fewer_intervals() {
    for tolerance in [1e-5, 1e-7, 1e-9] {
        let intervals = [Control::Error, Control::Defect, Control::Both].map(|control| {
            let bratu = Bratu::new(&[0.0, 1.0]);
            let options = Options {
                control,
                ..Options::to(tolerance)
            };
            let (mut family, mut z) = bratu.family(&options);
            for to in [2.0, 5.0, 10.0, 15.0, 20.0] {
                climb(&mut family, &mut z, to).unwrap();
                let lambda = z[z.len() - 1];
                let error = (lambda - exact(z[1])).abs() / (1.0 + lambda);
                assert!(error <= tolerance, "{tolerance:e} {to}: {error:e}");
                let defect = family.solution(&z).defect();
                assert!(
                    control == Control::Error || defect <= tolerance,
                    "{defect:e}"
                );
            }
            family.solution(&z).mesh(0).len() - 1
        });
        println!("{tolerance:e} {intervals:?}");
        assert!(3 * intervals[0] <= 2 * intervals[1], "{intervals:?}");
    }
}

#[test]
fn a_mesh_is_refined_where_the_solution_asks_for_it_and_does_not_flip() {
    let bratu = Bratu::new(&[0.0, 1.0]);
    let options = Options {
        control: Control::Defect,
        ..Options::to(1e-7)
    };
    let (mut family, mut z) = bratu.family(&options);
    let before = family.unknowns();
    let changes = climb(&mut family, &mut z, 20.0).unwrap();
    assert!((1..=15).contains(&changes), "{changes}");
    assert!(family.unknowns() > before);
    for _ in 0..40 {
        assert!(family.adapted(&mut [z.clone()]).unwrap().is_none());
    }
}

#[test]
fn a_mesh_far_too_fine_is_coarsened_with_all_vectors_and_once() {
    let bratu = Bratu::new(&[0.0, 1.0]);
    // Not quite equal intervals, which would be thinned before the first solution.
    let nodes: Vec<f64> = (0..=200)
        .map(|i| (f64::from(i) / 200.0).powf(1.01))
        .collect();
    let guess = Table {
        states: vec![vec![0.0; 2 * nodes.len()]],
        nodes: vec![nodes],
        parameters: vec![1.0],
    };
    let options = Options {
        control: Control::Defect,
        ..Options::default()
    };
    let (mut family, mut z) = Family::new(&bratu, 0, &[], &guess, &options).unwrap();
    let fine = family.unknowns();
    correct(&mut family, &mut z, fine - 1);
    let mut t = vec![0.0; fine];
    family.linearise(&z).unwrap();
    family.null_vector(&mut t);
    let mut vectors = vec![z, t];
    let mut changes = 0;
    for _ in 0..100 {
        if let Some(adapted) = family.adapted(&mut vectors).unwrap() {
            changes += 1;
            family = adapted;
            assert!(2 * family.unknowns() < fine + 100);
            let n = family.unknowns() - 1;
            assert!(vectors.iter().all(|vector| vector.len() == n + 1));
            let sizes = correct(&mut family, &mut vectors[0], n);
            assert!(sizes.len() <= 2, "{sizes:?}");
            // The tangent is that of the new mesh.
            let mut t = vec![0.0; n + 1];
            family.null_vector(&mut t);
            let cosine = dot(&t, &vectors[1]).powi(2);
            let cosine = cosine / (dot(&t, &t) * dot(&vectors[1], &vectors[1]));
            assert!((cosine - 1.0).abs() < 1e-8, "{cosine}");
        }
    }
    // An interval grows at most fivefold at once: 200, 40.
    assert!((1..=2).contains(&changes), "{changes}");
    assert!(family.solution(&vectors[0]).defect() <= family.tolerance());
}

#[test]
fn the_mesh_limit_ends_the_walk() {
    let bratu = Bratu::new(&[0.0, 1.0]);
    let options = Options {
        control: Control::Defect,
        max_intervals: 12,
        ..Options::to(1e-7)
    };
    let (mut family, mut z) = bratu.family(&options);
    let error = climb(&mut family, &mut z, 40.0).unwrap_err();
    let Error::MeshLimit {
        needed,
        limit: 12,
        defect,
        best,
        ..
    } = error
    else {
        panic!("{error}");
    };
    assert!(needed > 12 && defect > 1e-7 && best.defect() == defect);
    assert_eq!(best.start(0)[1], z[1]);
}

#[test]
fn refinement_by_halves_is_exact() {
    let bratu = Bratu::new(&[0.0, 0.3, 1.0]);
    let options = Options {
        max_intervals: 20,
        ..Options::default()
    };
    let (mut family, z) = bratu.family(&options);
    let n = family.unknowns() - 1;
    let mut t = vec![0.0; n + 1];
    family.linearise(&z).unwrap();
    family.null_vector(&mut t);
    let mut vectors = vec![z.clone(), t];
    let mut fine = family.refined(&mut vectors).unwrap();
    let count = fine.unknowns();
    // Two segments with three and with six intervals of (1 + 7) × 2, one more node each, and λ.
    assert_eq!((n + 1, count), (101, 197));
    let (coarse_solution, solution) = (family.solution(&z), fine.solution(&vectors[0]));
    for vector in &vectors {
        let mut g = vec![0.0; count - 1];
        fine.residual(vector, &mut g);
        let size = dot(vector, vector).sqrt();
        for segment in 0..2 {
            let intervals = solution.mesh(segment).len() - 1;
            let first = segment * 16 * intervals;
            let continuity = &g[first..first + 2 * intervals];
            assert!(continuity.iter().all(|g| g.abs() < 1e-14 * (1.0 + size)));
        }
    }
    let (mut coarse, mut y) = ([0.0; 2], [0.0; 2]);
    for i in 0..=30 {
        let s = 0.3 + 0.7 * f64::from(i) / 30.0;
        coarse_solution.state(1, s, &mut coarse);
        solution.state(1, s, &mut y);
        assert!((y[0] - coarse[0]).abs() + (y[1] - coarse[1]).abs() < 1e-14);
    }
    // 6, 12, 24 and 48 intervals; 96 are more than four times those allowed.
    let finer = fine.refined(&mut []).unwrap();
    let finest = finer.refined(&mut []).unwrap();
    let kept = vectors.clone();
    assert!(finest.refined(&mut vectors).is_none());
    assert_eq!(vectors, kept);
}
