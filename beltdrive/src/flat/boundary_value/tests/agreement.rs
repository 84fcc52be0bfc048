//! Profiles, borders and speeds.

use super::super::*;
use super::drive;
use crate::SpanTension::{Belt, DrivenTorque, Tractive};
use crate::{FrictionLaw, NormalForce};

const SHARES: [f64; 7] = [0.0, 0.1, 0.35, 0.6, 0.9, 0.99, 1.0];

/// The largest relative differences of tension, displacement, normal force, friction, speed of the driven
/// pulley, reference tensions and borders.
fn deviations(drive: &Drive, found: &BoundaryValue) -> [f64; 7] {
    let exact = ClosedForm::new(drive).unwrap();
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
        let omega = exact.rim_speed(drive, pulley) / radius[pulley];
        note(4, found.angular_speed(pulley) - omega, omega);
        let zones = found.zones(pulley);
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

fn show(values: &[f64; 7]) -> String {
    values.map(|value| format!("{value:.1e}")).join(" ")
}

fn sample() -> Vec<(String, Drive)> {
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
    let (mut solved, mut refused, mut wrong) = (0, 0, Vec::new());
    let mut structures = std::collections::BTreeMap::<String, usize>::new();
    for (name, drive) in sample() {
        let found = match BoundaryValue::solve(&drive, 1e-11, Scheme::Gauss { stages: 6 }) {
            Ok(found) => found,
            Err(Failure::Refused(_)) => {
                refused += 1;
                continue;
            }
            Err(failure) => {
                let text = match failure {
                    Failure::Solver(e) => e.to_string(),
                    f => format!("{f:?}"),
                };
                wrong.push(format!("{name}: {text}"));
                continue;
            }
        };
        solved += 1;
        let kinds = [DRIVEN, DRIVER].map(|pulley| {
            found
                .zones(pulley)
                .iter()
                .map(|z| z.kind)
                .collect::<Vec<_>>()
        });
        *structures.entry(format!("{kinds:?}")).or_default() += 1;
        let these = deviations(&drive, &found);
        for (worst, this) in worst.iter_mut().zip(these) {
            *worst = worst.max(this);
        }
        if these.iter().any(|d| *d > 1e-10) {
            wrong.push(format!(
                "{name}: {} {:?} {:?}",
                show(&these),
                found.error_estimate(),
                found.stats()
            ));
        }
    }
    println!(
        "{solved} solved, {refused} refused; T u n f ω T_o borders {}",
        show(&worst)
    );
    println!("{structures:#?}");
    for w in wrong.iter() {
        println!("{w}");
    }
    assert!(wrong.is_empty(), "{}", wrong.len());
}
