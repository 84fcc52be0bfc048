//! One piece of a branch: as long as the friction zones stay the same.

use super::carried::{Carried, Member};
use super::curve::Curve;
use super::family::{DriveFamily, Entry};
use super::path::{Effort, Path, Solved};
use super::state::describe;
use super::tracer::{Tracer, Until};
use super::watched::{FIRST_ZONE, RATIO, RATIOS};
use super::zones::Cut;
use super::{BeltProblem, DriveProblem, Law};
use crate::results::difficulty;
use crate::{BranchEnd, Drive, EventKind, Pulley};
use bvp::{Control, Family, Scheme};
use continuation::{Branch, Direction, Kind, Options, Point};

/// ℓ/R, and ε where the direction is normalised, where the tight tension is less than the first of [`RATIOS`] times
/// the slack one, less than the second, and beyond. With ℓ/R = 1e-10 everywhere branches near no load took three
/// times as many steps; with 1e-8 everywhere limits were off by up to 3e-7.
const LAGS: [f64; 3] = [1e-8, 1e-9, 1e-10];
const EPSILONS: [f64; 3] = [1e-5, 1e-6, 1e-7];
/// A share of the range that is no way.
const AHEAD: f64 = 1e-6;
/// Labelled points are located once more with ℓ or ε multiplied by this.
pub(super) const FINER: f64 = 0.25;
/// The effect of ℓ or ε from its change when that is multiplied by [`FINER`]: it vanishes at least as fast.
pub(super) const WHOLE: f64 = 1.0 / (1.0 - FINER);
/// The most steps of a piece, and of one in shorter steps.
const MAX_STEPS: usize = 600;
const MAX_SHORT_STEPS: usize = 2000;
/// The most mesh intervals: a point that needs more is approached by a shorter step.
const MAX_INTERVALS: usize = 4000;
/// The longest step, where the range of the entry counts as one.
const LARGEST_STEP: f64 = 0.15;

/// The first step of a piece.
const FIRST_STEP: f64 = 0.05;
/// Where the driven speed may have fallen below this share of that of the driver within a step, ...
const MARGIN: f64 = 0.05;
/// ... the step is taken again with steps and margin divided by this, ...
const REFINEMENT: f64 = 4.0;
/// ... at most so often.
const MAX_REFINEMENTS: i32 = 4;
/// Accuracy of the points of a branch, as a share of the tolerance; ...
const ACCURACY: f64 = 1e-3;
/// ... and where the direction is a state. Its rate of change is that of the slip over ℓ, and with 1e-3 the mesh was
/// refined up to 3600 intervals after errors of Newton's method, with this to 80.
const ACCURACY_OF_DIRECTION: f64 = 1e-6;

/// How a piece ends.
pub(super) enum PieceEnd {
    /// With the branch.
    Branch(BranchEnd),
    /// At a state from which the next piece starts.
    Next {
        solved: Box<Solved>,
        value: f64,
        direction: Direction,
    },
}

/// How the members of the family of a problem are discretised.
pub(super) fn discretisation(tolerance: f64, problem: &DriveProblem) -> bvp::Options {
    // Bristles make smooth profiles; the turn of sliding friction asks for a higher order.
    let stages = if problem.smoothing() > 0.0 { 6 } else { 5 };
    bvp::Options {
        tolerance,
        scheme: Some(Scheme::Gauss { stages }),
        control: Control::Defect,
        max_intervals: MAX_INTERVALS,
        ..bvp::Options::default()
    }
}

/// How a branch is followed between scaled values of its entry.
pub(super) fn steps(tolerance: f64, problem: &DriveProblem, [low, high]: [f64; 2]) -> Options {
    let accuracy = match problem.has_direction() {
        true => ACCURACY_OF_DIRECTION,
        false => ACCURACY,
    };
    Options {
        largest_step: LARGEST_STEP,
        first_step: FIRST_STEP,
        steps: MAX_STEPS,
        accuracy: accuracy * tolerance,
        ..Options::within(low, high)
    }
}

impl Tracer<'_> {
    /// ℓ/R or ε of a problem at the load of a drive.
    fn smoothing(drive: &Drive, problem: &DriveProblem) -> f64 {
        let ratio = drive.load.tight.value() / drive.load.slack.value();
        let range = RATIOS.iter().filter(|&&change| ratio >= change).count();
        match problem.law() {
            Law::Sliding { .. } => LAGS[range],
            Law::Normalised { .. } => EPSILONS[range],
            Law::Bristle { .. } => 0.0,
        }
    }

    /// Follows the branch as long as its friction zones stay the same.
    pub(super) fn piece(
        &mut self,
        solved: &Solved,
        value: f64,
        direction: Direction,
        progress: &mut dyn FnMut(f64, &str),
    ) -> PieceEnd {
        let not_converged = |cause: &str| {
            let cause = cause.to_owned();
            PieceEnd::Branch(BranchEnd::NotConverged { cause })
        };
        let unit = self.unit();
        let drive = self.drive_at(value);
        // A piece may begin where ℓ or ε changes: what counts is what lies ahead.
        let ahead = match direction {
            Direction::Increasing => AHEAD,
            Direction::Decreasing => -AHEAD,
        };
        let drive_ahead = self.drive_at(value + ahead * unit);
        let smoothing = Self::smoothing(&drive_ahead, &solved.problem);
        let mut path = Path::new(&drive, self.tolerance);
        let solved = match path.smooth_less(solved.clone(), smoothing, Effort::Full) {
            Ok(solved) => solved,
            Err(stuck) => return not_converged(difficulty::of_solver(&stuck.cause)),
        };
        self.convergence.slip_normalisation = self.convergence.slip_normalisation.max(smoothing);
        let entry = Entry {
            key: self.key,
            unit,
        };
        let family = DriveFamily::new(self.drive, &solved, vec![entry]);
        let finer = DriveFamily::new(self.drive, &solved, vec![entry]);
        let finer = finer.with_smoothing(FINER * smoothing);
        let options = discretisation(self.tolerance, &solved.problem);
        let first = family.first_entry();
        let guess = Member {
            solution: Carried(&solved),
            values: &[value / unit],
        };
        let (discretised, z) = match Family::new(&family, first, &[], &guess, &options) {
            Ok(start) => start,
            Err(error) => return not_converged(difficulty::of_solver(&error)),
        };
        let mut curve = Curve {
            family: discretised,
            finer: (smoothing > 0.0).then_some(&finer),
        };
        let options = Options {
            largest_step: LARGEST_STEP / REFINEMENT.powi(self.refinements),
            first_step: FIRST_STEP / REFINEMENT.powi(self.refinements),
            steps: if self.refinements > 0 {
                MAX_SHORT_STEPS
            } else {
                MAX_STEPS
            },
            ..steps(
                self.tolerance,
                &solved.problem,
                self.range.map(|end| end / unit),
            )
        };
        let branch = match Branch::new(&mut curve, &z, direction, &options) {
            Ok(branch) => branch,
            Err(error) => return not_converged(difficulty::of_branch(&error)),
        };
        let mut branch = self.with_events(branch, &solved, first);
        let mut last = bvp::Stats::default();
        let mut before: Option<(Point, Solved)> = None;
        let driven_speed = |point: &Point| {
            let of = |vector| family.own(vector)[DriveProblem::DRIVEN_SPEED];
            [of(&point.z), of(&point.tangent), point.arclength]
        };
        while let Some(point) = branch.next() {
            let solution = branch.system().family.solution(&point.z);
            last = *solution.stats();
            let here = Solved {
                problem: family.member(&[point.lambda()]),
                solution,
            };
            if let Some((passed, solved)) = &before
                && self.refinements < MAX_REFINEMENTS
                && lowest_between(driven_speed(passed), driven_speed(&point))
                    < MARGIN / REFINEMENT.powi(self.refinements)
            {
                // The driven pulley may have stood still in between: once more, in shorter steps.
                self.convergence.count(&last);
                self.refinements += 1;
                self.before += passed.arclength;
                return PieceEnd::Next {
                    solved: Box::new(solved.clone()),
                    value: self.value(passed.lambda()),
                    direction: onward(passed),
                };
            }
            let effect = branch.system().smoothing_effect(&point.z);
            let ahead = match point.kind {
                // A step may have passed the place where a zone appears: its state is none, but a guess.
                Kind::Regular => Some(onward(&point)),
                // Not of the load, but of the way of a cut.
                Kind::LimitPoint if family.moves_cuts_only(&point.tangent) => {
                    let before = before.as_ref().map(|(point, _)| onward(point));
                    Some(before.unwrap_or(direction))
                }
                _ => None,
            };
            let outcome = self.take(&point, &here, effect, ahead);
            progress(self.share(self.value(point.lambda())), "tracing");
            if let Some(end) = outcome {
                self.convergence.count(&last);
                return end;
            }
            before = Some((point, here));
        }
        self.convergence.count(&last);
        PieceEnd::Branch(self.end(branch.into_stop()))
    }

    /// Takes in a point of the branch with its solution, the relative effect of ℓ or ε on it and, if it counts only
    /// as long as the zones are the same, the direction in which the branch goes on. Returns an end if the piece
    /// ends there.
    fn take(
        &mut self,
        point: &Point,
        here: &Solved,
        effect: Option<f64>,
        ahead: Option<Direction>,
    ) -> Option<PieceEnd> {
        let drive = self.drive_at(self.value(point.lambda()));
        self.convergence.continuation_steps += 1;
        let state = describe(&Path::new(&drive, self.tolerance), here);
        let kind = self.kind(point, here);
        // Beyond a state at which the driven pulley stands there are no drive states.
        if here.driven_speed() < 0.0 && kind != Some(EventKind::GrossSlip(Pulley::Driven)) {
            return None;
        }
        if let Some(direction) = ahead
            && here.problem.has_junctions()
            && !Cut::of(here).is_kept()
        {
            return Some(self.next_piece(point, here.clone(), &drive, direction));
        }
        let restart = match point.kind {
            Kind::Event(RATIO) => point.arclength > AHEAD,
            Kind::Event(index) => index >= FIRST_ZONE,
            _ => false,
        };
        if let Err(error) = state.verified() {
            let cause = error.to_string();
            return Some(match restart {
                // The next piece begins with a state that is solved anew, and checked.
                true => self.next_piece(point, here.clone(), &drive, onward(point)),
                false => PieceEnd::Branch(BranchEnd::NotConverged { cause }),
            });
        }
        let has_direction = here.problem.has_direction();
        let place = self.record(point, kind, &state, effect, has_direction);
        if kind != Some(EventKind::LimitPoint) {
            self.near = Some((place, here.clone()));
        }
        let end = match kind {
            Some(EventKind::GrossSlip(pulley)) => Some(BranchEnd::GrossSlip(pulley)),
            Some(EventKind::LimitPoint) if self.until == Until::LimitPoint => {
                Some(BranchEnd::Target)
            }
            _ => self.came_back(place).then_some(BranchEnd::Returned),
        };
        match end {
            Some(end) => Some(PieceEnd::Branch(end)),
            None => restart.then(|| self.next_piece(point, here.clone(), &drive, onward(point))),
        }
    }

    /// The next piece, from a point whose state is cut anew into zones.
    fn next_piece(
        &mut self,
        point: &Point,
        here: Solved,
        drive: &Drive,
        direction: Direction,
    ) -> PieceEnd {
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
                cause: difficulty::of_solver(&stuck.cause).to_owned(),
            }),
        }
    }
}

/// The sense in which the entry changes at a point.
fn onward(point: &Point) -> Direction {
    if point.tangent[point.tangent.len() - 1] > 0.0 {
        Direction::Increasing
    } else {
        Direction::Decreasing
    }
}

/// The lowest value between two points of the cubic with the values, rates and arclengths there,
/// if it is lower than at both; else infinity.
fn lowest_between([a, da, s]: [f64; 3], [b, db, t]: [f64; 3]) -> f64 {
    let length = t - s;
    if !(da < 0.0 && db > 0.0 && length > 0.0) {
        return f64::INFINITY;
    }
    // a + a' u + c₂ u² + c₃ u³ with u from 0 to the length.
    let slope = (b - a) / length;
    let c3 = (da + db - 2.0 * slope) / (length * length);
    let c2 = (slope - da) / length - c3 * length;
    let root = (c2 * c2 - 3.0 * c3 * da).max(0.0).sqrt();
    let u = (-da / (c2 + root)).clamp(0.0, length);
    a + u * (da + u * (c2 + u * c3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_value_of_a_cubic_is_found() {
        let cubic = |u: f64| 1.0 - 2.0 * u + u.powi(3);
        let rate = |u: f64| -2.0 + 3.0 * u * u;
        let at = |u: f64| [cubic(u), rate(u), 5.0 + u];
        let lowest = cubic((2.0f64 / 3.0).sqrt());
        assert!((lowest_between(at(0.1), at(1.5)) - lowest).abs() < 1e-12);
        assert_eq!(lowest_between(at(0.1), at(0.5)), f64::INFINITY);
    }
}
