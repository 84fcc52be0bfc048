//! Runs that would take so many explicit steps that implicit ones follow them.

use super::loops::example;
use super::{driver, follow, from_rest, loaded};
use beltdrive::transient::{Load, Schedule, Simulation, Until};

/// A light idler on stiff bristles, which makes explicit steps of 6 µs; start-up in half a second, a load step at 3 s.
fn light_idler(end: f64) -> Simulation {
    let stiff = ["friction.law = epp", "friction.stiffness = 1e10 N/m^2"];
    let drive = example("back-side-idler", &stiff);
    let axles = drive.pulleys.iter().map(|pulley| match pulley.duty {
        beltdrive::Duty::Driver(speed) => driver(Schedule::ramp([0.0, 0.5], [0.0, speed])),
        beltdrive::Duty::Torque(torque) if torque != 0.0 => {
            loaded(0.02, Load::new(Schedule::step(3.0, [0.0, torque])))
        }
        _ => loaded(2e-5, Load::new(Schedule::constant(0.0))),
    });
    let axles = axles.collect();
    let mut simulation = from_rest(drive, axles, 40, end);
    simulation.axial_damping = 1.0;
    simulation.interval = 5e-3;
    simulation
}

#[test]
fn implicit_steps_follow_a_long_stiff_run_as_explicit_ones_do() {
    let simulation = light_idler(7.0);
    let own = follow(&simulation);
    let explicit = follow(&Simulation {
        step: Some(5.5e-6),
        ..simulation
    });
    assert_eq!(explicit.effort.implicit.steps, 0);
    let mut off = [0.0_f64; 3];
    for (own, explicit) in own.samples.iter().zip(&explicit.samples) {
        assert!((own.time - explicit.time).abs() < 1e-9);
        let off = &mut off[usize::from(own.time > 3.0) + usize::from(own.time > 6.0)];
        for (one, other) in own.tensions.iter().zip(&explicit.tensions) {
            *off = off.max((one / other - 1.0).abs());
        }
        for (one, other) in own.pulleys.iter().zip(&explicit.pulleys) {
            *off = off.max((one.angular_speed - other.angular_speed).abs() / 400.0);
        }
    }
    println!("off by {off:?}, {:?}, {:?}", own.effort, explicit.effort);
    // While the drive starts, after the load step, and when its vibration has died out.
    for (off, allowed) in off.iter().zip([3e-3, 1e-2, 2e-4]) {
        assert!(*off < allowed, "{off:e}");
    }
    assert!(own.effort.implicit.steps > 500);
    assert!(10 * own.effort.steps < explicit.effort.steps);
}

#[test]
fn a_run_of_ordinary_length_has_explicit_steps_alone() {
    let mut simulation = light_idler(0.1);
    simulation.until = Until::Slack { latest: 0.1 };
    assert_eq!(follow(&simulation).effort.implicit.steps, 0);
}
