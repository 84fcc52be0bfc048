//! The belt laid round the pulleys of a running loop: its spans, its length, and what closes it.

use super::super::EndAngles;
use super::super::belt_problem::{BeltProblem, end_angles};
use super::super::groove::TENSION;
use super::super::path::Solved;
use super::plane::Laid;
use super::problem::LoopProblem;
use super::rest::Known;
use super::seat::Seat;
use crate::Closure;
use bvp::{Ends, Problem, Real, Solution};

/// What the closure asks of the running belt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Target {
    /// Length of the unstretched belt, m.
    Length(f64),
    /// Belt tension of a span, N.
    Tension { span: usize, tension: f64 },
    /// Tractive tension of a span, N.
    Tractive { span: usize, tension: f64 },
}

impl Target {
    /// What a closure asks of the running belt, or of the belt at rest.
    pub(super) fn of(closure: Closure) -> Result<Self, Known> {
        match closure {
            Closure::UnstretchedLength(length) => Err(Known::Length(length)),
            Closure::SetupTension(tension) => Err(Known::Tension(tension)),
            Closure::RestCoordinate(_) => Err(Known::Equilibrium),
            Closure::SpanTension { span, tension } => Ok(Self::Tension { span, tension }),
            Closure::SpanTractiveTension { span, tension } => Ok(Self::Tractive { span, tension }),
            Closure::BothSpans(_) => unreachable!("two pulleys are solved as two pulleys"),
        }
    }
}

/// The belt of a problem with states at both ends of every segment, and parameters.
pub(super) struct Round<'a, T> {
    problem: &'a LoopProblem,
    at: &'a Ends<'a, T>,
    p: &'a [T],
}

impl LoopProblem {
    /// The belt with states at both ends of every segment, and parameters.
    pub(super) fn round<'a, T: Real>(&'a self, at: &'a Ends<'a, T>, p: &'a [T]) -> Round<'a, T> {
        Round {
            problem: self,
            at,
            p,
        }
    }

    /// Calls `view` with the belt of a solution.
    pub(super) fn solved_by<R>(
        &self,
        solution: &Solution,
        view: impl FnOnce(&Round<'_, f64>) -> R,
    ) -> R {
        let segments = self.segments();
        let values = (0..segments.len()).flat_map(|i| [solution.start(i), solution.end(i)]);
        let values: Vec<f64> = values.flatten().copied().collect();
        let at = Ends::new(&segments, &values);
        view(&self.round(&at, solution.parameters()))
    }
}

impl Solved<LoopProblem> {
    /// Calls `view` with the belt round the pulleys.
    pub(super) fn round<R>(&self, view: impl FnOnce(&Round<'_, f64>) -> R) -> R {
        self.problem.solved_by(&self.solution, view)
    }

    /// The factor on all torques.
    pub(super) fn factor(&self) -> f64 {
        self.problem.factor(self.solution.parameters())
    }
}

impl<T: Real> Round<'_, T> {
    /// Tractive tension with which the belt leaves a pulley, scaled.
    pub(super) fn leaving(&self, pulley: usize) -> T {
        let mut pulley = pulley;
        for _ in &self.problem.seats {
            if let Some(last) = self.problem.zones(pulley).last() {
                return self.at.end(last)[TENSION];
            }
            pulley = self.problem.plane.arriving(pulley);
        }
        T::from_f64(f64::NAN)
    }

    /// Inclinations at both ends of every contact.
    pub(super) fn end_angles(&self) -> Vec<EndAngles<T>> {
        let pulleys = self.problem.seats.iter().enumerate();
        let ends = pulleys.map(|(pulley, seat)| match seat {
            Seat::Groove(_) => end_angles(self.problem, pulley, self.at),
            Seat::Back(_) | Seat::Idle => EndAngles {
                entry: T::ZERO,
                exit: T::ZERO,
            },
        });
        ends.collect()
    }

    /// The tension of the slackest span, scaled: the tractive one where the closure gives such a tension.
    pub(super) fn slackest(&self) -> T {
        let spans = (0..self.problem.seats.len()).map(|span| self.leaving(span));
        let slackest = spans.fold(T::from_f64(f64::INFINITY), Real::min);
        match self.problem.target {
            Target::Tractive { .. } => slackest,
            _ => self
                .problem
                .units
                .strand()
                .tension(slackest, self.problem.flow(self.p)),
        }
    }

    /// Length of the belt less that of the unstretched belt, and that of the stretched one, m.
    fn elongation(&self, laid: &Laid<T>) -> [T; 2] {
        let problem = self.problem;
        let strand = problem.units.strand();
        let (mut elongation, mut length) = (T::ZERO, T::ZERO);
        for (pulley, &span) in laid.lengths.iter().enumerate() {
            let tension = strand.tension(self.leaving(pulley), self.problem.flow(self.p));
            let strain = strand.strain(tension);
            length += span;
            elongation += span * (strain / (strain + 1.0));
            let radius = problem.plane.spots[pulley].radius;
            match problem.zones(pulley).last() {
                Some(last) => {
                    let end = self.at.end(last);
                    length += problem.contact_length(pulley, self.p) * radius;
                    elongation += end[end.len() - 1] * radius;
                }
                None => {
                    let arc = laid.turned[pulley] * radius;
                    length += arc;
                    elongation += arc * (strain / (strain + 1.0));
                }
            }
        }
        [elongation, length]
    }

    /// Length of the unstretched belt, and of the running one, m.
    pub(super) fn lengths(&self) -> [T; 2] {
        let coordinate = self.problem.coordinate(self.p);
        let laid = self.problem.plane.lay(coordinate, &self.end_angles());
        let [elongation, length] = self.elongation(&laid);
        [length - elongation, length]
    }

    /// The residual of the closure.
    pub(super) fn closing(&self, laid: &Laid<T>) -> T {
        let units = self.problem.units;
        match self.problem.target {
            Target::Length(unstretched) => {
                let [elongation, length] = self.elongation(laid);
                (length - unstretched - elongation) / (unstretched * units.strand().compliance)
            }
            Target::Tension { span, tension } => {
                let tractive = self.leaving(span);
                units.strand().tension(tractive, self.problem.flow(self.p)) - tension / units.force
            }
            Target::Tractive { span, tension } => self.leaving(span) - tension / units.force,
        }
    }
}
