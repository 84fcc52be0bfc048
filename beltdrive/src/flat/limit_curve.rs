//! The limit of one entry of a flat-belt drive over a second one.

use super::closed_form::Refusal;
use super::limits::{LargestLoad, largest_load};
use super::range::{Members, boundary};
use crate::input::Key;
use crate::results::branch::samples;
use crate::{
    BranchEnd, Drive, LimitCurve, LimitCurvePoint, SolveError, SolveOptions, TraceConvergence,
};
use web_time::Instant;

/// Intervals between the points of a curve.
const INTERVALS: usize = 40;

/// The largest value of `key` over the values of `second` from `range[0]` to `range[1]`.
pub(crate) fn limit_curve(
    drive: &Drive,
    key: &Key,
    second: &Key,
    range: [f64; 2],
    options: &SolveOptions,
) -> Result<LimitCurve, SolveError> {
    let start = Instant::now();
    let [from, _] = range;
    let curve = Curve {
        drive,
        key: *key,
        second: *second,
    };
    let mut points = vec![curve.point(from).ok_or_else(|| curve.unlimited(from))?];
    let mut end = BranchEnd::Target;
    for value in samples(range, INTERVALS) {
        let Some(point) = curve.point(value) else {
            end = curve.end(value);
            break;
        };
        let last = points
            .last()
            .map(|last: &LimitCurvePoint| (last.second, last.reason));
        if let Some((before, reason)) = last
            && reason != point.reason
        {
            points.extend(curve.change(before, value));
        }
        points.push(point);
    }
    let convergence = TraceConvergence {
        tolerance: options.tolerance,
        continuation_steps: points.len(),
        seconds: start.elapsed().as_secs_f64(),
        ..TraceConvergence::default()
    };
    Ok(LimitCurve {
        key: *key,
        second: *second,
        drive: drive.clone(),
        points,
        cusps: Vec::new(),
        end,
        convergence,
    })
}

/// The drives of a chart.
struct Curve<'d> {
    drive: &'d Drive,
    key: Key,
    second: Key,
}

impl Curve<'_> {
    fn drive_at(&self, second: f64) -> Drive {
        Members::new(self.drive, &self.second).drive_at(second)
    }

    fn limit(&self, second: f64) -> Option<LargestLoad> {
        largest_load(&self.drive_at(second), &self.key)
    }

    /// The limit at a value of the second entry, if there is one.
    fn point(&self, second: f64) -> Option<LimitCurvePoint> {
        let LargestLoad { value, reason } = self.limit(second)?;
        let drive = self.drive_at(second);
        let state = Members::new(&drive, &self.key).summary(value)?;
        Some(LimitCurvePoint {
            second,
            value,
            value_error: Some(f64::EPSILON * value.abs()),
            reason,
            state,
        })
    }

    /// The limits on both sides of a change of their kind.
    fn change(&self, before: f64, after: f64) -> Vec<LimitCurvePoint> {
        let kind = |second: f64| self.limit(second).map(|limit| limit.reason);
        let first = kind(before);
        let (before, after) = boundary(before, after, |second| kind(second) == first);
        [before, after]
            .into_iter()
            .filter_map(|second| self.point(second))
            .collect()
    }

    /// Why the curve ends before a value of the second entry at which there is no limit.
    fn end(&self, second: f64) -> BranchEnd {
        let drive = self.drive_at(second);
        match Members::new(&drive, &self.key).carried() {
            Err(Refusal::LiftsOff { .. }) => BranchEnd::LiftsOff,
            _ => BranchEnd::NotConverged {
                cause: self.unlimited(second).to_string(),
            },
        }
    }

    fn unlimited(&self, second: f64) -> SolveError {
        let cause = format!("the {} has no limit there", self.key.name());
        SolveError::NoLimit {
            reached: second,
            cause,
        }
    }
}
