//! What closes a running loop: its length, or the tension of a span.

use super::super::BeltProblem;
use super::plane::Laid;
use super::problem::{FLOW, LoopProblem};
use bvp::{Ends, Real};

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

impl LoopProblem {
    /// The tension of the slackest span, scaled: the tractive one where the closure gives such a tension.
    pub(super) fn slackest<T: Real>(&self, at: &Ends<'_, T>, p: &[T]) -> T {
        let spans = (0..self.seats.len()).map(|span| self.leaving(span, at));
        let slackest = spans.fold(T::from_f64(f64::INFINITY), Real::min);
        match self.target {
            Target::Tractive { .. } => slackest,
            _ => self.units.strand().tension(slackest, p[FLOW]),
        }
    }

    /// Length of the belt less that of the unstretched belt, and that of the stretched one, m.
    fn elongation<T: Real>(&self, at: &Ends<'_, T>, p: &[T], laid: &Laid<T>) -> [T; 2] {
        let strand = self.units.strand();
        let (mut elongation, mut length) = (T::ZERO, T::ZERO);
        for (pulley, &span) in laid.lengths.iter().enumerate() {
            let tension = strand.tension(self.leaving(pulley, at), p[FLOW]);
            let strain = strand.strain(tension);
            length += span;
            elongation += span * (strain / (strain + 1.0));
            let radius = self.plane.spots[pulley].radius;
            match self.zones(pulley).last() {
                Some(last) => {
                    let end = at.end(last);
                    length += self.contact_length(pulley, p) * radius;
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
    pub(super) fn lengths(&self, at: &Ends<'_, f64>, p: &[f64]) -> [f64; 2] {
        let laid = self.plane.lay(self.coordinate(p), &self.end_angles(at));
        let [elongation, length] = self.elongation(at, p, &laid);
        [length - elongation, length]
    }

    /// The residual of the closure.
    pub(super) fn closing<T: Real>(&self, at: &Ends<'_, T>, p: &[T], laid: &Laid<T>) -> T {
        match self.target {
            Target::Length(unstretched) => {
                let [elongation, length] = self.elongation(at, p, laid);
                (length - unstretched - elongation) / (unstretched * self.units.strand().compliance)
            }
            Target::Tension { span, tension } => {
                let tractive = self.leaving(span, at);
                self.units.strand().tension(tractive, p[FLOW]) - tension / self.units.force
            }
            Target::Tractive { span, tension } => {
                self.leaving(span, at) - tension / self.units.force
            }
        }
    }
}
