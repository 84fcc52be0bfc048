//! The way to the steady state with both integrators.

use super::super::axle::{Axle, Load, Motion};
use super::super::dynamics::{Dynamics, ImplicitSteps, StepLimits};
use super::super::implicit::{Implicit, ImplicitWork};
use super::super::ledger::Ledger;
use super::super::schedule::Schedule;
use super::{Rates, STRETCH, System, follow, system};

/// A drive whose driver has a constant speed, with a load in proportion to the speed.
fn drive(cells: usize) -> System {
    let driver = Axle {
        inertia: 0.01,
        motion: Motion::Speed(Schedule::constant(SPEED)),
    };
    let load = Load {
        per_speed: 0.35,
        ..Load::new(Schedule::constant(0.0))
    };
    let driven = Axle {
        inertia: 0.005,
        motion: Motion::Torques { motor: None, load },
    };
    let mut system = system(cells, [1.2, 2e8], [driven, driver]);
    system.axial_damping = 0.5;
    system
}

/// Speed of the driver, rad/s.
const SPEED: f64 = 100.0;

/// The belt runs with the driver, the driven pulley as fast, and no bristle is displaced.
fn running(system: &System) -> Vec<f64> {
    let radius = system.wheels[0].radius;
    let mut state = system.parts.uniform(1.0 / STRETCH, SPEED * radius);
    state[system.parts.speed.clone()].fill(SPEED);
    state
}

/// The state at a time in s, and what it took.
fn implicitly(system: &System, end: f64) -> (Vec<f64>, ImplicitWork) {
    let mut state = running(system);
    let mut rates = Rates::new(system);
    let mut changes = vec![0.0; state.len()];
    let mut implicit = Implicit::new(
        &rates,
        &state,
        StepLimits {
            longest: 0.1,
            shortest: 0.0,
            tolerance: 1e-3,
        },
    );
    rates.begin(0.0);
    rates.of(0.0, &mut state, &mut changes);
    implicit.begin(&rates, &state, &changes);
    let mut time = 0.0;
    while time < end {
        if let Some(reached) = implicit.step(&mut rates, [time, end], &mut state) {
            time = reached;
        } else {
            // Explicit steps over two milliseconds, as between two samples of a run.
            follow(system, &mut state, 2e-3, |_, _| {});
            time += 2e-3;
            rates.of(time, &mut state, &mut changes);
            implicit.begin(&rates, &state, &changes);
        }
    }
    (state, implicit.work())
}

#[test]
fn two_integrators_find_one_steady_state() {
    let system = drive(60);
    let end = 3.0;
    let mut explicit = running(&system);
    let begun = system.energy(&explicit);
    follow(&system, &mut explicit, end, |_, _| {});
    let (implicit, work) = implicitly(&system, end);
    let (parts, speed) = (&system.parts, system.parts.speed.start);
    println!(
        "{work:?}: {} and {} rad/s",
        explicit[speed], implicit[speed]
    );
    let [one, other] = [&explicit, &implicit].map(|state| &state[parts.density.clone()]);
    let off = one.iter().zip(other).map(|(one, other)| {
        let [one, other] = [one, other].map(|density| system.tension(density.recip()));
        (one / other - 1.0).abs()
    });
    let off = off.fold((explicit[speed] / implicit[speed] - 1.0).abs(), f64::max);
    let ledger = Ledger::of(&system, &implicit, begun);
    println!(
        "off by {off:e}, {:e} J of {} J missing",
        ledger.residual(),
        ledger.turnover
    );
    assert!(off < 1e-9);
    assert!(ledger.closes());
    // With five percent to spare.
    assert!(work.steps <= 430 && work.iterations <= 2500 && work.factorisations <= 540);
}
