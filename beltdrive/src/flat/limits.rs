//! Both ends of the range of an entry over which a flat-belt drive has steady states.

use super::closed_form::Refusal;
use super::range::{End, Members};
use super::solve::refused;
use super::trace::branch_between;
use crate::input::Key;
use crate::{Drive, Limit, LimitReason, Limits, RangeEnd, SolveError, SolveOptions};
use web_time::Instant;

/// An end that is a limit.
#[derive(Clone, Copy, Debug)]
pub(super) struct LargestLoad {
    /// The largest value, SI.
    pub(super) value: f64,
    /// What happens there.
    pub(super) reason: LimitReason,
}

/// Both ends of the range of an entry, and the branch between.
pub(crate) fn limits(
    drive: &Drive,
    key: &Key,
    options: &SolveOptions,
) -> Result<Limits, SolveError> {
    let start = Instant::now();
    let members = Members::new(drive, key);
    let value = members
        .carried()
        .map_err(|refusal| refused(drive, refusal))?;
    let [low, high] = members.domain();
    let smallest = limit(&members, value, low);
    let largest = limit(&members, value, high);
    let range = [smallest.value, largest.value];
    let mut branch = branch_between(&members, range, options)?;
    branch.convergence.seconds = start.elapsed().as_secs_f64();
    Ok(Limits {
        branch,
        smallest,
        largest,
    })
}

/// The end of the range from a value that the drive carries towards the bound of its domain.
fn limit(members: &Members<'_>, value: f64, bound: f64) -> Limit {
    let end = members.end_towards(value, bound);
    let is_load = members.key.path().starts_with("load.");
    let (at, reason) = match end {
        Some(End { value, refusal }) => (value, range_end(refusal)),
        // A load that ends at its bound transmits nothing there.
        None if is_load && bound.is_finite() && members.at(bound).is_ok() => {
            (bound, RangeEnd::NoLoad)
        }
        None => (members.last_towards(value, bound), RangeEnd::NotFound),
    };
    let state = members.summary(at);
    Limit {
        value: at,
        value_error: match reason {
            RangeEnd::NotFound => None,
            RangeEnd::NoLoad => Some(0.0),
            RangeEnd::Limit(_) => Some(f64::EPSILON * at.abs()),
        },
        reason,
        errors: members.errors(at, value),
        state: state.expect("a value that the drive carries"),
    }
}

/// Why a range ends where a state is refused.
fn range_end(refusal: Refusal) -> RangeEnd {
    match refusal {
        Refusal::Slips(reason) => RangeEnd::Limit(reason),
        Refusal::LiftsOff { .. } => RangeEnd::Limit(LimitReason::LiftsOff),
        Refusal::Backwards { .. } => RangeEnd::NoLoad,
    }
}

/// The largest value of an entry that the drive carries, and why; `None` if it has no limit.
pub(super) fn largest_load(drive: &Drive, key: &Key) -> Option<LargestLoad> {
    let members = Members::new(drive, key);
    let value = members.carried().ok()?;
    let [_, high] = members.domain();
    let end = members.end_towards(value, high)?;
    match range_end(end.refusal) {
        RangeEnd::Limit(reason) => Some(LargestLoad {
            value: end.value,
            reason,
        }),
        _ => None,
    }
}
