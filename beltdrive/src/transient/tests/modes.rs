//! Torsional modes of a belt at rest that sticks: a rod with a bristle foundation on the arcs.

use super::super::axle::{Axle, Load, Motion};
use super::super::schedule::Schedule;
use super::{STRETCH, follow, held, order, system};
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
    let mut state = system.parts.uniform(1.0 / STRETCH, 0.0);
    let speed = system.parts.speed.start;
    state[speed] = 0.01;
    let (mut samples, mut next) = (vec![], 0.0);
    follow(&system, &mut state, DURATION, |time, state| {
        if time >= next {
            samples.push([time, state[speed]]);
            next = time + 2e-4;
        }
    });
    fitted(&samples, near)
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

/// What is left of samples of time and value without a constant and a sinusoid, with a weight that fades at both ends:
/// waves ride on the vibration.
fn left(samples: &[[f64; 2]], frequency: f64) -> f64 {
    let weight = |time: f64| (0.5 - 0.5 * (TAU * time / DURATION).cos()).powi(2);
    let basis = |time: f64| {
        let (sine, cosine) = (frequency * time).sin_cos();
        nalgebra::Vector3::new(1.0, sine, cosine)
    };
    let mut normal = nalgebra::Matrix3::zeros();
    let mut right = nalgebra::Vector3::zeros();
    for &[time, value] in samples {
        let basis = basis(time);
        normal += weight(time) * basis * basis.transpose();
        right += weight(time) * value * basis;
    }
    let found = normal.lu().solve(&right).expect("independent functions");
    let rest = samples.iter().map(|&[time, value]| {
        let rest = value - found.dot(&basis(time));
        weight(time) * rest * rest
    });
    rest.sum()
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
