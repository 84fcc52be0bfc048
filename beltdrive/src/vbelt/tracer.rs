//! Following the steady states of a drive over one entry of the drive file.
//!
//! A branch is followed in pieces on which the friction zones of every pulley, and with them the
//! segments of the boundary value problem, stay the same. Where a zone vanishes or appears, the
//! states are cut anew into zones and the next piece begins.
//!
//! Along the branch the slip direction is normalised with a fixed ε, smaller where the belt slips
//! everywhere, larger near no load, where places at which it breaks loose move with the load the
//! more abruptly the smaller ε is. Every labelled point is located once more with ε/4 on the halved
//! mesh: the difference is its error.

use super::carried::Carried;
use super::curve::Curve;
use super::family::{DriveFamily, Entry};
use super::laws::{GREAT_STEP, with_epsilon};
use super::path::{Effort, Path, Solved};
use super::solve::violated;
use super::state::describe;
use super::zones::Split;
use super::{DRIVEN, DRIVER, DriveProblem, INCLINATION, PENETRATION, Regime};
use crate::input::Key;
use crate::{
    BranchEnd, BranchEvent, Drive, EventKind, FrictionLaw, Pulley, PulleyErrors, PulleySummary,
    StateErrors, StateSummary, SteadyState, TraceConvergence, TracePoint, ZoneKind,
};
use bvp::{Family, GlobalError, Scheme};
use continuation::{Branch, Direction, Kind, Options, Point, Stop, System};
use std::f64::consts::FRAC_PI_2;
use std::time::Instant;

/// ε where the belt slips everywhere, and ...
const EPSILON: f64 = 1e-7;
/// ... where the tight tension is less than this multiple of the slack one.
const LOW_RATIO: f64 = 3.0;
const LOW_RATIO_EPSILON: f64 = 1e-5;
/// A share of the range that is no way.
const AHEAD: f64 = 1e-6;
/// The most pieces of a branch.
const MAX_PIECES: usize = 40;
/// The most steps of a piece.
const MAX_STEPS: usize = 600;
/// Behind a limit point a branch is followed until the entry has come back by this share of its way.
const WAY_BACK: f64 = 0.25;
/// The most mesh intervals: a point that needs more is approached by a shorter step.
const MAX_INTERVALS: usize = 4000;
/// The longest step, where the range of the entry counts as one.
const LARGEST_STEP: f64 = 0.1;

/// Accuracy of the points of a branch, as a share of the tolerance.
const ACCURACY: f64 = 1e-3;

/// Event functions of every piece, by their number; those of the zones follow.
const OVERHANG: [usize; 2] = [0, 1];
const DRIVEN_STOPS: usize = 2;
const RATIO: usize = 3;
const BELT_HEIGHT: [usize; 2] = [4, 5];
const FIRST_ZONE: usize = 6;

/// Where a trace shall end, apart from the ends of its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Until {
    /// Nowhere.
    RangeEnds,
    /// At a limit point.
    LimitPoint,
}

/// A branch while it is followed.
pub(super) struct Tracer<'d> {
    drive: &'d Drive,
    key: Key,
    /// Smallest and largest value of the entry, SI.
    range: [f64; 2],
    tolerance: f64,
    until: Until,
    pub(super) points: Vec<TracePoint>,
    pub(super) events: Vec<BranchEvent>,
    pub(super) convergence: TraceConvergence,
    /// Arclength of the pieces before.
    before: f64,
}

/// How a piece ends.
enum PieceEnd {
    /// With the branch.
    Branch(BranchEnd),
    /// At a state from which the next piece starts.
    Next {
        solved: Box<Solved>,
        value: f64,
        direction: Direction,
    },
}

/// A solution of a member of the family as the guess for it.
struct Start<'a> {
    solution: Carried<'a>,
    value: f64,
}

impl bvp::Guess for Start<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        self.solution.state(segment, s, y);
    }

    fn parameters(&self, p: &mut [f64]) {
        let last = p.len() - 1;
        self.solution.parameters(&mut p[..last]);
        p[last] = self.value;
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        self.solution.mesh()
    }
}

impl<'d> Tracer<'d> {
    /// A trace of `drive` over `key` within `range` (SI).
    pub(super) fn new(
        drive: &'d Drive,
        key: Key,
        range: [f64; 2],
        tolerance: f64,
        until: Until,
    ) -> Self {
        Self {
            drive,
            key,
            range,
            tolerance,
            until,
            points: Vec::new(),
            events: Vec::new(),
            convergence: TraceConvergence {
                tolerance,
                ..TraceConvergence::default()
            },
            before: 0.0,
        }
    }

    /// The value of the entry (SI) that counts as one.
    fn unit(&self) -> f64 {
        self.range[0].abs().max(self.range[1].abs())
    }

    /// The value of the entry, exact at the ends of the range.
    fn value(&self, scaled: f64) -> f64 {
        let unit = self.unit();
        let end = self.range.into_iter().find(|end| scaled == end / unit);
        end.unwrap_or(scaled * unit)
    }

    /// The drive with another value of the entry.
    pub(super) fn drive_at(&self, value: f64) -> Drive {
        let mut drive = self.drive.clone();
        self.key.set(&mut drive, value);
        drive
    }

    /// Follows the branch from the state `solved` at `value`, and says how it ends.
    pub(super) fn run(
        &mut self,
        solved: Solved,
        value: f64,
        direction: Direction,
        progress: &mut dyn FnMut(f64, &str),
    ) -> BranchEnd {
        let start = Instant::now();
        let (mut solved, mut value, mut direction) = (solved, value, direction);
        let mut end = None;
        for _ in 0..MAX_PIECES {
            match self.piece(&solved, value, direction, progress) {
                PieceEnd::Branch(reason) => {
                    end = Some(reason);
                    break;
                }
                PieceEnd::Next {
                    solved: next,
                    value: at,
                    direction: onward,
                } => (solved, value, direction) = (*next, at, onward),
            }
        }
        let end = end.unwrap_or_else(|| BranchEnd::NotConverged {
            cause: format!("the friction zones have changed {MAX_PIECES} times"),
        });
        if let Some(last) = self.points.last().cloned()
            && self.events.last().is_none_or(|event| event.point != last)
        {
            self.events.push(BranchEvent {
                kind: EventKind::End,
                point: last,
                value_error: None,
                errors: None,
            });
        }
        self.convergence.seconds += start.elapsed().as_secs_f64();
        end
    }

    /// ε at a drive.
    fn epsilon(drive: &Drive) -> f64 {
        let ratio = drive.load.tight.value() / drive.load.slack.value();
        match drive.law {
            FrictionLaw::Bristle { .. } => 0.0,
            _ if ratio < LOW_RATIO => LOW_RATIO_EPSILON,
            _ => EPSILON,
        }
    }

    /// Follows the branch as long as its friction zones stay the same.
    fn piece(
        &mut self,
        solved: &Solved,
        value: f64,
        direction: Direction,
        progress: &mut dyn FnMut(f64, &str),
    ) -> PieceEnd {
        let not_converged = |cause: String| PieceEnd::Branch(BranchEnd::NotConverged { cause });
        let unit = self.unit();
        let drive = self.drive_at(value);
        // A piece may begin where ε changes: what counts is what lies ahead.
        let ahead = match direction {
            Direction::Increasing => AHEAD,
            Direction::Decreasing => -AHEAD,
        };
        let epsilon = Self::epsilon(&self.drive_at(value + ahead * unit));
        let mut solved = solved.clone();
        if epsilon > 0.0 && solved.problem.epsilon() != epsilon {
            let range = [solved.problem.epsilon().ln(), epsilon.ln()];
            let mut path = Path::new(&drive, self.tolerance);
            match path.follow(solved, range, GREAT_STEP, Effort::Full, with_epsilon) {
                Ok(normalised) => solved = normalised,
                Err(stuck) => return not_converged(stuck.cause.to_string()),
            }
        }
        self.convergence.slip_normalisation = self.convergence.slip_normalisation.max(epsilon);
        let entry = Entry {
            key: self.key,
            unit,
        };
        let family = DriveFamily::new(self.drive, &solved, vec![entry]);
        let finer = DriveFamily::new(self.drive, &solved, vec![entry]).with_epsilon(0.25 * epsilon);
        // Bristles make smooth profiles; layers of ε ask for a higher order.
        let stages = if epsilon > 0.0 { 6 } else { 5 };
        let options = bvp::Options {
            tolerance: self.tolerance,
            scheme: Scheme::Gauss { stages },
            global_error: GlobalError::Skip,
            max_intervals: MAX_INTERVALS,
            ..bvp::Options::default()
        };
        let first = family.first_entry();
        let guess = Start {
            solution: Carried(&solved),
            value: value / unit,
        };
        let (discretised, z) = match Family::new(&family, first, &[], &guess, &options) {
            Ok(start) => start,
            Err(error) => return not_converged(error.to_string()),
        };
        let mut curve = Curve {
            family: discretised,
            finer: Some(&finer),
            second: first,
        };
        let options = Options {
            largest_step: LARGEST_STEP,
            steps: MAX_STEPS,
            accuracy: ACCURACY * self.tolerance,
            ..Options::within(self.range[0] / unit, self.range[1] / unit)
        };
        let branch = match Branch::new(&mut curve, &z, direction, &options) {
            Ok(branch) => branch,
            Err(error) => return not_converged(error.to_string()),
        };
        let mut branch = self.with_events(branch, &solved, first);
        let mut last = None;
        while let Some(point) = branch.next() {
            let solution = branch.system().family.solution(&point.z);
            let scaled = point.lambda();
            let here = Solved {
                problem: family.member(&[scaled]),
                solution,
            };
            let drive = family.drive(&[scaled]);
            self.convergence.continuation_steps += 1;
            let state = describe(&Path::new(&drive, self.tolerance), &here);
            let kind = self.kind(&point, &here);
            // A state at which the driven pulley stands is the end of all drive states.
            if here.driven_speed() < 0.0 && kind != Some(EventKind::GrossSlip(Pulley::Driven)) {
                continue;
            }
            last = Some(here.solution.stats().to_owned());
            // A step may have passed the place where a zone appears: its state is none, but a guess.
            let passed = point.kind == Kind::Regular && Split::of(&here).is_some();
            if passed && here.problem.is_split() {
                self.count(last);
                return self.next_piece(&point, here, &drive);
            }
            if let Some(check) = violated(&state) {
                self.count(last);
                let cause = format!("a state violates an invariant, {}", check.name);
                return not_converged(cause);
            }
            let place = self.record(&point, kind, &state);
            progress(self.share(place), "tracing");
            let ends_here = match kind {
                Some(EventKind::GrossSlip(pulley)) => Some(BranchEnd::GrossSlip(pulley)),
                Some(EventKind::LimitPoint) if self.until == Until::LimitPoint => {
                    Some(BranchEnd::Target)
                }
                _ => self.came_back(place).then_some(BranchEnd::Returned),
            };
            if let Some(end) = ends_here {
                self.count(last);
                return PieceEnd::Branch(end);
            }
            let restart = match point.kind {
                Kind::Event(RATIO) => point.arclength > AHEAD,
                Kind::Event(index) => index >= FIRST_ZONE,
                _ => false,
            };
            if restart {
                self.count(last);
                return self.next_piece(&point, here, &drive);
            }
        }
        self.count(last);
        PieceEnd::Branch(self.end(branch.into_stop()))
    }

    /// The next piece, from a point whose state is cut anew into zones.
    fn next_piece(&mut self, point: &Point, here: Solved, drive: &Drive) -> PieceEnd {
        let rate = point.tangent[point.tangent.len() - 1];
        let direction = if rate > 0.0 {
            Direction::Increasing
        } else {
            Direction::Decreasing
        };
        let mut path = Path::new(drive, self.tolerance);
        match path.keep_zones(here, Effort::Full) {
            Ok(next) => {
                self.before += point.arclength;
                PieceEnd::Next {
                    solved: Box::new(next),
                    value: self.value(point.lambda()),
                    direction,
                }
            }
            Err(stuck) => PieceEnd::Branch(BranchEnd::NotConverged {
                cause: stuck.cause.to_string(),
            }),
        }
    }

    /// Adds the event functions to a piece of the branch.
    fn with_events<'a>(
        &self,
        branch: Branch<'a, Curve<'a>>,
        solved: &Solved,
        constants: usize,
    ) -> Branch<'a, Curve<'a>> {
        let problem = &solved.problem;
        let exits = [DRIVEN, DRIVER].map(|pulley| problem.zones(pulley).end - 1);
        let parameter = move |curve: &Curve<'_>, z: &[f64], index: usize| {
            z[curve.unknowns() - 1 - constants + index]
        };
        let overhang = |exit: usize| {
            move |curve: &Curve<'_>, z: &[f64]| curve.family.end(z, exit)[INCLINATION] - FRAC_PI_2
        };
        let (drive, key, unit) = (self.drive.clone(), self.key, self.unit());
        let ratio = move |_: &Curve<'_>, z: &[f64]| {
            let mut drive = drive.clone();
            key.set(&mut drive, z[z.len() - 1] * unit);
            match drive.law {
                FrictionLaw::Bristle { .. } => 1.0,
                _ => drive.load.tight.value() / (LOW_RATIO * drive.load.slack.value()) - 1.0,
            }
        };
        let height = self.drive.belt.height;
        let radius = problem.scales().radius;
        let sunk = |pulley: usize| {
            let zones = problem.zones(pulley);
            move |curve: &Curve<'_>, z: &[f64]| {
                let Some(height) = height else {
                    return -1.0;
                };
                let solution = curve.family.solution(z);
                let depths = zones.clone().flat_map(|segment| {
                    let nodes = 0..solution.mesh(segment).len();
                    let depth = |node| solution.node(segment, node)[PENETRATION];
                    nodes.map(depth).collect::<Vec<_>>()
                });
                depths.fold(0.0, f64::max) * radius[pulley] / height - 1.0
            }
        };
        let mut branch = branch
            .event(overhang(exits[DRIVEN]))
            .event(overhang(exits[DRIVER]))
            .event(move |curve, z| parameter(curve, z, DriveProblem::DRIVEN_SPEED))
            .event(ratio)
            .event(sunk(DRIVEN))
            .event(sunk(DRIVER));
        if problem.is_split() {
            for segment in 0..problem.zones(DRIVER).end {
                let index = DriveProblem::length_index(segment);
                branch = branch.event(move |curve, z| parameter(curve, z, index));
            }
        }
        branch
    }

    /// What happens at a point.
    fn kind(&self, point: &Point, here: &Solved) -> Option<EventKind> {
        let pulleys = [Pulley::Driven, Pulley::Driver];
        match point.kind {
            Kind::Start if self.points.is_empty() => Some(EventKind::Start),
            Kind::LimitPoint => Some(EventKind::LimitPoint),
            Kind::BranchPoint => Some(EventKind::BranchPoint),
            Kind::Event(DRIVEN_STOPS) => Some(EventKind::GrossSlip(Pulley::Driven)),
            Kind::Event(index) if OVERHANG.contains(&index) => {
                Some(EventKind::Overhang(pulleys[index - OVERHANG[0]]))
            }
            Kind::Event(index) if BELT_HEIGHT.contains(&index) => {
                Some(EventKind::BeltHeight(pulleys[index - BELT_HEIGHT[0]]))
            }
            Kind::Event(index) if index >= FIRST_ZONE => {
                let segment = index - FIRST_ZONE;
                Some(EventKind::ZoneVanishes {
                    pulley: pulleys[here.problem.pulley(segment)],
                    kind: match here.problem.regime(segment) {
                        Regime::Elastic => ZoneKind::Elastic,
                        Regime::Slip | Regime::Either => ZoneKind::Slip,
                    },
                })
            }
            _ => None,
        }
    }

    /// Records a point and what happens there; returns its value.
    fn record(&mut self, point: &Point, kind: Option<EventKind>, state: &SteadyState) -> f64 {
        let value = self.value(point.lambda());
        // Where the comparison did not converge, nothing is known.
        let error = point.error.filter(|error| error.states.is_finite());
        let relative = error.map(|error| {
            let own = if value == 0.0 {
                0.0
            } else {
                error.lambda / point.lambda().abs()
            };
            error.states.max(own)
        });
        let traced = TracePoint {
            value,
            arclength: self.before + point.arclength,
            state: StateSummary {
                error_estimate: relative,
                ..StateSummary::from(state)
            },
        };
        if let Some(kind) = kind {
            self.events.push(BranchEvent {
                kind,
                point: traced.clone(),
                value_error: error.map(|error| error.lambda * self.unit()),
                errors: relative.map(|relative| errors(&traced.state, self.drive, relative)),
            });
        }
        let first_of_next_piece = point.kind == Kind::Start && !self.points.is_empty();
        if !first_of_next_piece {
            self.points.push(traced);
        }
        value
    }

    /// Whether the entry has come back far enough behind the last limit point.
    fn came_back(&self, value: f64) -> bool {
        let is_turn = |event: &&BranchEvent| event.kind == EventKind::LimitPoint;
        let Some(turn) = self.events.iter().rfind(is_turn) else {
            return false;
        };
        let (first, turn) = (self.points[0].value, turn.point.value);
        (value - turn).abs() >= WAY_BACK * (turn - first).abs()
    }

    /// How much of the range lies behind.
    fn share(&self, value: f64) -> f64 {
        let from = self.points.first().map_or(value, |point| point.value);
        let [low, high] = self.range;
        let whole = (high - from).max(from - low);
        ((value - from).abs() / whole).min(1.0)
    }

    /// Adds the cost of a piece.
    fn count(&mut self, stats: Option<bvp::Stats>) {
        let stats = stats.unwrap_or_default();
        self.convergence.newton_iterations += stats.newton_steps;
        self.convergence.rhs_evaluations += stats.rhs_evaluations;
        self.convergence.factorisations += stats.factorisations;
    }

    /// Why the branch ends, from the reason of the tracer.
    fn end(&self, stop: Option<Stop>) -> BranchEnd {
        let value = self.points.last().map(|point| point.value);
        let first = self.points.first().map(|point| point.value);
        match stop {
            Some(Stop::Bound { .. }) => {
                let slack = self.drive.load.slack.value();
                let no_load = self.key == Key::tight_tension(self.drive) && value == Some(slack);
                if no_load {
                    BranchEnd::NoLoad
                } else if value == first {
                    BranchEnd::Returned
                } else {
                    BranchEnd::Target
                }
            }
            Some(Stop::Closed) => BranchEnd::Closed,
            Some(stop) => BranchEnd::NotConverged {
                cause: stop.to_string(),
            },
            None => BranchEnd::Target,
        }
    }
}

/// Absolute errors of the scalars of a state with a relative error.
pub(super) fn errors(state: &StateSummary, drive: &Drive, relative: f64) -> StateErrors {
    let pulley = |pulley: &PulleySummary, radius: f64| PulleyErrors {
        angular_speed: relative * state.driver.angular_speed,
        // A torque is a difference of tensions.
        torque: relative * state.tight_tension * radius,
        wrap_angle: relative * pulley.wrap_angle,
        max_penetration: relative * pulley.max_penetration,
        inclination: [relative * steepest(state); 2],
    };
    StateErrors {
        efficiency: relative,
        driver: pulley(&state.driver, drive.driver_radius),
        driven: pulley(&state.driven, drive.driven_radius),
    }
}

/// The largest inclination at the ends of both pulleys.
fn steepest(state: &StateSummary) -> f64 {
    let ends = [state.driver.inclination, state.driven.inclination].concat();
    ends.into_iter()
        .fold(0.0, |m: f64, theta| m.max(theta.abs()))
}
