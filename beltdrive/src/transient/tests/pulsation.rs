//! A load that pulsates against the linearised equations.

use super::super::axle::{Axle, Load, Motion};
use super::super::dynamics::Dynamics;
use super::super::linearised::linearised;
use super::super::rates::Rates;
use super::super::schedule::{Pulsation, Schedule};
use super::super::system::System;
use super::{STRETCH, follow, system};
use faer::Mat;
use faer::linalg::solvers::Solve;
use std::f64::consts::TAU;

/// Speed of the driver, rad/s.
const SPEED: f64 = 120.0;

/// Amplitude of the torque of the load, N·m: small beside what friction carries.
const AMPLITUDE: f64 = 0.01;

/// A drive that sticks, whose driver has a constant speed, with a load that pulsates at an angular frequency in rad/s.
fn drive(angular_frequency: f64) -> System {
    let pulsation = Pulsation {
        amplitude: AMPLITUDE,
        angular_frequency,
    };
    let load = Load {
        is_one_way: true,
        ..Load::new(Schedule::constant(0.0).pulsating(pulsation))
    };
    let driven = Axle {
        inertia: 0.005,
        motion: Motion::Torques { motor: None, load },
    };
    let driver = Axle {
        inertia: 0.01,
        motion: Motion::Speed(Schedule::constant(SPEED)),
    };
    let mut system = system(24, [1.2, 2e8], [driven, driver]);
    system.axial_damping = 5.0;
    system
}

/// The belt runs with both pulleys, without load.
fn running(system: &System) -> Vec<f64> {
    let velocity = SPEED * system.wheels[0].radius;
    let mut state = system.parts.uniform(1.0 / STRETCH, velocity);
    state[system.parts.speed.clone()].fill(SPEED);
    state
}

/// The amplitude of the speed of the driven pulley in rad/s, by the linearised equations: |(i ω − A)⁻¹ b|.
fn linear(system: &System, angular_frequency: f64) -> f64 {
    let mut state = running(system);
    let mut rates = Rates::new(system);
    rates.begin(0.0);
    let mut changes = vec![0.0; state.len()];
    rates.of(0.0, &mut state, &mut changes);
    let found = linearised(&rates, &state, None);
    let speed = found.speed[0].expect("the driven pulley turns freely");
    let n = found.matrix.nrows();
    // Real and imaginary part one below the other.
    let matrix = Mat::from_fn(2 * n, 2 * n, |row, column| {
        let of_same_part = row / n == column / n;
        let (r, c) = (row % n, column % n);
        match (of_same_part, r == c) {
            (true, _) => -found.matrix[(r, c)],
            (false, true) if row < n => -angular_frequency,
            (false, true) => angular_frequency,
            (false, false) => 0.0,
        }
    });
    let scale = found.scales[speed];
    let acceleration = -AMPLITUDE / system.wheels[0].axle.inertia;
    let right = Mat::from_fn(2 * n, 1, |row, _| match row == speed {
        true => acceleration / scale,
        false => 0.0,
    });
    let response = matrix.partial_piv_lu().solve(&right);
    response[(speed, 0)].hypot(response[(n + speed, 0)]) * scale
}

/// The same by following the drive until its own vibrations have died away.
fn followed(system: &System, angular_frequency: f64) -> f64 {
    let mut state = running(system);
    let period = TAU / angular_frequency;
    let begin = 0.4;
    let end = begin + 20.0 * period;
    let place = system.parts.speed.start;
    let [mut sine, mut cosine, mut last] = [0.0, 0.0, begin];
    follow(system, &mut state, end, |time, state| {
        if time > begin {
            let (s, c) = (angular_frequency * time).sin_cos();
            let change = (state[place] - SPEED) * (time - last);
            sine += s * change;
            cosine += c * change;
            last = time;
        }
    });
    2.0 * sine.hypot(cosine) / (last - begin)
}

#[test]
fn a_pulsating_load_makes_the_vibration_of_the_linearised_equations() {
    // Below, at and above the torsional frequency.
    let amplitudes = [500.0, 833.0, 1300.0].map(|frequency| {
        let system = drive(frequency);
        let [known, found] = [linear(&system, frequency), followed(&system, frequency)];
        println!("{frequency} rad/s: {known} by the linearised equations, {found}");
        assert!((found / known - 1.0).abs() < 5e-3);
        found
    });
    assert!(amplitudes[1] > 5.0 * amplitudes[0] && amplitudes[1] > 5.0 * amplitudes[2]);
}
