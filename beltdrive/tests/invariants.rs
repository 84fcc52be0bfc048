//! Invariants of every steady state, on drives with unequal pulleys and every friction law.

use beltdrive::{
    BeltKind, Drive, FrictionLaw, SolveOptions, SpanTension, SteadyState, TwoPulleys, examples,
    input, solve,
};
use std::f64::consts::PI;

const LAWS: [FrictionLaw; 4] = [
    FrictionLaw::Coulomb,
    FrictionLaw::Epp { stiffness: 8e6 },
    FrictionLaw::VectorEpp { stiffness: 8e6 },
    FrictionLaw::Bristle { stiffness: 2000.0 },
];

fn drives() -> Vec<TwoPulleys> {
    let example = examples::find("kim2009").unwrap();
    let kim = input::parse(example.name, example.text, &[]).unwrap();
    let kim = kim.two_pulleys().unwrap();
    let mut drives = Vec::new();
    for law in LAWS {
        for (driver_radius, driven_radius) in [(0.25, 0.25), (0.12, 0.3), (0.3, 0.12)] {
            drives.push(TwoPulleys {
                law,
                driver_radius,
                driven_radius,
                ..kim
            });
        }
    }
    drives
}

fn solved(drive: &TwoPulleys) -> SteadyState {
    solve(&Drive::from(*drive), &SolveOptions::default()).unwrap()
}

/// Trapezoidal ∫ y dx over a profile.
fn integral(x: &[f64], y: &[f64]) -> f64 {
    let panels = x.windows(2).zip(y.windows(2));
    panels
        .map(|(x, y)| 0.5 * (x[1] - x[0]) * (y[0] + y[1]))
        .sum()
}

#[test]
fn every_check_holds_with_room_to_spare() {
    for drive in drives() {
        let state = solved(&drive);
        assert!(state.checks.len() >= 6);
        for check in &state.checks {
            assert!(check.deviation <= 0.1 * check.limit, "{check:?}");
        }
    }
}

#[test]
fn zones_and_penetrations_do_not_depend_on_the_mesh() {
    for drive in drives() {
        let FrictionLaw::Bristle { .. } = drive.law else {
            continue;
        };
        let [usual, strict] = [1e-6, 1e-9].map(|tolerance| {
            let options = SolveOptions { tolerance };
            solve(&Drive::from(drive), &options).unwrap()
        });
        for (one, other) in [(usual.driver, strict.driver), (usual.driven, strict.driven)] {
            let [deepest, expected] = [&one, &other].map(|pulley| pulley.max_penetration);
            assert!(
                (deepest / expected - 1.0).abs() < 1e-7,
                "{deepest:e} {expected:e}"
            );
            assert_eq!(one.zones.len(), other.zones.len());
            for (zone, expected) in one.zones.iter().zip(&other.zones) {
                assert_eq!(zone.kind, expected.kind);
                let off = (zone.to - expected.to).abs();
                assert!(off < 1e-5, "{zone:?} {expected:?}");
            }
        }
    }
}

#[test]
fn torques_are_tension_differences_and_powers_balance() {
    for drive in drives() {
        let state = solved(&drive);
        let cos = |pulley: &beltdrive::PulleyState| pulley.inclination.map(f64::cos);
        let (slack, tight) = (state.slack_tractive_tension, state.tight_tractive_tension);
        let [entry, exit] = cos(&state.driven);
        let moment = (tight * exit - slack * entry) * drive.driven_radius;
        assert!((state.driven.torque / moment - 1.0).abs() < 1e-6);
        let [entry, exit] = cos(&state.driver);
        let moment = (tight * entry - slack * exit) * drive.driver_radius;
        assert!((state.driver.torque / moment - 1.0).abs() < 1e-6);
        let given = state.driver.torque * state.driver.angular_speed;
        let taken = state.driven.torque * state.driven.angular_speed;
        assert!(given > taken && taken > 0.0 && state.friction_loss > 0.0);
        assert!((state.efficiency - taken / given).abs() < 1e-9);
        // The transverse work is a small part of the balance.
        assert!(((given - taken - state.friction_loss) / given).abs() < 1e-2);
    }
}

#[test]
fn the_belt_turns_once_around() {
    for drive in drives() {
        let state = solved(&drive);
        let turned = |pulley: &beltdrive::PulleyState| {
            pulley.wrap_angle - (pulley.inclination[1] - pulley.inclination[0])
        };
        let total = turned(&state.driver) + turned(&state.driven);
        assert!((total - 2.0 * PI).abs() < 1e-9);
    }
}

#[test]
fn the_profile_of_the_angle_follows_from_the_inclination() {
    for drive in drives() {
        let state = solved(&drive);
        for (pulley, radius) in [
            (&state.driver, drive.driver_radius),
            (&state.driven, drive.driven_radius),
        ] {
            let profile = &pulley.profile;
            let sweep: Vec<f64> = profile
                .inclination
                .iter()
                .zip(&profile.penetration)
                .map(|(theta, x)| theta.cos() / (radius - x))
                .collect();
            let swept = integral(&profile.arc_length, &sweep);
            assert!((swept - pulley.wrap_angle).abs() < 1e-4);
            assert!(profile.arc_length.len() >= 200);
        }
    }
}

#[test]
fn a_drive_in_other_units_is_the_same_drive() {
    // Lengths, masses and times scaled together leave every angle and ratio alone.
    let (length, mass, time) = (0.4, 2.5, 0.8);
    let force = mass * length / (time * time);
    for drive in drives() {
        let tension = |t: SpanTension| match t {
            SpanTension::Tractive(value) => SpanTension::Tractive(value * force),
            SpanTension::Belt(value) => SpanTension::Belt(value * force),
            SpanTension::DrivenTorque(_) => unreachable!("V-belt drives have two tensions"),
        };
        let mut scaled = drive;
        scaled.belt.mass_per_length *= mass / length;
        scaled.belt.axial_stiffness *= force;
        if let BeltKind::V(belt) = &mut scaled.belt.kind {
            belt.radial_stiffness *= force / (length * length);
        }
        scaled.law = match drive.law {
            FrictionLaw::Coulomb => FrictionLaw::Coulomb,
            FrictionLaw::VectorEpp { stiffness } => FrictionLaw::VectorEpp {
                stiffness: stiffness * force / length.powi(2),
            },
            FrictionLaw::Epp { stiffness } => FrictionLaw::Epp {
                stiffness: stiffness * force / (length * length),
            },
            FrictionLaw::Bristle { stiffness } => FrictionLaw::Bristle {
                stiffness: stiffness / length,
            },
            _ => unreachable!("a law for V-belts"),
        };
        scaled.driver_radius *= length;
        scaled.driven_radius *= length;
        scaled.centre_distance *= length;
        scaled.driver_speed /= time;
        scaled.load.slack = tension(drive.load.slack);
        scaled.load.tight = tension(drive.load.tight);
        let (a, b) = (solved(&drive), solved(&scaled));
        assert!((a.driver.wrap_angle - b.driver.wrap_angle).abs() < 1e-8);
        assert!((a.efficiency - b.efficiency).abs() < 1e-8);
        assert!((a.driven.torque * force * length / b.driven.torque - 1.0).abs() < 1e-8);
    }
}

#[test]
fn the_belt_carries_its_tension_without_friction() {
    // With little friction the slip and the load are small and the belt seats where its tension
    // presses it: k x tan β r = F.
    let example = examples::find("kim2009-bristle").unwrap();
    let drive = input::parse(example.name, example.text, &[]).unwrap();
    let mut drive = drive.two_pulleys().unwrap();
    drive.friction_coefficient = 1e-3;
    drive.load.tight = SpanTension::Tractive(100.05);
    let state = solved(&drive);
    let profile = &state.driver.profile;
    let half = 0.5 * profile.arc_length[profile.arc_length.len() - 1];
    let middle = profile.arc_length.partition_point(|&s| s < half);
    let x = profile.penetration[middle];
    let BeltKind::V(belt) = drive.belt.kind else {
        panic!("a V-belt");
    };
    let carried = belt.radial_stiffness * x * belt.half_angle.tan() * (drive.driver_radius - x);
    let ratio = carried / profile.tractive_tension[middle];
    assert!((ratio - 1.0).abs() < 5e-3, "{ratio}");
}
