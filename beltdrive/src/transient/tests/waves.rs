//! An axial wave round the running loop without friction.

use super::super::system::System;
use super::{STRETCH, follow, held, order, system};

/// Width of the pulse, m, and its amplitude as a stretch.
const WIDTH: f64 = 0.05;
const AMPLITUDE: f64 = 1e-5;

/// Belt speed, m/s.
const SPEED: f64 = 9.75;

/// A pulse round a place of the loop at another one.
fn pulse(length: f64, from: f64) -> f64 {
    let distance = (from + 0.5 * length).rem_euclid(length) - 0.5 * length;
    (-(distance / WIDTH).powi(2)).exp()
}

/// A belt with a pulse in the middle of the loop that runs with the motion (+1) or against it (−1).
pub(super) fn launched(system: &System, sense: f64) -> Vec<f64> {
    let parts = &system.parts;
    let length = system.mesh.length();
    let waves = (system.axial_stiffness / system.mass).sqrt();
    let mut state = parts.uniform(1.0 / STRETCH, SPEED);
    for (cell, at) in system.mesh.middles().enumerate() {
        let stretch = STRETCH + AMPLITUDE * pulse(length, at - 0.5 * length);
        state[parts.density.start + 1 + cell] = stretch.recip();
        let face = at - 0.5 * system.mesh.lengths[cell];
        let faster = -sense * waves * AMPLITUDE * pulse(length, face - 0.5 * length);
        state[parts.velocity.start + cell] += faster;
    }
    parts.close(&mut state);
    state
}

/// How far a pulse has come short over five rounds, as a share of the way, and the share of its amplitude that is left.
fn after_five_rounds(cells: usize, sense: f64, period: f64) -> [f64; 2] {
    let system = system(cells, [0.0, 2.0e8], [held(), held()]);
    let length = system.mesh.length();
    let mut state = launched(&system, sense);
    let before = state.clone();
    follow(&system, &mut state, 5.0 * period, |_, _| {});
    let overlap = |state: &[f64], shift: f64| -> f64 {
        let densities = &state[system.parts.density.clone()][1..];
        let middles = system
            .mesh
            .middles()
            .zip(densities)
            .zip(&system.mesh.lengths);
        let parts = middles.map(|((at, density), cell)| {
            (density.recip() - STRETCH) * cell * pulse(length, at - 0.5 * length - shift)
        });
        parts.sum()
    };
    let [mut low, mut high] = [-0.05, 0.05];
    while high - low > 1e-9 {
        let inner = [1.0, 2.0].map(|third| low + third * (high - low) / 3.0);
        match overlap(&state, inner[0]) > overlap(&state, inner[1]) {
            true => high = inner[1],
            false => low = inner[0],
        }
    }
    let shift = 0.5 * (low + high);
    [
        shift / (5.0 * length),
        overlap(&state, shift) / overlap(&before, 0.0),
    ]
}

#[test]
fn waves_round_the_running_loop_have_their_periods_to_second_order() {
    // L/(λ c ± V)
    for (sense, period) in [(1.0, 1.130_747_8e-3), (-1.0, 1.155_971_4e-3)] {
        let found = [240, 480, 960].map(|cells| after_five_rounds(cells, sense, period));
        let shifts = found.map(|[shift, _]| shift.abs());
        println!("sense {sense}: {found:?}, order {:.2}", order(&shifts));
        // Dispersion of the staggered differences: (k h)²/24 with 3/w² for k², and 8e-4, 2.2e-4, 5.6e-5 in another code.
        for (shift, known) in shifts.iter().zip([8e-4, 2.2e-4, 5.6e-5]) {
            assert!((0.5..2.0).contains(&(shift / known)), "{found:?}");
        }
        assert!((order(&shifts) - 2.0).abs() < 0.15, "{found:?}");
        assert!(
            found
                .iter()
                .all(|[_, amplitude]| (amplitude - 1.0).abs() < 0.01)
        );
    }
}
