//! A loop of two pulleys, from the drive with two pulleys whose spans have nearly the same tensions.
//!
//! The belt lies in both grooves as in that drive, whose state is found in ways that a loop does not have: from the integrals of a
//! belt that locks, along the branch of its load. The first tensions are those of the loop with bristles. The state z₀ of the drive
//! misses the closure of the loop and its torque or power, which is taken back on the way from t = 0 to 1,
//!
//! ```text
//! r(z) = (1 − t) r(z₀)
//! ```
//!
//! or by other tensions where it is far off: scalar EPP friction may hold the belt much deeper in a groove than bristles do.

use super::super::path::{Effort, Path, Solved};
use super::super::solve::solve;
use super::super::{BeltProblem, DRIVEN, DRIVER, TENSION};
use super::guess::groove_compliances;
use super::problem::LoopProblem;
use super::round::Target;
use super::solve::Search;
use super::start::Start;
use crate::{Drive, Load, SolveOptions, SpanTension};
use bvp::Guess;

/// The most tensions that are tried: `v-power` without load and with scalar EPP friction of 1e8 N/m² takes four.
const TRIES: usize = 4;
/// A state is led to the loop whose closure it misses by no more than this share of the largest tension. With 0.2 none is,
/// from 0.65 of the largest load up, to two of 16 random loops with scalar EPP friction, of one of which 2.04 times its load was told
/// in place of 24.6.
const NEAR: f64 = 1.0;

/// How the state of a drive is sought.
pub(super) type Way = fn(&mut Path<'_>) -> Option<Solved>;

impl Search<'_> {
    /// The state of a loop with two pulleys on both of which the belt locks, from that of its drive with the tensions of bristles.
    pub(super) fn by_locked_pair(
        &mut self,
        start: &Start<'_>,
        bristles: &Solved<LoopProblem>,
    ) -> Option<Solved<LoopProblem>> {
        let drive = Tensions::of(bristles, start.target)?.drive(self.drive)?;
        let solved = self.solved_pair(&drive, |path| path.at_locked_load())?;
        self.led_from(&OfPair::new(self.drive, start, &solved)?)
    }

    /// The state of a loop with two pulleys from that of its drive, which is sought in some way with the tensions of a state near by.
    pub(super) fn by_pair(
        &mut self,
        start: &Start<'_>,
        near: &Solved<LoopProblem>,
        way: Way,
    ) -> Option<Solved<LoopProblem>> {
        let mut tensions = Tensions::of(near, start.target)?;
        let stretched = start.layout.length() / self.drive.belt.axial_stiffness;
        let sunk: f64 = groove_compliances(self.drive, &start.layout).iter().sum();
        // By how much a rise of the tension lowers what the closure is missed by.
        let mut slope = (stretched + sunk) / stretched;
        let mut before: Option<[f64; 2]> = None;
        for _ in 0..TRIES {
            let drive = tensions.drive(self.drive)?;
            let solved = self.solved_pair(&drive, way)?;
            let pair = OfPair::new(self.drive, start, &solved)?;
            if pair.missed[1].abs() <= NEAR
                && solved.problem.has_direction()
                && let Some(found) = self.led_from(&pair)
            {
                return Some(found);
            }
            let force = solved.problem.units().force;
            let [load, closure] = pair.missed.map(|missed| missed * force);
            if let Some([level, then]) = before
                && (then - closure) / (tensions.slack - level) > 0.0
            {
                slope = (then - closure) / (tensions.slack - level);
            }
            before = Some([tensions.slack, closure]);
            tensions.slack += closure / slope;
            tensions.tight += closure / slope - load;
        }
        None
    }

    /// The state of a drive.
    fn solved_pair(&mut self, drive: &Drive, way: Way) -> Option<Solved> {
        let mut path = Path::new(drive, self.tolerance);
        let solved = way(&mut path);
        self.problems += path.problems;
        self.stats += path.stats;
        solved
    }

    /// The state of a loop from that of its drive.
    fn led_from(&mut self, pair: &OfPair<'_>) -> Option<Solved<LoopProblem>> {
        let missing = |problem: &LoopProblem, t: f64| {
            let left = pair.missed.map(|missed| (1.0 - t) * missed);
            problem.clone().missing(left)
        };
        // The mesh of the drive may be finer than that of a rough state.
        let begin = self.attempt(missing(&pair.problem, 0.0), pair, Effort::Start);
        let led = self.follow(begin.ok()?, [0.0, 1.0], 1.0, Effort::Rough, missing);
        self.finish_obeying(led.ok()?).ok()
    }
}

/// The state of a drive as it is told.
pub(super) fn in_any_way(path: &mut Path<'_>) -> Option<Solved> {
    if let Some(solved) = path.with_direction() {
        return Some(solved);
    }
    let tolerance = path.tolerance;
    let state = solve(path.drive, &SolveOptions { tolerance }).ok()?;
    state.restart.as_deref().cloned()
}

/// The tensions of both spans, N.
struct Tensions {
    slack: f64,
    tight: f64,
    /// Of the kind that the displacement of EPP friction depends on in the loop.
    kind: fn(f64) -> SpanTension,
}

impl Tensions {
    /// Those of a loop, if it has two pulleys.
    fn of(solved: &Solved<LoopProblem>, target: Target) -> Option<Self> {
        if solved.problem.pulleys() != 2 {
            return None;
        }
        let units = solved.problem.units;
        let flow = solved.problem.flow(solved.solution.parameters());
        let is_tractive = matches!(target, Target::Tractive { .. });
        let tension = |span: usize| {
            let tractive = solved.round(|round| round.leaving(span));
            units.force
                * match is_tractive {
                    true => tractive,
                    false => units.strand().tension(tractive, flow),
                }
        };
        let driver = solved.problem.driver;
        Some(Self {
            slack: tension(driver),
            tight: tension(1 - driver),
            kind: match is_tractive {
                true => SpanTension::Tractive,
                false => SpanTension::Belt,
            },
        })
    }

    /// The drive with two pulleys that a loop is with these tensions, if it is one.
    fn drive(&self, as_loop: &Drive) -> Option<Drive> {
        if self.slack <= 0.0 {
            return None;
        }
        let [slack, tight] = [self.slack, self.tight].map(self.kind);
        as_loop.closed_by(Load { slack, tight })
    }
}

/// Whether a loop is a drive with two pulleys with other tensions.
pub(super) fn is_pair(as_loop: &Drive) -> bool {
    let [slack, tight] = [1.0; 2].map(SpanTension::Belt);
    as_loop.closed_by(Load { slack, tight }).is_some()
}

/// What a pulley of a loop is in the drive.
fn role(pulley: usize, driver: usize) -> usize {
    match pulley == driver {
        true => DRIVER,
        false => DRIVEN,
    }
}

/// A loop near the state of its drive.
struct OfPair<'s> {
    problem: LoopProblem,
    pair: &'s Solved,
    /// What that misses of the torque or power of the driven pulley, and of the closure.
    missed: [f64; 2],
}

impl<'s> OfPair<'s> {
    fn new(drive: &Drive, start: &Start<'_>, pair: &'s Solved) -> Option<Self> {
        let (units, lag) = (pair.problem.units(), pair.problem.smoothing());
        let (law, layout) = (drive.law, &start.layout);
        let problem = LoopProblem::new(drive, layout, units, start.target, law, lag);
        let regimes = pair.problem.regimes();
        let zones = [0, 1].map(|pulley| regimes[role(pulley, problem.driver)].clone());
        let problem = problem
            .with_factor(start.factor)
            .with_direction(pair.problem.has_direction())
            .with_zones(&zones);
        let near = Self {
            problem,
            pair,
            missed: [0.0; 2],
        };
        let missed = near.problem.missed_by(&near);
        Some(Self { missed, ..near })
    }

    /// The segment of the drive that is one of the loop.
    fn of_pair(&self, segment: usize) -> usize {
        let pulley = self.problem.pulley(segment);
        let of_pair = self.pair.problem.zones(role(pulley, self.problem.driver));
        of_pair.start + segment - self.problem.zones(pulley).start
    }
}

impl Guess for OfPair<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let Solved { problem, solution } = self.pair;
        let (segment, last) = (self.of_pair(segment), y.len() - 1);
        solution.state(segment, s, &mut y[..last]);
        // The elongation from the entry with the mean tension on the way.
        let (p, first) = (
            solution.parameters(),
            problem.zones(problem.pulley(segment)).start,
        );
        let before = (first..segment).map(|zone| problem.length(zone, p));
        let arc = before.sum::<f64>() + s * problem.length(segment, p);
        let mean = 0.5 * (solution.start(first)[TENSION] + y[TENSION]);
        let strand = self.problem.units.strand();
        let strain = strand.strain(strand.tension(mean, problem.flow(p)));
        y[last] = arc * strain / (1.0 + strain);
    }

    fn parameters(&self, p: &mut [f64]) {
        let Solved { problem, solution } = self.pair;
        let (known, unknowns) = (solution.parameters(), &self.problem.unknowns);
        for pulley in 0..self.problem.pulleys() {
            if let Some(index) = unknowns.rim_speeds[pulley] {
                p[index] = problem.rim_speed(role(pulley, self.problem.driver), known);
            }
        }
        let segments = self.problem.zoning().count();
        for segment in 0..segments {
            let length = problem.length(self.of_pair(segment), known);
            p[self.problem.first_length() + segment] = length;
        }
        if let Some(index) = unknowns.reference(segments) {
            let [slack, _] = problem.load();
            p[index] = slack.value();
        }
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        let segments = 0..self.problem.zoning().count();
        let meshes =
            segments.map(|segment| self.pair.solution.mesh(self.of_pair(segment)).to_vec());
        Some(meshes.collect())
    }
}
