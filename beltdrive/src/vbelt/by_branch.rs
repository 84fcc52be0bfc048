//! The state at a load from the branch that leads to it.
//!
//! Where a state is not found at its own load, nor from one near it with the same friction zones, it is sought along the
//! branch of a rising or falling load, on which zones may change.

use super::beyond::{FARTHER, slips_grossly};
use super::found::{checked, not_carried};
use super::limit::slips_far;
use super::limits::upwards;
use super::path::{Path, Solved};
use super::starts::{HARDLY_ANY, StartLoad, start_loads};
use super::tracer::{Tracer, Until};
use crate::input::Key;
use crate::{BranchEnd, Drive, FrictionLaw, RangeEnd, SolveError, SteadyState};
use continuation::Direction;
use web_time::Instant;

/// The most branches that are followed.
const BRANCHES: usize = 4;

/// Slips of the driven pulley at which scalar elastic friction carries about as much as it may: more is not carried, and a limit
/// below that is none.
const GREAT_SLIPS: [f64; 2] = [0.1, 0.2];

/// The steady state of the drive of a search that began at `start`, or the limit of its load if that is lower; `None` if
/// no branch leads there. Where a state with a normalised direction `is_known`, none begins with one, and one is followed:
/// three more took 20 s in vain on one of 700 random drives.
pub(super) fn by_branch(
    path: &mut Path<'_>,
    start: Instant,
    is_known: bool,
) -> Option<Result<SteadyState, SolveError>> {
    let drive = path.drive;
    // With scalar elastic friction a branch may end where the kinds of its zones change and others do not, so that its
    // end is the limit only if no state is found beyond it.
    let may_go_on = matches!(drive.law, FrictionLaw::Epp { .. });
    if may_go_on && let Some(answer) = from_slip(path, start) {
        return Some(answer);
    }
    let mut refusal: Option<(f64, SolveError)> = None;
    let most = if is_known { 1 } else { BRANCHES };
    let mut branches = 0;
    for load in start_loads(drive, false) {
        // With a normalised direction none was found beyond the limits of 141 random drives, in half the time of a refusal.
        if !load.has_direction && (is_known || refusal.is_some()) {
            break;
        }
        if refusal
            .as_ref()
            .is_some_and(|&(limit, _)| load.value <= limit)
        {
            continue;
        }
        let Some((near, solved)) = load.state(path) else {
            continue;
        };
        match from_state(path, (&near, solved), start) {
            Some(Led::There(state)) => return Some(Ok(*state)),
            Some(Led::ToLimit(limit, refused, slips)) if may_go_on && refusal.is_none() => {
                if !slips && let Some(state) = from_farther(path, start) {
                    return Some(Ok(*state));
                }
                refusal = Some((limit, refused));
            }
            Some(Led::ToLimit(_, refused, _)) => return Some(Err(refused)),
            // There are states beyond the limit, which lead nowhere.
            None if refusal.is_some() => return None,
            None => {}
        }
        branches += 1;
        if branches == most {
            break;
        }
    }
    refusal.map(|(_, refused)| Err(refused))
}

/// The same with scalar elastic friction on the branch from a state of some slip under a smaller load.
fn from_slip(path: &mut Path<'_>, start: Instant) -> Option<Result<SteadyState, SolveError>> {
    let (force, asked) = (
        path.scales().units.force,
        Key::load(path.drive).get(path.drive),
    );
    let idle = path.idle_bristles()?;
    let at_great_slip = GREAT_SLIPS.map(|slip| path.bristles_at_slip(&idle, slip));
    let carried = |load: f64| {
        let mut at_great_slip = at_great_slip.iter().flatten();
        at_great_slip.any(|bristles| bristles.tight_tension() * force > load)
    };
    if carried(asked) {
        return None;
    }
    let (near, solved) = path.slipping(&idle, asked)?;
    match from_state(path, (&near, solved), start)? {
        Led::There(state) => Some(Ok(*state)),
        Led::ToLimit(limit, refused, _) => {
            let mut slips = GREAT_SLIPS.into_iter();
            let goes_on = carried(limit)
                && slips.any(|slip| path.at_slip(&idle, slip, [limit, asked]).is_some());
            (!goes_on).then_some(Err(refused))
        }
    }
}

/// Where a branch has led.
enum Led {
    /// To the load that is asked for.
    There(Box<SteadyState>),
    /// To the limit of the load, SI, which is smaller, and whether a pulley slips grossly there.
    ToLimit(f64, SolveError, bool),
}

/// Where the branch of the load leads from a state of the drive under another load, if anywhere.
fn from_state(
    path: &mut Path<'_>,
    (near, solved): (&Drive, Solved),
    start: Instant,
) -> Option<Led> {
    let (drive, tolerance) = (path.drive, path.tolerance);
    let key = Key::load(drive);
    let [value, asked] = [near, drive].map(|drive| key.get(drive));
    let near = match asked > value {
        true => {
            let up = upwards(near, &key, tolerance, solved, asked, &mut |_, _| {});
            path.count_trace(&up.tracer.convergence);
            if let Some((reached, _)) = up.tracer.near {
                path.reached = path.reached.max(reached / path.scales().units.force);
            }
            if let Ok(limit) = up.limit()
                && let RangeEnd::Limit(reason) = limit.reason
            {
                let state = &limit.state;
                let [speed, exit] = [state.driven.angular_speed, state.driver.inclination[1]];
                let refused = not_carried(drive, limit.value, reason, [speed, exit]);
                let slips = slips_grossly(state);
                return Some(Led::ToLimit(limit.value, refused, slips));
            }
            (up.end == BranchEnd::Target).then_some(up.tracer.near)
        }
        false => lowered(path, (near, solved), [asked, value]).map(Some),
    };
    at_asked(path, near.flatten()?, start).map(Led::There)
}

/// A state to which a branch has led as the one that is asked for, if its load, SI, is that.
fn at_asked(
    path: &mut Path<'_>,
    (reached, solved): (f64, Solved),
    start: Instant,
) -> Option<Box<SteadyState>> {
    if reached != Key::load(path.drive).get(path.drive) {
        return None;
    }
    let solved = path.finish(solved).ok()?;
    checked(path, solved, start).ok().map(Box::new)
}

/// The state to which a load is lowered that is larger than the one that is asked for, which may itself not be found: a drive whose
/// first states end at 1753.14 N has others from there to 2086.88 N, of which that at 1800 N is found from 1854 N.
fn from_farther(path: &mut Path<'_>, start: Instant) -> Option<Box<SteadyState>> {
    let asked = Key::load(path.drive).get(path.drive);
    FARTHER.into_iter().find_map(|share| {
        let load = StartLoad {
            value: asked * (1.0 + share),
            has_direction: true,
        };
        let (near, solved) = load.state(path)?;
        let led = lowered(path, (&near, solved), [asked, load.value])?;
        at_asked(path, led, start)
    })
}

/// The state at the smaller of two loads, SI, to which the branch from a state of the drive under the larger one leads, with
/// that load.
fn lowered(
    path: &mut Path<'_>,
    (near, solved): (&Drive, Solved),
    range: [f64; 2],
) -> Option<(f64, Solved)> {
    let key = Key::load(near);
    let mut down = Tracer::new(near, key, range, path.tolerance, Until::LimitPoint);
    let end = down.run(solved, range[1], Direction::Decreasing, &mut |_, _| {});
    path.count_trace(&down.convergence);
    (end == BranchEnd::Target).then_some(down.near)?
}

/// Whether the branch of the load leads from hardly any load to a state of the drive. Where friction is a soft vector, the
/// driver of one drive creeps by 0.02 even then, so that no start load is one of small slip.
pub(super) fn is_led_from_rest(path: &mut Path<'_>, solved: &Solved) -> bool {
    let drive = path.drive;
    let load = Key::load(drive).get(drive);
    let least = HARDLY_ANY * drive.pair().load.slack.value();
    let from = match least < load {
        true => lowered(path, (drive, solved.clone()), [least, load]),
        false => Some((load, solved.clone())),
    };
    from.is_some_and(|(_, light)| !slips_far(&light))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vbelt::limit::may_be_another;
    use crate::vbelt::limit::tests::lets_go;
    use crate::vbelt::scaling::tests::{kim, tractive, v_belt};
    use crate::vbelt::solve::solve;
    use crate::{SolveOptions, TwoPulleys};

    #[test]
    fn a_branch_that_is_lost_tells_what_the_drive_carries() {
        let drive = lets_go();
        let mut path = Path::new(&drive, 1e-6);
        assert!(by_branch(&mut path, Instant::now(), true).is_none());
        let reached = path.reached * path.scales().units.force;
        assert!(reached > 305.0, "{reached}");
    }

    #[test]
    fn a_driver_that_creeps_under_any_load_is_led_from_hardly_any() {
        let law = FrictionLaw::VectorEpp {
            stiffness: 172_615.0,
        };
        let drive = TwoPulleys {
            belt: v_belt([0.357_985_408, 85_999.256_6, 371_094.143, 0.316_057_492]),
            friction_coefficient: 0.718_014_84,
            driver_radius: 0.032_653_804_7,
            driver_speed: 241.759_425,
            driven_radius: 0.045_820_977_2,
            centre_distance: 0.265_451_952,
            load: tractive(51.185_595_4, 110.852_573),
            ..kim(law, 0.25)
        };
        let drive = Drive::from(drive);
        let mut path = Path::new(&drive, 1e-6);
        let solved = path.at_load(path.target()).unwrap();
        assert!(may_be_another(&solved) && !path.is_reached(&solved));
        assert!(is_led_from_rest(&mut path, &solved));
        let state = solve(&drive, &SolveOptions::default()).unwrap();
        let steps = state.convergence.newton_iterations;
        assert!(steps <= 400, "{steps}");
    }

    #[test]
    fn a_state_behind_the_limit_of_a_driver_that_creeps_under_any_load_is_not_told() {
        // It carries 568.886 N, and behind that limit 560 N again with a driven pulley at 6.98 rad/s.
        let law = FrictionLaw::VectorEpp {
            stiffness: 1_353_290.0,
        };
        let drive = TwoPulleys {
            belt: v_belt([0.670_260_060_1, 49_253.706_27, 2_016_376.575, 0.359_355_755]),
            friction_coefficient: 0.462_804_179_7,
            driver_radius: 0.028_755_453_05,
            driver_speed: 22.764_960_53,
            driven_radius: 0.045_679_134_25,
            centre_distance: 0.204_339_994_5,
            load: tractive(245.831_713, 560.0),
            ..kim(law, 0.25)
        };
        let state = solve(&Drive::from(drive), &SolveOptions::default()).unwrap();
        let speed = state.driven.angular_speed;
        assert!((speed / 8.397_57 - 1.0).abs() < 1e-5, "{speed}");
    }

    #[test]
    fn a_load_between_two_branches_is_lowered_from_a_larger_one() {
        let law = FrictionLaw::Epp {
            stiffness: 7.9906e7,
        };
        let drive = TwoPulleys {
            belt: v_belt([0.150_527_75, 23_290.782_6, 1.611_748_19e7, 0.222_320_323]),
            friction_coefficient: 0.293_666_66,
            driver_radius: 0.026_293_783,
            driver_speed: 293.877_126,
            driven_radius: 0.062_089_964,
            centre_distance: 0.205_130_998,
            load: tractive(647.104_648, 1800.0),
            ..kim(law, 0.25)
        };
        let state = solve(&Drive::from(drive), &SolveOptions::default()).unwrap();
        let slips = [&state.driver, &state.driven].map(|pulley| pulley.least_slip.unwrap().slip);
        assert!(slips[0] > 0.005 && slips[1] > 0.005, "{slips:?}");
    }

    #[test]
    fn beyond_a_limit_with_elastic_friction_no_normalised_direction_is_tried() {
        let law = FrictionLaw::Epp {
            stiffness: 3.205_731e6,
        };
        let drive = TwoPulleys {
            belt: v_belt([0.061_204_77, 212_798.5, 1.375_931e6, 0.353_422_7]),
            friction_coefficient: 0.716_296_7,
            driver_radius: 0.327_539_7,
            driver_speed: 12.092_17,
            driven_radius: 0.241_27,
            centre_distance: 1.358_765,
            load: tractive(316.717_4, 942.983_7),
            ..kim(law, 0.25)
        };
        let drive = Drive::from(drive);
        let mut path = Path::new(&drive, 1e-6);
        let refused = by_branch(&mut path, Instant::now(), false).unwrap();
        let Err(SolveError::NoSteadyState { limit, .. }) = refused else {
            panic!("{refused:?}");
        };
        assert!((limit / 396.9556 - 1.0).abs() < 1e-5, "{limit}");
        let steps = path.stats.newton_steps;
        assert!(steps <= 1000, "{steps}");
    }
}
