//! The last steady state of a loop as its load rises.

use super::super::path::{Effort, Solved};
use super::climb::{DOUBLED, LARGEST_FACTOR, Limit};
use super::elastic_limit::Unelastic;
use super::problem::LoopProblem;
use super::running::{is_drive, overloaded};
use super::solve::{Found, Search};
use super::state::state;
use crate::Drive;
use crate::results::largest_load::LastState;

/// Distances from the limit, relative, at which a state is sought in turn: the first is that to which a limit is known.
const BEFORE: [f64; 4] = [1e-6, 1e-5, 1e-4, 1e-3];

/// The last state of a loop as all its torques and powers rise, from its own; `None` if that has no load, or if the limit
/// or a state beside it is not found. The friction of its states is that of the law itself: others only lead to guesses.
pub(crate) fn last_state(drive: &Drive, tolerance: f64) -> Option<LastState> {
    if drive.is_idle() {
        return None;
    }
    let mut search = Search::new(drive, tolerance);
    let Found {
        at_rest,
        rest,
        running,
    } = search.search().ok()?;
    let elastic = Unelastic::of(&running.start)
        .and_then(|unelastic| search.elastic_limit(&running.start, &unelastic));
    let found = elastic.or_else(|| {
        let begin = running.followed(&mut search)?;
        let risen = search.rise(&begin, DOUBLED, LARGEST_FACTOR, None).ok()?;
        risen.filter(|(limit, _)| limit.is_largest())
    });
    let (limit, from) = found?;
    let top = limit.top;
    let solved = BEFORE.into_iter().find_map(|share| {
        let factor = (1.0 - share) * top.factor;
        let solved = search.below_limit(&limit, &from, factor)?;
        search.within_travel(&rest, &solved).ok()?;
        Some((share, factor, solved))
    });
    let (share, factor, solved) = solved?;
    Some(LastState {
        factor,
        error: share + top.error,
        reason: overloaded(drive, &top),
        state: state(&mut search, &rest, &at_rest, &solved, None).ok()?,
    })
}

impl Search<'_> {
    /// A state under a load below a limit, to the tolerance.
    fn below_limit(
        &mut self,
        limit: &Limit,
        from: &Solved<LoopProblem>,
        factor: f64,
    ) -> Option<Solved<LoopProblem>> {
        let below = limit.below.iter().rev();
        let mut below = below.filter(|state| state.factor() <= factor);
        let near = self.at_factor(below.next().unwrap_or(from), factor, Effort::Rough)?;
        self.finish_obeying(near).ok().filter(is_drive)
    }
}
