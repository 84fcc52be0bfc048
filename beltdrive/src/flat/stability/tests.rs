//! The spectrum as a whole.

use super::examples::{FORMS, coulomb_at_rest, driven, driver};
use super::scaled::Scaled;
use super::*;
use faer::c64;
use proptest::prelude::*;
use std::f64::consts::PI;

fn modes(motion: &AxialMotion, form: LinearisedForm, count: usize) -> Vec<Mode> {
    spectrum(motion, form, count).expect("a spectrum").modes
}

#[test]
fn the_published_eigenvalues_are_met() {
    let found = modes(&driven(800.0), LinearisedForm::Thesis, 3);
    let published = [(-128.17, 18740.2), (-12.40, 31072.4), (-32.12, 37919.5)];
    for (mode, (re, im)) in found.iter().zip(published) {
        assert!((mode.value.re - re).abs() < 0.005 && (mode.value.im - im).abs() < 0.05);
    }
}

#[test]
fn the_driver_becomes_unstable_at_the_published_load() {
    for angular_speed in [119.1, 120.0] {
        let least_stable = |tight: f64| {
            let spectrum = spectrum(&driver(tight, angular_speed), LinearisedForm::Thesis, 6);
            let spectrum = spectrum.expect("a spectrum");
            let index = spectrum.least_stable;
            (index, spectrum.modes[index].value.re)
        };
        let (mut low, mut high) = (800.0, 2500.0);
        while high - low > 1e-3 {
            let middle = 0.5 * (low + high);
            let stable = least_stable(middle).1 < 0.0;
            *if stable { &mut low } else { &mut high } = middle;
        }
        assert!((low - 1698.9).abs() < 0.05, "{low}");
        assert_eq!(least_stable(low).0, 1);
    }
}

#[test]
fn conservative_motion_neither_grows_nor_decays() {
    for motion in [
        driven(800.0),
        driver(1500.0, 120.0),
        AxialMotion {
            speed: 400.0,
            ..driven(800.0)
        },
    ] {
        let scaled = Scaled::new(&motion, LinearisedForm::Conservative);
        let spectral = scaled.spectral_eigenvalues(20).expect("eigenvalues");
        let newton = modes(&motion, LinearisedForm::Conservative, 20);
        let newton = newton.iter().map(|mode| mode.value);
        for value in newton.chain(spectral.into_iter().take(20)) {
            assert!(value.re.abs() <= 1e-10 * value.norm(), "{value}");
        }
    }
}

#[test]
fn an_elastic_zone_alone_is_a_rod_on_springs() {
    let motion = AxialMotion {
        speed: 0.0,
        transition: PI * 0.08125,
        ..driven(800.0)
    };
    for form in FORMS {
        for elastic in [1e5, 8.1e7, 1e10, 1e14] {
            let motion = AxialMotion {
                elastic: Some(elastic),
                ..motion
            };
            for (n, mode) in modes(&motion, form, 12).iter().enumerate() {
                let wave = (n as f64 + 0.5) * PI / motion.length;
                let square = elastic + motion.moving_stiffness() * wave * wave;
                let exact = (square / motion.mass_per_length).sqrt();
                assert!(
                    (mode.value - c64::new(0.0, exact)).norm() < 1e-10 * exact,
                    "{elastic}"
                );
            }
        }
    }
}

#[test]
fn rigid_friction_leaves_a_rod() {
    let motion = coulomb_at_rest();
    for (n, mode) in modes(&motion, LinearisedForm::Thesis, 12)
        .iter()
        .enumerate()
    {
        let length = motion.length - motion.transition;
        let exact = motion.critical_speed() * (n as f64 + 0.5) * PI / length;
        assert!((mode.value - c64::new(0.0, exact)).norm() < 1e-13 * exact);
    }
}

#[test]
fn stiff_friction_approaches_rigid_friction() {
    let motion = AxialMotion {
        speed: 100.0,
        ..driven(800.0)
    };
    for form in FORMS {
        let rigid = modes(
            &AxialMotion {
                elastic: None,
                ..motion
            },
            form,
            6,
        );
        let stiff = modes(
            &AxialMotion {
                elastic: Some(1e14),
                ..motion
            },
            form,
            6,
        );
        for (rigid, stiff) in rigid.iter().zip(&stiff) {
            // The belt gives way by √(D/k_f) at the transition.
            assert!((stiff.value / rigid.value - 1.0).norm() < 2e-3);
        }
    }
}

#[test]
fn no_mode_is_missing() {
    let bases = [driven(800.0), driver(1500.0, 120.0)];
    for elastic in [None, Some(1e5), Some(8.1e7), Some(1e10), Some(1e14)] {
        for form in FORMS {
            for (base, speed) in bases
                .iter()
                .flat_map(|b| [0.0, 10.0, 400.0, 700.0].map(|v| (b, v)))
            {
                let motion = AxialMotion {
                    elastic,
                    speed,
                    ..*base
                };
                let spectrum = spectrum(&motion, form, 12).expect("a spectrum");
                let conjugates = spectrum.modes.iter().filter(|mode| mode.value.im > 0.0);
                assert!(spectrum.counted >= 12 + conjugates.count());
                for mode in &spectrum.modes {
                    assert!(mode.difference < 1e-10, "{motion:?} {form:?} {mode:?}");
                }
            }
        }
    }
}

#[test]
fn zones_may_be_short() {
    for form in FORMS {
        let whole = AxialMotion {
            transition: driven(800.0).length,
            ..driven(800.0)
        };
        for share in [1e-9, 1e-3, 0.999, 1.0 - 1e-9] {
            let motion = AxialMotion {
                transition: share * whole.length,
                ..whole
            };
            let found = modes(&motion, form, 12);
            let worst = found.iter().map(|mode| mode.difference).fold(0.0, f64::max);
            assert!(worst < 1e-7, "{form:?} {share} {worst:e}");
        }
    }
}

/// The modes above the first dozen, one by one, up to the number `last`; every one is found from the
/// place one spacing above the one before.
fn climb(motion: &AxialMotion, form: LinearisedForm, last: usize) -> Vec<c64> {
    let scaled = Scaled::new(motion, form);
    let spacing = PI * scaled.delta;
    let mut found = vec![modes(motion, form, 12)[11].value / scaled.rate];
    for n in 12..last {
        let below = found[n - 12];
        let root = scaled
            .root_near(below + c64::new(0.0, spacing))
            .expect("convergence");
        assert!(((root - below).im / spacing - 1.0).abs() < 0.3, "{n}");
        found.push(root);
    }
    found.iter().map(|root| root * scaled.rate).collect()
}

#[test]
fn high_modes_approach_their_limit() {
    let slow = driven(800.0);
    let fast = AxialMotion {
        speed: 300.0,
        ..driver(1500.0, 120.0)
    };
    for form in [LinearisedForm::Thesis, LinearisedForm::NaturalOutlet] {
        for motion in [slow, fast] {
            let limit = motion.high_mode_limit(form);
            let high = climb(&motion, form, 1000);
            let tail = &high[488..];
            let mean = tail.iter().map(|value| value.re).sum::<f64>() / tail.len() as f64;
            assert!((mean / limit - 1.0).abs() < 2e-4, "{form:?} {mean} {limit}");
            let spread = |modes: &[c64]| {
                modes
                    .iter()
                    .map(|l| (l.re - limit).abs())
                    .fold(0.0, f64::max)
            };
            assert!(spread(tail) < 0.1 * spread(&high[..30]));
            let rigid = AxialMotion {
                elastic: None,
                ..motion
            };
            let limit = rigid.high_mode_limit(form);
            let last = climb(&rigid, form, 400)[388].re;
            assert!((last / limit - 1.0).abs() < 1e-6, "{form:?} {last} {limit}");
        }
    }
    assert_eq!(fast.high_mode_limit(LinearisedForm::Conservative), 0.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn both_methods_agree(
        form in prop::sample::select(FORMS.to_vec()),
        ln_stiffness in prop::option::weighted(0.85, 4.0..14.0),
        transition in 0.0..0.8,
        slip in -4.0..4.0,
        mach in 0.0..0.7,
        length in 0.05..2.0,
    ) {
        let belt = driven(800.0);
        let motion = AxialMotion {
            speed: mach * belt.critical_speed(),
            length,
            transition: transition * length,
            elastic: ln_stiffness.map(|exponent| 10f64.powf(exponent)),
            slip_rate: slip / length,
            ..belt
        };
        let spectrum = spectrum(&motion, form, 12);
        let spectrum = spectrum.map_err(|error| TestCaseError::fail(error.to_string()))?;
        for mode in spectrum.modes {
            prop_assert!(mode.difference < 1e-9, "{:?}", mode);
        }
    }
}
