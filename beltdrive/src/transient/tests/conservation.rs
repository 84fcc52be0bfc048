//! What the loop without friction and damping keeps.

use super::waves::launched;
use super::{follow, held, order, system};

#[test]
fn mass_is_conserved_to_rounding_and_energy_to_second_order() {
    // Energy of the pulse, EA ε² w sqrt(π/2), beside which that of the running belt is constant.
    let pulse = 80_068.0 * 1e-5 * 1e-5 * 0.05 * std::f64::consts::FRAC_PI_2.sqrt();
    let lost = [120, 240, 480].map(|cells| {
        let system = system(cells, [0.0, 2.0e8], [held(), held()]);
        let mut state = launched(&system, 1.0);
        let (length, energy) = (system.unstretched_length(&state), system.energy(&state));
        follow(&system, &mut state, 0.02, |_, _| {});
        let lost = system.unstretched_length(&state) / length - 1.0;
        assert!(lost.abs() < 1e-13, "{lost:e}");
        (system.energy(&state) - energy) / pulse
    });
    println!("{lost:?}, order {:.2}", order(&lost));
    assert!(lost[1].abs() < 0.01 && order(&lost) > 1.5, "{lost:?}");
}

#[test]
fn a_loop_without_friction_runs_back_to_where_it_came_from() {
    let system = system(240, [0.0, 2.0e8], [held(), held()]);
    let mut state = launched(&system, 1.0);
    let before = state.clone();
    let parts = &system.parts;
    let densities = |state: &[f64]| state[parts.density.clone()].to_vec();
    let furthest = |one: &[f64], other: &[f64]| {
        let pairs = densities(one).into_iter().zip(densities(other));
        pairs
            .map(|(one, other)| (one - other).abs())
            .fold(0.0, f64::max)
    };
    // Two and a half rounds: the pulse is on the other side of the loop. The time steps damp its shortest waves.
    follow(&system, &mut state, 2.5 * 1.130_747_8e-3, |_, _| {});
    let away = furthest(&state, &before);
    state[parts.velocity.clone()]
        .iter_mut()
        .for_each(|speed| *speed = -*speed);
    follow(&system, &mut state, 2.5 * 1.130_747_8e-3, |_, _| {});
    let back = furthest(&state, &before);
    println!("away {away:.2e}, back {back:.2e}");
    assert!(away > 5e-6 && back < 2e-3 * away, "{away:e} {back:e}");
}
