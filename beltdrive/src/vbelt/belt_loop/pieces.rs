//! A curve of states over the last parameter of a problem, in pieces on which the zones of friction stay the same.
//!
//! Where a zone vanishes or another one shows, the state is cut anew and the next piece begins. The states are only good
//! enough on the way.

use super::super::BeltProblem;
use super::super::groove::Law;
use super::super::laws::{WRONG_WAY, power_gained};
use super::super::path::{Effort, Solved};
use super::super::piece::{ACCURACY, ACCURACY_OF_DIRECTION, LOCATION, MAX_REFINEMENTS, REFINEMENT};
use super::super::tracer::MAX_PIECES;
use super::super::zones::Refused;
use super::rising::Rising;
use super::solve::Search;
use crate::results::difficulty;
use bvp::{Control, Family, Options, Problem, Scheme, Solution};
use continuation::{Branch, Direction, Kind, Point};

/// Tolerance of the states on the way, which are only guesses of those to come, ...
pub(super) const ROUGH: f64 = 1e-4;
/// ... and where meshes are for their error, as with bristles: these are half as fine as for the defect and the rating of
/// `spb-fan` takes half the time. With 1e-4 two curves with stiff bristles in it were lost, and two of `kim2009`.
const ROUGH_ERROR: f64 = 3e-5;
/// The most mesh intervals: a point that needs more is approached by a shorter step. Four times as many found no more
/// limits on five loops, and took 31 s in place of 3 s to find none with elastic friction on four grooves.
const MAX_INTERVALS: usize = 1000;
/// The most steps of a piece.
const STEPS: usize = 300;
/// ℓ/R along a curve. With 1e-10, that of a state to 1e-8, zones of `v-power` with Coulomb friction that had to change were
/// kept, and a limit was seen at 1.54 in place of 2.03 of the load. Limits of five drives are off by 1.4e-7 with it.
const LAG: f64 = 1e-8;
/// The cause where the end of a curve is none: the belt locks on all pulleys, and the slip of a turn changes its sense. `v-power` at
/// 55 W with Coulomb friction was said to carry 2.13 times that, where it is 206 times.
pub(super) const LOCKS: &str = "the belt locks there";
const ABRUPT: &str = "the states change too abruptly there to be followed";

/// A problem with a number that may be its last parameter, without a condition for it.
pub(super) trait Curved: BeltProblem {
    /// The same problem with the number as its last parameter.
    fn freed(self) -> Self;

    /// The same problem with a value of the number.
    fn held(self, value: f64) -> Self;

    /// The number, from the parameters of a solution.
    fn number(&self, p: &[f64]) -> f64;
}

/// What a point of a curve is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// One on the way.
    Way,
    /// A limit point.
    LimitPoint,
    /// A zero of one of the watched parameters, by its number among them.
    Zero(usize),
    /// The last value that is asked for.
    End,
}

/// A curve was not followed farther than to a value, for this reason.
pub(super) struct Lost {
    pub(super) reached: f64,
    pub(super) cause: &'static str,
}

/// How a piece ends.
enum Piece<P, T> {
    /// With what was sought.
    Ends(T),
    /// At a state whose zones are others.
    Changes(Box<Solved<P>>),
    /// Behind a state from which it is to be followed in shorter steps.
    Shorter(Box<Solved<P>>),
}

/// A curve while it is followed.
struct Curve<'c> {
    /// The values to which it leads.
    range: [f64; 2],
    /// The parameters whose zeros are sought.
    watched: &'c [usize],
    /// Zones that the first state of a piece shows and Newton's method refused.
    refused: Refused,
}

impl Curve<'_> {
    /// Whether the zones of a state are its segments, if they have to be.
    fn is_kept<P: BeltProblem>(&self, here: &Solved<P>) -> bool {
        !here.problem.has_junctions() || self.refused.are_all(here)
    }
}

impl Search<'_> {
    /// Follows a curve from a state towards larger values within a range, until `take` has what is sought at one of its
    /// points.
    pub(super) fn along<P: Curved, T>(
        &mut self,
        from: &Solved<P>,
        range: [f64; 2],
        watched: &[usize],
        mut take: impl FnMut(&mut Self, Place, &Point, Solved<P>) -> Option<T>,
    ) -> Result<T, Lost> {
        let mut curve = Curve {
            range,
            watched,
            refused: Refused::default(),
        };
        let begin = match from.problem.has_direction() {
            true => self.smooth_less(from.clone(), LAG, Effort::Close).ok(),
            false => None,
        };
        let (mut here, mut refinements) = (begin.unwrap_or_else(|| from.clone()), 0);
        for _ in 0..MAX_PIECES {
            let reached = here.problem.number(here.solution.parameters());
            let lost = |cause| Lost { reached, cause };
            match self.piece(&here, &curve, refinements, &mut take)? {
                Piece::Ends(found) => return Ok(found),
                Piece::Shorter(last) if refinements < MAX_REFINEMENTS => {
                    (here, refinements) = (*last, refinements + 1);
                }
                Piece::Shorter(_) => return Err(lost(ABRUPT)),
                Piece::Changes(state) => {
                    let next = self.keep_zones(*state, Effort::Full);
                    here = next.map_err(|stuck| lost(difficulty::of_solver(&stuck.cause)))?;
                    curve.refused = Refused::by(&here);
                    refinements = 0;
                }
            }
        }
        Err(Lost {
            reached: here.problem.number(here.solution.parameters()),
            cause: ABRUPT,
        })
    }

    /// A piece of a curve.
    fn piece<P: Curved, T>(
        &mut self,
        from: &Solved<P>,
        curve: &Curve<'_>,
        refinements: i32,
        take: &mut impl FnMut(&mut Self, Place, &Point, Solved<P>) -> Option<T>,
    ) -> Result<Piece<P, T>, Lost> {
        let begin = from.problem.number(from.solution.parameters());
        let lost = |cause| Lost {
            reached: begin,
            cause,
        };
        let free = from.problem.clone().freed();
        let unknown = Problem::parameters(&free) - 1;
        let options = on_the_way(self.tolerance, free.law());
        let guess = WithNumber {
            solution: &from.solution,
            number: begin,
        };
        let family = Family::new(&free, unknown, &[], &guess, &options);
        let (family, z) = family.map_err(|error| lost(difficulty::of_solver(&error)))?;
        let mut family = Rising(family);
        let [low, to] = curve.range;
        let steps = followed([low.min(begin), to], &options, free.law(), refinements);
        let branch = Branch::new(&mut family, &z, Direction::Increasing, &steps);
        let mut branch = branch.map_err(|error| lost(difficulty::of_branch(&error)))?;
        let lengths = match free.has_junctions() {
            true => free.first_length()..free.first_length() + free.zoning().count(),
            false => 0..0,
        };
        for index in curve.watched.iter().copied().chain(lengths) {
            branch = branch.event(move |_, point| point.z[point.z.len() - 1 - unknown + index]);
        }
        let mut reached = begin;
        let mut before: Option<Solved<P>> = None;
        while let Some(point) = branch.next() {
            let here = Solved {
                problem: free.clone().held(point.lambda()),
                solution: branch.system().solution(&point.z),
            };
            let place = match point.kind {
                Kind::LimitPoint => Place::LimitPoint,
                Kind::Event(index) if index < curve.watched.len() => Place::Zero(index),
                Kind::Event(_) => return Ok(Piece::Changes(Box::new(here))),
                Kind::Bound if point.lambda() == to => Place::End,
                _ => Place::Way,
            };
            if place != Place::End && !curve.is_kept(&here) {
                return Ok(match (place, before) {
                    // A zone has changed on the way there.
                    (Place::LimitPoint | Place::Zero(_), Some(last)) => {
                        Piece::Shorter(Box::new(last))
                    }
                    _ => Piece::Changes(Box::new(here)),
                });
            }
            if matches!(place, Place::LimitPoint | Place::Zero(_)) && here.problem.has_direction() {
                if power_gained(&here) > WRONG_WAY {
                    break;
                }
                if here.locks() {
                    let cause = LOCKS;
                    return Err(Lost { reached, cause });
                }
            }
            reached = point.lambda();
            before = Some(here.clone());
            if let Some(found) = take(self, place, &point, here) {
                return Ok(Piece::Ends(found));
            }
        }
        Err(Lost {
            reached,
            cause: ABRUPT,
        })
    }

    /// The state at a point of a curve, solved for itself.
    pub(super) fn at_point<P: Curved>(
        &mut self,
        point: Solved<P>,
    ) -> Result<Solved<P>, bvp::Error> {
        let Solved { problem, solution } = point;
        self.stats.newton_steps += solution.stats().newton_steps;
        let guess = WithNumber {
            number: problem.number(solution.parameters()),
            solution: &solution,
        };
        // Near a limit Newton's method does not come from a rough state to one to the tolerance.
        let effort = match problem.has_direction() {
            true => Effort::Close,
            false => Effort::Rough,
        };
        self.attempt(problem, &guess, effort)
    }
}

/// How states on the way are solved with a law, if the final tolerance is this. Beside a kink of elastic friction the
/// defect shows what an error does not: twice as many curves with it are lost on meshes for the error.
fn on_the_way(tolerance: f64, law: Law) -> Options {
    let (control, rough) = match law {
        Law::Bristle { elastic: None, .. } | Law::Sliding { elastic: None, .. } => {
            (Control::Error, ROUGH_ERROR)
        }
        _ => (Control::Defect, ROUGH),
    };
    Options {
        tolerance: tolerance.max(rough),
        scheme: Some(Scheme::Gauss { stages: 5 }),
        control,
        max_intervals: MAX_INTERVALS,
        ..Options::default()
    }
}

/// How a curve of states that are solved with these options is followed within bounds, its steps shortened so often.
fn followed(
    [low, high]: [f64; 2],
    options: &Options,
    law: Law,
    refinements: i32,
) -> continuation::Options {
    let usual = continuation::Options::within(low, high);
    let shorter = REFINEMENT.powi(refinements);
    let accuracy = match law {
        Law::Sliding { .. } => ACCURACY_OF_DIRECTION,
        _ => ACCURACY,
    };
    continuation::Options {
        steps: STEPS,
        first_step: usual.first_step / shorter,
        largest_step: usual.largest_step / shorter,
        accuracy: accuracy * options.tolerance,
        location: LOCATION,
        ..usual
    }
}

/// A solution as the guess of a problem with or without the number as its last parameter.
struct WithNumber<'a> {
    solution: &'a Solution,
    number: f64,
}

impl bvp::Guess for WithNumber<'_> {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        self.solution.state(segment, s, y);
    }

    fn parameters(&self, p: &mut [f64]) {
        let known = self.solution.parameters();
        let common = known.len().min(p.len());
        p[..common].copy_from_slice(&known[..common]);
        p[common..].fill(self.number);
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        bvp::Guess::mesh(self.solution)
    }
}
