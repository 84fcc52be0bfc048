//! Following the steady states of a drive over one entry of the drive file.
//!
//! A branch is followed in pieces on which the friction zones of every pulley, and with them the
//! segments of the boundary value problem, stay the same. Where a zone vanishes or appears, the
//! states are cut anew into zones and the next piece begins.
//!
//! Along the branch the direction of Coulomb and EPP friction is a state that follows the slip over a fixed length ℓ,
//! and contacts are cut where the belt breaks away and where it turns to be lifted: fronts that move with the load,
//! and that Newton's method follows only as ends of segments. A cut that is seen no longer, or elsewhere, is one more
//! change of zones. Every labelled point is located once more with ℓ/4 on the halved mesh: its error follows from the
//! difference. A branch from a state whose direction is normalised is followed in the same way with a fixed ε.

use super::found::is_crossed;
use super::path::Solved;
use super::piece::{PieceEnd, WHOLE};
use super::zones::Refused;
use crate::input::Key;
use crate::results::difficulty;
use crate::results::limits::STANDS;
use crate::{
    BranchEnd, BranchEvent, Drive, EventKind, Role, StateErrors, StateSummary, SteadyState,
    TraceConvergence, TracePoint,
};
use continuation::{Direction, Kind, Point, Stop};
use web_time::Instant;

/// The most pieces of a branch.
pub(super) const MAX_PIECES: usize = 40;
/// Behind a limit point a branch is followed until the entry has come back by this share of its way.
const WAY_BACK: f64 = 0.25;

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
    pub(super) drive: &'d Drive,
    pub(super) key: Key,
    /// Smallest and largest value of the entry, SI.
    pub(super) range: [f64; 2],
    pub(super) tolerance: f64,
    pub(super) until: Until,
    pub(super) points: Vec<TracePoint>,
    pub(super) events: Vec<BranchEvent>,
    pub(super) convergence: TraceConvergence,
    /// Arclength of the pieces before.
    pub(super) before: f64,
    /// The value at which the last piece began.
    pub(super) begun: f64,
    /// How often the steps were shortened since the zones have changed.
    pub(super) refinements: i32,
    /// Zones that the last state shows and Newton's method refused.
    pub(super) refused: Refused,
    /// The last state that is no limit point, and the value of the entry there.
    pub(super) near: Option<(f64, Solved)>,
    /// The constants of all states that are no limit points, with the values of the entry.
    pub(super) passed: Vec<(f64, Vec<f64>)>,
    /// The value at which both spans have the same tension, where it is known.
    pub(super) no_load: Option<f64>,
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
            begun: 0.0,
            refinements: 0,
            refused: Refused::default(),
            near: None,
            passed: Vec::new(),
            no_load: match key {
                _ if is_crossed(drive) => None,
                key if key == Key::load(drive) => Some(drive.pair().load.slack.value()),
                key if key.path().starts_with("load.slack") => {
                    Some(drive.pair().load.tight.value())
                }
                _ => None,
            },
        }
    }

    /// The value of the entry (SI) that counts as one.
    pub(super) fn unit(&self) -> f64 {
        self.range[0].abs().max(self.range[1].abs())
    }

    /// The value of the entry, exact at the ends of the range.
    pub(super) fn value(&self, scaled: f64) -> f64 {
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
            let mut next = self.piece(&solved, value, direction, progress);
            if let PieceEnd::Branch(BranchEnd::NotConverged { .. }) = next {
                next = self.beyond(direction).unwrap_or(next);
            }
            if let PieceEnd::Branch(BranchEnd::NotConverged { .. }) = next
                && let Some(event) = self.stand()
            {
                self.events.push(event);
                next = PieceEnd::Branch(BranchEnd::GrossSlip(Role::Driven));
            }
            match next {
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

    /// Gross slip of a driven pulley that all but stands at the last point, if it does, with the value at which it would, to first
    /// order, as its error.
    fn stand(&self) -> Option<BranchEvent> {
        let (_, solved) = self.near.as_ref()?;
        let [before, last] = self.points.last_chunk()?;
        let [fast, slow] = [before, last].map(|point| point.state.driven.angular_speed);
        let stands = solved.driven_speed() < STANDS && slow < fast;
        stands.then(|| BranchEvent {
            kind: EventKind::GrossSlip(Role::Driven),
            point: last.clone(),
            value_error: Some((last.value - before.value).abs() * slow / (fast - slow)),
            errors: None,
        })
    }

    /// The state at the upper end of the range and the value there, if the branch has ended there, from which it goes on
    /// to a larger upper end.
    pub(super) fn with_upper_end(&mut self, end: f64) -> Option<(f64, Solved)> {
        let (value, solved) = self.near.clone()?;
        let last = self.points.last()?;
        let has_ended_there = last.value == self.range[1] && value == last.value && value < end;
        if !has_ended_there {
            return None;
        }
        self.range[1] = end;
        self.before = last.arclength;
        self.refinements = 0;
        self.events.pop_if(|event| event.kind == EventKind::End);
        Some((value, solved))
    }

    /// Records a point and what happens there, with the relative effect of ℓ or ε on it; returns its
    /// value. Labelled points know their error better.
    pub(super) fn record(
        &mut self,
        point: &Point,
        kind: Option<EventKind>,
        state: &SteadyState,
        effect: Option<f64>,
        has_direction: bool,
    ) -> f64 {
        let value = self.value(point.lambda());
        // Where the comparison did not converge, nothing is known.
        let error = point.error.filter(|error| error.states.is_finite());
        let value_error = error.map(|error| WHOLE * error.lambda);
        let located = error.zip(value_error).map(|(error, own)| {
            let own = if value == 0.0 {
                0.0
            } else {
                own / point.lambda().abs()
            };
            let states = match effect {
                // The direction changes by more where the belt hardly slips, and is not printed.
                Some(effect) if has_direction => effect,
                _ => WHOLE * error.states,
            };
            states.max(own)
        });
        let relative = located.or(effect);
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
                value_error: value_error.map(|error| error * self.unit()),
                errors: relative
                    .map(|relative| StateErrors::relative(&traced.state, self.drive, relative)),
            });
        }
        let first_of_next_piece = point.kind == Kind::Start && !self.points.is_empty();
        if !first_of_next_piece {
            self.points.push(traced);
        }
        value
    }

    /// Whether the entry has come back far enough behind the last limit point.
    pub(super) fn came_back(&self, value: f64) -> bool {
        let is_turn = |event: &&BranchEvent| event.kind == EventKind::LimitPoint;
        let Some(turn) = self.events.iter().rfind(is_turn) else {
            return false;
        };
        let (first, turn) = (self.points[0].value, turn.point.value);
        (value - turn).abs() >= WAY_BACK * (turn - first).abs()
    }

    /// How much of the range lies behind.
    pub(super) fn share(&self, value: f64) -> f64 {
        let from = self.points.first().map_or(value, |point| point.value);
        let [low, high] = self.range;
        let whole = (high - from).max(from - low);
        ((value - from).abs() / whole).min(1.0)
    }

    /// Why the branch ends, from the reason of the tracer.
    pub(super) fn end(&self, stop: Option<Stop>) -> BranchEnd {
        let value = self.points.last().map(|point| point.value);
        let first = self.points.first().map(|point| point.value);
        match stop {
            Some(Stop::Bound { .. }) => {
                let no_load = value.is_some() && value == self.no_load;
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
                cause: difficulty::of_stop(&stop),
            },
            None => BranchEnd::Target,
        }
    }
}
