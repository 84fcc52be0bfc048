//! What the statement of a belt loop has to be.

use super::error::LoopError;
use crate::drive::belt_loop::{BeltLoop, Closure, Duty, Guide, Mount, Tensioner, TensionerLoad};
use crate::{BeltKind, FrictionLaw, NormalForce};

/// Largest magnitude of a number, SI: squares and products of three are far from overflow.
const LARGEST: f64 = 1e60;

/// How far the length of a direction may be from 1: components that were stated with ten digits.
const ROUNDED: f64 = 1e-9;

/// Largest coefficient of friction: the exponential of friction times wrap is a number up to here.
const LARGEST_FRICTION: f64 = 100.0;

/// The first part of the statement that is out of its range.
pub(super) fn check(belt_loop: &BeltLoop) -> Result<(), LoopError> {
    let refuse = |subject: &str, problem| {
        Err(LoopError::Statement {
            subject: subject.to_owned(),
            problem,
        })
    };
    let belt = belt_loop.belt;
    if !(positive(belt.mass_per_length) && positive(belt.axial_stiffness)) {
        return refuse(
            "belt",
            "mass per length and axial stiffness must be positive",
        );
    }
    let inertia = BeltKind::Flat {
        normal_force: NormalForce::Inertia,
    };
    if belt.kind != inertia {
        return refuse(
            "belt",
            "only flat belts with the normal force `inertia` are modelled",
        );
    }
    match belt_loop.law {
        FrictionLaw::Coulomb => {}
        FrictionLaw::Epp { stiffness } if positive(stiffness) => {}
        FrictionLaw::Epp { .. } => return refuse("friction", "the stiffness must be positive"),
        _ => return refuse("friction", "only `coulomb` and `epp` are modelled"),
    }
    let [mut drivers, mut tensioners] = [0, 0];
    for pulley in &belt_loop.pulleys {
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
        if pulley.half_angle.is_some() {
            return refuse(
                &pulley.name,
                "a flat belt has no groove, and so no half angle",
            );
        }
        match pulley.duty {
            Duty::Driver(speed) if positive(speed) => drivers += 1,
            Duty::Driver(_) => return refuse(&pulley.name, "the driver's speed must be positive"),
            Duty::Torque(torque) if finite(torque) => {}
            Duty::Power(power) if finite(power) => {}
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
    let is_closed = match belt_loop.closure {
        Closure::UnstretchedLength(length) => positive(length),
        Closure::SetupTension(tension) => positive(tension),
        Closure::SpanTension { span, tension } | Closure::SpanTractiveTension { span, tension } => {
            positive(tension) && span < belt_loop.pulleys.len()
        }
        Closure::RestCoordinate(coordinate) => finite(coordinate) && tensioners == 1,
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
