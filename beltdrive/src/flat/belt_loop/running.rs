//! The running belt on pulleys at fixed places with a given tension: its speed and its contacts.

use super::closing::Target;
use super::elongation::{self, elongation};
use super::loads::Loads;
use super::numbers::Numbers;
use crate::drive::layout::Wound;
use crate::friction::coulomb;
use crate::friction::rim::contact::{Arc, Contact};
use crate::friction::rim::traction::Traction;
use crate::mechanics::implicit::Implicit;
use crate::mechanics::root::{bracketed, near_with_slope};
use crate::{FrictionLaw, NormalForce, Pulley};

/// A tension in place of 0, N: its ratio to any other is a number.
pub(super) const LOOSEST: f64 = 1e-200;

/// The last step of the secant method for the belt speed, relative. Its error is about this times the step
/// before.
const SPEED: f64 = 1e-13;

/// Pulleys at fixed places, their loads and a friction law.
#[derive(Clone, Copy)]
pub(super) struct Running<'p, S = f64> {
    pub(super) numbers: &'p Numbers<S>,
    pub(super) wound: &'p Wound<S>,
    pub(super) law: FrictionLaw,
    /// Factor on all torques.
    pub(super) factor: f64,
}

/// The belt at a speed.
#[derive(Clone, Copy)]
pub(super) struct Moving<S = f64> {
    /// Speed c of the unstretched belt, m/s.
    pub(super) speed: S,
    /// Tension of the slackest span as in [`Running::moving`], N.
    slackest: S,
    pub(super) belt: Traction<S>,
    /// Traction of the slackest span, N.
    pub(super) lowest: S,
}

/// How tight a belt is.
#[derive(Clone, Copy)]
pub(super) struct Tightness<S = f64> {
    /// By how much it is tighter than the closure asks for, m or N.
    pub(super) surplus: S,
    /// What that is measured with.
    pub(super) scale: S,
    /// Traction at which it would run as fast as the rim of the driver, N.
    pub(super) reference: S,
}

/// The running belt.
#[derive(Clone, Debug)]
pub(super) struct RunningBelt<S = f64> {
    /// Speed c of the unstretched belt, m/s.
    pub(super) speed: S,
    /// Tension of the slackest span as in [`Running::moving`], N.
    pub(super) slackest: S,
    /// The moving belt.
    pub(super) belt: Traction<S>,
    /// Traction P of each span, N.
    pub(super) tractions: Vec<S>,
    /// Tractive tension F = T − G V of each span, N.
    pub(super) tractive: Vec<S>,
    /// Change of the traction on each pulley, N.
    pub(super) changes: Vec<S>,
    /// The contacts.
    pub(super) contacts: Vec<Contact<S>>,
    /// L − `L_0`, m.
    pub(super) elongation: S,
}

impl RunningBelt {
    /// The largest load |ln(P(L)/P(0))| of a pulley with a wrap angle in rad.
    pub(super) fn largest_load(&self, pulley: &Pulley, wrap: f64) -> f64 {
        let radius = pulley.radius;
        self.belt.slip_rate(pulley.friction_coefficient, radius) * radius * wrap
    }
}

impl<'p, S: Implicit> Running<'p, S> {
    /// All torques are multiplied by `factor`. With [`FrictionLaw::Coulomb`] friction is raised where it
    /// does not carry the load.
    pub(super) fn new(
        numbers: &'p Numbers<S>,
        wound: &'p Wound<S>,
        law: FrictionLaw,
        factor: f64,
    ) -> Self {
        Self {
            numbers,
            wound,
            law,
            factor,
        }
    }

    /// Traction of a span above that of the slackest one, N.
    pub(super) fn offset(&self, span: usize) -> S {
        self.numbers.loads.offsets[span] * self.factor
    }

    /// The spans behind and before a pulley.
    pub(super) fn spans(&self, pulley: usize) -> [usize; 2] {
        let count = self.numbers.rims.len();
        [(pulley + count - 1) % count, pulley]
    }

    /// The belt at a speed c. `slackest` is the tension of the slackest span with the convention `thesis`,
    /// where it enters the speed of that span, and its tractive tension with others, N.
    pub(super) fn moving(&self, speed: S, slackest: S) -> Moving<S> {
        let (mass, axial) = (self.numbers.mass_per_length, self.numbers.axial_stiffness);
        let convention = self.numbers.convention;
        let is_thesis = convention == NormalForce::Thesis;
        let reference = match is_thesis {
            true => speed * (slackest / axial + 1.0),
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

    /// The arc of a pulley.
    fn arc(&self, pulley: usize, moving: Moving<S>) -> Arc<S> {
        let Moving { belt, lowest, .. } = moving;
        let rim = self.numbers.rims[pulley];
        let [behind, before] = self.spans(pulley).map(|span| self.offset(span));
        let change = self.numbers.loads.changes[pulley] * self.factor;
        Arc {
            belt,
            sense: if change < 0.0 { -1.0 } else { 1.0 },
            slip_rate: belt.slip_rate(rim.friction_coefficient, rim.radius),
            length: rim.radius * self.wound.wraps[pulley],
            low: lowest + behind.min(before),
            change: change.abs(),
        }
    }

    /// The contact with a pulley.
    fn contact(&self, pulley: usize, moving: Moving<S>) -> Option<Contact<S>> {
        let arc = self.arc(pulley, moving);
        match self.law == FrictionLaw::Coulomb || arc.change == 0.0 {
            true => Some(coulomb::carried(arc)),
            false => self.law.contact(arc, moving.speed, self.numbers.parameter),
        }
    }

    /// Traction at which the belt would run as fast as the rim of the driver, N.
    fn reference(&self, moving: Moving<S>) -> Option<S> {
        let driver = self.numbers.driver;
        match self.law {
            FrictionLaw::Coulomb => Some(self.arc(driver, moving).entry()),
            _ => Some(self.contact(driver, moving)?.reference()),
        }
    }

    /// By how much the belt is faster than the rim of the driver at its reference traction, relative.
    pub(super) fn outruns(&self, moving: Moving<S>, reference: S) -> S {
        moving.speed * (moving.belt.strain(reference) + 1.0) / self.numbers.rim - 1.0
    }

    /// The running belt with a tension of the slackest span as in [`Self::moving`], N, whatever the closure.
    pub(super) fn at(&self, moving: Moving<S>) -> Option<RunningBelt<S>> {
        let Moving {
            speed,
            slackest,
            belt,
            lowest,
        } = moving;
        let count = self.numbers.rims.len();
        let contacts = (0..count).map(|pulley| self.contact(pulley, moving));
        let contacts = contacts.collect::<Option<Vec<_>>>()?;
        let on_pulleys = contacts.iter().map(elongation).sum::<S>();
        let changes = self.numbers.loads.changes.iter();
        Some(RunningBelt {
            speed,
            slackest,
            belt,
            tractive: (0..count).map(|span| self.tractive(moving, span)).collect(),
            tractions: (0..count).map(|span| lowest + self.offset(span)).collect(),
            changes: changes.map(|&change| change * self.factor).collect(),
            contacts,
            elongation: self.on_spans(moving) + on_pulleys,
        })
    }

    /// Tractive tension F = T − G V of a span, N.
    pub(super) fn tractive(&self, moving: Moving<S>, span: usize) -> S {
        let traction = moving.lowest + self.offset(span);
        match self.numbers.convention {
            NormalForce::Thesis => {
                let (mass, axial) = (self.numbers.mass_per_length, self.numbers.axial_stiffness);
                let inertia = Traction::new(NormalForce::Inertia, mass, axial, moving.speed);
                inertia.of_tension(moving.belt.tension(traction))
            }
            NormalForce::Inertia | NormalForce::Exact => traction,
        }
    }

    /// Length of the loop, m.
    pub(super) fn length(&self) -> S {
        let radii = self.numbers.rims.iter().map(|rim| rim.radius);
        self.wound.length(radii)
    }

    /// Elongation of the spans, m.
    fn on_spans(&self, moving: Moving<S>) -> S {
        let spans = self.wound.spans.iter().enumerate();
        let spans = spans.map(|(index, span)| {
            span.length * moving.belt.elongation(moving.lowest + self.offset(index))
        });
        spans.sum()
    }

    /// How tight the belt is for what a closure asks for; `None` if a pulley does not carry its load.
    pub(super) fn tightness(&self, moving: Moving<S>, target: Target<S>) -> Option<Tightness<S>> {
        let (found, tension) = match target {
            Target::Unstretched { length, elongation } => {
                let asked = (self.length() - length) + elongation;
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
    fn elongated(&self, moving: Moving<S>, asked: S) -> Option<Tightness<S>> {
        let mut found = self.on_spans(moving);
        let mut reference = S::from_f64(f64::NAN);
        for pulley in 0..self.numbers.rims.len() {
            let arc = self.arc(pulley, moving);
            let (on_pulley, entered) = match self.law {
                FrictionLaw::Coulomb => (elongation::rigid(&arc), arc.entry()),
                _ => {
                    let contact = self.contact(pulley, moving)?;
                    (elongation(&contact), contact.reference())
                }
            };
            found += on_pulley;
            if pulley == self.numbers.driver {
                reference = entered;
            }
        }
        Some(Tightness {
            surplus: found - asked,
            scale: found,
            reference,
        })
    }
}

impl Running<'_> {
    /// Tractive tension of a span if the slackest one has none, N.
    pub(super) fn loosest(&self, span: usize) -> f64 {
        match self.numbers.convention {
            NormalForce::Thesis => self
                .moving_with(LOOSEST)
                .map_or(f64::NAN, |moving| self.tractive(moving, span)),
            NormalForce::Inertia | NormalForce::Exact => self.offset(span),
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
        let &Numbers {
            mass_per_length,
            axial_stiffness,
            rim,
            driver,
            ..
        } = self.numbers;
        let [behind, _] = self.spans(driver);
        let linear = axial_stiffness + slackest + self.offset(behind);
        let constant = rim * axial_stiffness;
        let root = (linear * linear + 4.0 * mass_per_length * rim * constant).sqrt();
        2.0 * constant / (linear + root)
    }

    /// Speed c of the belt, which the driver turns with at its reference tension: c (1 + `T_o`/EA) = R ω.
    fn speed(&self, slackest: f64) -> Option<f64> {
        let guess = self.rigid_speed(slackest);
        if let (FrictionLaw::Coulomb, NormalForce::Inertia | NormalForce::Exact) =
            (self.law, self.numbers.convention)
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
                let numbers = self.numbers;
                let critical = (numbers.axial_stiffness / numbers.mass_per_length).sqrt();
                critical.min(2.0 * numbers.rim) * (1.0 - f64::EPSILON)
            }
            false => f64::EPSILON * guess,
        };
        bracketed(excess, [bound, guess], [excess(bound), start])
    }

    /// Below this tension of the slackest span, as in [`Self::moving`], a pulley slips grossly, N.
    pub(super) fn capacity_bound(&self) -> f64 {
        // The largest slip rate of the convention `thesis`, where the belt is no faster than the rim.
        let fastest = self.moving(self.numbers.rim, 0.0);
        match self.numbers.convention {
            NormalForce::Thesis if fastest.belt.stiffness <= 0.0 => 0.0,
            _ => self.slipping_at(fastest.belt),
        }
    }

    /// The traction of the slackest span of a moving belt at which the first pulley slips, N.
    pub(super) fn slipping_at(&self, belt: Traction) -> f64 {
        let raised = belt.slip_rate(1.0, 1.0);
        let Loads { changes, .. } = &self.numbers.loads;
        let bound = |pulley: usize| {
            let [behind, before] = self.spans(pulley).map(|span| self.offset(span));
            let friction = self.numbers.rims[pulley].friction_coefficient;
            let load = raised * friction * self.wound.wraps[pulley];
            match self.factor * changes[pulley] {
                0.0 => 0.0,
                change => change.abs() / load.exp_m1() - behind.min(before),
            }
        };
        (0..changes.len()).map(bound).fold(0.0, f64::max)
    }
}
