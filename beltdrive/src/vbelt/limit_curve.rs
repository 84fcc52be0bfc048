//! The limit of one entry over a second one: a design chart.

use super::limits::{domain, first_state, limit, upwards};
use super::solve::checked;
use super::{SolveError, SolveOptions};
use crate::input::Key;
use crate::{
    BranchEnd, Drive, Limit, LimitCurve, LimitCurvePoint, LimitReason, RangeEnd, TraceConvergence,
};
use std::time::Instant;

/// Number of equal steps over the range of the second entry.
const STEPS: usize = 20;
/// A change of the kind of limit is located to this share of a step.
const CHANGE: f64 = 0.01;

/// Finds the largest value of the entry `key` that a drive carries, and why, over the values of the
/// entry `second` from `range[0]` to `range[1]` (SI): the load limit against the coefficient of
/// friction, for instance.
///
/// Every limit is located on the branch of its own drive. Where the kind of limit changes, the place
/// of the change is found by bisection.
///
/// # Errors
/// Those of [`solve`](crate::solve) at the beginning of the range.
///
/// # Panics
/// If an entry is none of this drive.
pub fn limit_curve(
    drive: &Drive,
    key: &Key,
    second: &Key,
    range: [f64; 2],
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<LimitCurve, SolveError> {
    let start = Instant::now();
    let mut chart = Chart {
        drive,
        key: *key,
        second: *second,
        tolerance: checked(options)?,
        convergence: TraceConvergence {
            tolerance: options.tolerance,
            ..TraceConvergence::default()
        },
    };
    let [from, to] = range;
    let step = (to - from) / STEPS as f64;
    let mut points = vec![chart.limit_at(from)?];
    let mut end = BranchEnd::Target;
    for i in 1..=STEPS {
        progress((i - 1) as f64 / STEPS as f64, "tracing the limit");
        let value = if i == STEPS {
            to
        } else {
            from + step * i as f64
        };
        let next = match chart.limit_at(value) {
            Ok(next) => next,
            Err(error) => {
                end = BranchEnd::NotConverged {
                    cause: error.to_string(),
                };
                break;
            }
        };
        let last = &points[points.len() - 1];
        if next.reason != last.reason {
            let between = chart.change(last.clone(), next.clone(), CHANGE * step.abs());
            points.extend(between);
        }
        points.push(next);
    }
    let mut convergence = chart.convergence;
    convergence.seconds = start.elapsed().as_secs_f64();
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

/// What all limits of a chart have in common, and their cost.
struct Chart<'d> {
    drive: &'d Drive,
    key: Key,
    second: Key,
    tolerance: f64,
    convergence: TraceConvergence,
}

impl Chart<'_> {
    /// The limit at one value of the second entry.
    fn limit_at(&mut self, value: f64) -> Result<LimitCurvePoint, SolveError> {
        let mut drive = self.drive.clone();
        self.second.set(&mut drive, value);
        let tight = Key::tight_tension(&drive);
        // A slack tension above the tight one of the file leaves no load: begin with a light one.
        let least = 1.5 * drive.load.slack.value();
        if tight.get(&drive) < least {
            tight.set(&mut drive, least);
        }
        let (first, solved) = first_state(&drive, &self.key, self.tolerance)?;
        let [_, high] = domain(&first, &self.key);
        let found = upwards(
            &first,
            &self.key,
            self.tolerance,
            solved,
            high,
            &mut |_, _| {},
        );
        let cost = &found.tracer.convergence;
        self.convergence.continuation_steps += cost.continuation_steps;
        self.convergence.newton_iterations += cost.newton_iterations;
        self.convergence.rhs_evaluations += cost.rhs_evaluations;
        self.convergence.factorisations += cost.factorisations;
        self.convergence.slip_normalisation = cost.slip_normalisation;
        let Limit {
            value: largest,
            value_error,
            reason,
            state,
            ..
        } = limit(&found);
        let RangeEnd::Limit(reason) = reason else {
            return Err(SolveError::NoLimit {
                reached: largest,
                cause: found.end.to_string(),
            });
        };
        Ok(LimitCurvePoint {
            second: value,
            value: largest,
            value_error,
            reason,
            state,
        })
    }

    /// Two limits of different kinds closer to each other than `width`, between two such limits.
    fn change(
        &mut self,
        mut before: LimitCurvePoint,
        mut after: LimitCurvePoint,
        width: f64,
    ) -> Vec<LimitCurvePoint> {
        let kind: LimitReason = before.reason;
        while (after.second - before.second).abs() > width {
            let Ok(middle) = self.limit_at(0.5 * (before.second + after.second)) else {
                break;
            };
            if middle.reason == kind {
                before = middle;
            } else {
                after = middle;
            }
        }
        vec![before, after]
    }
}
