//! Creep-rate friction and damped bristles in time.

use super::{driver, from_rest, kim, loaded};
use beltdrive::belt_loop::solve;
use beltdrive::transient::{Ending, History, Load, Schedule, Simulation, Until};
use beltdrive::{Drive, FrictionLaw, simulate};

/// The drive of Kim (2009) from rest, with a friction law.
fn simulation(law: FrictionLaw, cells: usize) -> Simulation {
    let drive = Drive {
        law,
        ..kim(2e8, 5.45e-3, 30.0)
    };
    let load = Load::new(Schedule::ramp([0.05, 0.1], [0.0, 30.0]));
    let axles = vec![
        driver(Schedule::ramp([0.0, 0.05], [0.0, 120.0])),
        loaded(0.002, load),
    ];
    let mut simulation = from_rest(drive, axles, cells, 1.0);
    simulation.axial_damping = 0.02;
    simulation.until = Until::Steady { latest: 10.0 };
    simulation
}

fn steady(simulation: &Simulation) -> History {
    let history = simulate(simulation, &mut |_, _| true).unwrap();
    assert_eq!(history.ending, Ending::Steady);
    let ledger = history.samples.last().unwrap().ledger;
    assert!(ledger.residual().abs() < 2e-5 * ledger.turnover);
    println!("{:?}", history.effort);
    history
}

#[test]
fn with_creep_rate_friction_a_drive_comes_from_rest_to_the_closed_form() {
    let law = FrictionLaw::CreepRate { velocity: 0.1 };
    let known = solve(&simulation(law, 60).drive).unwrap();
    let errors = [60, 120, 240].map(|cells| {
        let history = steady(&simulation(law, cells));
        assert!(history.effort.implicit.steps > 0);
        let last = history.samples.last().unwrap();
        for (tension, span) in last.tensions.iter().zip(&known.spans) {
            assert!((tension / span.tension - 1.0).abs() < 1e-3);
        }
        last.pulleys[1].angular_speed - known.pulleys[1].angular_speed
    });
    println!("{errors:?} rad/s");
    assert!(errors[2].abs() < 2e-6 * 120.0 && (errors[0] / errors[2]).log2() > 3.4);
}

#[test]
fn damped_bristles_take_the_vibration_off_a_drive() {
    let law = FrictionLaw::Epp { stiffness: 2e8 };
    let mut damped = simulation(law, 60);
    damped.friction_damping = 1e4;
    let history = steady(&damped);
    assert!(history.effort.implicit.steps > 0);
    damped.step = Some(1e-5);
    let explicit = steady(&damped);
    assert_eq!(explicit.effort.implicit.steps, 0);
    println!("{:?} {:?}", history.effort, explicit.effort);
    let [own, other] = [&history, &explicit].map(|history| history.samples.last().unwrap());
    for (own, other) in own.tensions.iter().zip(&other.tensions) {
        assert!((own / other - 1.0).abs() < 1e-7, "{own} {other}");
    }
    let free = steady(&simulation(law, 60));
    let [damped, free] = [&history, &free].map(|history| history.samples.last().unwrap());
    // Friction is as that of bristles bent by c_f/k_f V = 0.5 mm of belt more.
    assert!((damped.tensions[1] / free.tensions[1] - 1.0).abs() < 1e-4);
    let slips = [damped, free].map(|sample| sample.pulleys[1].angular_speed / 120.0 - 1.0);
    assert!((slips[0] / slips[1] - 1.0).abs() < 0.02, "{slips:?}");
}
