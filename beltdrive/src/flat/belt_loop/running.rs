//! The running belt on pulleys at fixed places: speed and tensions that the closure asks for.

use super::super::contact::{Arc, Contact, Friction, Place};
use super::super::root::bracketed;
use super::super::traction::Traction;
use super::super::{coulomb, epp};
use super::error::LoadedState;
use super::solve::Problem;
use crate::drive::belt_loop::BeltLoop;
use crate::drive::layout::Layout;
use crate::{FrictionLaw, NormalForce};

/// Where the search for the slackest tension begins, as a share of the axial stiffness: the strain of a
/// slack belt. It only decides how often the bracket is doubled.
const SLACK_STRAIN: f64 = 1e-6;

/// A tractive tension in place of 0, N: its ratio to any other is a number.
const LOOSEST: f64 = 1e-200;

/// A closure is met to this, relative, and to the rounding of the length of the loop; a root of a
/// continuous function is met far better.
const CLOSED: f64 = 1e-9;

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
    driver: usize,
    /// Circumferential speed R ω of the driver, m/s.
    rim: f64,
    /// Change of the tractive tension on each pulley, N.
    changes: Vec<f64>,
    /// Tractive tension of each span above the slackest, N.
    offsets: Vec<f64>,
}

/// The running belt.
#[derive(Clone, Debug)]
pub(super) struct RunningBelt {
    /// Speed c of the unstretched belt, m/s.
    pub(super) speed: f64,
    /// The moving belt.
    pub(super) belt: Traction,
    /// Tractive tension F of each span, N.
    pub(super) tractive: Vec<f64>,
    /// Change of it on each pulley, N.
    pub(super) changes: Vec<f64>,
    /// The contacts.
    pub(super) contacts: Vec<Contact>,
    /// L − `L_0`, m.
    pub(super) elongation: f64,
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

    /// Tractive tension of a span above that of the slackest one, N.
    pub(super) fn offset(&self, span: usize) -> f64 {
        self.offsets[span]
    }

    fn traction(&self, speed: f64) -> Traction {
        let belt = self.belt_loop.belt;
        let inertia = NormalForce::Inertia;
        Traction::new(inertia, belt.mass_per_length, belt.axial_stiffness, speed)
    }

    /// Speed c of the belt with the tractive tension `F_o` where it runs as fast as the rim of the driver:
    /// m R ω c² + (EA + `F_o`) c = R ω EA. It is below the critical speed.
    fn speed(&self, reference: f64) -> f64 {
        let belt = self.belt_loop.belt;
        let linear = belt.axial_stiffness + reference;
        let constant = self.rim * belt.axial_stiffness;
        let root = (linear * linear + 4.0 * belt.mass_per_length * self.rim * constant).sqrt();
        2.0 * constant / (linear + root)
    }

    /// The contact with a pulley if the slackest span has a tractive tension, N.
    fn contact(&self, pulley: usize, slackest: f64, belt: Traction) -> Option<Contact> {
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
            _ => Some(coulomb::carried(arc)),
        }
    }

    /// The running belt with a tractive tension of the slackest span, N, whatever the closure.
    fn at(&self, slackest: f64) -> Option<RunningBelt> {
        let [behind, _] = self.spans(self.driver);
        let entering = self.speed(slackest + self.offsets[behind]);
        let speed = match self.law {
            FrictionLaw::Epp { .. } => {
                let excess = |speed: f64| {
                    let contact = self.contact(self.driver, slackest, self.traction(speed));
                    contact.map_or(f64::NAN, |contact| {
                        speed / self.speed(contact.reference()) - 1.0
                    })
                };
                self.speed_between(entering, excess)?
            }
            _ => entering,
        };
        let belt = self.traction(speed);
        let count = self.offsets.len();
        let contacts = (0..count).map(|pulley| self.contact(pulley, slackest, belt));
        let contacts = contacts.collect::<Option<Vec<_>>>()?;
        let axial = self.belt_loop.belt.axial_stiffness;
        let tractive: Vec<_> = self
            .offsets
            .iter()
            .map(|offset| slackest + offset)
            .collect();
        let spans = self.layout.spans().iter().zip(&tractive);
        let spans = spans.map(|(span, &force)| span.length * elongation_rate(belt, axial, force));
        let elongation = spans.sum::<f64>()
            + contacts
                .iter()
                .map(|contact| elongation(contact, axial))
                .sum::<f64>();
        Some(RunningBelt {
            speed,
            belt,
            tractive,
            changes: self.changes.clone(),
            contacts,
            elongation,
        })
    }

    /// The speed at which the driver takes the belt along, near that at which it would without creep.
    fn speed_between(&self, entering: f64, excess: impl Fn(f64) -> f64) -> Option<f64> {
        let at_entering = excess(entering);
        let bound = match at_entering < 0.0 {
            // The belt outruns a driver that is driven.
            true => {
                let belt = self.belt_loop.belt;
                let critical = (belt.axial_stiffness / belt.mass_per_length).sqrt();
                critical.min(2.0 * self.rim) * (1.0 - f64::EPSILON)
            }
            false => f64::EPSILON * entering,
        };
        bracketed(&excess, [bound, entering], [excess(bound), at_entering])
    }

    /// By how much the belt is tighter than the closure asks for, relative.
    fn excess(&self, found: &RunningBelt) -> f64 {
        match self.target {
            Target::Unstretched { length, elongation } => {
                let asked = (self.layout.length() - length) + elongation;
                1.0 - asked / found.elongation
            }
            Target::Tension { span, tension } => {
                found.belt.tension(found.tractive[span]) / tension - 1.0
            }
            Target::TractiveTension { span, tension } => found.tractive[span] / tension - 1.0,
        }
    }

    /// Below this tractive tension of the slackest span a pulley slips grossly, N.
    fn capacity_bound(&self) -> f64 {
        let bound = |pulley: usize| {
            let [behind, before] = self.spans(pulley).map(|span| self.offsets[span]);
            let load =
                self.belt_loop.pulleys[pulley].friction_coefficient * self.layout.wraps()[pulley];
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
            FrictionLaw::Epp { .. } => self.capacity_bound(),
            _ => 0.0,
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
            let load = pulley.friction_coefficient * self.layout.wraps()[index];
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
                .tractive
                .iter()
                .map(|&force| found.belt.tension(force))
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

/// 1 − 1/(1 + T/EA) = (F + m c²)/(EA + F): elongation per length of the stretched belt.
fn elongation_rate(belt: Traction, axial: f64, tractive: f64) -> f64 {
    (tractive + belt.inertia) / (axial + tractive)
}

/// The elongation of the belt on a pulley, m; by quadrature where friction is elastic. Where the belt
/// slips, with ds = dF/(± a F),
///
/// ```text
/// ∫ (F + m c²)/(EA + F) ds = | m c² ln(F₁/F₀) + D ln((EA + F₁)/(EA + F₀)) |/(a EA)
/// ```
fn elongation(contact: &Contact, axial: f64) -> f64 {
    let belt = contact.arc.belt;
    let rate = |place: &Place| elongation_rate(belt, axial, place.traction);
    let zones = contact.zones.iter().map(|zone| match zone.friction {
        Friction::Adhesion => (zone.end - zone.start.arc_length) * rate(&zone.start),
        Friction::Slip => {
            let extent = contact.arc.slip_rate * (zone.end - zone.start.arc_length);
            let grown = zone.start.traction * (contact.arc.sense * extent).exp_m1();
            let stretched = (grown / (axial + zone.start.traction)).ln_1p().abs();
            (belt.inertia * extent + belt.stiffness * stretched) / (contact.arc.slip_rate * axial)
        }
        Friction::Elastic { .. } | Friction::Creep { .. } => contact.over(zone, &rate),
    });
    zones.sum()
}
