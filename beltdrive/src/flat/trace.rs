//! The steady states of a flat-belt drive over one entry of the drive file.
//!
//! There is one state for each value, in closed form, so that the branch has no limit points and is
//! sampled; where the friction zones change between two samples, the place is found by bisection.

use super::closed_form::Refusal;
use super::range::{End, Members, boundary};
use super::solve::refused;
use crate::input::Key;
use crate::results::branch::samples;
use crate::{
    Branch, BranchEnd, BranchEvent, Drive, EventKind, LimitReason, PulleySummary, Role, SolveError,
    SolveOptions, TraceConvergence, TracePoint, Zone, ZoneKind,
};
use web_time::Instant;

/// Intervals between the samples of a branch.
const INTERVALS: usize = 48;
/// An interval is halved, at most so often, where the speed of the driven pulley or a slip arc bends by
/// more than a share of the speed of the driver or of the wrap.
const DEPTH: usize = 8;
const BEND: f64 = 2e-3;
/// Zones that change within this share of the range from its start are not told apart from it.
const EDGE: f64 = 1e-9;

/// The branch of steady states over an entry from `range[0]` to `range[1]`.
pub(crate) fn trace(
    drive: &Drive,
    key: &Key,
    range: [f64; 2],
    options: &SolveOptions,
) -> Result<Branch, SolveError> {
    branch_between(&Members::new(drive, key), range, options)
}

/// As [`trace`].
pub(super) fn branch_between(
    members: &Members<'_>,
    range: [f64; 2],
    options: &SolveOptions,
) -> Result<Branch, SolveError> {
    let start = Instant::now();
    let [from, to] = range;
    members
        .at(from)
        .map_err(|refusal| refused(&members.drive_at(from), refusal))?;
    let mut trace = Trace {
        members,
        range,
        points: Vec::new(),
        events: Vec::new(),
    };
    trace.event(EventKind::Start, from);
    let mut last = from;
    let mut end = BranchEnd::Target;
    for value in samples(range, INTERVALS) {
        if members.at(value).is_err() {
            end = trace.stop(last, value);
            break;
        }
        trace.zones_between(last, value);
        trace.refine(last, value, DEPTH);
        trace.point(value);
        last = value;
    }
    if end == BranchEnd::Target {
        trace.event(EventKind::End, to);
    }
    let continuation_steps = trace.points.len() + trace.events.len();
    Ok(Branch {
        key: members.key,
        drive: members.drive.clone(),
        points: trace.points,
        events: trace.events,
        end,
        convergence: TraceConvergence {
            tolerance: options.tolerance,
            continuation_steps,
            seconds: start.elapsed().as_secs_f64(),
            ..TraceConvergence::default()
        },
    })
}

/// A branch in the making.
struct Trace<'m> {
    members: &'m Members<'m>,
    range: [f64; 2],
    points: Vec<TracePoint>,
    events: Vec<BranchEvent>,
}

/// The kinds of the zones of the driven pulley and of the driver.
type Zones = [Vec<ZoneKind>; 2];

impl Trace<'_> {
    /// The state at a value that the drive carries.
    fn state(&self, value: f64) -> Option<TracePoint> {
        let [from, to] = self.range;
        Some(TracePoint {
            value,
            arclength: (value - from).abs() / (to - from).abs(),
            state: self.members.summary(value)?,
        })
    }

    fn point(&mut self, value: f64) {
        self.points.extend(self.state(value));
    }

    /// Adds points between two values where the branch bends.
    fn refine(&mut self, from: f64, to: f64, depth: usize) {
        let middle = 0.5 * (from + to);
        let shown = |value: f64| {
            let state = self.members.summary(value)?;
            let slip = |pulley: &PulleySummary| {
                let slips = |zone: &&Zone| zone.kind == ZoneKind::Slip;
                let arcs = pulley.zones.iter().filter(slips);
                arcs.map(|zone| zone.to - zone.from).sum::<f64>() / pulley.wrap_angle
            };
            let speed = state.driven.angular_speed / self.members.drive.pair().driver_speed;
            Some([speed, slip(&state.driven), slip(&state.driver)])
        };
        let (Some(one), Some(between), Some(other)) = (shown(from), shown(middle), shown(to))
        else {
            return;
        };
        let bends = |i: usize| (between[i] - 0.5 * (one[i] + other[i])).abs() > BEND;
        if depth == 0 || middle == from || middle == to || !(0..3).any(bends) {
            return;
        }
        self.refine(from, middle, depth - 1);
        self.point(middle);
        self.refine(middle, to, depth - 1);
    }

    /// Adds what happens at a value, as a point, too.
    fn event(&mut self, kind: EventKind, value: f64) {
        let located = !matches!(kind, EventKind::Start | EventKind::End);
        if !located {
            self.points.retain(|point| point.value != value);
            self.point(value);
        }
        let [from, _] = self.range;
        let errors = self.members.errors(value, from);
        self.events
            .extend(self.state(value).map(|point| BranchEvent {
                kind,
                value_error: Some(if located {
                    f64::EPSILON * value.abs()
                } else {
                    0.0
                }),
                errors,
                point,
            }));
    }

    /// Ends the branch between a value that the drive carries and one that it does not.
    fn stop(&mut self, inside: f64, outside: f64) -> BranchEnd {
        let Some(End { value, refusal }) = self.members.end_between(inside, outside) else {
            return BranchEnd::Target;
        };
        self.zones_between(inside, value);
        self.refine(inside, value, DEPTH);
        if value != inside {
            self.point(value);
        }
        match refusal {
            Refusal::Slips(reason) => {
                let pulley = match reason {
                    LimitReason::Capstan(pulley) => pulley,
                    _ => Role::Driven,
                };
                self.event(EventKind::GrossSlip(pulley), value);
                BranchEnd::GrossSlip(pulley)
            }
            Refusal::LiftsOff { .. } => {
                self.event(EventKind::End, value);
                BranchEnd::LiftsOff
            }
            Refusal::Backwards { .. } => {
                self.event(EventKind::End, value);
                BranchEnd::NoLoad
            }
        }
    }

    /// Locates where zones appear and vanish between two values that the drive carries.
    fn zones_between(&mut self, from: f64, to: f64) {
        let [start, end] = self.range;
        let edge = EDGE * (end - start).abs();
        let Some(last) = self.zones(to) else {
            return;
        };
        let mut here = from;
        while let Some(zones) = self.zones(here)
            && zones != last
        {
            let same = |value: f64| self.zones(value).as_ref() == Some(&zones);
            let (before, after) = boundary(here, to, same);
            // Beyond the rounding errors of the place.
            let beyond = after + (end - start).signum() * edge.min((to - after).abs());
            let Some(next) = self.zones(beyond) else {
                return;
            };
            if (before - start).abs() > edge {
                for kind in changes(&zones, &next) {
                    self.event(kind, after);
                }
            }
            if beyond == here {
                return;
            }
            here = beyond;
        }
    }

    fn zones(&self, value: f64) -> Option<Zones> {
        let solved = self.members.at(value).ok()?;
        let kinds = solved.contact.map(|contact| {
            let zones = contact.zones.iter();
            zones.map(|zone| zone.friction.kind()).collect()
        });
        Some(kinds)
    }
}

/// The zones that appear and vanish.
fn changes(before: &Zones, after: &Zones) -> Vec<EventKind> {
    let count = |zones: &[ZoneKind], kind| zones.iter().filter(|&&zone| zone == kind).count();
    let pulleys = [Role::Driven, Role::Driver];
    let mut events = Vec::new();
    for (pulley, (before, after)) in pulleys.into_iter().zip(before.iter().zip(after)) {
        for kind in ZoneKind::ALL {
            match count(after, kind).cmp(&count(before, kind)) {
                std::cmp::Ordering::Greater => events.push(EventKind::ZoneAppears { pulley, kind }),
                std::cmp::Ordering::Less => events.push(EventKind::ZoneVanishes { pulley, kind }),
                std::cmp::Ordering::Equal => {}
            }
        }
    }
    events
}
