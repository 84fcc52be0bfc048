//! Every reason to stop and every way to fail.

use crate::systems::{circle, cusp};
use crate::{of, trace};
use continuation::Direction::{Decreasing, Increasing};
use continuation::{
    Branch, Cause, DenseSystem, Difficulty, Error, Kind, Options, Parameterisation, Stop, System,
};

/// x = ln λ.
fn logarithm() -> DenseSystem {
    DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = x[0] - p[0].ln())
}

#[test]
fn predictions_that_leave_the_domain_of_a_logarithm_are_shortened() {
    let (points, stop) = trace(
        &mut logarithm(),
        &[0.0, 1.0],
        Decreasing,
        &Options::within(1e-8, 2.0),
    );
    assert!(matches!(stop, Stop::Bound { lambda: 1e-8 }));
    let end = points.last().unwrap();
    assert!((end.z[0] - 1e-8f64.ln()).abs() < 1e-9);
}

#[test]
fn without_a_bound_the_branch_goes_on_into_the_singularity() {
    let options = Options {
        steps: 100,
        ..Options::within(-1.0, 2.0)
    };
    let (points, stop) = trace(&mut logarithm(), &[0.0, 1.0], Decreasing, &options);
    assert!(
        matches!(stop, Stop::Steps { steps: 100 } | Stop::StepTooSmall { .. }),
        "{stop}"
    );
    assert!(
        points
            .iter()
            .all(|p| p.lambda() > 0.0 && (p.z[0].exp() - p.lambda()).abs() < 1e-8)
    );
}

#[test]
fn a_branch_ends_at_the_edge_of_the_domain_of_its_equations() {
    // NaN beyond λ = 0.5.
    let mut system = DenseSystem::new(1, &[0.0], 0, |x, p, g| {
        g[0] = if p[0] > 0.5 { f64::NAN } else { x[0] - p[0] };
    })
    .with_jacobian(|_, _, j| j.copy_from_slice(&[1.0, -1.0]));
    let (points, stop) = trace(
        &mut system,
        &[0.0, 0.0],
        Increasing,
        &Options::within(0.0, 1.0),
    );
    let last = points.last().unwrap().lambda();
    assert!(last <= 0.5 && last > 0.5 - 1e-6);
    let Stop::StepTooSmall { step, difficulty } = stop else {
        panic!("{stop}")
    };
    assert!(step < 1e-8);
    assert!(matches!(difficulty, Difficulty::NotFinite { equation: 0, lambda } if lambda > 0.5));
}

#[test]
fn natural_continuation_ends_at_a_limit_point_with_a_reason() {
    let parameterisation = Parameterisation::Natural;
    let options = Options {
        parameterisation,
        ..Options::within(-2.0, 2.0)
    };
    let (points, stop) = trace(&mut circle(), &[1.0, 0.0], Increasing, &options);
    assert!(matches!(stop, Stop::StepTooSmall { .. }), "{stop}");
    let last = points.last().unwrap();
    assert!((last.lambda() - 1.0).abs() < 1e-3 && last.z[0] >= 0.0);
    assert!(of(&points, Kind::LimitPoint).is_empty());
    // Where there is none it serves.
    let (_, stop) = trace(&mut cusp(-1.0), &[0.0, 0.0], Increasing, &options);
    assert!(matches!(stop, Stop::Bound { lambda: 2.0 }));
}

#[test]
fn as_many_steps_are_taken_as_asked_for() {
    let options = Options {
        steps: 5,
        ..Options::within(-2.0, 2.0)
    };
    let (points, stop) = trace(&mut circle(), &[1.0, 0.0], Increasing, &options);
    assert!(matches!(stop, Stop::Steps { steps: 5 }));
    assert_eq!(points.len(), 6);
}

#[test]
fn a_smallest_step_above_what_the_curve_needs_ends_it() {
    let options = Options {
        smallest_step: 0.04,
        ..Options::within(-1.0, 2.0)
    };
    let (points, stop) = trace(&mut logarithm(), &[0.0, 1.0], Decreasing, &options);
    let Stop::StepTooSmall { step, .. } = stop else {
        panic!("{stop}")
    };
    assert!(step < 0.04 && step > 0.04 * 0.2);
    assert!(points.last().unwrap().lambda() > 1e-8);
}

#[test]
fn starts_with_more_than_one_direction_are_refused() {
    let mut cross = DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = x[0] * x[0] - p[0] * p[0]);
    let mut nothing = DenseSystem::new(2, &[0.0], 0, |x, p, g| {
        g[0] = x[0] + x[1] - p[0];
        g[1] = 2.0 * g[0];
    });
    for (system, start) in [(&mut cross, &[0.0; 2][..]), (&mut nothing, &[0.0; 3][..])] {
        let error = Branch::new(system, start, Increasing, &Options::within(-1.0, 1.0)).err();
        assert!(matches!(error, Some(Error::SingularStart)), "{error:?}");
    }
}

#[test]
fn starts_that_are_none_are_refused() {
    let start =
        |z: &[f64]| Branch::new(&mut circle(), z, Increasing, &Options::within(-2.0, 2.0)).err();
    assert!(matches!(
        start(&[1.0]),
        Some(Error::StartCount {
            given: 1,
            unknowns: 2
        })
    ));
    assert!(matches!(
        start(&[1.0, 3.0]),
        Some(Error::StartOutside { .. })
    ));
    assert!(matches!(
        start(&[1.0, f64::NAN]),
        Some(Error::StartOutside { .. })
    ));
    assert!(matches!(
        start(&[f64::NAN, 0.0]),
        Some(Error::Start(Difficulty::NotFinite { .. }))
    ));
    // x² + λ² = −1
    let mut system = DenseSystem::new(1, &[0.0], 0, |x, p, g| {
        g[0] = x[0] * x[0] + p[0] * p[0] + 1.0;
    });
    let options = Options::within(-1.0, 1.0);
    let error = Branch::new(&mut system, &[0.7, 0.0], Increasing, &options).err();
    assert!(matches!(error, Some(Error::Start(_))), "{error:?}");
}

#[test]
fn settings_out_of_range_are_refused() {
    let refused = |options: Options| {
        let error = Branch::new(&mut circle(), &[1.0, 0.0], Increasing, &options).err();
        error.expect("an error").to_string()
    };
    let options = || Options::within(-2.0, 2.0);
    assert!(refused(Options::within(1.0, -1.0)).contains("no interval"));
    assert!(refused(Options::within(f64::NAN, 1.0)).contains("no interval"));
    for (name, options) in [
        (
            "first_step",
            Options {
                first_step: 0.0,
                ..options()
            },
        ),
        (
            "largest_step",
            Options {
                largest_step: f64::INFINITY,
                ..options()
            },
        ),
        (
            "smallest_step",
            Options {
                smallest_step: -1.0,
                ..options()
            },
        ),
        (
            "angle",
            Options {
                angle: f64::NAN,
                ..options()
            },
        ),
        (
            "accuracy",
            Options {
                accuracy: 0.0,
                ..options()
            },
        ),
        (
            "targets",
            Options {
                targets: vec![f64::NAN],
                ..options()
            },
        ),
        (
            "corrections",
            Options {
                corrections: 0,
                ..options()
            },
        ),
        (
            "weights",
            Options {
                weights: Some(vec![0.0, 0.0]),
                ..options()
            },
        ),
        (
            "weights",
            Options {
                weights: Some(vec![1.0, -1.0]),
                ..options()
            },
        ),
        (
            "weights",
            Options {
                weights: Some(vec![1.0]),
                ..options()
            },
        ),
    ] {
        let text = refused(options);
        assert!(text.contains(name), "{text}");
    }
}

/// A line whose discretisation cannot follow beyond λ = 0.5.
struct Stubborn;

impl System for Stubborn {
    fn unknowns(&self) -> usize {
        2
    }

    fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        g[0] = z[0] - z[1];
    }

    fn linearise(&mut self, z: &[f64]) -> Result<(), Cause> {
        if z[1] < -0.5 {
            Err("out of reach".into())
        } else {
            Ok(())
        }
    }

    fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        v.copy_from_slice(&[r[0], 0.0]);
    }

    fn null_vector(&mut self, t: &mut [f64]) {
        t.copy_from_slice(&[1.0, 1.0]);
    }

    fn adapted(&mut self, vectors: &mut [Vec<f64>]) -> Result<Option<Self>, Cause> {
        if vectors[0][1] > 0.5 {
            Err("no finer mesh".into())
        } else {
            Ok(None)
        }
    }
}

#[test]
fn what_a_system_reports_ends_the_branch_with_its_words() {
    let options = Options::within(-1.0, 1.0);
    let (points, stop) = trace(&mut Stubborn, &[0.0, 0.0], Increasing, &options);
    assert!(stop.to_string().contains("no finer mesh"), "{stop}");
    let Stop::StepTooSmall { difficulty, .. } = stop else {
        panic!("{stop}")
    };
    assert!(matches!(difficulty, Difficulty::Adaptation(_)));
    assert!((points.last().unwrap().lambda() - 0.5).abs() < 1e-6);
    let (points, stop) = trace(&mut Stubborn, &[0.0, 0.0], Decreasing, &options);
    assert!(stop.to_string().contains("out of reach"), "{stop}");
    assert!((points.last().unwrap().lambda() + 0.5).abs() < 1e-6);
}

#[test]
fn a_start_is_corrected_to_rounding_however_its_corrections_begin() {
    // Short corrections that do not shrink with the first linearisation.
    let mut system = DenseSystem::new(1, &[0.0], 0, |x, p, g| g[0] = (2e3 * x[0]).tanh() - p[0])
        .with_jacobian(|x, _, j| {
            j.copy_from_slice(&[2e3 / (2e3 * x[0]).cosh().powi(2), -1.0]);
        });
    let options = Options {
        weights: Some(vec![1.0, 1.0]),
        ..Options::within(-0.5, 0.5)
    };
    let mut branch = Branch::new(&mut system, &[5e-4, 0.0], Increasing, &options).unwrap();
    assert!(branch.next().unwrap().z[0].abs() < 1e-15);
}
