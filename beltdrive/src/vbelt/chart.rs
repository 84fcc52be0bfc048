//! The limits of a chart: located on branches at some values of the second entry, followed in
//! between.
//!
//! That a limit is the first one met on the way from a smaller value is known where it is located.
//! It remains so along the curve that is followed, as far as the curve agrees with the next limit
//! located.

use super::followed::{Course, Followed, Located};
use super::limits::{domain, first_state, upwards};
use crate::input::Key;
use crate::{
    BranchEnd, Drive, Limit, LimitCurvePoint, RangeEnd, SolveError, SolveOptions, TraceConvergence,
};

/// Number of equal steps over the range of the second entry; limits are known at their ends.
const STEPS: usize = 20;
/// A limit is located at every so many steps.
const STRIDE: usize = 5;
/// A change of the kind of limit that is not located exactly is located to this share of a step.
const CHANGE: f64 = 0.01;
/// Limits are located at most this many steps apart where they cannot be followed.
const UNKNOWN: f64 = 1.001;
/// Limits that differ by less than this multiple of the tolerance, relatively, are the same.
const SAME: f64 = 10.0;

/// What all limits of a chart have in common, and their cost.
pub(super) struct Chart<'d> {
    pub(super) drive: &'d Drive,
    pub(super) key: Key,
    pub(super) second: Key,
    range: [f64; 2],
    pub(super) tolerance: f64,
    pub(super) points: Vec<LimitCurvePoint>,
    pub(super) cusps: Vec<LimitCurvePoint>,
    pub(super) convergence: TraceConvergence,
}

impl<'d> Chart<'d> {
    /// An empty chart of the limit of the first of two entries over the second one.
    pub(super) fn new(
        drive: &'d Drive,
        [key, second]: [Key; 2],
        range: [f64; 2],
        options: &SolveOptions,
    ) -> Result<Self, SolveError> {
        Ok(Self {
            drive,
            key,
            second,
            range,
            tolerance: options.tolerance,
            points: Vec::new(),
            cusps: Vec::new(),
            convergence: TraceConvergence {
                tolerance: options.tolerance,
                ..TraceConvergence::default()
            },
        })
    }

    /// The value of the second entry (SI) that counts as one.
    pub(super) fn unit(&self) -> f64 {
        self.range[0].abs().max(self.range[1].abs())
    }

    /// The values of the second entry at which the limit shall be known.
    pub(super) fn values(&self) -> Vec<f64> {
        let [from, to] = self.range;
        let inner = (0..STEPS).map(|i| from + self.step() * i as f64);
        inner.chain([to]).collect()
    }

    fn step(&self) -> f64 {
        (self.range[1] - self.range[0]) / STEPS as f64
    }

    /// Finds the limits over the whole range, and says how the chart ends.
    pub(super) fn trace(
        &mut self,
        progress: &mut dyn FnMut(f64, &str),
    ) -> Result<BranchEnd, SolveError> {
        let values = self.values();
        let mut last = self.locate(values[0])?;
        self.points.push(last.point.clone());
        for i in (STRIDE..=STEPS).step_by(STRIDE) {
            let share = (i - STRIDE) as f64 / STEPS as f64;
            progress(share, "tracing the limit");
            let next = match self.locate(values[i]) {
                Ok(next) => next,
                Err(error) => {
                    let cause = error.to_string();
                    return Ok(BranchEnd::NotConverged { cause });
                }
            };
            self.connect(&last, &next);
            last = next;
        }
        Ok(BranchEnd::Target)
    }

    /// The limit at one value of the second entry, at the end of the branch of its drive.
    fn locate(&mut self, value: f64) -> Result<Located, SolveError> {
        let mut drive = self.drive.clone();
        self.second.set(&mut drive, value);
        let tight = Key::load(&drive);
        // A slack tension above the tight one of the file leaves no load: begin with a light one.
        let least = 1.5 * drive.pair().load.slack.value();
        if self.key == tight && tight.get(&drive) < least {
            tight.set(&mut drive, least);
        }
        let (first, solved) = first_state(&drive, &self.key, self.tolerance)?;
        let [_, high] = domain(&first, &self.key, self.tolerance)?;
        let (key, tolerance) = (&self.key, self.tolerance);
        let found = upwards(&first, key, tolerance, solved, high, &mut |_, _| {});
        self.convergence.add(&found.tracer.convergence);
        let Limit {
            value: largest,
            value_error,
            reason,
            state,
            ..
        } = found.limit()?;
        match (reason, found.tracer.near) {
            (RangeEnd::Limit(reason), Some(near)) => Ok(Located {
                point: LimitCurvePoint {
                    second: value,
                    value: largest,
                    value_error,
                    reason,
                    state,
                },
                near,
            }),
            _ => Err(SolveError::NoLimit {
                reached: largest,
                cause: found.end.to_string(),
            }),
        }
    }

    /// Adds the limits behind `from` up to `to`, which are both located.
    fn connect(&mut self, from: &Located, to: &Located) {
        let ahead = self.follow(from, to.point.second);
        if ahead.course == Course::Reached && self.same(ahead.last(), Some(&to.point)) {
            self.append(ahead);
            self.points.pop();
            self.points.push(to.point.clone());
            return;
        }
        let width = (to.point.second - from.point.second).abs();
        let unknown = from.slips() == to.slips() && ahead.course == Course::Lost;
        let share = if unknown { UNKNOWN } else { CHANGE };
        let halves = width > share * self.step().abs();
        if let Some((ahead, mut back)) = self.change(from, to, ahead) {
            back.points.reverse();
            self.append(ahead);
            self.append(back);
        } else if halves
            && let Ok(middle) = self.locate(self.middle(from.point.second, to.point.second))
        {
            self.connect(from, &middle);
            self.connect(&middle, to);
            return;
        }
        self.points.push(to.point.clone());
    }

    /// The limits followed from both sides, `ahead` from the first one, to the place where gross slip
    /// begins or ceases to be the limit.
    ///
    /// Where gross slip is possible at a smaller value than the limit point it is met first. So it is
    /// followed until it ends, which is where the limit jumps; or beyond the place where the limit
    /// point, followed from the other side, takes over without a jump.
    fn change(
        &mut self,
        from: &Located,
        to: &Located,
        ahead: Followed,
    ) -> Option<(Followed, Followed)> {
        let (slipping, turning) = match (from.slips(), to.slips()) {
            (true, false) => (from, to),
            (false, true) => (to, from),
            _ => return None,
        };
        let slip = if from.slips() {
            ahead
        } else {
            self.follow(slipping, turning.point.second)
        };
        let last = slip.last()?;
        let (slip, fold) = match slip.course {
            Course::Ends => {
                let fold = self.follow(turning, last.second);
                let beyond = fold.last()?.value > last.value;
                (beyond && fold.course == Course::Reached).then_some((slip, fold))?
            }
            Course::Reached if last.value > turning.point.value => {
                let fold = self.follow(turning, slipping.point.second);
                let end = fold.last().filter(|_| fold.course == Course::Ends)?;
                let slip = self.follow(slipping, end.second);
                let meets = slip.course == Course::Reached && self.same(slip.last(), Some(end));
                meets.then_some((slip, fold))?
            }
            _ => return None,
        };
        Some(if from.slips() {
            (slip, fold)
        } else {
            (fold, slip)
        })
    }

    /// Whether two limits at the same value of the second entry are the same.
    fn same(&self, one: Option<&LimitCurvePoint>, other: Option<&LimitCurvePoint>) -> bool {
        one.zip(other).is_some_and(|(one, other)| {
            let deviation = (one.value / other.value - 1.0).abs();
            deviation <= SAME * self.tolerance
        })
    }

    /// The value of the chart next to the middle between two values, or the middle.
    fn middle(&self, from: f64, to: f64) -> f64 {
        let middle = 0.5 * (from + to);
        let distance = |value: &f64| (value - middle).abs();
        let mut values = self.values();
        values.retain(|value| distance(value) < 0.4 * (to - from).abs());
        let nearest = values
            .into_iter()
            .min_by(|one, other| distance(one).total_cmp(&distance(other)));
        nearest.unwrap_or(middle)
    }

    fn append(&mut self, followed: Followed) {
        self.points.extend(followed.points);
        self.cusps.extend(followed.cusps);
    }
}
