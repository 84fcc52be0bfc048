//! Profiles, borders and speeds.

use super::super::*;
use super::drive;
use crate::SpanTension::{Belt, DrivenTorque, Tractive};
use crate::ZoneKind;
use std::collections::BTreeMap;

/// Shares of a zone that are compared, besides the nodes of its mesh.
const SHARES: [f64; 7] = [0.0, 0.1, 0.35, 0.6, 0.9, 0.99, 1.0];
/// The scheme of tight tolerances.
const FINE: Scheme = Scheme::Gauss { stages: 6 };

/// The largest relative differences of tension, displacement, normal force, friction, speed of the driven
/// pulley, reference tensions and borders.
fn deviations(drive: &TwoPulleys, found: &BoundaryValue) -> [f64; 7] {
    let exact = ClosedForm::find(drive).unwrap();
    let mut worst = [0.0_f64; 7];
    let mut note = |index: usize, difference: f64, scale: f64| {
        let relative = if difference == 0.0 {
            0.0
        } else {
            (difference / scale).abs()
        };
        worst[index] = if relative.is_nan() {
            f64::INFINITY
        } else {
            worst[index].max(relative)
        };
    };
    let radius = [drive.driven_radius, drive.driver_radius];
    for pulley in [DRIVEN, DRIVER] {
        let contact = &exact.contact[pulley];
        let arc = contact.arc;
        let last = contact.end(contact.zones.last().unwrap());
        let largest = contact.zones.iter().map(|zone| contact.end(zone).friction);
        let (u, f) = (last.displacement, largest.fold(0.0, f64::max));
        let belt = |traction: f64| arc.belt.tension(traction);
        let to = belt(contact.reference());
        note(5, found.reference(pulley) - to, to);
        let omega = exact.rim_speed(pulley) / radius[pulley];
        note(4, found.turning(pulley) - omega, omega);
        let zones = found.bordered(pulley);
        assert_eq!(zones.len(), contact.zones.len());
        for (index, (zone, exact_zone)) in zones.iter().zip(&contact.zones).enumerate() {
            assert_eq!(zone.kind, exact_zone.friction.kind());
            note(6, zone.from - exact_zone.start.arc_length, arc.length);
            note(6, zone.to - exact_zone.end, arc.length);
            let nodes = found.nodes(pulley, index);
            for &share in nodes.iter().chain(&SHARES) {
                let place = found.at(pulley, index, share);
                let share = match zone.kind {
                    ZoneKind::Elastic => share,
                    _ => (place.arc_length - zone.from) / (zone.to - zone.from),
                };
                let expected = contact.at(exact_zone, share);
                let tension = belt(expected.traction);
                let normal = arc.slip_rate * expected.traction / drive.friction_coefficient;
                note(0, place.tension - tension, tension);
                note(1, place.displacement - arc.sense * expected.displacement, u);
                note(2, place.normal - normal, normal);
                note(3, place.friction - arc.sense * expected.friction, f);
            }
        }
    }
    worst
}

/// Deviations in one line.
fn show(values: &[f64; 7]) -> String {
    values.map(|value| format!("{value:.1e}")).join(" ")
}

/// Drives of every law, convention, kind of load and ratio of radii.
fn sample() -> Vec<(String, TwoPulleys)> {
    let mut drives = Vec::new();
    let mut laws = vec![FrictionLaw::Coulomb];
    laws.extend([1e6, 1e7, 8.1e7, 1e9, 1e12].map(|stiffness| FrictionLaw::Epp { stiffness }));
    laws.extend([0.003, 0.03, 0.3].map(|velocity| FrictionLaw::CreepRate { velocity }));
    for law in laws {
        for convention in NormalForce::ALL {
            for (radius, centre) in [(0.08125, 0.3), (0.06, 0.25), (0.15, 0.4)] {
                for tight in [230.0, 400.0, 1500.0, 4000.0] {
                    let slack = 200.0;
                    let torque = DrivenTorque((tight - slack) * radius);
                    for load in [
                        [Belt(slack), Belt(tight)],
                        [Tractive(slack), Tractive(tight)],
                        [Belt(slack), torque],
                        [torque, Tractive(tight)],
                    ] {
                        let mut drive = drive(law, convention, load[0], load[1]);
                        drive.driven_radius = radius;
                        drive.centre_distance = centre;
                        let name = format!("{law:?} {convention:?} R1 {radius} {load:?}");
                        drives.push((name, drive));
                    }
                }
            }
        }
    }
    drives
}

#[test]
fn closed_form_and_boundary_value_problem_agree() {
    let mut worst = [0.0_f64; 7];
    let mut structures = BTreeMap::<String, usize>::new();
    let drives = sample();
    for (name, drive) in &drives {
        let found = BoundaryValue::solve(drive, 1e-12, FINE);
        let found = found.unwrap_or_else(|failure| panic!("{name}: {failure}"));
        let kinds = |pulley| {
            found
                .bordered(pulley)
                .iter()
                .map(|zone| zone.kind)
                .collect()
        };
        let kinds: [Vec<_>; 2] = [DRIVEN, DRIVER].map(kinds);
        *structures.entry(format!("{kinds:?}")).or_default() += 1;
        let these = deviations(drive, &found);
        for (worst, this) in worst.iter_mut().zip(these) {
            *worst = worst.max(this);
        }
        assert!(these.iter().all(|d| *d < 1e-11), "{name}: {}", show(&these));
        assert!(found.error_estimate().is_some_and(|error| error < 1e-11));
    }
    println!(
        "{} drives; T u n f ω T_o borders {}",
        drives.len(),
        show(&worst)
    );
    println!("{structures:#?}");
    assert_eq!(structures.len(), 7);
}

#[test]
fn they_agree_with_very_stiff_and_very_soft_bristles_and_close_to_gross_slip() {
    for (stiffness, tight) in [
        (1e14, 800.0),
        (1e14, 8200.0),
        (8.1e7, 8300.0),
        (1e6, 8200.0),
        (1e5, 400.0),
        (1e9, 201.0),
    ] {
        for convention in NormalForce::ALL {
            let law = FrictionLaw::Epp { stiffness };
            let drive = drive(law, convention, Belt(200.0), Belt(tight));
            let found = match BoundaryValue::solve(&drive, 1e-11, FINE) {
                Ok(found) => found,
                // At this tolerance measured rounding may exceed it, and is refused.
                Err(error) => {
                    assert!(format!("{error:?}").contains("IllConditioned"), "{error:?}");
                    continue;
                }
            };
            let these = deviations(&drive, &found);
            let name = format!("{stiffness:e} {tight} {convention:?}");
            println!("{name} {}", show(&these));
            // Relative to the smaller tension, 1/41 of the unit of the tolerance. Measured: 1.1e-9.
            assert!(these.iter().all(|d| *d < 2e-9), "{name}: {}", show(&these));
        }
    }
}

#[test]
fn without_load_nothing_moves() {
    for law in [
        FrictionLaw::Coulomb,
        FrictionLaw::Epp { stiffness: 1e9 },
        FrictionLaw::CreepRate { velocity: 0.01 },
    ] {
        let drive = drive(law, NormalForce::Inertia, Belt(200.0), Belt(200.0));
        let found = BoundaryValue::solve(&drive, 1e-9, Scheme::Gauss { stages: 4 }).unwrap();
        assert!((found.turning(DRIVEN) - drive.driver_speed).abs() < 1e-12);
        assert_eq!(found.tension(), [200.0; 2]);
        assert!((found.reference(DRIVEN) - 200.0).abs() < 1e-12);
    }
}

/// The belt that slips under a load so small that its displacement, |u| = P (eᶻ − 1 − z)/(a D) with the
/// load z, is small of second order.
#[test]
fn small_displacements_are_accurate() {
    let drive = drive(
        FrictionLaw::Coulomb,
        NormalForce::Inertia,
        Belt(200.0),
        Belt(200.02),
    );
    let found = BoundaryValue::solve(&drive, 1e-11, FINE).unwrap();
    let arc = ClosedForm::find(&drive).unwrap().contact[DRIVEN].arc;
    let z = arc.load();
    let second_order = z * z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0 * (1.0 + z / 5.0)));
    let displacement = arc.entry() / (arc.slip_rate * arc.belt.stiffness) * second_order;
    let relative = found.at(DRIVEN, 1, 1.0).displacement / displacement - 1.0;
    assert!(relative.abs() < 1e-11, "{relative:e}");
}

/// Friction that depends on speeds and forces alone is the same in both coordinates along the belt.
#[test]
fn creep_rate_friction_is_the_same_in_the_exact_convention() {
    for velocity in [0.003, 0.3] {
        let law = FrictionLaw::CreepRate { velocity };
        let drive = drive(law, NormalForce::Exact, Belt(200.0), Belt(4000.0));
        let solve = |convention| {
            let problem = formulation_of(&drive).unwrap();
            let kinds = |pulley| {
                problem
                    .zones(pulley)
                    .map(|zone| problem.kind(zone))
                    .collect()
            };
            let zones = [DRIVEN, DRIVER].map(kinds);
            let problem = Formulation::new(&drive, problem.wrap, convention, &zones);
            BoundaryValue::of(problem, 1e-11, FINE).unwrap()
        };
        let [inertia, exact] = [NormalForce::Inertia, NormalForce::Exact].map(solve);
        for pulley in [DRIVEN, DRIVER] {
            let ratio = exact.reference(pulley) / inertia.reference(pulley);
            assert!((ratio - 1.0).abs() < 1e-12, "{ratio}");
            for (exact, inertia) in exact.bordered(pulley).iter().zip(inertia.bordered(pulley)) {
                assert!((exact.to - inertia.to).abs() < 1e-12);
            }
        }
        assert!((exact.speed() / inertia.speed() - 1.0).abs() < 1e-13);
    }
}

#[test]
fn thesis_drives_take_little_work() {
    for stiffness in [2.768_21e7, 2e8, 8.1e9] {
        let law = FrictionLaw::Epp { stiffness };
        let drive = drive(law, NormalForce::Thesis, Belt(156.2), Belt(712.2));
        let found = BoundaryValue::solve(&drive, 1e-6, Scheme::Gauss { stages: 5 }).unwrap();
        let stats = found.stats();
        println!("{stiffness:e}: {stats:?}");
        assert!(
            stats.meshes <= 3 && stats.rhs_evaluations < 4000,
            "{stats:?}"
        );
        let these = deviations(&drive, &found);
        assert!(these.iter().all(|d| *d < 1e-6), "{}", show(&these));
    }
}
