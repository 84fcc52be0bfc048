//! The state at a load from the branch that leads to it.
//!
//! Where a state is not found at its own load, nor from one near it with the same friction zones, it is sought along the
//! branch of a rising or falling load, on which zones may change.

use super::found::{checked, not_carried};
use super::limits::upwards;
use super::path::{Path, Solved};
use super::tracer::{Tracer, Until};
use crate::input::Key;
use crate::{BranchEnd, Drive, FrictionLaw, RangeEnd, SolveError, SteadyState};
use continuation::Direction;
use web_time::Instant;

/// Loads from which the branch is followed, in the order in which they are tried: as powers of the ratio of the tensions,
/// from which the way is the shorter the nearer they are, but not all of whose states are found, ...
const LIGHTER: [f64; 4] = [0.8, 0.5, 0.25, 0.1];
/// ... or, where that ratio is less than the first of these, as multiples of the slack tension: nearer to no load the
/// belt hardly slips, and states are hard to find.
const HEAVIER: [f64; 2] = [2.0, 3.0];

/// The steady state of a drive, or the limit of its load if that is lower, in a search that began at `start`; `None` if
/// no branch leads there.
pub(super) fn by_branch(
    drive: &Drive,
    tolerance: f64,
    start: Instant,
) -> Option<Result<SteadyState, SolveError>> {
    let key = Key::load(drive);
    let slack = drive.pair().load.slack.value();
    let ratio = key.get(drive) / slack;
    let ratios = match ratio < HEAVIER[0] {
        true => HEAVIER.to_vec(),
        false => LIGHTER.map(|power| ratio.powf(power)).to_vec(),
    };
    ratios.into_iter().find_map(|ratio| {
        let mut near = drive.clone();
        key.set(&mut near, slack * ratio);
        let mut path = Path::new(&near, tolerance);
        let solved = match drive.law {
            FrictionLaw::Bristle { .. } => path.start()?,
            _ => path.with_direction()?,
        };
        match path.is_below_limit(&solved) {
            true => from_state(drive, (&near, solved), tolerance, start),
            false => None,
        }
    })
}

/// As [`by_branch`], from a state of the drive at another load.
fn from_state(
    drive: &Drive,
    (near, solved): (&Drive, Solved),
    tolerance: f64,
    start: Instant,
) -> Option<Result<SteadyState, SolveError>> {
    let key = Key::load(drive);
    let [value, asked] = [near, drive].map(|drive| key.get(drive));
    let near = match asked > value {
        true => {
            let up = upwards(near, &key, tolerance, solved, asked, &mut |_, _| {});
            if let Ok(limit) = up.limit()
                && let RangeEnd::Limit(reason) = limit.reason
            {
                let state = &limit.state;
                let [speed, exit] = [state.driven.angular_speed, state.driver.inclination[1]];
                return Some(Err(not_carried(drive, limit.value, reason, [speed, exit])));
            }
            (up.end == BranchEnd::Target).then_some(up.tracer.near)
        }
        false => {
            let range = [asked, value];
            let mut down = Tracer::new(near, key, range, tolerance, Until::LimitPoint);
            let end = down.run(solved, value, Direction::Decreasing, &mut |_, _| {});
            (end == BranchEnd::Target).then_some(down.near)
        }
    };
    let (reached, solved) = near.flatten()?;
    if reached != asked {
        return None;
    }
    let mut path = Path::new(drive, tolerance);
    let solved = path.finish(solved).ok()?;
    checked(&path, solved, start).ok().map(Ok)
}
