//! A loop at values of its unknowns, in any scalar: its equations, and what can be measured.
//!
//! ```text
//! unknowns                                     equations
//! tension of the slackest span                 the closure
//! speed c of the belt                          the driver takes it along
//! tension at rest                              the closure, or the length of the belt
//! coordinates of the tensioner, running        Q(q) − F dL/dq = 0
//!   and at rest                                  in both
//! torque of each pulley with a given power     M ω = P
//! torque of the driven pulley between two      the tension of the other span
//!   given tensions
//! ```

use super::closing::Target;
use super::numbers::{Numbers, Read};
use super::rest::{tension, unstretched};
use super::running::{Running, RunningBelt};
use super::solved::Solved;
use crate::drive::layout::{Circle, Wound};
use crate::mechanics::implicit::Implicit;
use crate::results::loop_state::LoopState;
use crate::{Closure, Drive, Duty, Load, Mount, NormalForce, SpanTension, Tensioner};
use bvp::Real;

/// A loop at values of its unknowns.
pub(super) struct Evaluated<S> {
    /// What is to vanish.
    pub(super) residuals: Vec<S>,
    numbers: Numbers<S>,
    pub(super) belt: RunningBelt<S>,
    wound: Wound<S>,
    rest_wound: Wound<S>,
    rest_tension: S,
    unstretched: S,
}

/// Whether the torque of a pulley is an unknown.
fn is_unknown(duty: Duty) -> bool {
    matches!(duty, Duty::Power(_) | Duty::Driven)
}

/// The unknowns in a solved state.
pub(super) fn unknowns(drive: &Drive, state: &LoopState) -> Vec<f64> {
    let is_thesis = Numbers::<f64>::convention(drive) == NormalForce::Thesis;
    let tensions = state.spans.iter().map(|span| match is_thesis {
        true => span.tension,
        false => span.tractive_tension,
    });
    let slackest = tensions.fold(f64::INFINITY, f64::min);
    let tensioner = state.tensioner.iter();
    let coordinates = tensioner.flat_map(|found| [found.coordinate, found.rest_coordinate]);
    let pulleys = drive.pulleys.iter().zip(&state.pulleys);
    let torques = pulleys.filter(|(stated, _)| is_unknown(stated.duty));
    [slackest, state.unstretched_speed, state.rest_tension]
        .into_iter()
        .chain(coordinates)
        .chain(torques.map(|(_, found)| found.torque))
        .collect()
}

/// The tensioner at a coordinate, which differs from its value by no more than a derivative.
struct Guided<S> {
    /// Its centre, m, and the derivative of that with the coordinate.
    centre: [S; 2],
    velocity: [S; 2],
    /// Load along the coordinate, N·m or N.
    load: S,
}

impl<S: Real> Guided<S> {
    fn new(read: &impl Read<S>, coordinate: S) -> Self {
        let place = coordinate.value();
        let beside = coordinate - place;
        let number = |of: &dyn Fn(&Tensioner) -> f64| {
            read(&|drive| {
                drive
                    .tensioner()
                    .map_or(f64::NAN, |(_, tensioner)| of(tensioner))
            })
        };
        let guided = |order: usize| {
            [0, 1].map(|part| {
                let [here, slope] = [order, order + 1]
                    .map(|order| number(&|tensioner| tensioner.guide.centre(place)[order][part]));
                here + slope * beside
            })
        };
        let [load, slope] =
            [0, 1].map(|order| number(&|tensioner| tensioner.load_at(place)[order]));
        Self {
            centre: guided(0),
            velocity: guided(1),
            load: load + slope * beside,
        }
    }

    /// Its load less the force of the belt with a tractive tension in N, along the coordinate: Q − F dL/dq.
    fn balance(&self, wound: &Wound<S>, idler: usize, tractive: S) -> S {
        let gradient = wound.length_gradient(idler);
        let slope = gradient[0] * self.velocity[0] + gradient[1] * self.velocity[1];
        self.load - tractive * slope
    }
}

impl<S: Implicit> Evaluated<S> {
    /// `None` if the belt cannot be laid round the pulleys, or does not carry the load.
    pub(super) fn new(drive: &Drive, unknowns: &[S], read: impl Read<S>) -> Option<Self> {
        let &[slackest, speed, rest_tension, ref others @ ..] = unknowns else {
            return None;
        };
        let idler = drive.tensioner().map(|(idler, _)| idler);
        let (coordinates, torques) = others.split_at(idler.map_or(0, |_| 2));
        let torques = self::torques(drive, torques, &read)?;
        let numbers = Numbers::new(drive, &torques, &read);
        let held = coordinates.iter();
        let held: Vec<_> = held.map(|&place| Guided::new(&read, place)).collect();
        let laid = |held: Option<&Guided<S>>| wound(drive, &numbers, held, &read);
        let [wound, rest_wound] = [laid(held.first())?, laid(held.last())?];
        let running = Running::new(&numbers, &wound, drive.law, 1.0);
        let moving = running.moving(speed, slackest);
        let belt = running.at(moving)?;
        let outruns = running.outruns(moving, belt.contacts[numbers.driver].reference());
        let mut residuals = vec![outruns];

        let rest_length = rest_wound.length(numbers.rims.iter().map(|rim| rim.radius));
        let axial = numbers.axial_stiffness;
        let asked = read(&|drive| drive.closure.value());
        let closes = |target| Some(running.tightness(moving, target)?.surplus);
        let unstretched = match (drive.closure, tensions(drive, &read)) {
            (closure, None) => {
                residuals.push(closes(Target::as_at_rest(
                    rest_length,
                    rest_tension,
                    axial,
                ))?);
                match closure {
                    Closure::UnstretchedLength(_) => asked,
                    _ => unstretched(rest_length, rest_tension, axial),
                }
            }
            (_, Some(tensions)) => {
                for (span, by, tension) in tensions {
                    residuals.push(match by {
                        SpanTension::Belt(_) => closes(Target::Tension { span, tension })?,
                        SpanTension::Tractive(_) => {
                            closes(Target::TractiveTension { span, tension })?
                        }
                        SpanTension::DrivenTorque(_) => torques[1 - numbers.driver] - tension,
                    });
                }
                running.length() - belt.elongation
            }
        };
        residuals.push(match (drive.closure, coordinates) {
            (Closure::SetupTension(_), _) => rest_tension - asked,
            (Closure::RestCoordinate(_), &[_, coordinate]) => coordinate - asked,
            _ => rest_tension - tension(rest_length, unstretched, axial),
        });
        if let (Some(idler), [moved, rest]) = (idler, &held[..]) {
            let tractive = running.tractive(moving, idler);
            residuals.push(moved.balance(&wound, idler, tractive));
            residuals.push(rest.balance(&rest_wound, idler, rest_tension));
        }
        let mut evaluated = Self {
            residuals,
            numbers,
            belt,
            wound,
            rest_wound,
            rest_tension,
            unstretched,
        };
        for (pulley, stated) in drive.pulleys.iter().enumerate() {
            if let Duty::Power(_) = stated.duty {
                let power = read(&|drive| drive.pulleys[pulley].duty.value());
                let speed = evaluated.solved().angular_speed(pulley);
                evaluated.residuals.push(torques[pulley] * speed - power);
            }
        }
        Some(evaluated)
    }

    /// What can be measured follows from this.
    pub(super) fn solved(&self) -> Solved<'_, S> {
        Solved {
            numbers: &self.numbers,
            belt: &self.belt,
            wound: &self.wound,
            rest_wound: &self.rest_wound,
            rest_tension: self.rest_tension,
            unstretched: self.unstretched,
        }
    }
}

/// The torques of all pulleys, N·m, of which some are unknowns; that of the driver means nothing.
fn torques<S: Real>(drive: &Drive, unknowns: &[S], read: &impl Read<S>) -> Option<Vec<S>> {
    let mut unknowns = unknowns.iter().copied();
    let pulleys = drive.pulleys.iter().enumerate();
    let torques = pulleys.map(|(pulley, stated)| match is_unknown(stated.duty) {
        true => unknowns.next(),
        false => Some(read(&|drive| drive.pulleys[pulley].duty.value())),
    });
    torques.collect()
}

/// The belt round the pulleys with the tensioner where it is held.
fn wound<S: Real>(
    drive: &Drive,
    numbers: &Numbers<S>,
    held: Option<&Guided<S>>,
    read: &impl Read<S>,
) -> Option<Wound<S>> {
    let circles = drive.pulleys.iter().zip(&numbers.rims).enumerate();
    let circles = circles.map(|(index, (pulley, rim))| Circle {
        centre: match (pulley.mount, held) {
            (Mount::Tensioner(_), Some(held)) => held.centre,
            _ => [0, 1].map(|part| read(&|drive| fixed(drive.pulleys[index].mount)[part])),
        },
        radius: rim.radius,
        turns: pulley.side.turns(drive.sense),
    });
    Wound::new(&circles.collect::<Vec<_>>()).ok()
}

/// The centre of a pulley at a fixed place, m.
fn fixed(mount: Mount) -> [f64; 2] {
    match mount {
        Mount::Fixed(centre) => centre,
        Mount::Tensioner(_) => [f64::NAN; 2],
    }
}

/// The spans whose tensions close a loop, by what these are prescribed, and that; `None` if its belt at rest does.
fn tensions<S: Real>(drive: &Drive, read: &impl Read<S>) -> Option<Vec<(usize, SpanTension, S)>> {
    let asked = read(&|drive| drive.closure.value());
    match drive.closure {
        Closure::SpanTension { span, tension } => {
            Some(vec![(span, SpanTension::Belt(tension), asked)])
        }
        Closure::SpanTractiveTension { span, tension } => {
            Some(vec![(span, SpanTension::Tractive(tension), asked)])
        }
        Closure::BothSpans(Load { slack, tight }) => {
            let other = read(&|drive| match drive.closure {
                Closure::BothSpans(load) => load.tight.value(),
                _ => f64::NAN,
            });
            let driver = drive.driver();
            Some(vec![(driver, slack, asked), (1 - driver, tight, other)])
        }
        Closure::UnstretchedLength(_) | Closure::SetupTension(_) | Closure::RestCoordinate(_) => {
            None
        }
    }
}
