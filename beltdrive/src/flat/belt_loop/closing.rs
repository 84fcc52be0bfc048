//! The running belt on pulleys at fixed places that the closure asks for.

use super::equations::Equations;
use super::problem::Problem;
use super::running::{LOOSEST, Moving, Running, RunningBelt, Tightness};
use crate::FrictionLaw;
use crate::drive::layout::Layout;
use crate::mechanics::root::bracketed;
use bvp::Real;

/// Where the search for the slackest tension begins, as a share of the axial stiffness: the strain of a
/// slack belt. It only decides how often the bracket is doubled.
const SLACK_STRAIN: f64 = 1e-6;

/// A closure is met to this, relative, and to the rounding of the length of the loop; a root of a
/// continuous function is met far better.
const CLOSED: f64 = 1e-9;

/// Most doublings of a bracket: from the slack belt they reach a strain of 1e12.
const DOUBLINGS: usize = 60;

/// What the closure asks of the running belt.
#[derive(Clone, Copy, Debug)]
pub(super) enum Target<S = f64> {
    /// Length of the unstretched belt as that of a loop less its elongation, m.
    Unstretched { length: S, elongation: S },
    /// Belt tension of a span, N.
    Tension { span: usize, tension: S },
    /// Tractive tension of a span, N.
    TractiveTension { span: usize, tension: S },
}

impl<S: Real> Target<S> {
    /// The belt that has a tension at rest in a loop of a length in m, N, with its axial stiffness, N.
    pub(super) fn as_at_rest(length: S, tension: S, axial_stiffness: S) -> Self {
        let strain = tension / axial_stiffness;
        Self::Unstretched {
            length,
            elongation: length * strain / (strain + 1.0),
        }
    }
}

/// The search for the tension that the closure asks for.
#[derive(Clone, Copy)]
pub(super) struct Closing<'p> {
    problem: &'p Problem<'p>,
    layout: &'p Layout,
    running: Running<'p>,
}

impl<'p> Closing<'p> {
    /// As [`Running::new`].
    pub(super) fn new(
        problem: &'p Problem<'p>,
        layout: &'p Layout,
        law: FrictionLaw,
        factor: f64,
    ) -> Self {
        Self {
            problem,
            layout,
            running: Running::new(&problem.numbers, layout.wound(), law, factor),
        }
    }

    /// How tight the belt is with a tension of the slackest span as in [`Running::moving`], N.
    fn tightness(&self, slackest: f64) -> Option<Tightness> {
        let moving = self.running.moving_with(slackest)?;
        self.running.tightness(moving, self.problem.target)
    }

    /// The running belt that the closure asks for: `Ok(None)` if it would have to be looser than the
    /// loosest that presses on all pulleys, or that carries the load with elastic friction; `Err` if it is
    /// not found.
    pub(super) fn closed(&self) -> Result<Option<RunningBelt>, ()> {
        Ok(self.moving()?.and_then(|moving| self.running.at(moving)))
    }

    /// As [`Self::closed`], the tractive tension of a span, N; that of the loosest belt in place of none.
    pub(super) fn closed_tractive(&self, span: usize) -> Result<f64, ()> {
        Ok(self.moving()?.map_or_else(
            || self.running.loosest(span),
            |moving| self.running.tractive(moving, span),
        ))
    }

    /// As [`Self::closed`], without its contacts.
    fn moving(&self) -> Result<Option<Moving>, ()> {
        let Running { law, factor, .. } = self.running;
        let equations = Equations::new(self.problem, law, self.layout);
        let guess = equations.guess(f64::NAN, factor);
        if let Some(([slackest, speed, ..], _)) = equations.solve::<2>(guess) {
            return Ok(Some(self.running.moving(speed, slackest)));
        }
        // Elastic friction that slips almost everywhere may not bring the driver to its speed: too loose.
        let excess = |slackest: f64| {
            let found = self.tightness(slackest);
            found.map_or(-1.0, |found| found.surplus / found.scale)
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
        let largest = self.running.factor * self.problem.numbers.loads.largest;
        let axial = self.problem.drive.belt.axial_stiffness;
        let mut step = largest.max(SLACK_STRAIN * axial);
        for _ in 0..DOUBLINGS {
            let high = loosest + step;
            let at_high = excess(high);
            if at_high >= 0.0 {
                let slackest = bracketed(excess, [low, high], [at_low, at_high]).ok_or(())?;
                // The sign also changes where the belt gets too loose for elastic friction.
                let rounding = 1e3 * f64::EPSILON * self.layout.length();
                let is_met = self
                    .tightness(slackest)
                    .is_some_and(|found| found.surplus.abs() < CLOSED * found.scale + rounding);
                let moving = || self.running.moving_with(slackest);
                return Ok(is_met.then(moving).flatten());
            }
            (low, at_low) = (high, at_high);
            step *= 2.0;
        }
        Err(())
    }
}
