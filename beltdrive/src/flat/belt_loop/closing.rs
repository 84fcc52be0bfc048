//! The running belt on pulleys at fixed places that the closure asks for.

use super::problem::Problem;
use super::running::{LOOSEST, Running, RunningBelt};
use crate::drive::layout::Layout;
use crate::mechanics::root::{ESTIMATED, bracketed, near, near_with_slope};
use crate::{FrictionLaw, NormalForce};
use std::cell::Cell;

/// Where the search for the slackest tension begins, as a share of the axial stiffness: the strain of a
/// slack belt. It only decides how often the bracket is doubled.
const SLACK_STRAIN: f64 = 1e-6;

/// A closure is met to this, relative, and to the rounding of the length of the loop; a root of a
/// continuous function is met far better.
const CLOSED: f64 = 1e-9;

/// The last step of the secant method for the tension of the slackest span, relative to the tension without
/// torques. Its error is about this times the step before.
const NEAR: f64 = 1e-11;

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

/// A guess of the belt that the closure asks for, from the tension without torques.
#[derive(Clone, Copy)]
struct Guess {
    /// Belt tension without torques, N.
    tension: f64,
    /// Tension of the slackest span as in [`Running::moving`] without torques, N.
    slackest: f64,
    /// By how much it is less under the torques, N.
    offset: f64,
    /// Slope of [`Closing::surplus`] with it.
    slope: f64,
}

/// The search for the tension that the closure asks for.
#[derive(Clone, Copy)]
pub(super) struct Closing<'p> {
    running: Running<'p>,
    /// What was found where the tensioner was just before.
    known: &'p Known,
}

/// What was found with the tensioner in a neighbouring place: a search that begins there takes two evaluations in
/// place of four.
#[derive(Default)]
pub(super) struct Known {
    /// Slackest tension above that of the guess, N, and slope of [`Closing::surplus`] over its own.
    tension: Cell<Option<[f64; 2]>>,
    /// For [`Running::speed`].
    speed: Cell<Option<[f64; 2]>>,
}

impl<'p> Closing<'p> {
    /// As [`Running::new`].
    pub(super) fn new(
        problem: &'p Problem<'p>,
        layout: &'p Layout,
        law: FrictionLaw,
        factor: f64,
        known: &'p Known,
    ) -> Self {
        let running = Running::new(problem, layout, law, factor, &known.speed);
        Self { running, known }
    }

    /// By how much the belt is tighter than the closure asks for, in m or N, and what that is measured with.
    fn surplus(&self, slackest: f64) -> Option<[f64; 2]> {
        let moving = self.running.moving_with(slackest)?;
        match self.running.problem.target {
            Target::Unstretched { length, elongation } => {
                let asked = (self.running.layout.length() - length) + elongation;
                let found = self.running.elongation(moving)?;
                Some([found - asked, found])
            }
            Target::Tension { span, tension } => {
                let traction = moving.lowest + self.running.offset(span);
                Some([moving.belt.tension(traction) - tension, tension])
            }
            Target::TractiveTension { span, tension } => {
                Some([self.running.tractive(moving, span) - tension, tension])
            }
        }
    }

    /// A guess of the belt, and of what the torques themselves change.
    fn guess(&self) -> Guess {
        let Problem {
            drive,
            loads,
            target,
            rim,
            ..
        } = self.running.problem;
        let (belt, whole) = (drive.belt, self.running.layout.length());
        let axial = belt.axial_stiffness;
        let (strain, offset) = match *target {
            Target::Unstretched { length, elongation } => {
                let asked = (whole - length) + elongation;
                let spans = self.running.layout.spans().iter().zip(&loads.offsets);
                let spans: f64 = spans.map(|(span, offset)| span.length * offset).sum();
                // Most of a contact has the tension of its entry.
                let pulleys = drive.pulleys.iter().zip(self.running.layout.wraps());
                let arcs = pulleys.enumerate().map(|(index, (pulley, wrap))| {
                    pulley.radius * wrap * loads.offsets[self.running.spans(index)[0]]
                });
                (asked / (whole - asked), (spans + arcs.sum::<f64>()) / whole)
            }
            Target::Tension { span, tension } => (tension / axial, loads.offsets[span]),
            Target::TractiveTension { span, tension } => {
                let kinetic = belt.mass_per_length * rim * rim;
                ((tension + kinetic) / axial, loads.offsets[span])
            }
        };
        let speed = rim / (1.0 + strain);
        let tension = axial * strain;
        Guess {
            tension,
            slackest: match self.running.problem.convention {
                NormalForce::Thesis => tension,
                _ => tension - belt.mass_per_length * speed * rim,
            },
            offset,
            slope: match target {
                Target::Unstretched { .. } => whole / (axial * (1.0 + strain).powi(2)),
                _ => 1.0,
            },
        }
    }

    /// The slackest tension by the secant method from the guess, N.
    fn slackest_near(&self) -> Option<f64> {
        let guess = self.guess();
        let surplus = |slackest: f64| {
            self.surplus(slackest)
                .map_or(f64::NAN, |[surplus, _]| surplus)
        };
        let ([above, steeper], first) = match self.known.tension.get() {
            Some(known) => (known, NEAR),
            None => ([0.0, 1.0], ESTIMATED * NEAR),
        };
        let guessed = guess.slackest - self.running.factor * guess.offset;
        let (start, slope) = (guessed + above, guess.slope * steeper);
        let range = [LOOSEST, f64::INFINITY];
        let within = [first, NEAR].map(|within| within * guess.tension);
        let found = (start > LOOSEST)
            .then(|| near_with_slope(surplus, [start, surplus(start)], slope, range, within))?;
        self.known
            .tension
            .set(found.map(|[root, slope]| [root - guessed, slope / guess.slope]));
        found.map(|[root, _]| root)
    }

    /// The factor on all torques at which the first pulley slips, and the tractive tension of a span there, N: with
    /// the change of traction c, the offset o and the capacity C of the pulleys the traction of the slackest span is
    /// the factor times the largest c/(exp C − 1) − o. `None` if it is not found at once.
    pub(super) fn slips_first(&self, span: usize) -> Option<[f64; 2]> {
        let at = |factor: f64| {
            let running = Running {
                factor,
                law: FrictionLaw::Coulomb,
                ..self.running
            };
            Self { running, ..*self }
        };
        let (guess, bound) = (self.guess(), at(1.0).running.capacity_bound());
        let surplus = |factor: f64| {
            let loaded = at(factor);
            let slackest = loaded.running.slackest_slipping(factor * bound);
            let surplus = slackest.and_then(|slackest| loaded.surplus(slackest));
            surplus.map_or(f64::NAN, |[surplus, _]| surplus)
        };
        let rise = bound + guess.offset;
        let start = guess.slackest / rise;
        let (slope, within) = (guess.slope * rise, NEAR * guess.tension / rise);
        let found = near(
            surplus,
            [start, surplus(start)],
            slope,
            [0.0, f64::INFINITY],
            within,
        )?;
        let running = at(found).running;
        let moving = running.moving_with(running.slackest_slipping(found * bound)?)?;
        Some([found, running.tractive(moving, span)])
    }

    /// The running belt that the closure asks for: `Ok(None)` if it would have to be looser than the
    /// loosest that presses on all pulleys, or that carries the load with elastic friction; `Err` if it is
    /// not found.
    pub(super) fn closed(&self) -> Result<Option<RunningBelt>, ()> {
        Ok(self
            .slackest()?
            .and_then(|slackest| self.running.at(slackest)))
    }

    /// As [`Self::closed`], the tractive tension of a span, N; that of the loosest belt in place of none.
    pub(super) fn closed_tractive(&self, span: usize) -> Result<f64, ()> {
        let moving = self
            .slackest()?
            .and_then(|slackest| self.running.moving_with(slackest));
        Ok(moving.map_or_else(
            || self.running.loosest(span),
            |moving| self.running.tractive(moving, span),
        ))
    }

    /// As [`Self::closed`], the tension of the slackest span as in [`Running::moving`], N.
    fn slackest(&self) -> Result<Option<f64>, ()> {
        if let Some(slackest) = self.slackest_near() {
            return Ok(Some(slackest));
        }
        // Elastic friction that slips almost everywhere may not bring the driver to its speed: too loose.
        let excess = |slackest: f64| {
            let found = self.surplus(slackest);
            found.map_or(-1.0, |[surplus, scale]| surplus / scale)
        };
        let loosest = match self.running.law {
            FrictionLaw::Coulomb => 0.0,
            _ => self.running.capacity_bound(),
        };
        let mut low = loosest.max(LOOSEST);
        let mut at_low = excess(low);
        if at_low >= 0.0 {
            return Ok(None);
        }
        let largest = self.running.factor * self.running.problem.loads.largest;
        let axial = self.running.problem.drive.belt.axial_stiffness;
        let mut step = largest.max(SLACK_STRAIN * axial);
        for _ in 0..DOUBLINGS {
            let high = loosest + step;
            let at_high = excess(high);
            if at_high >= 0.0 {
                let slackest = bracketed(excess, [low, high], [at_low, at_high]).ok_or(())?;
                // The sign also changes where the belt gets too loose for elastic friction.
                let rounding = 1e3 * f64::EPSILON * self.running.layout.length();
                let is_met = self
                    .surplus(slackest)
                    .is_some_and(|[surplus, scale]| surplus.abs() < CLOSED * scale + rounding);
                return Ok(is_met.then_some(slackest));
            }
            (low, at_low) = (high, at_high);
            step *= 2.0;
        }
        Err(())
    }
}
