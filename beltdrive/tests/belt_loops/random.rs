//! Random loops: solved with all invariants, or refused for a reason.

use super::invariants::hold;
use super::pulley;
use super::random_numbers::Random;
use beltdrive::belt_loop::solve;
use beltdrive::{
    Belt, BeltKind, Closure, Drive, Duty, FrictionLaw, Guide, Mount, NormalForce, Sense, Side,
    SolveError, Tensioner, TensionerLoad,
};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

fn random_loop(random: &mut Random) -> Drive {
    let count = random.between(2.0, 10.0).floor();
    let law = match random.between(0.0, 5.0) {
        choice if choice < 2.0 => FrictionLaw::Coulomb,
        choice if choice < 4.0 => FrictionLaw::Epp {
            stiffness: random.between(15.0, 23.0).exp(),
        },
        _ => FrictionLaw::CreepRate {
            velocity: random.between(-9.0, 0.0).exp(),
        },
    };
    let normal_force = match (law, random.between(0.0, 4.0)) {
        (_, choice) if choice < 2.0 => NormalForce::Inertia,
        (FrictionLaw::CreepRate { .. }, _) => NormalForce::Exact,
        (_, choice) if choice < 3.0 => NormalForce::Exact,
        _ => NormalForce::Thesis,
    };
    let driver = random.between(0.0, count).floor();
    let held = random.between(0.0, 2.0 * count).floor();
    let sense = match random.between(0.0, 1.0) < 0.5 {
        true => Sense::CounterClockwise,
        false => Sense::Clockwise,
    };
    let mut pulleys = Vec::new();
    let mut index = 0.0;
    while index < count {
        let angle = sense.sign() * (index + random.between(-0.3, 0.3)) / count * TAU;
        let is_outside = count > 3.0 && random.between(0.0, 1.0) < 0.3;
        let distance = if is_outside {
            random.between(0.2, 0.7)
        } else {
            random.between(0.8, 1.2)
        };
        let load = match random.between(0.0, 1.0) {
            share if share < 0.3 => 0.0,
            share if share < 0.4 => -random.between(0.0, 10.0),
            _ => random.between(0.0, 25.0),
        };
        let centre = [0.5 * distance * angle.cos(), 0.5 * distance * angle.sin()];
        let duty = match index == driver {
            true => Duty::Driver(random.between(10.0, 250.0)),
            false if random.between(0.0, 1.0) < 0.2 => Duty::Power(100.0 * load),
            false => Duty::Torque(load),
        };
        let side = if is_outside {
            Side::Outside
        } else {
            Side::Inside
        };
        let mut placed = pulley(
            &format!("{index}"),
            centre,
            random.between(0.02, 0.12),
            side,
            duty,
        );
        placed.friction_coefficient = random.between(0.2, 1.2);
        if index == held && index != driver {
            placed.duty = Duty::Torque(0.0);
            let angle = random.between(-3.0, 3.0);
            let way = [angle.cos(), angle.sin()];
            let stiffness = random.between(5.0, 100.0);
            let travel = None;
            placed.mount = Mount::Tensioner(match random.between(0.0, 1.0) < 0.5 {
                true => Tensioner {
                    guide: Guide::Rotary {
                        pivot: [centre[0] - 0.1 * way[0], centre[1] - 0.1 * way[1]],
                        arm_length: 0.1,
                    },
                    load: TensionerLoad::Spring {
                        stiffness,
                        free_coordinate: angle + random.between(-1.5, 1.5),
                    },
                    start_coordinate: angle,
                    travel,
                },
                false => Tensioner {
                    guide: Guide::Translating {
                        origin: centre,
                        direction: way,
                    },
                    load: match random.between(0.0, 1.0) < 0.8 {
                        true => TensionerLoad::Spring {
                            stiffness: 100.0 * stiffness,
                            free_coordinate: random.between(-0.2, 0.2),
                        },
                        false => TensionerLoad::Weight(10.0 * stiffness),
                    },
                    start_coordinate: 0.0,
                    travel,
                },
            });
        }
        pulleys.push(placed);
        index += 1.0;
    }
    let tension = random.between(50.0, 1500.0);
    let is_crossed = count < 3.0 && random.between(0.0, 1.0) < 0.3;
    if is_crossed {
        pulleys[1].side = Side::Outside;
    }
    Drive {
        title: None,
        belt: Belt {
            ribs: 1,
            mass_per_length: random.between(0.02, 0.3),
            axial_stiffness: random.between(9.0, 14.0).exp(),
            kind: BeltKind::Flat { normal_force },
        },
        law,
        sense,
        turning_number: if is_crossed { 0 } else { 1 },
        pulleys,
        closure: Closure::SetupTension(tension),
    }
}

/// The loop with another closure that is often met.
fn with_random_closure(mut drive: Drive, random: &mut Random) -> Drive {
    let Closure::SetupTension(tension) = drive.closure else {
        return drive;
    };
    let starts = drive.pulleys.iter().find_map(|pulley| match pulley.mount {
        Mount::Tensioner(tensioner) => Some(tensioner.start_coordinate),
        Mount::Fixed(_) => None,
    });
    let span = random.between(0.0, drive.pulleys.len() as f64);
    drive.closure = match (random.between(0.0, 4.0), starts) {
        (choice, _) if choice < 1.0 => drive.closure,
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "an index"
        )]
        (choice, _) if choice < 2.0 => Closure::SpanTension {
            span: span as usize,
            tension,
        },
        (choice, Some(start)) if choice < 3.0 => Closure::RestCoordinate(start),
        (_, start) => match drive.layout(start.unwrap_or(0.0)) {
            Ok(layout) => {
                let strain = tension / drive.belt.axial_stiffness;
                Closure::UnstretchedLength(layout.length() / (1.0 + strain))
            }
            Err(_) => drive.closure,
        },
    };
    drive
}

#[test]
fn random_loops_are_solved_or_refused_for_a_reason() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut solved_with = [0; 10];
    let mut reasons = BTreeMap::new();
    for _ in 0..4000 {
        let drive = random_loop(&mut random);
        let drive = with_random_closure(drive, &mut random);
        match solve(&drive) {
            Ok(state) => {
                hold(&drive, &state);
                solved_with[drive.pulleys.len()] += 1;
            }
            Err(error) => {
                let message = error.to_string();
                assert!(
                    !message.contains("NaN") && !message.contains('\n'),
                    "{message}"
                );
                let name = format!("{error:?}");
                let name = name
                    .split([' ', '(', '{'])
                    .next()
                    .unwrap_or_default()
                    .to_owned();
                assert!(name != "NotFound", "{error}\n{drive:?}");
                assert!(name != "Violated", "{error}\n{drive:?}");
                assert!(name != "Statement", "{error}\n{drive:?}");
                *reasons.entry(name).or_insert(0) += 1;
            }
        }
    }
    println!("solved {solved_with:?}, refused {reasons:?}");
    assert!(
        solved_with[2..].iter().all(|&count| count > 0),
        "{solved_with:?}"
    );
    assert!(reasons.contains_key("Layout") && reasons.contains_key("GrossSlip"));
}

/// Loops with one number far from any belt drive.
#[test]
fn absurd_loops_have_finite_answers_or_a_reason() {
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let mut count = 0;
    for _ in 0..4000 {
        let drive = random_loop(&mut random);
        let mut drive = with_random_closure(drive, &mut random);
        let factor = 10_f64.powf(random.between(-20.0, 20.0));
        let pulley = &mut drive.pulleys[1];
        match random.between(0.0, 7.0) {
            choice if choice < 1.0 => drive.belt.mass_per_length *= factor,
            choice if choice < 2.0 => drive.belt.axial_stiffness *= factor,
            choice if choice < 3.0 => pulley.friction_coefficient *= factor,
            choice if choice < 4.0 => pulley.radius *= factor.min(1.0),
            choice if choice < 5.0 => match &mut pulley.duty {
                Duty::Driver(number) | Duty::Torque(number) | Duty::Power(number) => {
                    *number *= factor;
                }
                Duty::Driven => unreachable!("no loop is closed by two tensions"),
            },
            choice if choice < 6.0 => match &mut drive.law {
                FrictionLaw::Epp { stiffness: number }
                | FrictionLaw::CreepRate { velocity: number } => *number *= factor,
                _ => continue,
            },
            _ => match &mut drive.closure {
                Closure::SetupTension(number)
                | Closure::UnstretchedLength(number)
                | Closure::RestCoordinate(number)
                | Closure::SpanTension {
                    tension: number, ..
                }
                | Closure::SpanTractiveTension {
                    tension: number, ..
                } => *number *= factor,
                Closure::BothSpans(_) => unreachable!("no loop is closed by two tensions"),
            },
        }
        match solve(&drive) {
            Ok(state) => {
                count += 1;
                let text = format!("{state:?}");
                assert!(
                    !text.contains("NaN") && !text.contains("inf"),
                    "{drive:?}\n{text}"
                );
            }
            Err(error) => {
                let text = error.to_string();
                assert!(
                    !text.contains("NaN") && !text.contains('\n'),
                    "{drive:?}\n{text}"
                );
            }
        }
    }
    assert!(count > 400, "{count}");
}

/// The load limit by another way: just below it the loop is solved, just above it slips.
#[test]
fn gross_slip_begins_at_the_load_limit() {
    let mut random = Random(0x6a09_e667_f3bc_c908);
    let mut count = 0;
    for _ in 0..1500 {
        let drive = random_loop(&mut random);
        let mut drive = with_random_closure(drive, &mut random);
        drive.law = FrictionLaw::Coulomb;
        let Ok(state) = solve(&drive) else {
            continue;
        };
        // The limit is that of the torques.
        for (pulley, found) in drive.pulleys.iter_mut().zip(&state.pulleys) {
            if let Duty::Power(_) = pulley.duty {
                pulley.duty = Duty::Torque(found.torque);
            }
        }
        let Some(limit) = state.load_limit else {
            continue;
        };
        // A torque of rounding errors would slip at a factor of its own.
        if limit.factor > 1e6 {
            continue;
        }
        count += 1;
        let at = |share: f64| {
            let mut scaled = drive.clone();
            for pulley in &mut scaled.pulleys {
                if let Duty::Torque(torque) = &mut pulley.duty {
                    *torque *= share * limit.factor;
                }
            }
            (solve(&scaled), scaled)
        };
        let (below, scaled) = at(1.0 - 1e-7);
        match below {
            Ok(below) => {
                hold(&scaled, &below);
                let used = below.pulleys[limit.pulley].friction_utilisation.unwrap();
                assert!(used > 1.0 - 1e-4, "{used} {scaled:?}");
            }
            Err(error) => assert!(matches!(error, SolveError::Overstretched { .. }), "{error}"),
        }
        let (above, scaled) = at(1.0 + 1e-7);
        let SolveError::GrossSlip {
            pulley,
            load_factor,
            ..
        } = above.expect_err("gross slip")
        else {
            panic!("gross slip {scaled:?}")
        };
        assert_eq!(pulley, scaled.pulleys[limit.pulley].name);
        assert!(
            (load_factor * (1.0 + 1e-7) - 1.0).abs() < 1e-9,
            "{load_factor}"
        );
    }
    assert!(count > 200, "{count}");
}
