//! The linearised rates against differences of the rates.

use super::super::axle::{Axle, Load, Motion, Motor};
use super::super::dynamics::Dynamics;
use super::super::linearised::linearised;
use super::super::rates::Rates;
use super::super::schedule::Schedule;
use super::super::system::{Resistance, System};
use super::super::vibration;
use super::{STRETCH, order, system};
use faer::c64;
use std::f64::consts::TAU;

fn free(inertia: f64, motor: Option<Motor>, per_speed: f64) -> Axle {
    let load = Load {
        per_speed,
        ..Load::new(Schedule::constant(0.5))
    };
    Axle {
        inertia,
        motion: Motion::Torques { motor, load },
    }
}

/// Bristles with a damping in N·s/m².
fn bristles(damping: f64) -> Resistance {
    Resistance::Bristles {
        stiffness: 2.0e8,
        damping,
    }
}

#[test]
fn the_linearised_rates_are_the_derivatives_of_the_rates() {
    // With the cells of a span that are slack.
    for slack in [0..0, 6..9] {
        rates_have_derivatives(bristles(0.0), slack);
    }
}

#[test]
fn those_of_damped_bristles_and_of_creep_are_so_too() {
    // Damping takes friction of some bristles to its limit that are below their own.
    for resistance in [bristles(2e4), Resistance::Creep { velocity: 0.1 }] {
        rates_have_derivatives(resistance, 0..0);
    }
}

fn rates_have_derivatives(resistance: Resistance, slack: std::ops::Range<usize>) {
    let motor = Motor::line(40.0, 150.0);
    let axles = [free(0.005, None, 0.02), free(0.01, Some(motor), 0.0)];
    let mut system = system(24, [0.4, 2.0e8], axles);
    system.axial_damping = 0.3;
    system.resistance = resistance;
    let parts = system.parts.clone();
    // Any state with the belt in motion, loaded, stretched unevenly; it slips in the last cells of both arcs, with creep
    // where it is fast enough.
    let mut state = parts.uniform(1.0 / STRETCH, 9.75);
    for (index, place) in parts.density.clone().skip(1).enumerate() {
        state[place] += 5e-4 * (1.3 * index as f64).sin();
        if slack.contains(&index) {
            state[place] += 0.01;
        }
    }
    for (index, place) in parts.velocity.clone().enumerate() {
        state[place] += 0.05 * (0.7 * index as f64).cos();
    }
    for (place, speed) in parts.speed.clone().zip([119.0, 121.0]) {
        state[place] = speed;
    }
    parts.close(&mut state);
    let cells: Vec<_> = { (0..6).map(|cell| (0, cell)) }
        .chain((12..18).map(|cell| (1, cell)))
        .collect();
    let slip = |(pulley, cell): (usize, usize)| {
        let faces = &state[parts.velocity.start + cell..][..2];
        0.5 * (faces[0] + faces[1]) - 0.08125 * state[parts.speed.start + pulley]
    };
    let slip: Vec<_> = cells.iter().copied().map(slip).collect();
    let (slips, carried): (Vec<_>, Vec<_>) = { slip.iter().enumerate() }
        .map(|(bristle, slip)| match resistance {
            Resistance::Bristles { .. } => (bristle % 6 >= 4, bristle % 6 < 4),
            Resistance::Creep { velocity } => (slip.abs() >= velocity, false),
        })
        .unzip();
    assert!(slips.contains(&true) && slips.contains(&false));
    for (bristle, slips) in slips.iter().enumerate() {
        let sign = if bristle < 6 { 1.0 } else { -1.0 };
        // Far beyond the largest displacement, to which it is cut back.
        let share = if *slips { 1.0 } else { 1e-6 };
        state[parts.bristle.start + bristle] = sign * share * (1.0 + 0.1 * bristle as f64);
    }
    let mut rates = Rates::new(&system);
    rates.begin(0.0);
    let mut of = |mut state: Vec<f64>| {
        parts.close(&mut state);
        let mut changes = vec![0.0; state.len()];
        rates.of(0.0, &mut state, &mut changes);
        (state, changes)
    };
    let carried = parts.bristle.clone().zip(&carried);
    let carried = carried.filter_map(|(place, carried)| carried.then_some(place));
    let densities = parts.density.clone().skip(1);
    let velocities = parts.velocity.clone().take(24);
    let places: Vec<_> = { densities.chain(velocities) }
        .chain(carried)
        .chain(parts.speed.clone())
        .collect();
    let columns: Vec<_> = { places.iter() }
        .map(|&place| {
            let step = match place {
                place if parts.density.contains(&place) => 1e-5,
                place if parts.bristle.contains(&place) => 1e-7,
                _ => 1e-3,
            };
            let [behind, ahead] = [-step, step].map(|step| {
                let mut near = state.clone();
                near[place] += step;
                of(near).1
            });
            let differences = places.iter().map(|&row| ahead[row] - behind[row]);
            differences
                .map(|change| change / (2.0 * step))
                .collect::<Vec<_>>()
        })
        .collect();
    let (cut, _) = of(state);
    if matches!(system.resistance, Resistance::Bristles { damping, .. } if damping > 0.0) {
        let limited = (0..12).filter(|&bristle| {
            let friction = rates.friction[cells[bristle].1 + 1].abs();
            let limit = 2.0e8 * rates.caps[bristle] * system.mesh.lengths[0];
            !slips[bristle] && (friction / limit - 1.0).abs() < 1e-12
        });
        // Both of them and others that are not.
        assert!((1..8).contains(&limited.count()));
    }
    let found = linearised(&rates, &cut, Some(&slips));
    assert_eq!(found.matrix.nrows(), places.len());
    let norm = found.matrix.norm_max();
    for (column, known) in columns.iter().enumerate() {
        for (row, known) in known.iter().enumerate() {
            let known = known * found.scales[column] / found.scales[row];
            let entry = found.matrix[(row, column)];
            assert!(
                (entry - known).abs() < 1e-8 * norm,
                "{row} {column}: {entry:e} {known:e}"
            );
        }
    }
}

/// The lowest mode of the belt at rest that sticks, on a mesh and one with twice the cells.
fn lowest(cells: usize, stiffness: f64, driver: &Axle) -> vibration::VibrationMode {
    let coarse = system(
        cells / 2,
        [1.2, stiffness],
        [free(0.005, None, 0.0), driver.clone()],
    );
    let fine = coarse.refined(2);
    let states = [&coarse, &fine].map(|system| {
        let state = system.parts.uniform(1.0 / STRETCH, 0.0);
        (system, state, None)
    });
    let modes = vibration::modes(states, 3).expect("eigenvalues");
    modes.into_iter().next().expect("a mode")
}

#[test]
fn torsional_eigenvalues_are_those_of_the_rod_to_second_order() {
    for (stiffness, driver, known) in [
        (2.0e8, super::held(), 833.083_529),
        (2.0e8, free(0.01, None, 0.0), 1_029.405_606),
        (8.1e9, super::held(), 885.707_146),
    ] {
        let modes = [40, 80, 160].map(|cells| lowest(cells, stiffness, &driver));
        let errors = modes
            .each_ref()
            .map(|mode| mode.angular_frequency / known - 1.0);
        println!("{errors:?}, order {:.2}", order(&errors));
        assert!(errors[1].abs() < 3e-5 && order(&errors) > 1.8, "{errors:?}");
        for mode in &modes {
            assert!(mode.is_torsional() && mode.growth.abs() < 1e-6, "{mode:?}");
            let off = (mode.angular_frequency - known).abs();
            assert!(off < mode.error, "{off} {}", mode.error);
        }
    }
}

/// The modes of a belt on two meshes in a state of uniform stretch that runs at a speed in m/s.
fn uniform(
    coarse: &System,
    speed: f64,
    slips: bool,
    count: usize,
) -> Vec<vibration::VibrationMode> {
    let fine = coarse.refined(2);
    let states = [coarse, &fine].map(|system| {
        let slips = Some(vec![slips; system.mesh.bristle_cells()]);
        let mut state = system.parts.uniform(1.0 / STRETCH, speed);
        state[system.parts.speed.clone()].fill(speed / 0.08125);
        (system, state, slips)
    });
    vibration::modes(states, count).expect("eigenvalues")
}

#[test]
fn a_light_belt_is_two_springs_between_two_inertias() {
    let radius: f64 = 0.08125;
    let pressed = 1.2 * 80_068.0 * (STRETCH - 1.0) * STRETCH / radius;
    // With k_f and c, by which friction resists displacement and slip velocity.
    for (resistance, stiffness, viscous) in [
        (bristles(0.0), 2.0e8, 0.0),
        (bristles(2e4), 2.0e8, 2e4),
        (Resistance::Creep { velocity: 0.03 }, 0.0, pressed / 0.03),
    ] {
        let axles = [free(0.005, None, 0.0), free(0.01, None, 0.0)];
        let mut system = system(80, [1.2, 2.0e8], axles);
        system.mass = 1e-4;
        system.resistance = resistance;
        // Motions as exp(s t) are held with k_f + c s, which gives way where the belt enters and leaves over
        // λ sqrt(EA/(k_f + c s)) each: s² = −2 K(s) R² (1/J₁ + 1/J₂) with the stiffness K of a span.
        let mut known = c64::new(0.0, 1e3);
        for _ in 0..50 {
            let held = c64::new(stiffness, 0.0) + known * viscous;
            let give = (c64::new(system.axial_stiffness, 0.0) / held).sqrt() * STRETCH;
            let spring = c64::new(system.axial_stiffness * STRETCH, 0.0) / (give * 2.0 + 0.25);
            let square = spring * (2.0 * radius * radius * (1.0 / 0.005 + 1.0 / 0.01));
            known = c64::new(0.0, 1.0) * square.sqrt();
        }
        let found = &uniform(&system, 0.0, false, 1)[0];
        let value = c64::new(found.growth, found.angular_frequency);
        let off = (value - known).norm() / known.norm();
        println!("{value:?} {known:?} off by {off:e}");
        assert!(off < 1e-3, "{off:e}");
        assert!(
            (found.pulley_shares[0] - 2.0 / 3.0).abs() < 1e-3,
            "{found:?}"
        );
        assert!((viscous > 0.0) == (found.growth < -1.0), "{found:?}");
        assert!(found.rims[0][0] * found.rims[1][0] < 0.0);
    }
}

#[test]
fn a_running_ring_without_friction_has_waves_with_and_against_the_motion() {
    let known = [1.155_971_4e-3, 1.130_747_8e-3].map(|period| TAU / period);
    let errors = [20, 40, 80].map(|cells| {
        let system = system(cells, [0.0, 2.0e8], [super::held(), super::held()]);
        let found = uniform(&system, 9.75, true, 2);
        assert!(
            found.iter().all(|mode| mode.growth.abs() < 1e-4 * known[0]),
            "{found:?}"
        );
        assert!(found.iter().all(|mode| !mode.is_torsional()));
        [0, 1].map(|wave| found[wave].angular_frequency / known[wave] - 1.0)
    });
    for wave in [0, 1] {
        let errors = errors.map(|errors| errors[wave]);
        println!("{errors:?}, order {:.2}", order(&errors));
        assert!(
            errors[2].abs() < 1e-3 && (order(&errors) - 2.0).abs() < 0.1,
            "{errors:?}"
        );
    }
}
