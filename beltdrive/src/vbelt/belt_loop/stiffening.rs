//! The largest load with Coulomb or EPP friction, from those with bristles: where the curve of states with that friction
//! itself is not followed to its end.
//!
//! Bristles have neither the 0/0 of the direction of Coulomb friction nor the kinks of EPP friction, and their curves are
//! followed in one piece. Their traction lags behind the slip by the length μ/κ, and what
//! a curve with bristles ends at, a largest load or torque, differs by as much from that without:
//!
//! ```text
//! λ(κ) = λ + b/κ + O(1/κ²)          λ ≈ λ(κ₂) + (λ(κ₂) − λ(κ₁))/(κ₂/κ₁ − 1)
//! ```
//!
//! (Richardson 1911). Each curve is followed from its beginning: near the limit of soft bristles stiffer ones may have
//! states that no rising load leads to. On a random accessory drive the alternator slips at 0.78 of the load with stiff
//! bristles, a limit point that soft ones do not have; they lead to 0.91, and so do stiff ones that begin there.

use super::super::BeltProblem;
use super::super::groove::Law;
use super::super::path::{Effort, Solved};
use super::climb::{Climbed, Limit, Top};
use super::problem::LoopProblem;
use super::running::is_drive;
use super::slipping::Slipping;
use super::solve::Search;
use super::start::Start;
use crate::FrictionLaw;

/// Factor between the stiffness of bristles and of the next ones.
const STIFFER: f64 = 10.0;

/// How often bristles are made stiffer: the first time tells b, the second one how well.
const TIMES: usize = 2;

/// Relative error of a limit that is that of one smoothed law alone: the one with soft bristles of a small pulley was
/// 3 % too low.
const SMOOTHED: f64 = 0.03;

/// Share of the difference between the last two extrapolated values that is told as the error of the last: 1/100 is
/// left of it where 1/κ² is the next term.
const LEFT: f64 = 0.1;

/// States higher on a curve from which stiffer bristles are tried where that fails from its beginning.
const HIGHER: usize = 3;

/// Multiple of the largest load up to which that with stiffer bristles is sought.
const FAR: f64 = 2.0;

/// Multiples of the load at which a pulley begins to slip grossly, at one of which it does with stiffer bristles too. On
/// the long way to where no limit point can come any more, the rating of `cvt-variator` took three times as long when it was
/// found with bristles.
const AHEAD: [f64; 3] = [1.02, 1.1, 1.3];

/// Each difference of three values is a tenth of the one before where 1/κ is the next term, and no more than this share of
/// it where they may be extrapolated.
const SHRINKS: f64 = 0.3;

/// Where a curve under a rising load ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Judge {
    /// At a limit point.
    LimitPoint,
    /// At a limit point, or where a pulley begins to slip grossly if none comes.
    LimitPointOrSlip,
    /// Where a pulley begins to slip grossly, if it does so for long, else at a limit point.
    GrossSlip,
}

/// The value without bristles, from those with bristles each [`STIFFER`] times as stiff as those before, and its error.
pub(super) fn extrapolated(values: &[f64]) -> Option<[f64; 2]> {
    let from = |one: f64, other: f64| other + (other - one) / (STIFFER - 1.0);
    match *values {
        [] => None,
        [only] => Some([only, SMOOTHED * only.abs()]),
        [one, other] => Some([from(one, other), (from(one, other) - other).abs()]),
        [.., first, one, other] if (other - one).abs() <= SHRINKS * (one - first).abs() => {
            let [before, last] = [from(first, one), from(one, other)];
            Some([last, LEFT * (last - before).abs()])
        }
        // The stiffness is too low for its order to show.
        [.., first, _, other] => Some([other, (other - first).abs()]),
    }
}

/// A rough state, and the same with stiffer bristles if they stand for the law of the drive.
pub(super) struct Stiffened(Vec<Solved<LoopProblem>>);

impl Stiffened {
    /// The rough state.
    pub(super) fn softest(&self) -> &Solved<LoopProblem> {
        &self.0[0]
    }

    /// A number of a state with the law of the drive in place of bristles, and its error.
    pub(super) fn value(
        &self,
        of: impl FnMut(&Solved<LoopProblem>) -> Option<f64>,
    ) -> Option<[f64; 2]> {
        let values: Vec<_> = self.0.iter().map_while(of).collect();
        extrapolated(&values)
    }
}

impl Search<'_> {
    /// Whether curves of states are followed with the law of the drive itself.
    pub(super) fn follows_law(&self) -> bool {
        !matches!(
            self.drive.law,
            FrictionLaw::Coulomb | FrictionLaw::Epp { .. }
        )
    }

    /// A rough state, and the same with stiffer bristles if they stand for the law of the drive.
    pub(super) fn with_stiffer_ones(&mut self, rough: &Solved<LoopProblem>) -> Stiffened {
        let mut states = vec![rough.clone()];
        while !self.follows_law() && states.len() <= TIMES {
            let last = &states[states.len() - 1];
            let stiffer = has_bristles(last).then(|| self.stiffer(last, STIFFER));
            let Some(stiffer) = stiffer.flatten() else {
                break;
            };
            states.push(stiffer);
        }
        Stiffened(states)
    }

    /// The same loop with bristles this many times as stiff.
    pub(super) fn stiffer(
        &mut self,
        state: &Solved<LoopProblem>,
        times: f64,
    ) -> Option<Solved<LoopProblem>> {
        let to = times.ln();
        let soft = state.problem.clone();
        let member = |_: &LoopProblem, t: f64| soft.clone().with_stiffer_bristles(t.exp());
        let found = self.follow(state.clone(), [0.0, to], to, Effort::Rough, member);
        found.ok()
    }

    /// The largest load of a loop from that with bristles in place of its law, if curves are not followed with that and
    /// it is found.
    pub(super) fn limit_by_bristles(&mut self, start: &Start<'_>) -> Option<Top> {
        if self.follows_law() {
            return None;
        }
        let begin = self.enter_bristles(start).ok().filter(is_drive)?;
        match self.climb(&begin, FAR, None) {
            Climbed::Limit(mut limit) => {
                self.without_bristles(&mut limit, &begin, Judge::LimitPoint);
                (limit.top.error < SMOOTHED).then_some(limit.top)
            }
            _ => None,
        }
    }

    /// Takes a limit with bristles, on a curve that began at `from`, to that of the law they stand for.
    pub(super) fn without_bristles(
        &mut self,
        limit: &mut Limit,
        from: &Solved<LoopProblem>,
        judge: Judge,
    ) {
        if self.follows_law() || limit.at.problem.has_direction() {
            return;
        }
        let mut factors = vec![limit.top.factor];
        if has_bristles(&limit.at) {
            let mut last = None;
            for _ in 0..TIMES {
                let (before, begin) = match &last {
                    None => (&*limit, from),
                    Some((limit, begin)) => (limit, begin),
                };
                let Some(next) = self.stiffer_limit(before, begin, judge) else {
                    break;
                };
                // Another end of the load is no neighbour of the one before.
                if !next.0.top.ends_as(&before.top) {
                    factors.clear();
                }
                factors.push(next.0.top.factor);
                last = Some(next);
            }
            if let Some((last, _)) = last {
                (limit.top, limit.at) = (last.top, last.at);
            }
        }
        if let Some([factor, error]) = extrapolated(&factors) {
            limit.top.factor = factor;
            limit.top.error += error / factor.abs();
        }
    }

    /// The limit with stiffer bristles than one on a curve that began at `from`, and where its curve begins: as low on
    /// that curve as it is found from.
    fn stiffer_limit(
        &mut self,
        limit: &Limit,
        from: &Solved<LoopProblem>,
        judge: Judge,
    ) -> Option<(Limit, Solved<LoopProblem>)> {
        let top = limit.top.factor;
        let count = limit.below.len();
        let higher = (1..=HIGHER).filter_map(|part| limit.below.get(count * part / (HIGHER + 1)));
        std::iter::once(from).chain(higher).find_map(|soft| {
            let begin = self.stiffer(soft, STIFFER).filter(is_drive)?;
            let next = match (judge, limit.top.is_last) {
                (Judge::GrossSlip, false) => {
                    self.gross_slip_above(&begin, AHEAD.map(|share| share * top))
                }
                _ => self.limit_above(&begin, FAR * top, judge),
            };
            Some((next?, begin))
        })
    }

    /// The limit of a curve that begins at a state, up to a load factor.
    fn limit_above(&mut self, begin: &Solved<LoopProblem>, to: f64, judge: Judge) -> Option<Limit> {
        let mut slipping = Slipping::judged(judge);
        let watched = (judge != Judge::LimitPoint).then_some(&mut slipping);
        match self.climb(begin, to, watched) {
            Climbed::Limit(limit) => Some(*limit),
            _ => None,
        }
    }
}

/// Whether a curve can be followed from a state to the tolerance. Of three pulleys with vector EPP friction in zones the
/// torque of one was said to have its largest value at 1.18 times that of the state, where it is 36 times.
pub(super) fn is_followed(state: &Solved<LoopProblem>) -> bool {
    state.problem.has_direction() || has_bristles(state)
}

/// Whether friction in a state is that of bristles.
fn has_bristles(state: &Solved<LoopProblem>) -> bool {
    matches!(state.problem.law(), Law::Bristle { .. })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_falls_with_the_stiffness_is_extrapolated() {
        let of = |stiffness: f64| 2.0 - 0.3 / stiffness + 0.05 / (stiffness * stiffness);
        let values = [1.0, 10.0, 100.0].map(of);
        let [two, error] = extrapolated(&values[..2]).unwrap();
        assert!(
            (two - 2.0).abs() < 0.006 && (two - 2.0).abs() < error,
            "{two}"
        );
        let [three, error] = extrapolated(&values).unwrap();
        assert!(
            (three - 2.0).abs() < 6e-5 && (three - 2.0).abs() < error,
            "{three}"
        );
        assert_eq!(extrapolated(&[1.0, 1.1, 1.2]), Some([1.2, 1.2 - 1.0]));
        assert_eq!(extrapolated(&[2.0]), Some([2.0, 2.0 * SMOOTHED]));
        assert_eq!(extrapolated(&[]), None);
    }
}
