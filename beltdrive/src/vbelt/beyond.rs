//! How a branch goes on beyond a place that its steps do not pass.
//!
//! Where an elastic arc is born or vanishes its end is a double root, and near it no tangent is found. A state
//! beyond it is sought from nothing, and taken if it is where the branch leads.

use super::path::{Path, Solved};
use super::piece::PieceEnd;
use super::state::describe;
use super::tracer::Tracer;
use crate::EventKind;
use continuation::Direction;

/// How far beyond the last state the next one is sought, as shares of the way behind. The largest is that of a usual
/// step.
const BEYOND: [f64; 4] = [1e-3, 1e-2, 0.03, 0.1];
/// A state is one of the branch if its constants are off the line through two states behind it by no more than this
/// share of their change along that, ...
const OFF: f64 = 0.5;
/// ... or by this share of 1 + |value|, within which constants that hardly change stay.
const SAME: f64 = 1e-3;

impl Tracer<'_> {
    /// The next piece, from a state beyond the last one in the direction in which the branch was followed.
    pub(super) fn beyond(&mut self, direction: Direction) -> Option<PieceEnd> {
        let turned = self
            .events
            .iter()
            .any(|event| event.kind == EventKind::LimitPoint);
        let (first, last) = match (self.passed.first(), self.passed.last()) {
            (Some((first, _)), Some((last, _))) if !turned => (*first, *last),
            _ => return None,
        };
        let sense = match direction {
            Direction::Increasing => 1.0,
            Direction::Decreasing => -1.0,
        };
        let [low, high] = self.range;
        for share in BEYOND {
            let value = last + sense * share * (last - first).abs();
            if value == last || !(low < value && value < high) {
                return None;
            }
            let drive = self.drive_at(value);
            let mut path = Path::new(&drive, self.tolerance);
            let found = path.with_direction();
            self.convergence.count(&path.stats);
            if let Some(solved) = found
                && self.leads_to(value, &solved)
                && describe(&path, &solved).verified().is_ok()
            {
                self.refused = None;
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

    /// Whether the states behind lead to one at a value of the entry.
    fn leads_to(&self, value: f64, solved: &Solved) -> bool {
        let Some((last, at_last)) = self.passed.last() else {
            return false;
        };
        let way = value - last;
        let is_far = |(behind, _): &&(f64, Vec<f64>)| (last - behind).abs() >= 0.5 * way.abs();
        let Some((behind, at_behind)) = self.passed.iter().rfind(is_far) else {
            return false;
        };
        let mut each = solved
            .constants()
            .into_iter()
            .zip(at_last.iter().zip(at_behind));
        each.all(|(found, (one, other))| {
            let change = (one - other) * way / (last - behind);
            (found - (one + change)).abs() <= OFF * change.abs() + SAME * (1.0 + one.abs())
        })
    }
}
