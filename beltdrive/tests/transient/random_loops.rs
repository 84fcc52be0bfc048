//! Random loops of two to five pulleys: from rest to the steady state of the closed form, or refused by both.

use super::{driver, flat_belt, from_rest, loaded};
use crate::random::Random;
use beltdrive::belt_loop::solve;
use beltdrive::transient::{
    Ending, History, Load, Schedule, TransientError, TransientEventKind, Until,
};
use beltdrive::{Closure, Drive, Duty, FrictionLaw, Pulley, Sense, simulate};
use std::f64::consts::TAU;

/// Time in which the driver comes up to speed, s; the loads rise after it.
const RISE: f64 = 0.3;

/// Uniform in the logarithm.
fn scale(random: &mut Random, low: f64, high: f64) -> f64 {
    random.between(low.ln(), high.ln()).exp()
}

/// A loop of pulleys about a circle, all inside the belt. The first one drives, the last one may idle, and what the
/// others take is at times more than friction carries.
fn drive(random: &mut Random) -> Drive {
    let count = match random.between(0.0, 4.0) {
        ..1.0 => 2,
        ..2.0 => 3,
        ..3.0 => 4,
        _ => 5,
    };
    let axial_stiffness = scale(random, 1e4, 4e5);
    let tension = axial_stiffness * scale(random, 8e-4, 6e-3);
    let mass_per_length = scale(random, 0.05, 0.5);
    let friction_coefficient = random.between(0.3, 1.2);
    let speed = (tension / mass_per_length).sqrt() * random.between(0.05, 0.4);
    // Pulleys beside each other on the circle do not touch.
    let circle = scale(random, 0.15, 0.8);
    let largest = 0.8 * circle * (0.5 * TAU / count as f64).sin();
    let radii: Vec<_> = (0..count)
        .map(|_| largest * random.between(0.3, 1.0))
        .collect();
    // Friction as stiff as lets it reach its limit on an arc, or up to a hundred times as stiff.
    let stiffness =
        friction_coefficient * axial_stiffness / largest.powi(2) * scale(random, 3.0, 100.0);
    // What all of them take of what friction carries on an arc of the driver that shrinks with their number.
    let carried = tension * (1.0 - (-friction_coefficient * TAU / count as f64).exp());
    let load = carried * random.between(0.2, 1.2);
    let shares: Vec<_> = (1..count)
        .map(|pulley| match pulley > 1 && pulley == count - 1 {
            true if random.between(0.0, 1.0) < 0.5 => 0.0,
            _ => random.between(0.5, 1.0),
        })
        .collect();
    let sum: f64 = shares.iter().sum();
    let pulleys = radii.iter().enumerate().map(|(index, &radius)| {
        let (sine, cosine) = (TAU * index as f64 / count as f64).sin_cos();
        let duty = match index.checked_sub(1) {
            None => Duty::Driver(speed / radius),
            Some(other) => Duty::Torque(load * radius * shares[other] / sum),
        };
        let centre = [circle * cosine, circle * sine];
        Pulley::new(
            &format!("p{index}"),
            centre,
            radius,
            friction_coefficient,
            duty,
        )
    });
    Drive {
        title: None,
        belt: flat_belt(mass_per_length, axial_stiffness),
        law: FrictionLaw::Epp { stiffness },
        sense: Sense::CounterClockwise,
        turning_number: 1,
        pulleys: pulleys.collect(),
        closure: Closure::SetupTension(tension),
    }
}

/// The drive from rest, until it is steady.
fn followed(drive: &Drive, cells: usize) -> Result<History, TransientError> {
    let axles = drive.pulleys.iter().map(|pulley| match pulley.duty {
        Duty::Driver(speed) => driver(Schedule::ramp([0.0, RISE], [0.0, speed])),
        Duty::Torque(torque) => {
            let rises = Schedule::ramp([RISE, 1.5 * RISE], [0.0, torque]);
            let inertia = 5.0 * drive.belt.mass_per_length * pulley.radius.powi(3);
            loaded(inertia, Load::new(rises))
        }
        _ => panic!("it drives or takes a torque"),
    });
    let mut simulation = from_rest(drive.clone(), axles.collect(), cells, 1.0);
    // Of the impedance of the belt: it ends waves and is nothing beside the loads.
    simulation.axial_damping =
        2e-4 * (drive.belt.mass_per_length * drive.belt.axial_stiffness).sqrt();
    simulation.interval = 5e-3;
    simulation.until = Until::Steady { latest: 20.0 };
    simulate(&simulation, &mut |_, _| true)
}

/// How drives of a survey ended.
#[derive(Debug, Default)]
struct Score {
    /// Both found one steady state.
    same: usize,
    /// Neither did: a pulley slips grossly.
    refused: usize,
    /// Numbers of those for which that is not so, with what was found.
    others: Vec<String>,
    /// The largest relative differences of speeds, and of tensions, of the largest one.
    largest: [f64; 2],
}

fn survey(count: usize, cells: usize) -> Score {
    let mut random = Random(20_261);
    let mut score = Score::default();
    for index in 0..count {
        let drive = drive(&mut random);
        let known = solve(&drive);
        let found = followed(&drive, cells);
        match (known, found) {
            (Ok(known), Ok(found)) if found.ending == Ending::Steady => {
                let last = found.samples.last().unwrap();
                let tight = known
                    .spans
                    .iter()
                    .map(|span| span.tension)
                    .fold(0.0, f64::max);
                let tensions = last.tensions.iter().zip(&known.spans);
                let tensions = tensions.map(|(found, known)| (found - known.tension).abs() / tight);
                let speeds = last.pulleys.iter().zip(&known.pulleys);
                let speeds = speeds
                    .map(|(found, known)| (found.angular_speed / known.angular_speed - 1.0).abs());
                let off = [speeds.fold(0.0, f64::max), tensions.fold(0.0, f64::max)];
                println!(
                    "{index}: {} pulleys, off by {off:?}, {:?}",
                    drive.pulleys.len(),
                    found.effort
                );
                score.same += 1;
                for (largest, off) in score.largest.iter_mut().zip(off) {
                    *largest = largest.max(off);
                }
            }
            (Err(error), Ok(found)) => {
                let slips = { found.events.iter() }
                    .any(|event| matches!(event.kind, TransientEventKind::GrossSlip(_)));
                let last = found.samples.last().unwrap();
                let stands = last
                    .pulleys
                    .iter()
                    .any(|pulley| pulley.angular_speed <= 0.0);
                println!("{index}: {error}, {:?}, {slips} {stands}", found.ending);
                match slips && (stands || found.ending != Ending::Steady) {
                    true => score.refused += 1,
                    false => score
                        .others
                        .push(format!("{index}: {error}, but {:?}", found.ending)),
                }
            }
            (Ok(_), Ok(found)) => score.others.push(format!("{index}: {:?}", found.ending)),
            (known, Err(error)) => {
                score
                    .others
                    .push(format!("{index}: {error}; steady: {}", known.is_ok()));
            }
        }
    }
    println!("{cells} cells: {score:?}");
    score
}

#[test]
fn random_loops_come_from_rest_to_the_closed_form_or_slip() {
    let score = survey(12, 60);
    assert_eq!(score.same + score.refused, 12);
    assert!(score.largest[0] < 1e-2 && score.largest[1] < 2e-3);
}

#[test]
#[ignore = "minutes"]
fn two_hundred_random_loops_do() {
    let score = survey(200, 120);
    // The one other slips grossly as well, and its energy ledger does not close then but with 480 cells.
    assert!(score.same >= 198 && score.refused >= 1);
    // Number 199 is close to its limit: the driver holds the belt on 0.02 of its arc, less than a cell, and its speeds
    // are off by 0.060, 0.058, 0.050, 0.035 and 0.015 with 60, 120, 240, 480 and 960 cells.
    assert!(score.largest[1] < 1e-3);
}
