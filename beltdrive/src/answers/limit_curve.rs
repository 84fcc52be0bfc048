//! The limit of one number of a loop over a second one.

use super::limits::{LoopEnd, LoopLimit, largest};
use super::members::{Refusal, Varied};
use super::trace::INTERVALS;
use crate::SolveOptions;
use crate::input::{DriveFile, FileKey};
use crate::results::branch::samples;

/// The largest value of a number over a second one.
#[derive(Clone, Debug)]
pub struct LoopLimitCurve {
    /// The number that has a limit.
    pub varied: Varied,
    /// The number over which the limit is sought.
    pub second: FileKey,
    /// The limits, in the order of the range.
    pub points: Vec<LoopLimitPoint>,
    /// Why the curve ends before the end of the range.
    pub end: Option<LoopEnd>,
}

/// A limit.
#[derive(Clone, Debug)]
pub struct LoopLimitPoint {
    /// The value of the second number, SI.
    pub second: f64,
    /// The largest value of the first one, and why it is.
    pub limit: LoopLimit,
}

/// The largest value of a number with which the loop has a steady state, at 41 values of the number `second`
/// from `range[0]` to `range[1]` in SI units, each sought as by [`limits`](super::limits::limits).
///
/// # Errors
/// There is no state at the beginning of the range from which to search.
pub fn limit_curve(
    file: &DriveFile,
    varied: &Varied,
    second: &FileKey,
    range: [f64; 2],
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<LoopLimitCurve, Refusal> {
    let at = |value: f64| {
        let limit = largest(&file.with(second, value), varied, options)?;
        Ok(LoopLimitPoint {
            second: value,
            limit,
        })
    };
    let [from, to] = range;
    let mut points = vec![at(from)?];
    let mut end = None;
    for value in samples(range, INTERVALS) {
        progress((value - from) / (to - from), "limits");
        match at(value) {
            Ok(point) => points.push(point),
            Err(refusal) => {
                end = Some(LoopEnd::Limit(refusal));
                break;
            }
        }
    }
    Ok(LoopLimitCurve {
        varied: varied.clone(),
        second: second.clone(),
        points,
        end,
    })
}
