//! From a loop to its steady state: rest, unloaded loop, load factor limit, loaded loop.

use super::checks::checked;
use super::closing::{Closing, Target};
use super::limit::{judged, largest, load_limit, slips};
use super::loads::Loads;
use super::results::{Found, state};
use super::running::RunningBelt;
use crate::drive::belt_loop::{BeltLoop, Closure, Duty, LoopPulley};
use crate::drive::layout::Layout;
use crate::mechanics::tensioner::{Held, Towards, equilibrium, length_derivatives, within_travel};
use crate::results::loop_error::LoopError;
use crate::results::loop_state::LoopState;
use crate::{BeltKind, FrictionLaw, NormalForce};

/// Largest strain of the belt: at twice its length no belt is linear elastic, and far beyond it the length
/// of the unstretched belt is lost in rounding.
const LARGEST_STRAIN: f64 = 1.0;

/// A given power is met to this, relative: rounding errors of the torques.
const POWER: f64 = 1e-14;

/// Most iterations for the torques of given powers. Each divides the error by about EA over the change of
/// tension, at least 10 for any belt, or by the belt speed over the creep; 30 leave room for one about to
/// stall.
const POWERS: usize = 30;

/// The slope of the torque asked for with the torque is taken from changes above this, relative, far above
/// rounding errors; it is no more than the second number, which limits a step to ten times the change.
const SLOPE: (f64, f64) = (1e-10, 0.9);

/// The belt at rest: uniform tension, no friction.
#[derive(Clone, Debug)]
pub(super) struct Rest {
    /// Coordinate of the tensioner, rad or m; without one it means nothing.
    pub(super) coordinate: f64,
    pub(super) layout: Layout,
    /// Belt tension, N.
    pub(super) tension: f64,
    /// Length `L_0` of the unstretched belt, m.
    pub(super) unstretched: f64,
}

/// The loop under load.
pub(super) struct Loaded {
    /// Coordinate of the tensioner, rad or m; without one it means nothing.
    pub(super) coordinate: f64,
    pub(super) layout: Layout,
    /// The belt; `None` if it does not press on all pulleys, or not enough for elastic friction.
    pub(super) belt: Option<RunningBelt>,
}

/// A loop with its torques and what its closure asks of the running belt.
pub(super) struct Problem<'l> {
    pub(super) belt_loop: &'l BeltLoop,
    pub(super) loads: Loads,
    pub(super) target: Target,
    pub(super) convention: NormalForce,
    /// Index of the driver.
    pub(super) driver: usize,
    /// Circumferential speed R ω of the driver, m/s.
    pub(super) rim: f64,
    /// Where the equilibrium of the tensioner is sought from.
    pub(super) start: f64,
    pub(super) towards: Towards,
}

/// The steady state of a belt loop.
///
/// Coulomb friction is judged first: a loop slips grossly if it does with Coulomb friction at the same
/// closure, whatever its friction law.
///
/// # Errors
/// Those of [`LoopError`], in the order given there.
pub(crate) fn solve(belt_loop: &BeltLoop) -> Result<LoopState, LoopError> {
    let rim = belt_loop.rim_speed();
    let torque = |pulley: &LoopPulley| match pulley.duty {
        Duty::Driver(_) => 0.0,
        Duty::Torque(torque) => torque,
        Duty::Power(power) => power * pulley.radius / rim,
    };
    let mut torques: Vec<_> = belt_loop.pulleys.iter().map(torque).collect();
    // The last torque of each pulley, what its power asked for there, and the slope of that.
    let mut last = vec![[f64::NAN, f64::NAN, 0.0]; torques.len()];
    let has_powers = belt_loop.pulleys.iter();
    let has_powers = { has_powers }.any(|pulley| matches!(pulley.duty, Duty::Power(_)));
    if !has_powers {
        return with_torques(belt_loop, &torques, true);
    }
    for _ in 0..POWERS {
        let state = with_torques(belt_loop, &torques, false)?;
        let mut change = 0.0;
        for (index, pulley) in belt_loop.pulleys.iter().enumerate() {
            if let Duty::Power(power) = pulley.duty {
                let (torque, [before, asked_before, slope]) = (torques[index], last[index]);
                let asked = power / state.pulleys[index].angular_speed;
                change = f64::max(change, ((asked - torque) / asked).abs());
                let moved = torque - before;
                let slope = match moved.abs() > SLOPE.0 * torque.abs() {
                    true => ((asked - asked_before) / moved).clamp(-SLOPE.1, SLOPE.1),
                    false => slope,
                };
                last[index] = [torque, asked, slope];
                torques[index] = torque + (asked - torque) / (1.0 - slope);
            }
        }
        if change.is_nan() || change < POWER {
            return with_torques(belt_loop, &torques, true);
        }
    }
    Err(LoopError::NotFound {
        what: "torque of a given power",
    })
}

/// The steady state of a belt loop with given torques; the final one has its load factor limit and its
/// checks.
fn with_torques(
    belt_loop: &BeltLoop,
    torques: &[f64],
    is_final: bool,
) -> Result<LoopState, LoopError> {
    let start = belt_loop.start_coordinate();
    belt_loop.layout(start)?;
    let (rest, target) = match belt_loop.closure {
        Closure::SpanTension { span, tension } => (None, Target::Tension { span, tension }),
        Closure::SpanTractiveTension { span, tension } => {
            (None, Target::TractiveTension { span, tension })
        }
        _ => {
            let rest = rest_of_closure(belt_loop, start)?;
            let length = rest.layout.length();
            let strain = rest.tension / belt_loop.belt.axial_stiffness;
            let elongation = length * strain / (1.0 + strain);
            (Some(rest), Target::Unstretched { length, elongation })
        }
    };
    let mut problem = Problem {
        belt_loop,
        loads: Loads::new(belt_loop, torques),
        target,
        convention: match belt_loop.belt.kind {
            BeltKind::Flat { normal_force } => belt_loop.law.row().convention(normal_force),
            BeltKind::V(_) => panic!("a flat belt was expected"),
        },
        driver: belt_loop.driver(),
        rim: belt_loop.rim_speed(),
        start: rest.as_ref().map_or(start, |rest| rest.coordinate),
        towards: match rest {
            Some(_) => Towards::Force,
            None => Towards::Newton,
        },
    };
    problem.start = problem.unloaded()?;
    let rigid = problem.loaded(1.0, FrictionLaw::Coulomb)?;
    let rest = match rest {
        Some(rest) => Some(rest),
        None => problem.rest_of(&rigid)?,
    };
    let at_rest = rest.as_ref().map(|rest| rest.coordinate);
    let running = rigid.belt.as_ref().map(|_| rigid.coordinate);
    for coordinate in at_rest.into_iter().chain(running) {
        within_travel(belt_loop, coordinate)?;
    }
    let judged = judged(&problem, &rigid);
    let limit = match is_final || slips(judged.as_ref()) {
        true => load_limit(&problem, &rigid, judged.as_ref())?,
        false => None,
    };
    let loaded = match belt_loop.law {
        FrictionLaw::Coulomb => rigid,
        _ => {
            problem.start = rigid.coordinate;
            problem.loaded(1.0, belt_loop.law)?
        }
    };
    let rest = match belt_loop.closure {
        Closure::SpanTension { .. } | Closure::SpanTractiveTension { .. } => {
            problem.rest_of(&loaded)?
        }
        _ => rest,
    };
    let stalls = |pulley: usize| LoopError::Stalls {
        pulley: belt_loop.pulleys[pulley].name.clone(),
    };
    let Loaded {
        coordinate,
        layout,
        belt: Some(belt),
    } = loaded
    else {
        return Err(stalls(judged.map_or(0, |judged| largest(&judged).0)));
    };
    let rest = rest.ok_or(LoopError::NotFound {
        what: "state at rest",
    })?;
    within_travel(belt_loop, coordinate)?;
    within_travel(belt_loop, rest.coordinate)?;
    let axial = belt_loop.belt.axial_stiffness;
    presses(&belt)?;
    let tractions = belt.tractions.iter();
    let strains = tractions.map(|&traction| belt.belt.strain(traction));
    let strain = strains.fold(rest.tension / axial, f64::max);
    if strain > LARGEST_STRAIN {
        return Err(LoopError::Overstretched { strain });
    }
    let stalled = |pulley: &usize| belt.belt.offset() + belt.contacts[*pulley].reference() <= 0.0;
    if let Some(pulley) = (0..belt.contacts.len()).find(stalled) {
        return Err(stalls(pulley));
    }
    let found = Found {
        belt_loop,
        rest,
        coordinate,
        layout,
        belt,
        limit,
    };
    found.stable()?;
    match is_final {
        true => checked(belt_loop, state(found)),
        false => Ok(state(found)),
    }
}

/// Whether a running belt presses on all pulleys: with the convention `thesis` friction does not ask for it.
fn presses(belt: &RunningBelt) -> Result<(), LoopError> {
    let spans = belt.tractive.iter().zip(&belt.tractions);
    match spans.min_by(|(one, _), (other, _)| one.total_cmp(other)) {
        Some((&tractive_tension, &traction)) if tractive_tension <= 0.0 => {
            Err(LoopError::LiftsOff {
                tractive_tension,
                speed: belt.speed * (1.0 + belt.belt.strain(traction)),
                is_loaded: true,
            })
        }
        _ => Ok(()),
    }
}

/// The belt at rest where its length or its tension at rest is given.
fn rest_of_closure(belt_loop: &BeltLoop, start: f64) -> Result<Rest, LoopError> {
    let axial = belt_loop.belt.axial_stiffness;
    let (coordinate, layout) = match belt_loop.closure {
        Closure::UnstretchedLength(length) => {
            return rest_of_length(belt_loop, start, length);
        }
        Closure::SetupTension(tension) => {
            equilibrium(belt_loop, start, Towards::Newton, "at rest", |_| {
                Ok([tension, 0.0])
            })?
        }
        Closure::RestCoordinate(_)
        | Closure::SpanTension { .. }
        | Closure::SpanTractiveTension { .. } => (start, belt_loop.layout(start)?),
    };
    let tension = match (belt_loop.closure, belt_loop.tensioner()) {
        (Closure::RestCoordinate(_), Some((pulley, tensioner))) => {
            let [slope, _] = length_derivatives(&layout, pulley, &tensioner.guide, coordinate);
            tensioner.load_at(coordinate)[0] / slope
        }
        (Closure::SetupTension(tension), _) => tension,
        _ => f64::NAN,
    };
    let unstretched = layout.length() / (1.0 + tension / axial);
    stable_rest(
        belt_loop,
        Rest {
            coordinate,
            layout,
            tension,
            unstretched,
        },
    )
}

/// The belt of a given unstretched length at rest.
fn rest_of_length(belt_loop: &BeltLoop, start: f64, length: f64) -> Result<Rest, LoopError> {
    let axial = belt_loop.belt.axial_stiffness;
    let tension = |layout: &Layout| axial * ((layout.length() - length) / length);
    let found = equilibrium(belt_loop, start, Towards::Force, "at rest", |layout| {
        Ok([tension(layout), axial / length])
    });
    let (coordinate, layout) = match found {
        Ok(found) => found,
        Err(error) => {
            let tension = tension(&belt_loop.layout(start)?);
            return Err(match tension <= 0.0 {
                true => LoopError::Slack { tension },
                false => error,
            });
        }
    };
    stable_rest(
        belt_loop,
        Rest {
            coordinate,
            tension: tension(&layout),
            layout,
            unstretched: length,
        },
    )
}

/// A belt at rest that is in tension, with its tensioner in a stable equilibrium.
fn stable_rest(belt_loop: &BeltLoop, rest: Rest) -> Result<Rest, LoopError> {
    let tension = rest.tension;
    if tension <= 0.0 {
        return Err(LoopError::Slack { tension });
    }
    let Some((pulley, tensioner)) = belt_loop.tensioner() else {
        return Ok(rest);
    };
    let Rest {
        coordinate,
        unstretched,
        ..
    } = rest;
    let carried = (pulley, tensioner);
    let held = Held::new(
        belt_loop,
        carried,
        &rest.layout,
        coordinate,
        tension,
        unstretched,
    );
    match tension.is_finite() && held.stiffness > 0.0 {
        true => Ok(rest),
        false => Err(LoopError::NoEquilibrium {
            pulley: belt_loop.pulleys[pulley].name.clone(),
            which: "at rest",
        }),
    }
}

impl Problem<'_> {
    /// Coordinate of the tensioner in the running loop without torques, whose tension is uniform; an error
    /// if the belt lifts off.
    fn unloaded(&self) -> Result<f64, LoopError> {
        let belt = self.belt_loop.belt;
        let rim = self.rim;
        let tractive = |layout: &Layout| {
            let strain = match self.target {
                Target::Unstretched { length, elongation } => {
                    let elongation = layout.length() - length + elongation;
                    elongation / (layout.length() - elongation)
                }
                Target::Tension { tension, .. } => tension / belt.axial_stiffness,
                Target::TractiveTension { tension, .. } => return tension,
            };
            let flow = belt.mass_per_length * rim / (1.0 + strain);
            belt.axial_stiffness * strain - flow * rim
        };
        let presses = |coordinate: f64| {
            let tractive_tension = tractive(&self.belt_loop.layout(coordinate)?);
            match tractive_tension > 0.0 {
                true => Ok(coordinate),
                false => Err(LoopError::LiftsOff {
                    tractive_tension,
                    speed: rim,
                    is_loaded: false,
                }),
            }
        };
        let found = equilibrium(
            self.belt_loop,
            self.start,
            self.towards,
            "without load",
            |layout| Ok([tractive(layout), self.tension_per_length()]),
        );
        match found {
            Ok((coordinate, _)) => presses(coordinate),
            Err(error) => Err(presses(self.start).err().unwrap_or(error)),
        }
    }

    /// The loop under its torques multiplied by a factor.
    pub(super) fn loaded(&self, factor: f64, law: FrictionLaw) -> Result<Loaded, LoopError> {
        let lost = LoopError::NotFound {
            what: "tension of the running belt",
        };
        let pulley = self.belt_loop.tensioner().map_or(0, |(pulley, _)| pulley);
        let (coordinate, layout) = equilibrium(
            self.belt_loop,
            self.start,
            self.towards,
            "under load",
            |layout| {
                let running = Closing::new(self, layout, law, factor);
                let tractive = running.closed_tractive(pulley);
                let tractive = tractive.map_err(|()| lost.clone())?;
                Ok([tractive, self.tension_per_length()])
            },
        )?;
        let belt = Closing::new(self, &layout, law, factor).closed();
        Ok(Loaded {
            coordinate,
            belt: belt.map_err(|()| lost)?,
            layout,
        })
    }

    /// How fast the tension grows with the length of the loop, about, N/m.
    pub(super) fn tension_per_length(&self) -> f64 {
        match self.target {
            Target::Unstretched { length, elongation } => {
                self.belt_loop.belt.axial_stiffness / (length - elongation)
            }
            Target::Tension { .. } | Target::TractiveTension { .. } => 0.0,
        }
    }

    /// The belt of a loaded loop at rest, if it presses on all pulleys.
    fn rest_of(&self, loaded: &Loaded) -> Result<Option<Rest>, LoopError> {
        let rest = loaded.belt.as_ref().map(|belt| {
            let unstretched = loaded.layout.length() - belt.elongation;
            rest_of_length(self.belt_loop, loaded.coordinate, unstretched)
        });
        rest.transpose()
    }
}
