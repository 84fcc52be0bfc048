//! Gross slip that does not end a curve of states under a rising load.
//!
//! A driver that slips grossly lets the belt run slower. Centrifugal force falls with it, and the belt presses more. Where
//! centrifugal force takes up much of the tension, states under ever more load follow each other until the belt
//! stands still, up to the limit of a drive that does not run. So they do where a soft belt sinks ever deeper into its
//! grooves: that of `cvt-variator` slips by an eighth on the way to ten times its load. What the drive carries then ends where
//! a pulley begins to slip grossly, which is a matter of definition; elsewhere it ends at a limit point, to which friction
//! leads.

use super::super::belt_problem::BeltProblem;
use super::super::groove::TENSION;
use super::super::path::{Effort, Solved};
use super::climb::{Limit, Top, limit_accuracy, without_zones};
use super::problem::LoopProblem;
use super::solve::Search;
use super::stiffening::Judge;
use crate::LeastSlip;
use crate::mechanics::root::bracketed;

/// The slip all along a contact at which a pulley is said to slip grossly.
const GROSS: f64 = LeastSlip::GROSS;

/// The slip of the driver at which the load has no limit point to come: the belt has lost a fifth of
/// its speed and a third of its centrifugal force.
const SLOWED: f64 = 0.2;

/// A limit point at more than this times the load at which a pulley begins to slip grossly is another one than friction
/// leads to: usually there are 2 to 4 % between the two. That of `spb-fan` at 10 937 rpm is 28 % above, on a curve that
/// passes the largest load so closely that a step leads over it.
const LONG: f64 = 1.1;

/// Factor between loads at which a state without gross slip is sought.
const LESS: f64 = 0.9;

/// The states of a curve on which the load rises, so far.
pub(super) struct Slipping {
    /// Where the curve ends.
    judge: Judge,
    /// The last state in which no pulley slips grossly.
    begin: Option<Solved<LoopProblem>>,
    /// The load factor of the first state behind it, in which one does.
    slips: Option<f64>,
}

/// Whether a pulley slips grossly.
pub(super) fn is_slipping(state: &Solved<LoopProblem>) -> bool {
    most(state).0 >= GROSS
}

/// The largest slip of a pulley, and that pulley.
fn most(state: &Solved<LoopProblem>) -> (f64, usize) {
    let pulleys = (0..state.problem.pulleys()).map(|pulley| (slip(state, pulley), pulley));
    pulleys.fold((0.0, 0), |most, next| match next.0 > most.0 {
        true => next,
        false => most,
    })
}

/// The speed of a pulley against the belt all along the contact, as a share of the speed of the belt; 0 of idlers.
/// A belt that lies deep in its groove is slow against the pitch circle without slipping.
pub(super) fn slip(state: &Solved<LoopProblem>, pulley: usize) -> f64 {
    let (problem, p) = (&state.problem, state.solution.parameters());
    if problem.is_idle(pulley) {
        return 0.0;
    }
    if let Some(in_groove) = state.in_groove(pulley) {
        return in_groove.least_slip().slip;
    }
    let strand = problem.units.strand();
    let flow = problem.flow(p);
    let tension = strand.tension(state.entry(pulley)[TENSION], flow);
    (strand.speed(tension, flow) - problem.omega(pulley, p)).abs()
}

impl Slipping {
    /// Of a curve of which nothing is known yet.
    pub(super) fn judged(judge: Judge) -> Self {
        Self {
            judge,
            begin: None,
            slips: None,
        }
    }

    /// Whether the load ends where a pulley began to slip grossly, as this next state shows, a limit or not: because it has
    /// slipped for long, or because no limit comes.
    pub(super) fn ends(&mut self, here: &Solved<LoopProblem>, is_limit: bool) -> bool {
        if !is_slipping(here) {
            (self.begin, self.slips) = (Some(here.clone()), None);
            return false;
        }
        let slips = *self.slips.get_or_insert(here.factor());
        let is_long = self.judge == Judge::GrossSlip && here.factor() > LONG * slips;
        is_long || !is_limit && slip(here, here.problem.driver) >= SLOWED
    }
}

impl Search<'_> {
    /// The load at which a pulley begins to slip grossly, on a curve on which the driver has slowed the belt and which
    /// began at `from`: below that load if one slips there already.
    pub(super) fn gross_slip(&mut self, slipping: &Slipping, from: &Solved<LoopProblem>) -> Limit {
        let (begin, slips) = match (&slipping.begin, slipping.slips) {
            (Some(begin), Some(slips)) => (begin.clone(), slips),
            _ => (self.unslipped(from.clone()), from.factor()),
        };
        let excess = |state: &Solved<LoopProblem>| most(state).0 - GROSS;
        let (places, first) = ([begin.factor(), slips], excess(&begin));
        let mut near = begin.clone();
        // Slip at a load changes with the error of a state in first order: by 2e-5 of the load where that is rough.
        let accuracy = limit_accuracy(self.tolerance);
        let mut accurate = Self::new(self.drive, accuracy);
        let mut reached = |to: f64| match accurate.at_factor(&near, to, Effort::Full) {
            Some(state) => {
                near = state;
                excess(&near)
            }
            None => f64::NAN,
        };
        let last = reached(slips);
        let found = bracketed(&mut reached, places, [first, last]);
        let is_found = found.map(&mut reached).is_some_and(f64::is_finite);
        let (_, pulley) = most(&near);
        let within = if is_found {
            0.0
        } else {
            (slips - begin.factor()).abs() / near.factor()
        };
        let without_zones = without_zones(near.problem.law());
        let top = Top {
            factor: near.factor(),
            pulley,
            overhangs: false,
            is_last: false,
            error: accuracy + within + without_zones,
        };
        Limit {
            top,
            at: near,
            below: vec![begin],
        }
    }

    /// The load at which a pulley begins to slip grossly, between that of a state in which none does and the first of some
    /// load factors at which one does.
    pub(super) fn gross_slip_above(
        &mut self,
        begin: &Solved<LoopProblem>,
        factors: impl IntoIterator<Item = f64>,
    ) -> Option<Limit> {
        if is_slipping(begin) {
            return None;
        }
        let mut factors = factors.into_iter();
        let slips = factors.find(|&factor| {
            let state = self.at_factor(begin, factor, Effort::Rough);
            state.is_some_and(|state| is_slipping(&state))
        })?;
        let slipping = Slipping {
            judge: Judge::GrossSlip,
            begin: Some(begin.clone()),
            slips: Some(slips),
        };
        Some(self.gross_slip(&slipping, begin))
    }

    /// A state under less load in which no pulley slips grossly, if it is found.
    fn unslipped(&mut self, mut state: Solved<LoopProblem>) -> Solved<LoopProblem> {
        while is_slipping(&state) {
            match self.at_factor(&state, LESS * state.factor(), Effort::Rough) {
                Some(lower) => state = lower,
                None => break,
            }
        }
        state
    }

    /// The state under another factor on all torques.
    pub(super) fn at_factor(
        &mut self,
        near: &Solved<LoopProblem>,
        to: f64,
        effort: Effort,
    ) -> Option<Solved<LoopProblem>> {
        let from = near.factor();
        let member = |problem: &LoopProblem, factor| problem.clone().with_factor(factor);
        let step = (to - from).abs();
        let found = self.follow(near.clone(), [from, to], step, effort, member);
        found.ok()
    }
}
