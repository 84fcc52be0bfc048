//! Torsional modes of a belt at rest that sticks: a rod with a bristle foundation on the arcs.

use super::super::axle::{Axle, Load, Motion};
use super::super::schedule::Schedule;
use super::super::system::{Resistance, System};
use super::super::vibration;
use super::{STRETCH, follow, held, order, system};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// A pulley that turns freely.
fn free(inertia: f64) -> Axle {
    Axle {
        inertia,
        motion: Motion::Torques {
            motor: None,
            load: Load::new(Schedule::constant(0.0)),
        },
    }
}

/// The angular frequency near a known one that the speed of the first pulley has after a push, rad/s.
fn frequency(cells: usize, stiffness: f64, driver: Axle, near: f64) -> f64 {
    let system = system(cells, [1.2, stiffness], [free(0.005), driver]);
    fitted(&pushed(&system), near)
}

/// Times in s and speeds in rad/s of the first pulley of a drive at rest that is pushed.
fn pushed(system: &System) -> Vec<[f64; 2]> {
    let mut state = system.parts.uniform(1.0 / STRETCH, 0.0);
    let speed = system.parts.speed.start;
    state[speed] = 0.01;
    let (mut samples, mut next) = (vec![], 0.0);
    follow(system, &mut state, DURATION, |time, state| {
        if time >= next {
            samples.push([time, state[speed]]);
            next = time + 2e-4;
        }
    });
    samples
}

/// The angular frequency near a known one at which a sinusoid leaves least of samples of time and value, rad/s.
pub(super) fn fitted(samples: &[[f64; 2]], near: f64) -> f64 {
    let [mut low, mut high] = [0.995 * near, 1.005 * near];
    while high - low > 1e-7 * near {
        let inner = [1.0, 2.0].map(|third| low + third * (high - low) / 3.0);
        let [one, other] = inner.map(|frequency| left(samples, frequency));
        match one < other {
            true => high = inner[1],
            false => low = inner[0],
        }
    }
    0.5 * (low + high)
}

/// Time over which a frequency is fitted, s.
pub(super) const DURATION: f64 = 0.3;

/// What is left of samples of time and value without a constant and a sinusoid.
fn left(samples: &[[f64; 2]], frequency: f64) -> f64 {
    let (weight, basis) = (weight(samples), basis(frequency));
    let found = constant_and_sinusoid(samples, frequency);
    let rest = samples.iter().map(|&[time, value]| {
        let rest = value - found.dot(&basis(time));
        weight(time) * rest * rest
    });
    rest.sum()
}

/// A weight that fades at both ends of samples: waves ride on the vibration.
fn weight(samples: &[[f64; 2]]) -> impl Fn(f64) -> f64 {
    let [from, to] = [samples[0][0], samples[samples.len() - 1][0]];
    move |time| (0.5 - 0.5 * (TAU * (time - from) / (to - from)).cos()).powi(2)
}

/// A constant, a sine and a cosine.
fn basis(frequency: f64) -> impl Fn(f64) -> Vector3<f64> {
    move |time| {
        let (sine, cosine) = (frequency * time).sin_cos();
        Vector3::new(1.0, sine, cosine)
    }
}

/// The weights of these in samples of time and value.
fn constant_and_sinusoid(samples: &[[f64; 2]], frequency: f64) -> Vector3<f64> {
    let (weight, basis) = (weight(samples), basis(frequency));
    let mut normal = nalgebra::Matrix3::zeros();
    let mut right = Vector3::zeros();
    for &[time, value] in samples {
        let basis = basis(time);
        normal += weight(time) * basis * basis.transpose();
        right += weight(time) * value * basis;
    }
    normal.lu().solve(&right).expect("independent functions")
}

#[test]
fn damped_bristles_let_torsion_decay() {
    // With k_f (1 + s τ) in place of k_f the square of the frequency F(k_f) has s = iω − τ k_f F′/2 to first order in ω τ,
    // which is 0.04.
    let (stiffness, time, near) = (2.0e8, 5e-5, 833.1);
    let of = |share: f64| frequency(60, share * stiffness, held(), near * share.powf(0.03));
    let slope = (of(1.05).powi(2) - of(0.95).powi(2)) / 0.1;
    let known = 0.5 * time * slope;
    let mut system = system(60, [1.2, stiffness], [free(0.005), held()]);
    system.resistance = Resistance::Bristles {
        stiffness,
        damping: time * stiffness,
    };
    let samples = pushed(&system);
    let halves = samples.split_at(samples.len() / 2);
    let [first, second] = [halves.0, halves.1].map(|half| {
        let found = constant_and_sinusoid(half, near);
        found[1].hypot(found[2])
    });
    let decay = (first / second).ln() / (0.5 * DURATION);
    println!("decay {decay} 1/s, known {known}");
    assert!((decay / known - 1.0).abs() < 0.01, "{decay} {known}");
    // The eigenvalue is the same motion, and halves with the damping.
    let eigenvalues = [1.0, 0.5].map(|share| {
        let mut coarse = super::system(30, [1.2, stiffness], [free(0.005), held()]);
        coarse.resistance = Resistance::Bristles {
            stiffness,
            damping: share * time * stiffness,
        };
        let fine = coarse.refined(2);
        let states = [&coarse, &fine].map(|system| {
            let state = system.parts.uniform(1.0 / STRETCH, 0.0);
            (system, state, None)
        });
        vibration::modes(states, 1).expect("eigenvalues")[0].growth
    });
    println!("growth {eigenvalues:?}");
    assert!(
        (eigenvalues[0] / -decay - 1.0).abs() < 0.003,
        "{eigenvalues:?} {decay}"
    );
    assert!(
        (eigenvalues[0] / eigenvalues[1] - 2.0).abs() < 0.01,
        "{eigenvalues:?}"
    );
}

#[test]
fn torsional_frequencies_are_those_of_the_rod_to_second_order() {
    for (stiffness, driver, known) in [
        (2.0e8, held(), 833.083_529),
        (2.0e8, free(0.01), 1_029.405_606),
        (8.1e9, held(), 885.707_146),
    ] {
        let errors = [60, 120, 240]
            .map(|cells| frequency(cells, stiffness, driver.clone(), known) / known - 1.0);
        println!("k_f {stiffness:e}: {errors:?}, order {:.2}", order(&errors));
        assert!(errors[1].abs() < 1e-5, "{errors:?}");
        assert!(order(&errors) > 1.8, "{errors:?}");
    }
}
