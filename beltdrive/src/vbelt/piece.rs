//! One piece of a branch: as long as the friction zones stay the same.

use super::carried::{Carried, Member};
use super::cubic::lowest_between;
use super::curve::Curve;
use super::family::{DriveFamily, Entry};
use super::laws::obeys_friction;
use super::path::{Effort, Path, Solved};
use super::state::describe;
use super::tracer::{Tracer, Until};
use super::watched::FIRST_ZONE;
use super::zones::Refused;
use super::{BeltProblem, DriveProblem, Law};
use crate::input::Key;
use crate::results::difficulty;
use crate::{BranchEnd, Drive, EventKind, Role};
use bvp::{Control, Family, Scheme};
use continuation::{Branch, Direction, Kind, Options, Point, Stop};

/// ℓ/R where the belt hardly slips somewhere, and where it slips everywhere. With 1e-10 in the first case rounding
/// errors of the slip asked for up to 3000 mesh intervals; with 1e-8 in the second limits were off by up to 3e-7.
const LAGS: [f64; 2] = [1e-8, 1e-10];
/// ε where the direction is normalised. Places at which the belt breaks loose move with the load the more abruptly
/// the smaller it is.
const EPSILON: f64 = 1e-6;
/// δ of vector EPP friction without zones over p/`k_f`: with a tenth of it `limits` of a random drive with stiff friction,
/// 5.6e8 N/m², takes minutes in place of seconds.
pub(super) const ROUNDING: f64 = 0.01;
/// Length τ/R over which the traction of vector EPP friction is led.
const BRANCH_LEAD: f64 = 1e-4;
/// Labelled points are located once more with ℓ, ε or τ divided by this.
pub(super) const FINER: i32 = 4;
/// The effect of ℓ, ε or τ from its change when that is divided by [`FINER`]: it vanishes at least as fast.
pub(super) const WHOLE: f64 = 1.0 / (1.0 - 1.0 / FINER as f64);
/// The most steps of a piece, and of one in shorter steps. Bristles take those: where a belt hardly slips the prediction must be
/// better than that slip, and one of 60 random drives is at a twelfth of its range after the usual ones.
const MAX_STEPS: usize = 600;
const MAX_SHORT_STEPS: usize = 2000;
/// The same of vector EPP friction without zones, after which they are sought: with them steps are longer. The limits of a drive
/// whose zones are found from 1.5 times the slack tension on take 5 s with this, 10 s with 60, and are not found in the usual
/// 600 steps, which take 20 s.
const GRADUAL_STEPS: usize = 30;
/// The most mesh intervals: a point that needs more is approached by a shorter step.
const MAX_INTERVALS: usize = 4000;
/// The longest step, where the range of the entry counts as one.
const LARGEST_STEP: f64 = 0.15;

/// A branch whose steps become shorter than this leads to a place that it does not pass. Down to 1e-8 one of 60 branches from
/// light loads takes 14 s in place of 3 s, and the limit of one of 60 drives with vector EPP friction is not found. Bristles take
/// steps as short as that at light loads: with 1e-6 three of 60 of their branches end.
const SMALLEST_STEP: f64 = 1e-6;
/// The first step of a piece.
const FIRST_STEP: f64 = 0.05;
/// Where the driven speed may have fallen below this share of that of the driver within a step, or zones have changed
/// on the way to a labelled point, ...
const MARGIN: f64 = 0.05;
/// ... the step is taken again with steps and margin divided by this, ...
pub(super) const REFINEMENT: f64 = 4.0;
/// ... at most so often.
pub(super) const MAX_REFINEMENTS: i32 = 4;
/// Accuracy of the points of a branch, as a share of the tolerance; ...
pub(super) const ACCURACY: f64 = 1e-3;
/// ... and where the direction is a state. Its rate of change is that of the slip over ℓ, and with 1e-3 the mesh was
/// refined up to 3600 intervals after errors of Newton's method, with this to 80.
pub(super) const ACCURACY_OF_DIRECTION: f64 = 1e-6;
/// Limit points, gross slip and changes of zones are located to this, where the range of the entry counts as one. Down to
/// rounding, `rating` of `kim2009-epp` takes a fifth more time.
pub(super) const LOCATION: f64 = 1e-10;

/// Values of the entry that differ by less than this share are the same: that of a state held by another quantity is known to the
/// tolerance.
const SAME_VALUE: f64 = 1e-6;

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

/// ℓ/R or ε along a piece with the zones of a problem.
fn smoothing(problem: &DriveProblem) -> f64 {
    match problem.law() {
        Law::Sliding { .. } => LAGS[usize::from(!problem.is_locked())],
        Law::Normalised { .. } => EPSILON,
        Law::Vector { .. } => BRANCH_LEAD,
        Law::Bristle { .. } => 0.0,
    }
}

/// How the members of the family of a problem are discretised.
pub(super) fn discretisation(tolerance: f64, problem: &DriveProblem) -> bvp::Options {
    // Bristles make smooth profiles; the turn of sliding friction asks for a higher order. On meshes for the defect rounding of a
    // slip that is hardly there asks for up to 3800 intervals. On those for the error speeds along the limits of eight random
    // drives with EPP friction differ from those of single states by 2e-7 at most at a tolerance of 1e-6, wraps by 4e-7 but on one
    // drive, by 3e-6.
    let (stages, control) = match problem.law() {
        Law::Bristle { .. } => (5, Control::Error),
        Law::Sliding { .. } => (6, Control::Error),
        _ => (6, Control::Defect),
    };
    bvp::Options {
        tolerance,
        scheme: Some(Scheme::Gauss { stages }),
        control,
        max_intervals: MAX_INTERVALS,
        // Every piece begins with a state that is solved.
        from_neighbour: true,
        ..bvp::Options::default()
    }
}

/// How a branch is followed between scaled values of its entry.
pub(super) fn steps(tolerance: f64, problem: &DriveProblem, [low, high]: [f64; 2]) -> Options {
    let accuracy = match problem.has_direction() {
        true => ACCURACY_OF_DIRECTION,
        false => ACCURACY,
    };
    let usual = Options::within(low, high);
    Options {
        largest_step: LARGEST_STEP,
        first_step: FIRST_STEP,
        smallest_step: match problem.law() {
            Law::Bristle { .. } => usual.smallest_step,
            _ => SMALLEST_STEP,
        },
        steps: MAX_STEPS,
        accuracy: accuracy * tolerance,
        location: LOCATION,
        // Of 300 random drives with bristles that lock the limits of six were not found with them, in 600 steps.
        branch_points: false,
        ..usual
    }
}

impl Tracer<'_> {
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
        self.begun = value;
        let unit = self.unit();
        let drive = self.drive_at(value);
        let smoothing = smoothing(&solved.problem);
        let mut path = Path::of_branch(&drive, self.tolerance);
        let is_longer = smoothing > solved.problem.smoothing();
        // With another ℓ, ε or τ the zones may not be those of the state, and with a longer one traction may lag too far
        // behind a slip that turns.
        let solved = path
            .smooth_less(solved.clone(), smoothing, Effort::Full)
            .ok()
            .filter(|found| !is_longer || obeys_friction(found, self.tolerance))
            .unwrap_or_else(|| solved.clone());
        let smoothing = solved.problem.smoothing();
        self.convergence.slip_normalisation = self.convergence.slip_normalisation.max(smoothing);
        let entry = Entry {
            key: self.key,
            unit,
        };
        let rounded = solved.problem.clone();
        let rounded = rounded.with_laws(|law, _| law.with_rounding(ROUNDING));
        let family = DriveFamily::new(self.drive, &rounded, vec![entry]);
        let finer = DriveFamily::new(self.drive, &rounded, vec![entry]).finer(FINER);
        let mut options = discretisation(self.tolerance, &solved.problem);
        // On the way to a limit meshes are for the error with every law. The limits of 77 random drives with vector EPP friction are the
        // same to 3e-6 on either, and take 227 s with these in place of 274 s, one of them 17 s in place of 33 s. Along their whole
        // range one of 40 branches is lost with these.
        if self.until == Until::LimitPoint {
            options.control = Control::Error;
        }
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
        let is_gradual =
            matches!(solved.problem.law(), Law::Vector { .. }) && !solved.problem.has_junctions();
        let is_bristle = matches!(solved.problem.law(), Law::Bristle { .. });
        let steps = Options {
            branch_points: self.until == Until::RangeEnds,
            largest_step: LARGEST_STEP / REFINEMENT.powi(self.refinements),
            first_step: FIRST_STEP / REFINEMENT.powi(self.refinements),
            steps: if is_gradual {
                GRADUAL_STEPS
            } else if self.refinements > 0 || is_bristle {
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
        let branch = match Branch::new(&mut curve, &z, direction, &steps) {
            Ok(branch) => branch,
            Err(error) => return not_converged(difficulty::of_branch(&error)),
        };
        let mut branch = self
            .with_events(branch, &solved, first)
            .unassessed(self.untold());
        let mut last = bvp::Stats::default();
        let mut before: Option<(Point, Solved, Direction)> = None;
        // The ends of a zone may move at a load that does not change.
        let mut ahead = direction;
        // Behind the limit point of a cut the states are those in front of it, up to where the cut is seen no longer, if it
        // is before the branch has come back to its start.
        let mut has_cut_turned = false;
        let driven_speed = |point: &Point| {
            let of = |vector| family.own(vector)[DriveProblem::DRIVEN_RIM_SPEED];
            [of(&point.z), of(&point.tangent), point.arclength]
        };
        while let Some(mut point) = branch.next() {
            if family.moves_cuts_only(&point.tangent) {
                if point.kind == Kind::LimitPoint {
                    // Not of the load, but of the way of a cut.
                    point.kind = Kind::Regular;
                    has_cut_turned = true;
                }
            } else if !has_cut_turned {
                ahead = match point.kind {
                    // Where a zone vanishes its end may be a double root, and the branch with it a limit point.
                    Kind::Event(_) => ahead,
                    Kind::LimitPoint => reversed(ahead),
                    _ => onward(&point),
                };
            }
            let solution = branch.system().family.solution(&point.z);
            last = *solution.stats();
            let here = Solved {
                problem: family.member(&[point.lambda()]),
                solution,
            };
            if let Some((passed, solved, towards)) = &before
                && self.refinements < MAX_REFINEMENTS
                && (self.has_other_zones(&point, &here)
                    || lowest_between(driven_speed(passed), driven_speed(&point))
                        < MARGIN / REFINEMENT.powi(self.refinements))
            {
                // What happens in between is not what is seen: once more, in shorter steps.
                self.convergence.count(&last);
                self.refinements += 1;
                return self.goes_on(passed, solved.clone(), *towards);
            }
            // Behind the lowest speed steps are as long as ever again: a branch with bristles, whose zones never change,
            // would end after so many short ones.
            let rises = |point: &Point| driven_speed(point)[1] > 0.0;
            let is_past = self.refinements > 0
                && !here.problem.has_junctions()
                && point.kind == Kind::Regular
                && rises(&point)
                && before.as_ref().is_some_and(|(passed, ..)| rises(passed));
            let is_back = has_cut_turned && self.is_back(&point, value, ahead);
            let is_none = point.kind == Kind::LimitPoint
                && (here.locks()
                    || !is_confirmed(&point) && self.goes_on_beyond(&point, direction));
            if is_back || is_none {
                self.convergence.count(&last);
                return not_converged(difficulty::TOO_ABRUPT);
            }
            let is_told = !self.untold().contains(&point.kind);
            let effect = is_told.then(|| branch.system().smoothing_effect(&point.z));
            let effect = effect.flatten();
            let precise = || precise(&family, branch.system(), &point, (&options, &steps));
            let outcome = self.take(&point, &here, &precise, effect, ahead, has_cut_turned);
            progress(self.share(self.value(point.lambda())), "tracing");
            if let Some(PieceEnd::Branch(BranchEnd::NotConverged { .. })) = &outcome
                && let Some(resting) = self.at_rest(&point, &here)
            {
                self.convergence.count(&last);
                return self.goes_on(&point, resting, ahead);
            }
            if let (
                Some((passed, solved, towards)),
                Some(PieceEnd::Branch(BranchEnd::NotConverged { .. })),
            ) = (&before, &outcome)
                && matches!(point.kind, Kind::Regular | Kind::Bound)
                && self.refinements < MAX_REFINEMENTS
            {
                self.convergence.count(&last);
                // Where the belt locks the slip of a turn may have changed its sense, and shorter steps do not pass that place.
                let locks = self.refinements == 0 && solved.locks();
                if locks && let Some(next) = self.beyond_locked(*towards) {
                    return next;
                }
                // A zone that has just appeared is found more easily, and a limit point between here and the end of the range,
                // beyond which there are no states with that zone.
                self.refinements += 1;
                return self.goes_on(passed, solved.clone(), *towards);
            }
            if let Some(end) = outcome {
                self.convergence.count(&last);
                return end;
            }
            if is_past {
                self.convergence.count(&last);
                self.refinements = 0;
                return self.goes_on(&point, here, ahead);
            }
            before = Some((point, here, ahead));
        }
        self.convergence.count(&last);
        let stop = branch.into_stop();
        match (before, &stop) {
            (Some((point, here, ahead)), Some(Stop::Steps { .. })) if is_gradual => {
                let next = self.with_zones_shown(&point, here);
                self.goes_on(&point, next, ahead)
            }
            _ => PieceEnd::Branch(self.end(stop)),
        }
    }

    /// The kinds of points whose errors are not told: of a branch up to a limit point those of its ends and of what happens on the
    /// way are, and the first point of a later piece is the last one of the piece before. Each takes one linearisation or more: with
    /// all of them `limits` of the drive of Kim (2009) takes 257 ms in place of 230 ms.
    fn untold(&self) -> &'static [Kind] {
        match self.until {
            Until::LimitPoint => &[Kind::Start, Kind::Regular],
            Until::RangeEnds if self.points.is_empty() => &[],
            Until::RangeEnds => &[Kind::Start],
        }
    }

    /// Takes in a point of the branch with its solution, the relative effect of ℓ or ε on it, and the
    /// direction in which the branch goes on. Returns an end if the piece ends there. A point that repeats states is
    /// looked at and not recorded.
    fn take(
        &mut self,
        point: &Point,
        here: &Solved,
        precise: &dyn Fn() -> Option<Solved>,
        effect: Option<f64>,
        ahead: Direction,
        repeats: bool,
    ) -> Option<PieceEnd> {
        let drive = self.drive_at(self.value(point.lambda()));
        self.convergence.continuation_steps += 1;
        let mut path = Path::of_branch(&drive, self.tolerance);
        let at_end = self.at_bound(point, here, &mut path);
        let here = at_end.as_ref().unwrap_or(here);
        let mut state = describe(&path, here);
        let kind = self.kind(point, here);
        // Beyond a state at which the driven pulley stands there are no drive states.
        if here.driven_speed() < 0.0 && kind != Some(EventKind::GrossSlip(Role::Driven)) {
            return None;
        }
        // A step may have passed the place where a zone appears: its state is none, but a guess.
        let is_guess = point.kind == Kind::Regular;
        if is_guess && here.problem.has_junctions() && !self.refused.are_all(here) {
            return Some(self.next_piece(point, here, &drive, ahead));
        }
        let restart = matches!(point.kind, Kind::Event(index) if index >= FIRST_ZONE);
        // On a mesh for the error the pressure may be negative beside an end by more than the check allows.
        if state.verified().is_err()
            && let Some(precise) = precise()
        {
            state = describe(&path, &precise);
        }
        if let Err(error) = state.verified() {
            let cause = error.to_string();
            return Some(match restart {
                // The next piece begins with a state that is solved anew, and checked.
                true => self.next_piece(point, here, &drive, ahead),
                false => PieceEnd::Branch(BranchEnd::NotConverged { cause }),
            });
        }
        if repeats {
            return restart.then(|| self.next_piece(point, here, &drive, ahead));
        }
        let has_direction = here.problem.has_direction();
        let place = self.record(point, kind, &state, effect, has_direction);
        if kind != Some(EventKind::LimitPoint) {
            self.passed.push((place, here.constants()));
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
            None => restart.then(|| self.next_piece(point, here, &drive, ahead)),
        }
    }

    /// Whether a branch that shall go on in a direction is back at the value at which it began.
    fn is_back(&self, point: &Point, start: f64, ahead: Direction) -> bool {
        let value = self.value(point.lambda());
        match ahead {
            Direction::Increasing => value <= start,
            Direction::Decreasing => value >= start,
        }
    }

    /// The state at an end of the range with its zones found anew, if they have changed on the last step and are found.
    fn at_bound(&self, point: &Point, here: &Solved, path: &mut Path<'_>) -> Option<Solved> {
        let has_others = point.kind == Kind::Bound
            && here.problem.has_junctions()
            && !self.refused.are_all(here);
        has_others.then(|| path.with_other_zones(here).ok())?
    }

    /// The state at a point at which elastic friction pulls with the slip with a belt that sticks there, if it is found.
    fn at_rest(&mut self, point: &Point, pulled: &Solved) -> Option<Solved> {
        let drive = self.drive_at(self.value(point.lambda()));
        let mut path = Path::of_branch(&drive, self.tolerance);
        let resting = path.with_belt_at_rest(pulled);
        self.convergence.count(&path.stats);
        let resting = resting?;
        self.refused = Refused::by(&resting);
        self.refinements = 0;
        Some(resting)
    }

    /// The state at a point with the zones that it shows, if they are found.
    fn with_zones_shown(&mut self, point: &Point, gradual: Solved) -> Solved {
        let drive = self.drive_at(self.value(point.lambda()));
        let mut path = Path::of_branch(&drive, self.tolerance);
        let zones = path.with_zones_shown(&gradual);
        self.convergence.count(&path.stats);
        let Some(zones) = zones else {
            return gradual;
        };
        self.refused = Refused::by(&zones);
        self.refinements = 0;
        zones
    }

    /// The next piece, with other steps from a point as it is.
    fn goes_on(&mut self, point: &Point, solved: Solved, direction: Direction) -> PieceEnd {
        self.before += point.arclength;
        PieceEnd::Next {
            solved: Box::new(solved),
            value: self.value(point.lambda()),
            direction,
        }
    }

    /// Whether a point at which something happens that is no change of zones is found with zones that have changed
    /// on the way to it.
    fn has_other_zones(&self, point: &Point, here: &Solved) -> bool {
        let happens = match point.kind {
            Kind::LimitPoint => true,
            Kind::Event(index) => index < FIRST_ZONE,
            _ => false,
        };
        happens && here.problem.has_junctions() && !self.refused.are_all(here)
    }

    /// The next piece, from a point whose state is cut anew into zones.
    fn next_piece(
        &mut self,
        point: &Point,
        here: &Solved,
        drive: &Drive,
        direction: Direction,
    ) -> PieceEnd {
        let mut path = Path::of_branch(drive, self.tolerance);
        let value = self.value(point.lambda());
        let found = path.with_other_zones(here).map(|next| (value, next));
        let found = found.or_else(|stuck| {
            let force = here.problem.scales().units.force;
            let largest = self.range[1] / force;
            let beside = match self.key == Key::load(self.drive) {
                true => path.with_other_zones_beside_limit(here, largest),
                false => None,
            };
            let load = |next: &Solved| match next.tight_tension() {
                tension if tension == largest => self.range[1],
                tension => tension * force,
            };
            // Where this piece began, those with its zones are its states: one of 60 branches with scalar elastic friction went round
            // so until its last piece. In between they may lead on with other steps.
            let leads_on = |next: &Solved| {
                let way = match direction {
                    Direction::Increasing => load(next) - self.begun,
                    Direction::Decreasing => self.begun - load(next),
                };
                next.problem.regimes() != here.problem.regimes() || way > SAME_VALUE * value.abs()
            };
            let beside = beside.filter(leads_on);
            beside.map(|next| (load(&next), next)).ok_or(stuck)
        });
        match found {
            Ok((value, next)) => {
                self.refused = Refused::by(&next);
                self.refinements = 0;
                self.before += point.arclength;
                PieceEnd::Next {
                    solved: Box::new(next),
                    value,
                    direction,
                }
            }
            Err(stuck) => PieceEnd::Branch(BranchEnd::NotConverged {
                cause: difficulty::of_solver(&stuck.cause).to_owned(),
            }),
        }
    }
}

/// The state at a point of a branch on a mesh for the defect, unless it is on one.
fn precise(
    family: &DriveFamily,
    curve: &Curve<'_>,
    point: &Point,
    (options, steps): (&bvp::Options, &Options),
) -> Option<Solved> {
    if options.control == Control::Defect {
        return None;
    }
    let options = bvp::Options {
        control: Control::Defect,
        ..options.clone()
    };
    let (first, mesh) = (family.first_entry(), curve.family.mesh());
    let mut better = Family::on_mesh(family, first, &[], mesh, &options).ok()?;
    let mut vectors = [point.z.clone(), point.tangent.clone()];
    better = better.adapted(&mut vectors).ok()??;
    let [z, tangent] = vectors;
    let near = Point {
        z,
        tangent,
        ..point.clone()
    };
    // Across the branch, since its value does not determine a state beside a limit point; at the ends of the range at
    // their values.
    let found = match point.kind {
        Kind::Start | Kind::Bound => {
            Branch::new(&mut better, &near.z, Direction::Increasing, steps)
        }
        _ => Branch::resume(&mut better, &near, steps),
    };
    let mut found = found.ok()?;
    let point = found.next()?;
    Some(Solved {
        problem: family.member(&[point.lambda()]),
        solution: found.system().solution(&point.z),
    })
}

/// The other direction.
fn reversed(direction: Direction) -> Direction {
    match direction {
        Direction::Increasing => Direction::Decreasing,
        Direction::Decreasing => Direction::Increasing,
    }
}

/// Whether a limit point is near the same place with a shorter ℓ on a finer mesh, so that its error is known.
fn is_confirmed(point: &Point) -> bool {
    point.error.is_some_and(|error| error.states.is_finite())
}

/// The sense in which the entry changes at a point.
fn onward(point: &Point) -> Direction {
    if point.tangent[point.tangent.len() - 1] > 0.0 {
        Direction::Increasing
    } else {
        Direction::Decreasing
    }
}
