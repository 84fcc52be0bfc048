//! How a branch goes on beyond a place that its steps do not pass.
//!
//! Where an elastic arc is born or vanishes its end is a double root, and near it no tangent is found. A state
//! beyond it is sought from nothing, and taken if it is where the branch leads.
//!
//! Scalar elastic friction may hold the belt on one arc or on another under the same load. The states with one of them
//! end in a limit point at which no pulley slips grossly, and the drive goes over to states with the other, under which
//! it carries more. The limit of its load is that of the last of them.

use super::found::verified;
use super::limit::slips_far;
use super::path::{Path, Solved};
use super::piece::PieceEnd;
use super::tracer::Tracer;
use super::zones::Refused;
use crate::{BranchEnd, BranchEvent, EventKind, FrictionLaw, LeastSlip, StateSummary};
use continuation::{Direction, Point};

/// How far beyond the last state the next one is sought, as shares of the way behind. The largest is that of a usual
/// step.
const BEYOND: [f64; 4] = [1e-3, 1e-2, 0.03, 0.1];
/// The same as shares of the value for a belt that locks: there the slip of a turn may change its sense, and within 0.03 %
/// of such a load the branch of the drive of Kim (2009) takes ten times as long as 0.1 % from it.
const BEYOND_LOCKED: [f64; 3] = [1e-3, 3e-4, 1e-4];
/// A state is one of the branch if its constants are off the line through two states behind it, or off the only one, by no
/// more than this share of their change along that, ...
const OFF: f64 = 0.5;
/// ... or by this share of 1 + |value|, within which constants that hardly change stay. Those of another family of states with scalar
/// elastic friction near no load differ by 6e-4: with 1e-3 a branch went over to it, and was lost there. With 1e-4 that branch is lost
/// where it might have gone over.
const SAME: f64 = 3e-4;
/// How far beyond the end of a branch a state of another one is sought, as shares of the value there. States are not found
/// everywhere: of a drive whose first ones end at 112.1 N others were found at 112.4, 115 and 130 N, and none at 125 N; of one whose
/// driver lets go of the belt that it holds at 966.9 N none up to 1934 N, and one at 3867 N, from which its limit of 15 912 N is found.
pub(super) const FARTHER: [f64; 6] = [3e-3, 0.01, 0.03, 0.1, 0.3, 3.0];

/// Whether the belt slips grossly on a pulley, so that there are no other states beyond the end of a branch.
pub(super) fn slips_grossly(state: &StateSummary) -> bool {
    let slips = [&state.driver, &state.driven].map(|pulley| pulley.least_slip);
    let mut slips = slips.iter().flatten();
    slips.any(|least| least.slip > LeastSlip::GROSS)
}

/// How a state is sought from nothing.
type Way = fn(&mut Path<'_>) -> Option<Solved>;
/// A belt that locks is found in a tenth of the time that others take, or not.
const LOCKED: Way = |path| path.at_locked_load();
/// Any belt.
const ANY: Way = |path| path.with_direction();
/// Any belt, with bristles that carry more than the softest if need be. With scalar elastic friction one of five random branches that
/// are lost as the belt ceases to stick goes on so.
const CARRYING: Way = |path| path.with_direction_or_beside();
/// Any belt, with a normalised direction if need be.
const NORMALISED: Way = |path| path.at_load(path.target()).ok();

impl Tracer<'_> {
    /// The next piece, from a state beyond the last one in the direction in which the branch was followed.
    pub(super) fn beyond(&mut self, direction: Direction) -> Option<PieceEnd> {
        let locked = self.beyond_locked(direction);
        locked.or_else(|| {
            let (first, last) = self.way_behind()?;
            let steps = BEYOND.map(|share| share * (last - first).abs());
            self.beyond_by((last, &steps), CARRYING, direction)
        })
    }

    /// The same of a belt that locks.
    pub(super) fn beyond_locked(&mut self, direction: Direction) -> Option<PieceEnd> {
        let (_, last) = self.way_behind()?;
        let steps = BEYOND_LOCKED.map(|share| share * last.abs());
        self.beyond_by((last, &steps), LOCKED, direction)
    }

    /// Whether a limit point is none, since a state beyond it goes on from those in front of it: where the slip of a turn changes
    /// its sense on one pulley, and the other one slips, a direction that lags behind the slip has a limit point. With such a one
    /// at 491.3 N a random drive with Coulomb friction carries 606 N.
    pub(super) fn goes_on_beyond(&mut self, point: &Point, direction: Direction) -> bool {
        let Some((first, last)) = self.way_behind() else {
            return false;
        };
        let step = BEYOND[0] * (last - first).abs();
        let from = self.value(point.lambda());
        self.beyond_by((from, &[step]), NORMALISED, direction)
            .is_some()
    }

    /// The values of the first and of the last state, unless a limit point is behind.
    fn way_behind(&self) -> Option<(f64, f64)> {
        let turned = self
            .events
            .iter()
            .any(|event| event.kind == EventKind::LimitPoint);
        match (self.passed.first(), self.passed.last()) {
            (Some((first, _)), Some((last, _))) if !turned => Some((*first, *last)),
            _ => None,
        }
    }

    /// The next piece, from a state that is found in some way by one of these steps beyond the last value.
    fn beyond_by(
        &mut self,
        (last, steps): (f64, &[f64]),
        way: Way,
        direction: Direction,
    ) -> Option<PieceEnd> {
        let sense = match direction {
            Direction::Increasing => 1.0,
            Direction::Decreasing => -1.0,
        };
        let [low, high] = self.range;
        for step in steps {
            let value = last + sense * step;
            if value != last
                && low < value
                && value < high
                && let Some(solved) = self.anew_at(value, way)
                && self.leads_to(value, &solved)
            {
                self.refused = Refused::default();
                self.refinements = 0;
                return Some(PieceEnd::Next {
                    solved: Box::new(solved),
                    value,
                    direction,
                });
            }
        }
        None
    }

    /// A state of another branch at a larger value than that at which this one has ended, and the value, if the end may
    /// not be that of all states.
    pub(super) fn elsewhere(&mut self, end: &BranchEnd) -> Option<(f64, Solved)> {
        let last = self.points.last()?;
        let may_go_on = match (self.drive.law, end) {
            (FrictionLaw::Bristle { .. }, _) => false,
            (_, BranchEnd::NotConverged { .. }) => true,
            (FrictionLaw::Epp { .. }, BranchEnd::Target) => {
                let turns = |event: &BranchEvent| event.kind == EventKind::LimitPoint;
                self.events.last().is_some_and(turns)
            }
            _ => false,
        };
        if !may_go_on || slips_grossly(&last.state) {
            return None;
        }
        let (value, before) = (last.value, last.arclength);
        let mut farther = FARTHER
            .map(|share| (value * (1.0 + share)).min(self.range[1]))
            .to_vec();
        // Those beyond the end of the range are all that end.
        farther.dedup();
        let found = farther
            .into_iter()
            .find_map(|value| Some((value, self.anew_at(value, ANY)?)))?;
        let ends =
            |event: &mut BranchEvent| matches!(event.kind, EventKind::LimitPoint | EventKind::End);
        self.events.pop_if(ends);
        self.passed.clear();
        self.before = before;
        self.refused = Refused::default();
        self.refinements = 0;
        Some(found)
    }

    /// The state at a value of the entry, from nothing in some way, if it is found below the limit of the load.
    fn anew_at(&mut self, value: f64, way: Way) -> Option<Solved> {
        let drive = self.drive_at(value);
        let mut path = Path::of_branch(&drive, self.tolerance);
        let found =
            way(&mut path).filter(|solved| !slips_far(solved) && path.is_before_limit(solved));
        let found = found.and_then(|solved| verified(&mut path, solved).ok());
        self.convergence.count(&path.stats);
        found
    }

    /// Whether the states behind lead to one at a value of the entry.
    fn leads_to(&self, value: f64, solved: &Solved) -> bool {
        let Some((last, at_last)) = self.passed.last() else {
            return false;
        };
        let way = value - last;
        let is_far = |(behind, _): &&(f64, Vec<f64>)| (last - behind).abs() >= 0.5 * way.abs();
        let far = self.passed.iter().rfind(is_far);
        let Some((behind, at_behind)) = far.or(self.passed.first()) else {
            return false;
        };
        let mut each = solved
            .constants()
            .into_iter()
            .zip(at_last.iter().zip(at_behind));
        each.all(|(found, (one, other))| {
            let change = match last == behind {
                true => 0.0,
                false => (one - other) * way / (last - behind),
            };
            (found - (one + change)).abs() <= OFF * change.abs() + SAME * (1.0 + one.abs())
        })
    }
}
