//! The running belt on pulleys at fixed places with a given tension: its speed and its contacts.

use super::closing::Target;
use super::elongation::{self, elongation};
use super::loads::Loads;
use super::problem::Problem;
use crate::drive::layout::Layout;
use crate::friction::coulomb;
use crate::friction::rim::contact::{Arc, Contact};
use crate::friction::rim::traction::Traction;
use crate::mechanics::root::{bracketed, near_with_slope};
use crate::{FrictionLaw, NormalForce, Pulley};

/// A tension in place of 0, N: its ratio to any other is a number.
pub(super) const LOOSEST: f64 = 1e-200;

/// The last step of the secant method for the belt speed, relative. Its error is about this times the step
/// before.
const SPEED: f64 = 1e-13;

/// Pulleys at fixed places, their loads and a friction law.
#[derive(Clone, Copy)]
pub(super) struct Running<'p> {
    pub(super) problem: &'p Problem<'p>,
    pub(super) layout: &'p Layout,
    pub(super) law: FrictionLaw,
    /// Factor on all torques.
    pub(super) factor: f64,
}

/// The belt at a speed.
#[derive(Clone, Copy)]
pub(super) struct Moving {
    /// Speed c of the unstretched belt, m/s.
    pub(super) speed: f64,
    /// Tension of the slackest span as in [`Running::moving`], N.
    slackest: f64,
    pub(super) belt: Traction,
    /// Traction of the slackest span, N.
    pub(super) lowest: f64,
}

/// How tight a belt is.
#[derive(Clone, Copy)]
pub(super) struct Tightness {
    /// By how much it is tighter than the closure asks for, m or N.
    pub(super) surplus: f64,
    /// What that is measured with.
    pub(super) scale: f64,
    /// Traction at which it would run as fast as the rim of the driver, N.
    pub(super) reference: f64,
}

/// The running belt.
#[derive(Clone, Debug)]
pub(super) struct RunningBelt {
    /// Speed c of the unstretched belt, m/s.
    pub(super) speed: f64,
    /// Tension of the slackest span as in [`Running::moving`], N.
    pub(super) slackest: f64,
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
    ) -> Self {
        Self {
            problem,
            layout,
            law,
            factor,
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
    pub(super) fn moving(&self, speed: f64, slackest: f64) -> Moving {
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
            slackest,
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

    /// Speed c of the belt if it runs as fast as the rim of the driver with the tractive tension `F_o` where it
    /// enters: m R ω c² + (EA + `F_o`) c = R ω EA. It is below the critical speed.
    pub(super) fn rigid_speed(&self, slackest: f64) -> f64 {
        let (belt, rim) = (self.problem.drive.belt, self.problem.rim);
        let [behind, _] = self.spans(self.problem.driver);
        let linear = belt.axial_stiffness + slackest + self.offset(behind);
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
            false => {
                let parameter = self.law.parameter().unwrap_or_default();
                self.law.contact(arc, moving.speed, parameter)
            }
        }
    }

    /// Traction at which the belt would run as fast as the rim of the driver, N.
    fn reference(&self, moving: Moving) -> Option<f64> {
        let driver = self.problem.driver;
        match self.law {
            FrictionLaw::Coulomb => Some(self.arc(driver, moving).entry()),
            _ => Some(self.contact(driver, moving)?.reference()),
        }
    }

    /// By how much the belt is faster than the rim of the driver at its reference traction, relative.
    pub(super) fn outruns(&self, moving: Moving, reference: f64) -> f64 {
        moving.speed * (1.0 + moving.belt.strain(reference)) / self.problem.rim - 1.0
    }

    /// Speed c of the belt, which the driver turns with at its reference tension: c (1 + `T_o`/EA) = R ω.
    fn speed(&self, slackest: f64) -> Option<f64> {
        let guess = self.rigid_speed(slackest);
        if let (FrictionLaw::Coulomb, NormalForce::Inertia | NormalForce::Exact) =
            (self.law, self.problem.convention)
        {
            return Some(guess);
        }
        let excess = |speed: f64| {
            let moving = self.moving(speed, slackest);
            Some(self.outruns(moving, self.reference(moving)?))
        };
        let range = [0.5 * guess, 2.0 * guess];
        let found = near_with_slope(excess, guess, guess.recip(), range, SPEED * guess);
        if found.is_some() {
            return found;
        }
        let excess = |speed: f64| excess(speed).unwrap_or(f64::NAN);
        let start = excess(guess);
        let bound = match start < 0.0 {
            // The belt outruns a driver that is driven.
            true => {
                let belt = self.problem.drive.belt;
                let critical = (belt.axial_stiffness / belt.mass_per_length).sqrt();
                critical.min(2.0 * self.problem.rim) * (1.0 - f64::EPSILON)
            }
            false => f64::EPSILON * guess,
        };
        bracketed(excess, [bound, guess], [excess(bound), start])
    }

    /// The running belt with a tension of the slackest span as in [`Self::moving`], N, whatever the closure.
    pub(super) fn at(&self, moving: Moving) -> Option<RunningBelt> {
        let Moving {
            speed,
            slackest,
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
            slackest,
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

    /// How tight the belt is; `None` if a pulley does not carry its load.
    pub(super) fn tightness(&self, moving: Moving) -> Option<Tightness> {
        let (found, tension) = match self.problem.target {
            Target::Unstretched { length, elongation } => {
                let asked = (self.layout.length() - length) + elongation;
                return self.elongated(moving, asked);
            }
            Target::Tension { span, tension } => {
                let traction = moving.lowest + self.offset(span);
                (moving.belt.tension(traction), tension)
            }
            Target::TractiveTension { span, tension } => (self.tractive(moving, span), tension),
        };
        Some(Tightness {
            surplus: found - tension,
            scale: tension,
            reference: self.reference(moving)?,
        })
    }

    /// How tight the belt is if L − `L_0` is asked for, m.
    fn elongated(&self, moving: Moving, asked: f64) -> Option<Tightness> {
        let mut found = self.on_spans(moving);
        let mut reference = f64::NAN;
        for pulley in 0..self.layout.wraps().len() {
            let arc = self.arc(pulley, moving);
            let (on_pulley, entered) = match self.law {
                FrictionLaw::Coulomb => (elongation::rigid(&arc), arc.entry()),
                _ => {
                    let contact = self.contact(pulley, moving)?;
                    (elongation(&contact), contact.reference())
                }
            };
            found += on_pulley;
            if pulley == self.problem.driver {
                reference = entered;
            }
        }
        Some(Tightness {
            surplus: found - asked,
            scale: found,
            reference,
        })
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
