//! Both ends of the range of an entry over which a drive has steady states.

use super::found::{carried, find, forwards, is_crossed, pressed_through_without_states, verified};
use super::path::{Path, Solved};
use super::starts::start_loads;
use super::state::describe;
use super::tracer::{Tracer, Until};
use crate::input::Key;
use crate::results::possible;
use crate::{
    Branch, BranchEnd, BranchEvent, Drive, EventKind, FrictionLaw, Limit, LimitReason, Limits,
    Load, RangeEnd, SolveError, SolveOptions, StateErrors, StateSummary, TracePoint,
};
use continuation::Direction;
use std::f64::consts::PI;
use std::sync::Arc;
use web_time::Instant;

/// Below this multiple of the slack tension a branch is left to the state without load.
const LIGHT: f64 = 3.0;
/// An upper end is sought up to this multiple of the value in the drive, and from there again.
const STRETCH: f64 = 64.0;
/// The most such stretches.
const STRETCHES: usize = 3;
/// The most branches that are followed one beyond the other.
const BRANCHES: usize = 6;
/// A lower end is sought down to this share of the value.
const SMALLEST_SHARE: f64 = 1e-3;

/// Both ends of the range of an entry of a V-belt drive, and the branch between.
pub(crate) fn limits(
    drive: &Drive,
    key: &Key,
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<Limits, SolveError> {
    let start = Instant::now();
    let tolerance = options.tolerance;
    progress(0.0, "solving a state between the limits");
    let mut loads = states(drive, key, tolerance);
    let first = first_of(&mut loads, drive, tolerance)?;
    let mut found = limits_from(first, key, tolerance, progress);
    if let FrictionLaw::VectorEpp { .. } = drive.law
        && is_lost(&found)
        && let Some(other) = loads.next()
    {
        let led = limits_from(other, key, tolerance, progress);
        if led.is_ok() && !is_lost(&led) {
            found = led;
        }
    }
    let mut found = found?;
    found.branch.convergence.seconds = start.elapsed().as_secs_f64();
    Ok(found)
}

/// Whether the upper end of a range was not found on the branch from one state. With vector EPP friction one from another load
/// passes the places where zones appear with other steps: of 54 random drives one has no limit without it, and none with it. With
/// other friction those of five random drives are not found from three further loads either.
fn is_lost(found: &Result<Limits, SolveError>) -> bool {
    match found {
        Ok(found) => found.largest.reason == RangeEnd::NotFound,
        Err(cause) => matches!(cause, SolveError::NoLimit { .. }),
    }
}

/// The same on the branch from one state.
fn limits_from(
    (drive, solved): (Drive, Solved),
    key: &Key,
    tolerance: f64,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<Limits, SolveError> {
    let value = key.get(&drive);
    let [low, high] = domain(&drive, key, tolerance)?;
    forwards(&drive, &describe(&Path::new(&drive, tolerance), &solved))?;

    let mut up = upwards(&drive, key, tolerance, solved.clone(), high, progress);
    let largest = up.limit()?;
    let is_load = *key == Key::load(&drive);
    let bottom = if is_load && !matches!(drive.law, FrictionLaw::Bristle { .. }) {
        (LIGHT * drive.pair().load.slack.value()).min(value)
    } else {
        low
    };
    let mut tracer = Tracer::new(&drive, *key, [bottom, value], tolerance, Until::LimitPoint);
    if is_load {
        tracer.no_load = Some(low);
    }
    let end = if bottom < value {
        tracer.run(solved, value, Direction::Decreasing, progress)
    } else {
        BranchEnd::Target
    };
    let down = Traced { tracer, end };
    let smallest = if is_load && (bottom > low || bottom == value) {
        // Where that is not found the smallest load that was reached is known.
        let reached = |_| down.limit().or_else(|cause| up.first().ok_or(cause));
        no_load(&drive, key, tolerance).or_else(reached)?
    } else {
        down.limit()?
    };
    let mut down = down.tracer;

    // From the smallest value to the largest.
    let turn = |point: &mut TracePoint| point.arclength = -point.arclength;
    down.points.iter_mut().for_each(turn);
    down.events
        .iter_mut()
        .for_each(|event| turn(&mut event.point));
    let mut points: Vec<TracePoint> = down.points.into_iter().rev().collect();
    let mut events: Vec<BranchEvent> = down.events.into_iter().rev().collect();
    points.append(&mut up.tracer.points);
    events.append(&mut up.tracer.events);
    events.retain(|event| !matches!(event.kind, EventKind::Start | EventKind::End));
    let mut convergence = up.tracer.convergence;
    convergence.add(&down.convergence);
    Ok(Limits {
        branch: Branch {
            key: *key,
            drive: drive.clone(),
            points,
            events,
            end: up.end,
            convergence,
        },
        smallest,
        largest,
    })
}

/// A finished trace and how it ended.
pub(super) struct Traced<'d> {
    pub(super) tracer: Tracer<'d>,
    pub(super) end: BranchEnd,
}

/// States of the drive under loads from which the range of its load may be followed, the best first; none for other entries.
fn states<'d>(
    drive: &'d Drive,
    key: &Key,
    tolerance: f64,
) -> impl Iterator<Item = (Drive, Solved)> + use<'d> {
    let is_load = *key == Key::load(drive);
    let is_elastic = matches!(drive.law, FrictionLaw::Epp { .. });
    let mut path = Path::of_branch(drive, tolerance);
    let mut loads = start_loads(drive, true).map(Some);
    // Where the load of the drive is not carried, one of some slip.
    let own = loads.next().into_iter();
    let begins = own.chain(is_elastic.then_some(None)).chain(loads);
    let mut may_be = true;
    begins
        .filter(move |_| is_load)
        .filter_map(move |begin| match begin {
            Some(load) if may_be => load.state(&mut path),
            Some(_) => None,
            None => {
                may_be = pressed_through_without_states(&mut path).is_none();
                let idle = path.idle_bristles().filter(|_| may_be)?;
                path.slipping(&idle, f64::INFINITY)
            }
        })
}

/// A state of the drive, at a smaller load if it does not carry its own, at a larger one near no load.
pub(super) fn first_state(
    drive: &Drive,
    key: &Key,
    tolerance: f64,
) -> Result<(Drive, Solved), SolveError> {
    first_of(&mut states(drive, key, tolerance), drive, tolerance)
}

/// The first of these states, or else that of the drive.
fn first_of(
    states: &mut impl Iterator<Item = (Drive, Solved)>,
    drive: &Drive,
    tolerance: f64,
) -> Result<(Drive, Solved), SolveError> {
    if let Some((first, solved)) = states.next() {
        // No load makes the belt slower.
        return match possible::fault(&describe(&Path::new(&first, tolerance), &solved)) {
            Some(fault) => Err(SolveError::Impossible(fault)),
            None => Ok((first, solved)),
        };
    }
    let (mut path, found) = find(drive, tolerance);
    let solved = carried(&path, found)?;
    Ok((drive.clone(), verified(&mut path, solved)?))
}

/// Follows the branch towards larger values until it ends.
pub(super) fn upwards<'d>(
    drive: &'d Drive,
    key: &Key,
    tolerance: f64,
    solved: Solved,
    high: f64,
    progress: &mut dyn FnMut(f64, &str),
) -> Traced<'d> {
    let value = key.get(drive);
    let range = [value, (value * STRETCH).min(high)];
    let mut tracer = Tracer::new(drive, *key, range, tolerance, Until::LimitPoint);
    if is_slack(key) {
        tracer.no_load = Some(high);
    }
    let (mut from, mut solved) = (value, solved);
    let (mut stretches, mut branches) = (1, 1);
    loop {
        let end = tracer.run(solved, from, Direction::Increasing, progress);
        let farther = (tracer.range[1] * STRETCH).min(high);
        (from, solved) = if stretches < STRETCHES
            && let Some(next) = tracer.with_upper_end(farther)
        {
            stretches += 1;
            next
        } else if branches < BRANCHES
            && let Some(next) = tracer.elsewhere(&end)
        {
            branches += 1;
            next
        } else {
            return Traced { tracer, end };
        };
    }
}

impl Traced<'_> {
    /// Where it begins, as an end that was not found.
    fn first(&self) -> Option<Limit> {
        let point = self.tracer.points.first()?;
        Some(Limit {
            value: point.value,
            value_error: None,
            reason: RangeEnd::NotFound,
            state: point.state.clone(),
            errors: None,
        })
    }

    /// Its end as a limit.
    ///
    /// # Errors
    /// The branch could not be followed from its first state.
    pub(super) fn limit(&self) -> Result<Limit, SolveError> {
        let last = self.tracer.events.last();
        let reason = match last {
            Some(event) if matches!(event.kind, EventKind::GrossSlip(_)) => {
                RangeEnd::Limit(LimitReason::DrivenSlips)
            }
            Some(event) if event.kind == EventKind::LimitPoint => {
                let state = &event.point.state;
                let [exit, share] = [state.driver.inclination[1], 1.0 - state.speed_loss];
                RangeEnd::Limit(LimitReason::of_limit_point(exit, share))
            }
            _ if self.end == BranchEnd::NoLoad => RangeEnd::NoLoad,
            _ => RangeEnd::NotFound,
        };
        let event = last.filter(|_| matches!(reason, RangeEnd::Limit(_)));
        let at_event = event.map(|event| &event.point);
        let Some(point) = at_event.or(self.tracer.points.last()) else {
            return Err(SolveError::NoLimit {
                reached: self.tracer.key.get(self.tracer.drive),
                cause: self.end.to_string(),
            });
        };
        let tracer = &self.tracer;
        let errors = || {
            let relative = point.state.error_estimate?;
            Some(StateErrors::relative(&point.state, tracer.drive, relative))
        };
        Ok(Limit {
            value: point.value,
            value_error: match event {
                Some(event) => event.value_error,
                // Without load it is the tension of the other span.
                None => (reason == RangeEnd::NoLoad && !is_crossed(tracer.drive)).then_some(0.0),
            },
            reason,
            state: point.state.clone(),
            errors: event.map_or_else(errors, |event| event.errors),
        })
    }
}

/// The state without load: both spans have the same tension. Its ε is the smallest that was reached.
fn no_load(drive: &Drive, key: &Key, tolerance: f64) -> Result<Limit, SolveError> {
    let idle = idle(drive, key);
    let mut path = Path::new(&idle, tolerance);
    let scaled = idle.pair().load.tight.value() / path.scales().units.force;
    let solved = match path.at_no_load(scaled) {
        Ok(solved) => solved,
        // Stuck on the way to a smaller ε.
        Err(stuck) => match stuck.last {
            Some(last) if last.is_resolved(drive.law, tolerance) => *last,
            _ => {
                let tight = None;
                let cause = Arc::new(stuck.cause);
                return Err(SolveError::NotConverged { tight, cause });
            }
        },
    };
    let state = describe(&path, &solved);
    // Without an estimate of its own the state is only as good as the effect of its ε is known.
    let estimate = solved.solution.error_estimate();
    let relative = estimate.map(|estimate| estimate.max(path.smoothing_effect));
    let (value, value_error) = match is_crossed(drive) {
        false => (idle.pair().load.tight.value(), Some(0.0)),
        true => {
            let value = match key.path().contains("tractive") {
                true => state.tight_tractive_tension,
                false => state.tight_tension,
            };
            (value, relative.map(|relative| relative * value))
        }
    };
    let state = StateSummary {
        error_estimate: relative,
        ..StateSummary::from(&state)
    };
    Ok(Limit {
        value,
        value_error,
        reason: RangeEnd::NoLoad,
        errors: relative.map(|relative| StateErrors::relative(&state, drive, relative)),
        state,
    })
}

/// Whether an entry is the tension of the slack span.
fn is_slack(key: &Key) -> bool {
    key.path().starts_with("load.slack")
}

/// The drive with the tension of one span replaced by that of the other.
fn idle(drive: &Drive, key: &Key) -> Drive {
    let Load { slack, tight } = drive.pair().load;
    let tension = match is_slack(key) {
        true => tight,
        false => slack,
    };
    drive.with_load(Load {
        slack: tension,
        tight: tension,
    })
}

/// The value of a span tension at which both spans have the same: a bound of its values.
fn equal(drive: &Drive, key: &Key, tolerance: f64) -> Result<f64, SolveError> {
    match is_crossed(drive) {
        false => Ok(idle(drive, key).pair().load.tight.value()),
        true => no_load(drive, key, tolerance).map(|limit| limit.value),
    }
}

/// The values of an entry that a drive can have.
///
/// # Errors
/// The state without load, at which a tension ends, was not found.
pub(super) fn domain(drive: &Drive, key: &Key, tolerance: f64) -> Result<[f64; 2], SolveError> {
    let (value, pair) = (key.get(drive), drive.pair());
    let [mut low, mut high] = [SMALLEST_SHARE * value, f64::INFINITY];
    match key.path() {
        "load.tight_tractive_tension" | "load.tight_tension" => {
            low = equal(drive, key, tolerance)?;
        }
        "load.slack_tractive_tension" | "load.slack_tension" => {
            high = equal(drive, key, tolerance)?;
        }
        "groove.half_angle" => high = 0.49 * PI,
        "layout.centre_distance" => low = 1.001 * (pair.driver_radius + pair.driven_radius),
        "pulleys.driver.radius" => high = 0.999 * pair.centre_distance - pair.driven_radius,
        "pulleys.driven.radius" => high = 0.999 * pair.centre_distance - pair.driver_radius,
        _ => {}
    }
    Ok([low, high])
}
