//! A branch of steady states over one entry of the drive file.

use crate::input::Key;
use crate::{Drive, LimitReason, Role, StateErrors, StateSummary, ZoneKind};
use std::fmt;

/// The steady states that belong together over one entry of the drive file, the parameter.
#[derive(Clone, Debug)]
pub struct Branch {
    /// The entry that varies along the branch.
    pub key: Key,
    /// The drive, of which this entry varies.
    pub drive: Drive,
    /// States along the branch, in order of their arclength.
    pub points: Vec<TracePoint>,
    /// What happens along the branch, in order of arclength.
    pub events: Vec<BranchEvent>,
    /// Why the branch ends.
    pub end: BranchEnd,
    /// How the branch was traced.
    pub convergence: TraceConvergence,
}

/// A state of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct TracePoint {
    /// The value of the parameter, SI.
    pub value: f64,
    /// Arclength along the branch in scaled variables; rises along the branch.
    pub arclength: f64,
    /// The steady state.
    pub state: StateSummary,
}

/// A state at which something happens, located to the tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchEvent {
    /// What happens.
    pub kind: EventKind,
    /// The state at which it happens.
    pub point: TracePoint,
    /// Estimated absolute error of the value of the parameter, SI.
    pub value_error: Option<f64>,
    /// Estimated absolute errors of the state.
    pub errors: Option<StateErrors>,
}

/// What happens at a state of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum EventKind {
    /// The branch starts.
    Start,
    /// A limit point, also called fold: the parameter turns back.
    LimitPoint,
    /// A branch point: another branch crosses this one.
    BranchPoint,
    /// The inclination reaches 90° on a pulley.
    Overhang(Role),
    /// The pulley slips grossly; the driven pulley then stands still.
    GrossSlip(Role),
    /// A friction zone appears on a pulley.
    ZoneAppears {
        /// Where.
        pulley: Role,
        /// The kind of the zone.
        kind: ZoneKind,
    },
    /// A friction zone vanishes from a pulley.
    ZoneVanishes {
        /// Where.
        pulley: Role,
        /// The kind of the zone.
        kind: ZoneKind,
    },
    /// The belt sinks into the groove of a pulley by its whole height.
    BeltHeight(Role),
    /// The branch ends.
    End,
}

/// Why a branch ends.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BranchEnd {
    /// The parameter has reached the value asked for.
    Target,
    /// Behind a limit point the parameter has come back by a quarter of its way, or to where the
    /// branch starts.
    Returned,
    /// The pulley slips grossly.
    GrossSlip(Role),
    /// Both spans have the same tension: the drive transmits no torque.
    NoLoad,
    /// The belt is too slack for its speed and lifts off the pulleys.
    LiftsOff,
    /// The branch has closed on itself.
    Closed,
    /// The next state was not found. The last point is the last good one.
    NotConverged {
        /// Why.
        cause: String,
    },
}

/// In words, without the value of the parameter.
impl fmt::Display for BranchEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Target => f.write_str("the parameter reached the value asked for"),
            Self::Returned => f.write_str(
                "behind a limit point the parameter has come back by a quarter of its way",
            ),
            Self::GrossSlip(pulley) => write!(f, "the {} slips grossly", pulley.name()),
            Self::NoLoad => {
                f.write_str("the spans have the same tension: the drive transmits no torque")
            }
            Self::LiftsOff => LimitReason::LiftsOff.fmt(f),
            Self::Closed => f.write_str("the branch closed on itself"),
            Self::NotConverged { cause } => write!(f, "the next state was not found: {cause}"),
        }
    }
}

/// How a branch was traced and what it cost.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TraceConvergence {
    /// Relative tolerance asked for.
    pub tolerance: f64,
    /// Normalisation ε of the slip direction along the branch (0 for the bristle law).
    pub slip_normalisation: f64,
    /// States found along the branch, those of events included.
    pub continuation_steps: usize,
    /// Newton steps, with a new or a kept Jacobian.
    pub newton_iterations: usize,
    /// Evaluations of the right-hand side (with or without its derivatives).
    pub rhs_evaluations: usize,
    /// Factorisations of the Newton matrix.
    pub factorisations: usize,
    /// Wall-clock seconds.
    pub seconds: f64,
}

impl TraceConvergence {
    /// Adds the cost of boundary value problems.
    pub(crate) fn count(&mut self, stats: &bvp::Stats) {
        self.newton_iterations += stats.newton_steps;
        self.rhs_evaluations += stats.rhs_evaluations;
        self.factorisations += stats.factorisations;
    }

    /// Adds what another trace took, but for its time.
    pub(crate) fn add(&mut self, other: &Self) {
        self.slip_normalisation = self.slip_normalisation.max(other.slip_normalisation);
        self.continuation_steps += other.continuation_steps;
        self.newton_iterations += other.newton_iterations;
        self.rhs_evaluations += other.rhs_evaluations;
        self.factorisations += other.factorisations;
    }
}

impl Branch {
    /// The states of the branch and of its events, in order of arclength, each with what happens
    /// there.
    pub(crate) fn rows(&self) -> Vec<(&TracePoint, Option<&BranchEvent>)> {
        let points = self.points.iter().map(|point| (point, None));
        let events = self.events.iter().map(|event| (&event.point, Some(event)));
        let mut rows: Vec<_> = points.chain(events).collect();
        rows.sort_by(|(one, _), (other, _)| one.arclength.total_cmp(&other.arclength));
        // A point of the branch that is an event stands there once.
        let at_event = |point: &TracePoint| {
            let mut events = self.events.iter();
            events.any(|event| event.point.arclength == point.arclength)
        };
        rows.retain(|(point, event)| event.is_some() || !at_event(point));
        rows
    }
}

/// A range is sampled in equal ratios if its ends have a larger one.
const WIDE: f64 = 20.0;

/// The values of a range after its first, in equal differences or ratios.
pub(crate) fn samples([from, to]: [f64; 2], intervals: usize) -> impl Iterator<Item = f64> {
    let ratio = to / from;
    let is_wide = from > 0.0 && ratio.is_normal() && ratio.max(ratio.recip()) > WIDE;
    (1..=intervals).map(move |sample| {
        let share = sample as f64 / intervals as f64;
        match sample {
            _ if sample == intervals => to,
            _ if is_wide => from * ratio.powf(share),
            _ => from + share * (to - from),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::samples::branch as sample_branch;

    #[test]
    fn rows_hold_points_and_events_in_order_and_once() {
        let mut branch = sample_branch::folded();
        let count = branch.points.len() + branch.events.len();
        let start = &branch.events[0];
        assert_eq!(start.kind, EventKind::Start);
        assert_eq!(start.point.arclength, branch.points[0].arclength);
        // Start, limit point and end are points, too.
        assert_eq!(branch.rows().len(), count - 3);
        branch.events.reverse();
        let rows = branch.rows();
        assert!(rows.is_sorted_by_key(|(point, _)| point.arclength));
        assert_eq!(rows.iter().filter(|(_, event)| event.is_some()).count(), 4);
    }
}
