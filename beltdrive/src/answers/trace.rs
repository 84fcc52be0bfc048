//! The steady states of a loop over a range of one number.

use super::limits::LoopEnd;
use super::members::{Member, Members, Refusal, Varied};
use crate::belt_loop::LoopState;
use crate::input::DriveFile;
use crate::results::branch::samples;
use crate::{Drive, SolveOptions};

/// Intervals between the states of a branch.
pub(super) const INTERVALS: usize = 40;

/// The steady states of a loop over a range, in the order from its beginning to its end.
#[derive(Clone, Debug)]
pub struct LoopBranch {
    /// What varies.
    pub varied: Varied,
    /// The states. The last one lies at the end of the range, or is the last before there is none.
    pub points: Vec<LoopPoint>,
    /// Why the branch ends before the end of the range.
    pub end: Option<LoopEnd>,
}

/// A steady state of a branch.
#[derive(Clone, Debug)]
pub struct LoopPoint {
    /// The value of what varies, SI.
    pub value: f64,
    /// How far a located value may be off, SI; 0 for one that was chosen.
    pub value_error: f64,
    /// The loop.
    pub drive: Drive,
    /// Its steady state.
    pub state: LoopState,
}

impl LoopPoint {
    pub(super) fn new(value: f64, value_error: f64, member: Member) -> Self {
        let Member { drive, state } = member;
        Self {
            value,
            value_error,
            drive,
            state,
        }
    }
}

/// The steady states of the loop that a drive file states, at 41 values of a number from `range[0]` to
/// `range[1]` in SI units: equal steps, or equal ratios over a wide range. The branch ends at the first value
/// that has no state, which is located. `progress` is called with the share that is done.
///
/// # Errors
/// There is no state at the beginning of the range.
pub fn trace(
    file: &DriveFile,
    varied: &Varied,
    range: [f64; 2],
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<LoopBranch, Refusal> {
    let members = Members::new(file, varied, options);
    let [from, _] = range;
    let mut points = vec![LoopPoint::new(from, 0.0, members.at(from)?)];
    let mut end = None;
    let mut last = from;
    for (index, value) in samples(range, INTERVALS).enumerate() {
        progress((index + 1) as f64 / INTERVALS as f64, "states");
        match members.at(value) {
            Ok(member) => points.push(LoopPoint::new(value, 0.0, member)),
            Err(refusal) => {
                let (limit, error, refusal) = members.end_between(last, value, refusal);
                if limit != last
                    && let Ok(member) = members.at(limit)
                {
                    points.push(LoopPoint::new(limit, error, member));
                }
                end = Some(LoopEnd::Limit(refusal));
                break;
            }
        }
        last = value;
    }
    Ok(LoopBranch {
        varied: varied.clone(),
        points,
        end,
    })
}
