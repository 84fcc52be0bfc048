//! What the statement of a belt loop has to be.

use crate::drive::layout::Side;
use crate::{BeltKind, Closure, Drive, Duty, Guide, Mount, SolveError, Tensioner, TensionerLoad};
use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;

/// Largest magnitude of a number, SI: squares and products of three are far from overflow.
const LARGEST: f64 = 1e60;

/// Smallest distance of a half angle from 0 and from 90°, rad: tan β and its inverse are no larger than
/// 1e4.
const SMALLEST_ANGLE: f64 = 1e-4;

/// How far the length of a direction may be from 1: components that were stated with ten digits.
const ROUNDED: f64 = 1e-9;

/// Largest coefficient of friction: the exponential of friction times wrap is a number up to here.
const LARGEST_FRICTION: f64 = 100.0;

/// A part of the statement that is out of its range.
fn refuse(subject: &str, problem: impl Into<Cow<'static, str>>) -> Result<(), SolveError> {
    Err(SolveError::Statement {
        subject: subject.to_owned(),
        problem: problem.into(),
    })
}

/// The first part of the statement that is out of its range.
pub(crate) fn check(drive: &Drive) -> Result<(), SolveError> {
    let belt = drive.belt;
    if !(positive(belt.mass_per_length) && positive(belt.axial_stiffness)) {
        return refuse(
            "belt",
            "mass per length and axial stiffness must be positive",
        );
    }
    let half_angle = |angle: f64| angle > SMALLEST_ANGLE && angle < FRAC_PI_2 - SMALLEST_ANGLE;
    let normal_force = match belt.kind {
        BeltKind::Flat { normal_force } => Some(normal_force),
        BeltKind::V(v) if positive(v.radial_stiffness) && half_angle(v.half_angle) => None,
        BeltKind::V(_) => {
            return refuse(
                "belt",
                "the radial stiffness must be positive, and the half angle between 0 and 90°",
            );
        }
    };
    let is_flat = normal_force.is_some();
    let law = drive.law;
    if let Some(reason) = law.row().unsuited(belt.kind) {
        return refuse("friction", reason);
    }
    if let (Some(parameter), Some(value)) = (&law.row().parameter, law.parameter())
        && !positive(value)
    {
        return refuse(
            "friction",
            format!("the {} must be positive", parameter.name),
        );
    }
    let [mut drivers, mut tensioners] = [0, 0];
    for pulley in &drive.pulleys {
        if !(positive(pulley.radius) && positive(pulley.friction_coefficient)) {
            return refuse(
                &pulley.name,
                "radius and coefficient of friction must be positive",
            );
        }
        if pulley.friction_coefficient > LARGEST_FRICTION {
            return refuse(
                &pulley.name,
                "the coefficient of friction must not exceed 100",
            );
        }
        match pulley.half_angle {
            Some(_) if is_flat || pulley.side == Side::Outside => {
                return refuse(
                    &pulley.name,
                    "a half angle is that of the groove of a V-belt, and this pulley has none",
                );
            }
            Some(angle) if !half_angle(angle) => {
                return refuse(&pulley.name, "the half angle must be between 0 and 90°");
            }
            _ => {}
        }
        if let (BeltKind::V(v), Side::Inside) = (belt.kind, pulley.side) {
            let half_angle = pulley.half_angle.unwrap_or(v.half_angle);
            if pulley.friction_coefficient * half_angle.tan() >= 1.0 {
                return refuse(
                    &pulley.name,
                    "the groove is so wide and rough that its faces cannot press a belt that sinks: the \
                     coefficient of friction must be below 1/tan of the half angle",
                );
            }
        }
        match pulley.duty {
            Duty::Driver(speed) if positive(speed) => drivers += 1,
            Duty::Driver(_) => return refuse(&pulley.name, "the driver's speed must be positive"),
            Duty::Torque(torque) if finite(torque) => {}
            Duty::Power(power) if finite(power) => {}
            Duty::Driven if matches!(drive.closure, Closure::BothSpans(_)) => {}
            Duty::Driven => {
                return refuse(
                    &pulley.name,
                    "it takes what the tensions of both spans leave it, and these do not close the drive",
                );
            }
            Duty::Torque(_) => return refuse(&pulley.name, "the torque must be a finite number"),
            Duty::Power(_) => return refuse(&pulley.name, "the power must be a finite number"),
        }
        match pulley.mount {
            Mount::Fixed(centre) if centre.iter().all(|&part| finite(part)) => {}
            Mount::Fixed(_) => return refuse(&pulley.name, "the centre must be finite"),
            Mount::Tensioner(tensioner) => {
                tensioners += 1;
                if !is_tensioner(&tensioner) {
                    return refuse(
                        &pulley.name,
                        "the tensioner needs finite places, a positive stiffness or weight, an arm or a direction of \
                         length 1, and stops in ascending order",
                    );
                }
                if pulley.duty != Duty::Torque(0.0) {
                    return refuse(&pulley.name, "the pulley on a tensioner must be an idler");
                }
            }
        }
    }
    if drivers != 1 {
        return refuse("pulleys", "exactly one must be the driver");
    }
    if tensioners > 1 {
        return refuse("pulleys", "at most one can be on a tensioner");
    }
    let is_closed = match drive.closure {
        Closure::UnstretchedLength(length) => positive(length),
        Closure::SetupTension(tension) => positive(tension),
        Closure::SpanTension { span, tension } | Closure::SpanTractiveTension { span, tension } => {
            positive(tension) && span < drive.pulleys.len()
        }
        Closure::RestCoordinate(coordinate) => finite(coordinate) && tensioners == 1,
        Closure::BothSpans(_) => {
            return refuse(
                "closure",
                "the tensions of both spans close an open belt round a driver and a driven pulley",
            );
        }
    };
    match is_closed {
        true => Ok(()),
        false => refuse(
            "closure",
            "a length or a tension must be positive, a span one of the loop, \
             a coordinate that of a tensioner",
        ),
    }
}

/// Whether the numbers of a tensioner are in their ranges.
fn is_tensioner(tensioner: &Tensioner) -> bool {
    let (place, is_guided) = match tensioner.guide {
        Guide::Rotary { pivot, arm_length } => (pivot, positive(arm_length)),
        Guide::Translating {
            origin,
            direction: [x, y],
        } => (origin, (x.hypot(y) - 1.0).abs() < ROUNDED),
    };
    let [low, high] = tensioner.travel.unwrap_or([0.0, 1.0]);
    let is_loaded = match tensioner.load {
        TensionerLoad::Spring {
            stiffness,
            free_coordinate,
        } => positive(stiffness) && finite(free_coordinate),
        TensionerLoad::Weight(weight) => positive(weight),
    };
    let numbers = [place[0], place[1], tensioner.start_coordinate, low, high];
    let is_finite = numbers.iter().all(|&number| finite(number));
    is_finite && is_guided && is_loaded && low < high
}

/// Whether a number is one, and not too large.
fn finite(value: f64) -> bool {
    value.abs() < LARGEST
}

/// Whether a number is positive, and neither too small nor too large.
fn positive(value: f64) -> bool {
    value > 1.0 / LARGEST && value < LARGEST
}
