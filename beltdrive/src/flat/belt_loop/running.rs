//! The running belt on pulleys at fixed places with a given tension: its speed and its contacts.

use super::elongation::{self, elongation};
use super::loads::Loads;
use super::problem::Problem;
use crate::drive::layout::Layout;
use crate::friction::coulomb;
use crate::friction::rim::contact::{Arc, Contact};
use crate::friction::rim::traction::Traction;
use crate::mechanics::root::{ESTIMATED, bracketed, near_with_slope};
use crate::{FrictionLaw, NormalForce, Pulley};
use std::cell::Cell;

/// A tension in place of 0, N: its ratio to any other is a number.
pub(super) const LOOSEST: f64 = 1e-200;

/// The last step of the secant method for the belt speed, relative. Its error is about this times the step
/// before.
const SPEED: f64 = 1e-13;

/// Most turns for the tension at which the first pulley slips: three to five are usual.
const TURNS: usize = 12;

/// Pulleys at fixed places, their loads and a friction law.
#[derive(Clone, Copy)]
pub(super) struct Running<'p> {
    pub(super) problem: &'p Problem<'p>,
    pub(super) layout: &'p Layout,
    pub(super) law: FrictionLaw,
    /// Factor on all torques.
    pub(super) factor: f64,
    /// Speed that was just found over its guess, and slope of what is to vanish there.
    pub(super) known: &'p Cell<Option<[f64; 2]>>,
}

/// The belt at a speed.
#[derive(Clone, Copy)]
pub(super) struct Moving {
    /// Speed c of the unstretched belt, m/s.
    speed: f64,
    pub(super) belt: Traction,
    /// Traction of the slackest span, N.
    pub(super) lowest: f64,
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
    pub(super) fn largest_load(&self, pulley: &Pulley, wrap: f64) -> f64 {
        let radius = pulley.radius;
        self.belt.slip_rate(pulley.friction_coefficient, radius) * radius * wrap
    }
}

impl<'p> Running<'p> {
    /// All torques are multiplied by `factor`. With [`FrictionLaw::Coulomb`] friction is raised where it
    /// does not carry the load.
    pub(super) fn new(
        problem: &'p Problem<'p>,
        layout: &'p Layout,
        law: FrictionLaw,
        factor: f64,
        known: &'p Cell<Option<[f64; 2]>>,
    ) -> Self {
        Self {
            problem,
            layout,
            law,
            factor,
            known,
        }
    }

    /// Traction of a span above that of the slackest one, N.
    pub(super) fn offset(&self, span: usize) -> f64 {
        self.factor * self.problem.loads.offsets[span]
    }

    /// The spans behind and before a pulley.
    pub(super) fn spans(&self, pulley: usize) -> [usize; 2] {
        let count = self.problem.loads.offsets.len();
        [(pulley + count - 1) % count, pulley]
    }

    /// Tractive tension of a span if the slackest one has none, N.
    pub(super) fn loosest(&self, span: usize) -> f64 {
        match self.problem.convention {
            NormalForce::Thesis => self
                .moving_with(LOOSEST)
                .map_or(f64::NAN, |moving| self.tractive(moving, span)),
            NormalForce::Inertia | NormalForce::Exact => self.offset(span),
        }
    }

    /// The belt at a speed c. `slackest` is the tension of the slackest span with the convention `thesis`,
    /// where it enters the speed of that span, and its tractive tension with others, N.
    fn moving(&self, speed: f64, slackest: f64) -> Moving {
        let belt = self.problem.drive.belt;
        let (mass, axial) = (belt.mass_per_length, belt.axial_stiffness);
        let convention = self.problem.convention;
        let is_thesis = convention == NormalForce::Thesis;
        let reference = match is_thesis {
            true => speed * (1.0 + slackest / axial),
            false => speed,
        };
        let belt = Traction::new(convention, mass, axial, reference);
        Moving {
            speed,
            belt,
            lowest: match is_thesis {
                true => belt.of_tension(slackest),
                false => slackest,
            },
        }
    }

    /// As [`Self::moving`], with the speed that the driver gives it.
    pub(super) fn moving_with(&self, slackest: f64) -> Option<Moving> {
        let speed = self.speed(slackest)?;
        Some(self.moving(speed, slackest))
    }

    /// Speed c of the belt with the tractive tension `F_o` where it runs as fast as the rim of the driver:
    /// m R ω c² + (EA + `F_o`) c = R ω EA. It is below the critical speed.
    fn rigid_speed(&self, reference: f64) -> f64 {
        let (belt, rim) = (self.problem.drive.belt, self.problem.rim);
        let linear = belt.axial_stiffness + reference;
        let constant = rim * belt.axial_stiffness;
        let root = (linear * linear + 4.0 * belt.mass_per_length * rim * constant).sqrt();
        2.0 * constant / (linear + root)
    }

    /// The arc of a pulley.
    fn arc(&self, pulley: usize, moving: Moving) -> Arc {
        let Moving { belt, lowest, .. } = moving;
        let stated = &self.problem.drive.pulleys[pulley];
        let [behind, before] = self.spans(pulley).map(|span| self.offset(span));
        let change = self.factor * self.problem.loads.changes[pulley];
        Arc {
            belt,
            sense: if change < 0.0 { -1.0 } else { 1.0 },
            slip_rate: belt.slip_rate(stated.friction_coefficient, stated.radius),
            length: stated.radius * self.layout.wraps()[pulley],
            low: lowest + behind.min(before),
            change: change.abs(),
        }
    }

    /// The contact with a pulley.
    fn contact(&self, pulley: usize, moving: Moving) -> Option<Contact> {
        let arc = self.arc(pulley, moving);
        match self.law == FrictionLaw::Coulomb || arc.change == 0.0 {
            true => Some(coulomb::carried(arc)),
            false => self
                .law
                .row()
                .contact(arc, moving.speed, self.law.parameter()),
        }
    }

    /// Speed c of the belt, which the driver turns with at its reference tension: c (1 + `T_o`/EA) = R ω.
    fn speed(&self, slackest: f64) -> Option<f64> {
        let driver = self.problem.driver;
        let [behind, _] = self.spans(driver);
        let offset = self.offset(behind);
        let guess = self.rigid_speed(slackest + offset);
        let reference = |moving: Moving| match self.law {
            FrictionLaw::Coulomb => Some(moving.lowest + offset),
            _ => Some(self.contact(driver, moving)?.reference()),
        };
        let excess = |speed: f64| {
            let moving = self.moving(speed, slackest);
            let reference = reference(moving);
            reference.map_or(f64::NAN, |reference| {
                speed * (1.0 + moving.belt.strain(reference)) / self.problem.rim - 1.0
            })
        };
        match (self.law, self.problem.convention) {
            (FrictionLaw::Coulomb, NormalForce::Inertia | NormalForce::Exact) => Some(guess),
            _ => self.speed_near(guess, excess),
        }
    }

    /// The speed near a guess at which the driver takes the belt along.
    fn speed_near(&self, guess: f64, excess: impl Fn(f64) -> f64) -> Option<f64> {
        let range = [0.5 * guess, 2.0 * guess];
        let ([faster, slope], first) = match self.known.get() {
            Some(known) => (known, SPEED),
            None => ([1.0, 1.0], ESTIMATED * SPEED),
        };
        let start = faster * guess;
        let found = near_with_slope(
            &excess,
            [start, excess(start)],
            slope / guess,
            range,
            [first, SPEED].map(|within| within * guess),
        );
        self.known
            .set(found.map(|[speed, slope]| [speed / guess, slope * guess]));
        if let Some([speed, _]) = found {
            return Some(speed);
        }
        let at_guess = excess(guess);
        let bound = match at_guess < 0.0 {
            // The belt outruns a driver that is driven.
            true => {
                let belt = self.problem.drive.belt;
                let critical = (belt.axial_stiffness / belt.mass_per_length).sqrt();
                critical.min(2.0 * self.problem.rim) * (1.0 - f64::EPSILON)
            }
            false => f64::EPSILON * guess,
        };
        bracketed(&excess, [bound, guess], [excess(bound), at_guess])
    }

    /// The running belt with a tension of the slackest span as in [`Self::moving`], N, whatever the closure.
    pub(super) fn at(&self, slackest: f64) -> Option<RunningBelt> {
        let moving = self.moving_with(slackest)?;
        let Moving {
            speed,
            belt,
            lowest,
        } = moving;
        let count = self.problem.loads.offsets.len();
        let contacts = (0..count).map(|pulley| self.contact(pulley, moving));
        let contacts = contacts.collect::<Option<Vec<_>>>()?;
        let on_pulleys = contacts.iter().map(elongation).sum::<f64>();
        let changes = self.problem.loads.changes.iter();
        Some(RunningBelt {
            speed,
            belt,
            tractive: (0..count).map(|span| self.tractive(moving, span)).collect(),
            tractions: (0..count).map(|span| lowest + self.offset(span)).collect(),
            changes: changes.map(|change| self.factor * change).collect(),
            contacts,
            elongation: self.on_spans(moving) + on_pulleys,
        })
    }

    /// Tractive tension F = T − G V of a span, N.
    pub(super) fn tractive(&self, moving: Moving, span: usize) -> f64 {
        let traction = moving.lowest + self.offset(span);
        match self.problem.convention {
            NormalForce::Thesis => {
                let belt = self.problem.drive.belt;
                let (mass, axial) = (belt.mass_per_length, belt.axial_stiffness);
                let inertia = Traction::new(NormalForce::Inertia, mass, axial, moving.speed);
                inertia.of_tension(moving.belt.tension(traction))
            }
            NormalForce::Inertia | NormalForce::Exact => traction,
        }
    }

    /// Elongation of the spans, m.
    fn on_spans(&self, moving: Moving) -> f64 {
        let spans = self.layout.spans().iter().enumerate();
        let spans = spans.map(|(index, span)| {
            span.length * moving.belt.elongation(moving.lowest + self.offset(index))
        });
        spans.sum()
    }

    /// L − `L_0`, m; `None` if a pulley does not carry its load.
    pub(super) fn elongation(&self, moving: Moving) -> Option<f64> {
        let mut sum = self.on_spans(moving);
        for pulley in 0..self.layout.wraps().len() {
            sum += match self.law {
                FrictionLaw::Coulomb => elongation::rigid(&self.arc(pulley, moving)),
                _ => elongation(&self.contact(pulley, moving)?),
            };
        }
        Some(sum)
    }

    /// Below this tension of the slackest span, as in [`Self::moving`], a pulley slips grossly, N.
    pub(super) fn capacity_bound(&self) -> f64 {
        // The largest slip rate of the convention `thesis`, where the belt is no faster than the rim.
        let fastest = self.moving(self.problem.rim, 0.0);
        match self.problem.convention {
            NormalForce::Thesis if fastest.belt.stiffness <= 0.0 => 0.0,
            _ => self.slipping_at(fastest.belt),
        }
    }

    /// The tension of the slackest span as in [`Self::moving`] at which the first pulley slips, N, from one near it.
    /// With the convention `thesis` capacities depend on the speed, but little: each turn divides the error by
    /// EA/(m c²) at least.
    pub(super) fn slackest_slipping(&self, near: f64) -> Option<f64> {
        if self.problem.convention != NormalForce::Thesis {
            return Some(near);
        }
        let mut slackest = near;
        for _ in 0..TURNS {
            let Moving { belt, .. } = self.moving_with(slackest)?;
            let next = belt.tension(self.slipping_at(belt));
            let change = (next - slackest).abs();
            slackest = next;
            if change <= SPEED * slackest {
                return Some(slackest);
            }
        }
        None
    }

    /// The traction of the slackest span of a moving belt at which the first pulley slips, N.
    pub(super) fn slipping_at(&self, belt: Traction) -> f64 {
        let raised = belt.slip_rate(1.0, 1.0);
        let Loads { changes, .. } = &self.problem.loads;
        let bound = |pulley: usize| {
            let [behind, before] = self.spans(pulley).map(|span| self.offset(span));
            let stated = &self.problem.drive.pulleys[pulley];
            let load = raised * stated.friction_coefficient * self.layout.wraps()[pulley];
            match self.factor * changes[pulley] {
                0.0 => 0.0,
                change => change.abs() / load.exp_m1() - behind.min(before),
            }
        };
        (0..changes.len()).map(bound).fold(0.0, f64::max)
    }
}
