//! The running belt on pulleys at fixed places: speed and tensions that the closure asks for.

use super::super::contact::{Arc, Contact, Friction, Place};
use super::super::creep_rate;
use super::super::root::bracketed;
use super::super::traction::{Traction, convention};
use super::super::{coulomb, epp};
use super::error::LoadedState;
use super::solve::Problem;
use crate::drive::belt_loop::{BeltLoop, LoopPulley};
use crate::drive::layout::Layout;
use crate::{BeltKind, FrictionLaw, NormalForce};

/// Where the search for the slackest tension begins, as a share of the axial stiffness: the strain of a
/// slack belt. It only decides how often the bracket is doubled.
const SLACK_STRAIN: f64 = 1e-6;

/// A tension in place of 0, N: its ratio to any other is a number.
const LOOSEST: f64 = 1e-200;

/// A closure is met to this, relative, and to the rounding of the length of the loop; a root of a
/// continuous function is met far better.
const CLOSED: f64 = 1e-9;

/// Most steps of the secant method for the belt speed, which takes three or four unless the driver all but
/// slips.
const SPEEDS: usize = 12;

/// Most doublings of a bracket: from the slack belt they reach a strain of 1e12.
const DOUBLINGS: usize = 60;

/// What the closure asks of the running belt.
#[derive(Clone, Copy, Debug)]
pub(super) enum Target {
    /// Length of the unstretched belt as that of a loop less its elongation, m.
    Unstretched { length: f64, elongation: f64 },
    /// Belt tension of a span, N.
    Tension { span: usize, tension: f64 },
    /// Tractive tension of a span, N.
    TractiveTension { span: usize, tension: f64 },
}

/// Pulleys at fixed places, their loads, a closure and a friction law.
pub(super) struct Running<'l> {
    belt_loop: &'l BeltLoop,
    layout: &'l Layout,
    target: Target,
    law: FrictionLaw,
    convention: NormalForce,
    driver: usize,
    /// Circumferential speed R ω of the driver, m/s.
    rim: f64,
    /// Change of the traction P on each pulley, N.
    changes: Vec<f64>,
    /// Traction of each span above the slackest, N.
    offsets: Vec<f64>,
}

/// The running belt.
#[derive(Clone, Debug)]
pub(super) struct RunningBelt {
    /// Speed c of the unstretched belt, m/s.
    pub(super) speed: f64,
    /// The moving belt.
    pub(super) belt: Traction,
    /// Traction P of each span, N.
    pub(super) tractions: Vec<f64>,
    /// Tractive tension F = T − G V of each span, N.
    pub(super) tractive: Vec<f64>,
    /// Change of the traction on each pulley, N.
    pub(super) changes: Vec<f64>,
    /// The contacts.
    pub(super) contacts: Vec<Contact>,
    /// L − `L_0`, m.
    pub(super) elongation: f64,
}

impl RunningBelt {
    /// The largest load |ln(P(L)/P(0))| of a pulley with a wrap angle in rad.
    pub(super) fn largest_load(&self, pulley: &LoopPulley, wrap: f64) -> f64 {
        let radius = pulley.radius;
        self.belt.slip_rate(pulley.friction_coefficient, radius) * radius * wrap
    }
}

impl<'l> Running<'l> {
    /// All torques are multiplied by `factor`. With [`FrictionLaw::Coulomb`] friction is raised where it
    /// does not carry the load.
    pub(super) fn new(
        problem: &Problem<'l>,
        layout: &'l Layout,
        law: FrictionLaw,
        factor: f64,
    ) -> Self {
        let &Problem {
            belt_loop,
            torques,
            target,
            ..
        } = problem;
        let pulleys = &belt_loop.pulleys;
        let driver = belt_loop.driver();
        let loads = pulleys.iter().zip(torques);
        let mut changes: Vec<_> = loads
            .map(|(pulley, torque)| factor * torque / pulley.radius)
            .collect();
        changes[driver] = 0.0;
        changes[driver] = 0.0 - changes.iter().sum::<f64>();
        let mut offsets = vec![0.0; pulleys.len()];
        for step in 1..pulleys.len() {
            let pulley = (driver + step) % pulleys.len();
            let behind = (driver + step - 1) % pulleys.len();
            offsets[pulley] = offsets[behind] + changes[pulley];
        }
        let lowest = offsets.iter().copied().fold(f64::INFINITY, f64::min);
        offsets.iter_mut().for_each(|offset| *offset -= lowest);
        Self {
            belt_loop,
            layout,
            target,
            law,
            convention: match belt_loop.belt.kind {
                BeltKind::Flat { normal_force } => convention(normal_force, belt_loop.law),
                BeltKind::V(_) => panic!("a flat belt was expected"),
            },
            driver,
            rim: belt_loop.rim_speed(),
            changes,
            offsets,
        }
    }

    /// The spans behind and before a pulley.
    fn spans(&self, pulley: usize) -> [usize; 2] {
        let count = self.offsets.len();
        [(pulley + count - 1) % count, pulley]
    }

    /// Tractive tension of a span if the slackest one has none, N.
    pub(super) fn loosest(&self, span: usize) -> f64 {
        match self.convention {
            NormalForce::Thesis => self
                .at(LOOSEST)
                .map_or(f64::NAN, |found| found.tractive[span]),
            NormalForce::Inertia | NormalForce::Exact => self.offsets[span],
        }
    }

    /// The belt at a speed c, and the traction of its slackest span. `slackest` is the tension of that span
    /// with the convention `thesis`, which enters its speed, and the tractive tension with others, N.
    fn moving(&self, speed: f64, slackest: f64) -> (Traction, f64) {
        let belt = self.belt_loop.belt;
        let (mass, axial) = (belt.mass_per_length, belt.axial_stiffness);
        match self.convention {
            NormalForce::Thesis => {
                let speed = speed * (1.0 + slackest / axial);
                let belt = Traction::new(self.convention, mass, axial, speed);
                (belt, belt.of_tension(slackest))
            }
            NormalForce::Inertia | NormalForce::Exact => {
                let belt = Traction::new(self.convention, mass, axial, speed);
                (belt, slackest)
            }
        }
    }

    /// Speed c of the belt with the tractive tension `F_o` where it runs as fast as the rim of the driver:
    /// m R ω c² + (EA + `F_o`) c = R ω EA. It is below the critical speed.
    fn rigid_speed(&self, reference: f64) -> f64 {
        let belt = self.belt_loop.belt;
        let linear = belt.axial_stiffness + reference;
        let constant = self.rim * belt.axial_stiffness;
        let root = (linear * linear + 4.0 * belt.mass_per_length * self.rim * constant).sqrt();
        2.0 * constant / (linear + root)
    }

    /// The contact with a pulley of the belt at a speed c, if the slackest span has a traction, N.
    fn contact(
        &self,
        pulley: usize,
        (belt, slackest): (Traction, f64),
        speed: f64,
    ) -> Option<Contact> {
        let stated = &self.belt_loop.pulleys[pulley];
        let [behind, before] = self.spans(pulley).map(|span| self.offsets[span]);
        let change = self.changes[pulley];
        let arc = Arc {
            belt,
            sense: if change < 0.0 { -1.0 } else { 1.0 },
            slip_rate: belt.slip_rate(stated.friction_coefficient, stated.radius),
            length: stated.radius * self.layout.wraps()[pulley],
            low: slackest + behind.min(before),
            change: change.abs(),
        };
        match self.law {
            FrictionLaw::Epp { stiffness } if change != 0.0 => epp::solve(arc, stiffness),
            FrictionLaw::CreepRate { velocity } if change != 0.0 => {
                creep_rate::solve(arc, speed, velocity)
            }
            _ => Some(coulomb::carried(arc)),
        }
    }

    /// Speed c of the belt, which the driver turns with at its reference tension: c (1 + `T_o`/EA) = R ω.
    fn speed(&self, slackest: f64) -> Option<f64> {
        let [behind, _] = self.spans(self.driver);
        let offset = self.offsets[behind];
        let guess = self.rigid_speed(slackest + offset);
        let reference = |speed: f64| {
            let moving = self.moving(speed, slackest);
            let reference = match self.law {
                FrictionLaw::Coulomb => moving.1 + offset,
                _ => self.contact(self.driver, moving, speed)?.reference(),
            };
            Some(moving.0.strain(reference))
        };
        match (self.law, self.convention) {
            (FrictionLaw::Coulomb, NormalForce::Inertia | NormalForce::Exact) => Some(guess),
            _ => self.speed_near(guess, |speed| {
                let strain = reference(speed);
                strain.map_or(f64::NAN, |strain| speed * (1.0 + strain) / self.rim - 1.0)
            }),
        }
    }

    /// The speed at which the driver takes the belt along, by the secant method from a guess.
    fn speed_near(&self, guess: f64, excess: impl Fn(f64) -> f64) -> Option<f64> {
        let at_guess = excess(guess);
        let mut last = [guess, at_guess];
        let mut speed = guess * (1.0 - at_guess);
        for _ in 0..SPEEDS {
            let found = excess(speed);
            let slope = (found - last[1]) / (speed - last[0]);
            let change = match found == 0.0 {
                true => 0.0,
                false => -found / slope,
            };
            if change.abs() <= 2.0 * f64::EPSILON * speed {
                return Some(speed + change);
            }
            // Not a number included.
            let is_small = change.abs() < 0.5 * speed;
            if !is_small {
                break;
            }
            last = [speed, found];
            speed += change;
        }
        let bound = match at_guess < 0.0 {
            // The belt outruns a driver that is driven.
            true => {
                let belt = self.belt_loop.belt;
                let critical = (belt.axial_stiffness / belt.mass_per_length).sqrt();
                critical.min(2.0 * self.rim) * (1.0 - f64::EPSILON)
            }
            false => f64::EPSILON * guess,
        };
        bracketed(&excess, [bound, guess], [excess(bound), at_guess])
    }

    /// The running belt with a tension of the slackest span as in [`Self::moving`], N, whatever the closure.
    fn at(&self, slackest: f64) -> Option<RunningBelt> {
        let speed = self.speed(slackest)?;
        let moving = self.moving(speed, slackest);
        let (belt, lowest) = moving;
        let count = self.offsets.len();
        let contacts = (0..count).map(|pulley| self.contact(pulley, moving, speed));
        let contacts = contacts.collect::<Option<Vec<_>>>()?;
        let tractions: Vec<_> = self.offsets.iter().map(|offset| lowest + offset).collect();
        let spans = self.layout.spans().iter().zip(&tractions);
        let spans = spans.map(|(span, &traction)| span.length * belt.elongation(traction));
        let elongation = spans.sum::<f64>() + contacts.iter().map(elongation).sum::<f64>();
        Some(RunningBelt {
            speed,
            belt,
            tractive: self.tractive(speed, belt, &tractions),
            tractions,
            changes: self.changes.clone(),
            contacts,
            elongation,
        })
    }

    /// The tractive tensions F = T − G V that belong to tractions P, N.
    fn tractive(&self, speed: f64, belt: Traction, tractions: &[f64]) -> Vec<f64> {
        match self.convention {
            NormalForce::Thesis => {
                let stated = self.belt_loop.belt;
                let (mass, axial) = (stated.mass_per_length, stated.axial_stiffness);
                let inertia = Traction::new(NormalForce::Inertia, mass, axial, speed);
                let tensions = tractions.iter().map(|&traction| belt.tension(traction));
                tensions
                    .map(|tension| inertia.of_tension(tension))
                    .collect()
            }
            NormalForce::Inertia | NormalForce::Exact => tractions.to_vec(),
        }
    }

    /// By how much the belt is tighter than the closure asks for, relative.
    fn excess(&self, found: &RunningBelt) -> f64 {
        match self.target {
            Target::Unstretched { length, elongation } => {
                let asked = (self.layout.length() - length) + elongation;
                1.0 - asked / found.elongation
            }
            Target::Tension { span, tension } => {
                found.belt.tension(found.tractions[span]) / tension - 1.0
            }
            Target::TractiveTension { span, tension } => found.tractive[span] / tension - 1.0,
        }
    }

    /// Below this tension of the slackest span, as in [`Self::moving`], a pulley slips grossly, N.
    fn capacity_bound(&self) -> f64 {
        // The largest slip rate of the convention `thesis`, where the belt is no faster than the rim.
        let (fastest, _) = self.moving(self.rim, 0.0);
        let raised = match self.convention {
            NormalForce::Thesis if fastest.stiffness <= 0.0 => return 0.0,
            _ => fastest.slip_rate(1.0, 1.0),
        };
        let bound = |pulley: usize| {
            let [behind, before] = self.spans(pulley).map(|span| self.offsets[span]);
            let stated = &self.belt_loop.pulleys[pulley];
            let load = raised * stated.friction_coefficient * self.layout.wraps()[pulley];
            match self.changes[pulley] {
                0.0 => 0.0,
                change => change.abs() / load.exp_m1() - behind.min(before),
            }
        };
        (0..self.offsets.len()).map(bound).fold(0.0, f64::max)
    }

    /// The running belt that the closure asks for: `Ok(None)` if it would have to be looser than the
    /// loosest that presses on all pulleys, or that carries the load with elastic friction; `Err` if it is
    /// not found.
    pub(super) fn closed(&self) -> Result<Option<RunningBelt>, ()> {
        // Elastic friction that slips almost everywhere may not bring the driver to its speed: too loose.
        let excess = |slackest: f64| {
            let found = self.at(slackest);
            found.map_or(-1.0, |found| self.excess(&found))
        };
        let loosest = match self.law {
            FrictionLaw::Coulomb => 0.0,
            _ => self.capacity_bound(),
        };
        let mut low = loosest.max(LOOSEST);
        let mut at_low = excess(low);
        if at_low >= 0.0 {
            return Ok(None);
        }
        let largest = self.offsets.iter().copied().fold(0.0, f64::max);
        let mut step = largest.max(SLACK_STRAIN * self.belt_loop.belt.axial_stiffness);
        for _ in 0..DOUBLINGS {
            let high = loosest + step;
            let at_high = excess(high);
            if at_high >= 0.0 {
                let slackest = bracketed(excess, [low, high], [at_low, at_high]).ok_or(())?;
                // The sign also changes where the belt gets too loose for elastic friction.
                let rounding = 1e3 * f64::EPSILON * self.layout.length();
                let found = self.at(slackest).filter(|found| {
                    self.excess(found).abs() < CLOSED + rounding / found.elongation
                });
                return Ok(found);
            }
            (low, at_low) = (high, at_high);
            step *= 2.0;
        }
        Err(())
    }

    /// A found belt against the friction that the pulleys have.
    pub(super) fn loaded(&self, found: &RunningBelt, coordinate: Option<f64>) -> LoadedState {
        let belt = self.belt_loop.belt;
        let pulleys = self.belt_loop.pulleys.iter().enumerate();
        let used = pulleys.map(|(index, pulley)| {
            let load = found.largest_load(pulley, self.layout.wraps()[index]);
            let arc = found.contacts[index].arc;
            let torque = found.changes[index] * pulley.radius;
            let capacity = pulley.radius * arc.low * load.exp_m1();
            let utilisation = if arc.change == 0.0 {
                0.0
            } else {
                arc.load() / load
            };
            let margin = (torque != 0.0).then(|| capacity / torque.abs());
            (torque, capacity, utilisation, margin)
        });
        let used: Vec<_> = used.collect();
        LoadedState {
            torques: used.iter().map(|used| used.0).collect(),
            tensions: found
                .tractions
                .iter()
                .map(|&traction| found.belt.tension(traction))
                .collect(),
            tractive_tensions: found.tractive.clone(),
            mass_flow: belt.mass_per_length * found.speed,
            tensioner_coordinate: coordinate,
            friction_utilisations: used.iter().map(|used| used.2).collect(),
            torque_capacities: used.iter().map(|used| used.1).collect(),
            torque_margins: used.iter().map(|used| used.3).collect(),
        }
    }
}

/// The elongation L − `L_0` of the belt on a pulley, m; by quadrature where friction is elastic.
///
/// With ε/(1 + ε) = (P + m c²)/(P + S) per length it is, where the belt slips, ds = dP/(± a P),
///
/// ```text
/// | m c² ln(P₁/P₀) + D ln((S + P₁)/(S + P₀)) |/(a S)
/// ```
///
/// and where it creeps, ds = `v_s` D/(a c) dP/(P (P − `P_o`)), with that of `P_o` times the length,
///
/// ```text
/// + v_s D²/(a c S (S + P_o)) ln( P₁ (S + P₀)/(P₀ (S + P₁)) )
/// ```
fn elongation(contact: &Contact) -> f64 {
    let (belt, arc) = (contact.arc.belt, contact.arc);
    let offset = belt.offset();
    let zones = contact.zones.iter().map(|zone| {
        let (length, from) = (zone.end - zone.start.arc_length, zone.start.traction);
        match zone.friction {
            Friction::Adhesion => length * belt.elongation(from),
            Friction::Slip => {
                let extent = arc.slip_rate * length;
                let grown = from * (arc.sense * extent).exp_m1();
                let stretched = (grown / (offset + from)).ln_1p().abs();
                (belt.inertia * extent + belt.stiffness * stretched) / (arc.slip_rate * offset)
            }
            Friction::Creep {
                speed, saturation, ..
            } => {
                let reference = contact.reference();
                let to = contact.end(zone).traction;
                let logarithm = (to / from * ((offset + from) / (offset + to))).ln();
                let stiffness = belt.stiffness * belt.stiffness;
                let unit = saturation * stiffness / (arc.slip_rate * speed * offset);
                length * belt.elongation(reference) + unit * logarithm / (offset + reference)
            }
            Friction::Elastic { .. } => {
                contact.over(zone, &|place: &Place| belt.elongation(place.traction))
            }
        }
    });
    zones.sum()
}
