//! A limit followed by continuation over a second entry of the drive file.
//!
//! Where the driven pulley slips grossly, its speed is held at zero and the limited entry is one of
//! the unknowns: a family over the second entry alone. Elsewhere the limit is a limit point, and the
//! curve of limit points in both entries is followed. Either curve is left where
//!
//! - it turns back in the second entry: the limit there vanishes. Of the curve of gross slip this
//!   is the place where the least speed of the driven pulley on the way to a farther limit is zero;
//! - the speed of the driven pulley at the limit point falls to zero: no drive state lies beyond;
//! - the friction zones change.

use super::carried::{Carried, Member};
use super::chart::Chart;
use super::curve::Curve;
use super::family::{DriveFamily, Entry};
use super::path::{Path, Solved};
use super::piece::{FINER, discretisation, steps};
use super::state::describe;
use super::zones::Cut;
use super::{BeltProblem, DRIVER, DriveProblem, INCLINATION};
use crate::{LimitCurvePoint, LimitReason, StateSummary};
use bvp::{Control, Family, Solution};
use continuation::{Branch, Direction, Kind, LimitPointCurve, Point, Stop, System, TwoParameter};
use std::f64::consts::FRAC_PI_2;

/// A limit point is sought between these multiples of the limit.
const AROUND: [f64; 2] = [0.5, 1.5];

/// The longest step, where the range of the second entry counts as one.
const LARGEST_STEP: f64 = 0.2;

/// Events of a curve of limit points; those of the zones follow.
const DRIVEN_STOPS: usize = 0;
const OVERHANG: usize = 1;
const LIMIT_POINT_EVENTS: usize = 2;

/// A limit with a state from which it can be followed.
#[derive(Clone)]
pub(super) struct Located {
    pub(super) point: LimitCurvePoint,
    /// A state near or at the limit, and the value of the limited entry there: a solution that is
    /// determined by that value, or by the speed of the driven pulley where it slips grossly.
    pub(super) near: (f64, Solved),
}

impl Located {
    /// Whether the driven pulley slips grossly.
    pub(super) fn slips(&self) -> bool {
        self.point.reason == LimitReason::DrivenSlips
    }
}

/// How far a limit was followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Course {
    /// To the value asked for.
    Reached,
    /// To where it is no limit any more, which is the last point.
    Ends,
    /// Not further than to the last point, if any.
    Lost,
}

/// A limit over the second entry, from a located one, which is not among the points.
pub(super) struct Followed {
    pub(super) points: Vec<LimitCurvePoint>,
    pub(super) cusps: Vec<LimitCurvePoint>,
    pub(super) course: Course,
}

impl Followed {
    /// The limit at the end of the way.
    pub(super) fn last(&self) -> Option<&LimitCurvePoint> {
        self.points.last()
    }
}

/// A curve of limits whose last two unknowns are both entries.
trait LimitSystem: System {
    /// The discretised drives.
    fn family(&self) -> &Family<'_>;

    /// The drive at a point.
    fn solution(&self, z: &[f64]) -> Solution;
}

impl LimitSystem for Curve<'_> {
    fn family(&self) -> &Family<'_> {
        &self.family
    }

    fn solution(&self, z: &[f64]) -> Solution {
        self.family.solution(z)
    }
}

impl LimitSystem for LimitPointCurve<Curve<'_>> {
    fn family(&self) -> &Family<'_> {
        &self.base().family
    }

    fn solution(&self, z: &[f64]) -> Solution {
        let mut base = self.base().clone();
        let (second, z) = z.split_last().expect("both entries are unknowns");
        base.set_second(*second);
        base.family.solution(z)
    }
}

impl Chart<'_> {
    /// Follows a limit over the second entry from where it was located.
    pub(super) fn follow(&mut self, from: &Located, to: f64) -> Followed {
        let (value, solved) = &from.near;
        let entries = [(self.key, from.point.value), (self.second, self.unit())];
        let entries = entries.map(|(key, unit)| Entry { key, unit });
        let family = DriveFamily::new(self.drive, &solved.problem, entries.to_vec());
        let finer = DriveFamily::new(self.drive, &solved.problem, entries.to_vec());
        let finer = finer.finer(FINER);
        let mut walk = Walk {
            family: &family,
            finer: &finer,
            solved,
            from: &from.point,
            to,
            chart: self,
            followed: Followed {
                points: Vec::new(),
                cusps: Vec::new(),
                course: Course::Lost,
            },
        };
        let values = [value / entries[0].unit, from.point.second / entries[1].unit];
        let entered = if from.slips() {
            walk.gross_slip(&values)
        } else {
            walk.limit_points(&values)
        };
        if entered.is_none() {
            walk.followed.course = Course::Lost;
        }
        walk.followed
    }
}

/// A limit while it is followed.
struct Walk<'a, 'c, 'd> {
    family: &'a DriveFamily,
    finer: &'a DriveFamily,
    solved: &'a Solved,
    from: &'a LimitCurvePoint,
    to: f64,
    chart: &'c mut Chart<'d>,
    followed: Followed,
}

impl<'a> Walk<'a, '_, '_> {
    /// The direction of the second entry.
    fn direction(&self) -> Direction {
        if self.to > self.from.second {
            Direction::Increasing
        } else {
            Direction::Decreasing
        }
    }

    /// The family with one entry or constant as its parameter and another one held.
    fn discretised(
        &self,
        parameter: usize,
        second: usize,
        values: &[f64],
    ) -> Result<(Curve<'a>, Vec<f64>), bvp::Error> {
        let guess = Member {
            solution: Carried(self.solved),
            values,
        };
        // Every point must show a state that passes its checks.
        let options = bvp::Options {
            control: Control::Defect,
            ..discretisation(self.chart.tolerance, &self.solved.problem)
        };
        let (family, z) = Family::new(self.family, parameter, &[second], &guess, &options)?;
        let finer = (self.solved.problem.smoothing() > 0.0).then_some(self.finer);
        let curve = Curve { family, finer };
        Ok((curve, z))
    }

    /// The settings over the second entry, with the values of the chart as targets.
    fn steps(&self) -> continuation::Options {
        let unit = self.chart.unit();
        let [from, to] = [self.from.second, self.to].map(|end| end / unit);
        let values = self.chart.values().into_iter().map(|value| value / unit);
        let range = [from.min(to), from.max(to)];
        continuation::Options {
            targets: values
                .filter(|&value| range[0] < value && value < range[1])
                .collect(),
            largest_step: LARGEST_STEP,
            ..steps(self.chart.tolerance, &self.solved.problem, range)
        }
    }

    /// Follows gross slip of the driven pulley; `None` where it cannot be followed at all.
    fn gross_slip(&mut self, values: &[f64]) -> Option<()> {
        let second = self.family.first_entry() + 1;
        let start = self.discretised(second, DriveProblem::DRIVEN_RIM_SPEED, values);
        let (mut curve, z) = start.ok()?;
        let options = self.steps();
        let branch = Branch::new(&mut curve, &z, self.direction(), &options).ok()?;
        self.walk(branch, 0);
        Some(())
    }

    /// Finds the limit point and follows it; `None` where it cannot be followed at all.
    fn limit_points(&mut self, values: &[f64]) -> Option<()> {
        let first = self.family.first_entry();
        let (mut curve, z) = self.discretised(first, first + 1, values).ok()?;
        let options = steps(self.chart.tolerance, &self.solved.problem, AROUND);
        let mut branch = Branch::new(&mut curve, &z, Direction::Increasing, &options).ok()?;
        let limit = branch.find(|point| point.kind == Kind::LimitPoint)?;
        let system = branch.system().clone();
        let mut curve = LimitPointCurve::new(system, &limit.z).ok()?;
        let start = curve.start(&limit.z);
        let options = self.steps();
        let exit = self.solved.problem.zones(DRIVER).end - 1;
        let constants = self.family.first_entry();
        let branch = Branch::new(&mut curve, &start, self.direction(), &options)
            .ok()?
            .event(move |_, point| {
                point.z[point.z.len() - 2 - constants + DriveProblem::DRIVEN_RIM_SPEED]
            })
            .event(move |curve: &LimitPointCurve<Curve<'_>>, point| {
                curve.family().end(&point.z, exit)[INCLINATION] - FRAC_PI_2
            });
        self.walk(branch, LIMIT_POINT_EVENTS);
        Some(())
    }

    /// Follows a curve with so many events of its own until it ends.
    fn walk<S: LimitSystem>(&mut self, mut branch: Branch<'_, S>, events: usize) {
        let split = self.solved.problem.is_split();
        if split {
            let zones = self.solved.problem.zones(DRIVER).end;
            for segment in 0..zones {
                branch = branch.event(move |_, point| point.z[point.z.len() - 2 - zones + segment]);
            }
        }
        let mut stats = bvp::Stats::default();
        let mut reason = self.from.reason;
        while let Some(point) = branch.next() {
            self.chart.convergence.continuation_steps += 1;
            if point.kind == Kind::Start || point.kind == Kind::Regular && !split {
                continue;
            }
            let solution = branch.system().solution(&point.z);
            stats = solution.stats().to_owned();
            let Some((here, limit)) = self.limit(&point, solution, reason) else {
                break;
            };
            match point.kind {
                Kind::Regular if !Cut::of(&here).is_kept() => break,
                Kind::Regular => continue,
                Kind::Event(index) if index >= events => {
                    self.followed.points.push(limit);
                    break;
                }
                Kind::Event(OVERHANG) => {
                    // Once more as the first limit of the other kind.
                    reason = match reason {
                        LimitReason::Overhang => LimitReason::DriverSlips,
                        _ => LimitReason::Overhang,
                    };
                    let other = LimitCurvePoint {
                        reason,
                        ..limit.clone()
                    };
                    self.followed.points.extend([limit, other]);
                }
                Kind::Cusp => self.followed.cusps.push(limit),
                Kind::LimitPoint | Kind::Event(DRIVEN_STOPS) => {
                    self.followed.points.push(limit);
                    self.followed.course = Course::Ends;
                    break;
                }
                _ => self.followed.points.push(limit),
            }
        }
        if let Some(Stop::Bound { .. }) = branch.stop() {
            self.followed.course = Course::Reached;
        }
        self.chart.convergence.count(&stats);
    }

    /// The state and the limit at a point; none if the state violates an invariant.
    fn limit(
        &self,
        point: &Point,
        solution: Solution,
        reason: LimitReason,
    ) -> Option<(Solved, LimitCurvePoint)> {
        let scaled = &point.z[point.z.len() - 2..];
        let here = Solved {
            problem: self.family.member(scaled),
            solution,
        };
        let drive = self.family.drive(scaled);
        let state = describe(&Path::new(&drive, self.chart.tolerance), &here);
        state.verified().ok()?;
        let error = point.error.map(|error| error.states);
        let relative = error.filter(|error| error.is_finite());
        let value = scaled[0] * self.from.value;
        let limit = LimitCurvePoint {
            second: self.second(point.lambda()),
            value,
            value_error: relative.map(|error| error * value.abs()),
            reason,
            state: StateSummary {
                error_estimate: relative,
                ..StateSummary::from(&state)
            },
        };
        Some((here, limit))
    }

    /// The value of the second entry, exact where it was asked for.
    fn second(&self, scaled: f64) -> f64 {
        let unit = self.chart.unit();
        let mut asked = self.chart.values().into_iter().chain([self.to]);
        let exact = asked.find(|value| scaled == value / unit);
        exact.unwrap_or(scaled * unit)
    }
}
