//! Both ends of the range of a number over which a loop has steady states.

use super::members::{Member, Members, Refusal, Varied};
use super::trace::LoopPoint;
use crate::input::DriveFile;
use crate::model::model;
use crate::{SolveError, SolveOptions};
use std::iter;

/// Factor between the values, or the distances from the first one, at which an end is looked for.
const STEP: f64 = 1.1;

/// Most of these steps: up to 1e6 times the first value or distance, and down to a millionth.
const STEPS: i32 = 145;

/// The first distance of a number that may be 0 or negative, relative to its value or to 1 in its SI unit.
const FIRST: f64 = 1e-2;

/// The share of the largest load of a loop that carries less than its own from which the load is raised.
const BELOW: f64 = 0.5;

/// Shares of a load from which it is raised in place of that load, in turn: from half of the largest load of `v-power` with EPP
/// friction of 8e6 N/m² its direction is not found, and bisection takes 44 s.
const LOWER: [f64; 2] = [0.7, 0.4];

/// Factor between loads from which that of a hardly loaded drive is raised, in turn. A hundredth of the load of `spb-fan` is on no
/// curve that is followed, and states at a hundred loads from there to the largest take 40 s.
const RAISED: f64 = 4.0;

/// The smallest and the largest value with which a loop has a steady state.
#[derive(Clone, Debug)]
pub struct LoopLimits {
    /// What varies.
    pub varied: Varied,
    /// The lower end.
    pub smallest: LoopLimit,
    /// The upper end.
    pub largest: LoopLimit,
}

/// One end of the range.
#[derive(Clone, Debug)]
pub struct LoopLimit {
    /// The last value with a state, its error, and the state.
    pub point: LoopPoint,
    /// Why the range ends there.
    pub end: LoopEnd,
}

/// Why a range ends.
#[derive(Clone, Debug)]
pub enum LoopEnd {
    /// No steady state lies beyond.
    Limit(Refusal),
    /// No torque: the loop runs idle.
    NoLoad,
    /// The search ended at a value with a state.
    NotFound,
}

impl LoopEnd {
    /// One word for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Limit(refusal) => refusal.kind(),
            Self::NoLoad => "no load",
            Self::NotFound => "none found",
        }
    }
}

/// In words, on one line.
impl std::fmt::Display for LoopEnd {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Limit(Refusal::Loop(error)) => match &**error {
                // At the limit there is nothing to say of a load beyond.
                SolveError::Overloaded {
                    pulley,
                    overhangs: true,
                    ..
                } => write!(f, "the belt overhangs itself on pulley `{pulley}`"),
                SolveError::GrossSlip { pulley, .. } | SolveError::Overloaded { pulley, .. } => {
                    write!(f, "pulley `{pulley}` slips grossly")
                }
                SolveError::TensionerBeyondTravel { pulley, .. } => {
                    write!(f, "the tensioner `{pulley}` reaches the end of its travel")
                }
                SolveError::Overstretched { .. } => {
                    f.write_str("the belt is stretched to twice its length")
                }
                error => error.fmt(f),
            },
            Self::Limit(refusal) => refusal.fmt(f),
            Self::NoLoad => f.write_str("no torque: the loop runs idle"),
            Self::NotFound => f.write_str("no limit was found up to here"),
        }
    }
}

/// The smallest and the largest value of a number with which the loop that a drive file states has a steady
/// state. The search goes from the value of the file by growing steps, so that a gap between two values that
/// both have a state is only seen where it is wider than a tenth of the value, or of the way to it.
///
/// # Errors
/// There is no state with the value of the file; of the load factor, without load.
pub fn limits(
    file: &DriveFile,
    varied: &Varied,
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<LoopLimits, Refusal> {
    let members = Members::new(file, varied, options);
    let start = start(&members, varied)?;
    let smallest = end(&members, varied, start, -1.0)?;
    progress(0.5, "smallest");
    let largest = end(&members, varied, start, 1.0)?;
    Ok(LoopLimits {
        varied: varied.clone(),
        smallest,
        largest,
    })
}

/// As [`limits`], the upper end alone.
pub(super) fn largest(
    file: &DriveFile,
    varied: &Varied,
    options: &SolveOptions,
) -> Result<LoopLimit, Refusal> {
    let members = Members::new(file, varied, options);
    let start = start(&members, varied)?;
    end(&members, varied, start, 1.0)
}

/// A value that has a state: that of the file, or near it.
fn start(members: &Members<'_>, varied: &Varied) -> Result<f64, Refusal> {
    let given = members.given();
    match (members.at(given), varied) {
        (Ok(_), _) => Ok(given),
        (Err(refusal), Varied::LoadFactor) => {
            let below = refusal
                .largest_load()
                .map(|largest| BELOW * largest * given);
            Ok(below
                .filter(|&below| members.at(below).is_ok())
                .unwrap_or(0.0))
        }
        (Err(refusal), Varied::Key(_)) => easier(members, given).ok_or(refusal),
    }
}

/// The value nearest to one without a state that has one: of those that are smaller or larger by the factor
/// between two steps of the search.
fn easier(members: &Members<'_>, given: f64) -> Option<f64> {
    let steps = (1..=STEPS).map(|step| STEP.powi(step));
    let mut near = steps.flat_map(|factor| [given / factor, given * factor]);
    near.find(|&value| members.at(value).is_ok())
}

impl Members<'_> {
    /// The largest load factor, along the curve of states above one of them: of that at `start`, of larger ones, or of smaller ones.
    fn last(&self, start: f64) -> Option<LoopLimit> {
        let raised = iter::successors(Some(RAISED * start), |factor| Some(RAISED * factor));
        let mut carried = raised.take_while(|&factor| factor > start && self.at(factor).is_ok());
        let mut lower = LOWER.into_iter();
        self.last_above(start)
            .or_else(|| carried.find_map(|factor| self.last_above(factor)))
            .or_else(|| lower.find_map(|share| self.last_above(share * start)))
    }

    /// The largest load factor, along the curve of states above one of them; `None` where that is not followed.
    fn last_above(&self, start: f64) -> Option<LoopLimit> {
        let stated = self.drive(start).ok()?;
        let last = model(stated.belt.kind).last_state(&stated, self.options)?;
        let value = start * last.factor;
        let drive = self.drive(value).ok()?;
        let state = last.state;
        Some(LoopLimit {
            point: LoopPoint::new(value, last.error * value, Member { drive, state }),
            end: LoopEnd::Limit(last.reason.into()),
        })
    }
}

/// The end of the range from a value that has a state, upwards or downwards.
pub(super) fn end(
    members: &Members<'_>,
    varied: &Varied,
    start: f64,
    direction: f64,
) -> Result<LoopLimit, Refusal> {
    let found = |value: f64, error: f64, end: LoopEnd| {
        Ok(LoopLimit {
            point: LoopPoint::new(value, error, members.at(value)?),
            end,
        })
    };
    if direction < 0.0
        && varied.ends_at_zero()
        && let Ok(idle) = members.at(0.0)
    {
        return Ok(LoopLimit {
            point: LoopPoint::new(0.0, 0.0, idle),
            end: LoopEnd::NoLoad,
        });
    }
    if direction > 0.0
        && *varied == Varied::LoadFactor
        && let Some(last) = members.last(start)
    {
        return Ok(last);
    }
    let first = FIRST * start.abs().max(if start == 0.0 { 1.0 } else { 0.0 });
    let mut inside = start;
    let mut distance = first;
    for _ in 0..STEPS {
        let next = match varied.is_positive() {
            true if direction > 0.0 => inside * STEP,
            true => inside / STEP,
            false => start + direction * distance,
        };
        match members.at(next) {
            Ok(_) => inside = next,
            Err(refusal) => {
                let (value, error, refusal) = members.end_between(inside, next, refusal);
                return found(value, error, LoopEnd::Limit(refusal));
            }
        }
        distance *= STEP;
    }
    found(inside, 0.0, LoopEnd::NotFound)
}
