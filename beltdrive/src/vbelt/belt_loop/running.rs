//! The search for the running loop under its whole load.

use super::super::BeltProblem;
use super::super::carried::{Carried, Extrapolated};
use super::super::creep::{CREEP, begins_at_rest};
use super::super::groove::TENSION;
use super::super::laws::Asked;
use super::super::path::{Effort, Solved};
use super::climb::{Climbed, Top};
use super::elastic_limit::Unelastic;
use super::guess::on_pitch_line;
use super::like::Like;
use super::problem::LoopProblem;
use super::rest::Rest;
use super::round::Target;
use super::slipping::slip;
use super::solve::{Search, lost};
use super::start::Start;
use super::stiffening::is_followed;
use crate::drive::layout::Layout;
use crate::{Drive, FrictionLaw, SolveError};
use bvp::Problem;

/// Shares of the load that are tried in turn where the whole fails; from them the load is raised.
const SHARES: [f64; 6] = [0.5, 0.2, 0.05, 0.01, 1e-3, 0.0];
/// Factor between the stiffness of bristles with which the load is raised in place of Coulomb friction and that of the next
/// ones, ...
const STIFFER: f64 = 3.0;
/// ... and how often it is raised: of bristles up to 81 times as stiff. With a factor of 10 the curve of the stiffest was lost
/// for `spb-fan` with μ = 0.6 and 33 N, whose belt locks with ones that are 30 times as stiff.
const CLIMBS: usize = 5;
/// Where the belt leaves a pulley more steeply than this, or a pulley loses more than this share of its
/// speed, a state may lie beyond the largest load.
const STEEP: f64 = 1.3;
pub(super) const SLOW: f64 = 0.5;
/// Share of a load under which the slip tells whether it begins at rest.
const LESS: f64 = 0.9;

/// A running loop.
pub(super) struct Running<'l> {
    /// To the tolerance.
    pub(super) solved: Solved<LoopProblem>,
    /// How it was stated.
    pub(super) start: Start<'l>,
    /// Roughly, if the load was raised to it.
    raised: Option<Solved<LoopProblem>>,
}

impl<'l> Start<'l> {
    /// The loop that was found so, roughly too if its load was raised.
    fn found(
        &self,
        solved: Solved<LoopProblem>,
        raised: Option<Solved<LoopProblem>>,
    ) -> Running<'l> {
        Running {
            solved,
            start: self.clone(),
            raised,
        }
    }
}

impl Running<'_> {
    /// The loop roughly, with one zone on every pulley, and with bristles where friction changes abruptly, so that
    /// curves of states can be followed from it.
    pub(super) fn roughly(
        &self,
        search: &mut Search<'_>,
    ) -> Result<Solved<LoopProblem>, bvp::Error> {
        match &self.raised {
            Some(raised) => {
                let bristles = search.bristles_near(&self.start, raised);
                Ok(bristles.unwrap_or_else(|| raised.clone()))
            }
            None => {
                let entered = search.enter_bristles(&self.start);
                entered.map_err(|stuck| stuck.cause)
            }
        }
    }

    /// The loop with a law whose curve of states can be followed to a limit that is that of its own law.
    pub(super) fn followed(&self, search: &mut Search<'_>) -> Option<Solved<LoopProblem>> {
        if is_followed(&self.solved) {
            return Some(self.solved.clone());
        }
        let bristles = self.roughly(search).ok()?;
        search.with_direction_near(&Like::new(search.drive, &bristles), &bristles)
    }
}

/// The running loop under its whole load: at once where Newton's method finds it and it cannot lie
/// beyond the largest load, else by raising a share of the load.
pub(super) fn running<'l>(
    search: &mut Search<'l>,
    target: Target,
    rest: Option<&Rest>,
    coordinate: f64,
) -> Result<Running<'l>, SolveError> {
    let drive = search.drive;
    let layout = drive.layout(coordinate)?;
    presses(search, target, &layout)?;
    let whole = Start::new(
        drive,
        layout,
        target,
        rest.map(|rest| rest.tension),
        coordinate,
    );
    let direct = match whole.is_taut() {
        true => search.seek(&whole).map_err(|stuck| Some(stuck.cause)),
        false => Err(None),
    };
    let direct = match direct {
        Ok(solved) if search.is_led_to(&solved) => return Ok(whole.found(solved, None)),
        other => other,
    };
    match (
        raised(search, &whole, &SHARES.map(|share| whole.under(share))),
        direct,
    ) {
        (Ok(Some(found)), _) => Ok(found),
        (Err(SolveError::Unreached { .. }), Ok(solved)) if is_safe(&solved) => {
            Ok(whole.found(solved, None))
        }
        (Err(error), _) => Err(error),
        (Ok(None), Ok(solved)) if is_drive(&solved) => Ok(whole.found(solved, None)),
        (Ok(None), Err(Some(cause))) => Err(lost(0.0, &cause)),
        (Ok(None), _) => Err(SolveError::Unreached {
            reached: 0.0,
            cause: "the belt would have to push in a span even under hardly any load",
        }),
    }
}

/// The running loop under its whole load, raised from the first of some shares of it that is found; `None` where none is.
fn raised<'l>(
    search: &mut Search<'_>,
    whole: &Start<'l>,
    shares: &[Start<'_>],
) -> Result<Option<Running<'l>>, SolveError> {
    let drive = search.drive;
    let shares = || shares.iter().filter(|share| share.is_taut());
    let has_direction = matches!(drive.law, FrictionLaw::Coulomb | FrictionLaw::Epp { .. });
    for share in shares().filter(|_| has_direction) {
        match along_direction(search, share) {
            Along::Carries(solved) => return Ok(Some(whole.found(*solved, None))),
            Along::Ends(top) if drive.law == FrictionLaw::Coulomb => {
                return Err(overloaded(drive, &top));
            }
            // Where scalar EPP friction has a limit point, states with the belt at rest on other arcs may lead on.
            Along::Ends(_) => break,
            Along::Lost => {}
        }
    }
    let unelastic = Unelastic::of(whole);
    let mut is_carried = false;
    if let Some(unelastic) = &unelastic
        && let Some((limit, _)) = search.elastic_limit(whole, unelastic)
    {
        if limit.top.factor <= 1.0 {
            return Err(overloaded(drive, &limit.top));
        }
        is_carried = true;
        if let Some(solved) = search.elastic(whole, unelastic) {
            return Ok(Some(whole.found(solved, None)));
        }
    }
    // The limit of scalar EPP friction is often another one than that of stiff bristles, by which it took six times as long.
    if drive.law == FrictionLaw::Coulomb
        && let Some(solved) = over_bristles(search, shares())
    {
        return Ok(Some(whole.found(solved, None)));
    }
    for share in shares() {
        let entered = search.enter(share).ok();
        let Some(rough) = entered.filter(|rough| search.is_led_to(rough)) else {
            continue;
        };
        let raised = match raise(search, share, &rough) {
            // Another curve leads to more.
            Err(SolveError::Overloaded { load_factor, .. }) if is_carried => {
                return Err(too_abrupt(load_factor));
            }
            outcome => outcome?,
        };
        return match search.seek_from(whole, &raised) {
            Ok(solved) => Ok(Some(whole.found(solved, Some(raised)))),
            Err(stuck) => Err(match search.limit_by_bristles(share) {
                Some(top) if top.factor <= 1.0 && !is_carried => overloaded(drive, &top),
                _ => lost(1.0, &stuck.cause),
            }),
        };
    }
    Ok(None)
}

/// Where a load that is raised with Coulomb or EPP friction whose direction is a state comes to.
enum Along {
    /// The whole load.
    Carries(Box<Solved<LoopProblem>>),
    /// The largest load, which is less.
    Ends(Top),
    /// It is not followed so far.
    Lost,
}

/// The whole load, raised from a share of it with Coulomb or EPP friction whose direction is a state.
fn along_direction(search: &mut Search<'_>, share: &Start<'_>) -> Along {
    let bristles = search.enter_bristles(share).ok();
    let bristles = bristles.filter(|bristles| search.is_led_to(bristles));
    let begin = bristles.and_then(|bristles| search.with_direction_near(share, &bristles));
    match begin.map(|begin| search.climb(&begin, 1.0, None)) {
        Some(Climbed::Reached(raised)) => match search.finish_obeying(*raised) {
            Ok(solved) => Along::Carries(Box::new(solved)),
            Err(_) => Along::Lost,
        },
        Some(Climbed::Limit(limit)) => Along::Ends(limit.top),
        Some(Climbed::Lost { .. }) | None => Along::Lost,
    }
}

/// The whole load with Coulomb friction, from that with bristles raised from the first of some shares of it at which they
/// are found: with stiffer ones where soft ones end before. Those of `spb-fan` with μ = 0.6 and 40 N slip grossly at 0.12 of the
/// load, and ones that are ten times as stiff lock in the grooves, as Coulomb friction does.
fn over_bristles<'s>(
    search: &mut Search<'_>,
    mut shares: impl Iterator<Item = &'s Start<'s>>,
) -> Option<Solved<LoopProblem>> {
    let mut bristles = shares.find_map(|share| {
        let bristles = search.enter_bristles(share).ok();
        bristles.filter(|bristles| search.is_led_to(bristles))
    })?;
    for _ in 0..CLIMBS {
        match search.climb(&bristles, 1.0, None) {
            Climbed::Reached(raised) => {
                let near = Like::new(search.drive, &raised);
                let directed = search.with_direction_near(&near, &raised)?;
                return search.finish_obeying(directed).ok().filter(is_safe);
            }
            Climbed::Limit(_) | Climbed::Lost { .. } => {
                bristles = search.stiffer(&bristles, STIFFER).filter(is_safe)?;
            }
        }
    }
    None
}

/// The running loop under its whole load from a neighbour, and the one before that at an equal step, if Newton's method
/// finds it and it cannot lie beyond the largest load.
pub(super) fn neighbouring<'s>(
    search: &mut Search<'_>,
    near: [Option<&'s Solved<LoopProblem>>; 2],
    target: Target,
    rest: Option<&Rest>,
    coordinate: f64,
) -> Option<Solved<LoopProblem>> {
    let drive = search.drive;
    let layout = drive.layout(coordinate).ok()?;
    presses(search, target, &layout).ok()?;
    let start = Start::new(
        drive,
        layout,
        target,
        rest.map(|rest| rest.tension),
        coordinate,
    );
    if !start.is_taut() {
        return None;
    }
    let problem = start.problem(drive.law, 0.0);
    let like = |near: Option<&'s Solved<LoopProblem>>| {
        near.filter(|near| problem.segments() == near.problem.segments())
    };
    let [last, before] = near.map(like);
    let last = last?;
    let by_both = before.and_then(|before| {
        let guess = Extrapolated { last, before };
        search.attempt(problem.clone(), &guess, Effort::Final).ok()
    });
    let by_both = by_both.filter(|solved| search.is_led_to(solved));
    by_both.or_else(|| {
        let by_last = search.attempt(problem, &Carried(last), Effort::Final);
        by_last.ok().filter(|solved| search.is_led_to(solved))
    })
}

/// Whether a belt between fixed centres presses on its pulleys without torques. Where it hardly presses
/// it does not sink either: the tractive tension of its pitch line decides, in N, where it can be told.
pub(super) fn presses(
    search: &Search<'_>,
    target: Target,
    layout: &Layout,
) -> Result<Option<f64>, SolveError> {
    let (Target::Length(length), None) = (target, search.drive.tensioner()) else {
        return Ok(None);
    };
    let [_, tractive_tension] = on_pitch_line(search.drive, layout, length);
    match tractive_tension > 0.0 {
        true => Ok(Some(tractive_tension)),
        false => Err(SolveError::LiftsOff {
            tractive_tension,
            speed: search.drive.rim_speed(),
            is_loaded: false,
        }),
    }
}

/// Raises the load of a state, that of a start entered, to the whole.
fn raise(
    search: &mut Search<'_>,
    start: &Start<'_>,
    from: &Solved<LoopProblem>,
) -> Result<Solved<LoopProblem>, SolveError> {
    let limit = match search.climb(from, 1.0, None) {
        Climbed::Reached(raised) => return Ok(*raised),
        Climbed::Limit(limit) => limit,
        Climbed::Lost { reached, cause } => return Err(SolveError::Unreached { reached, cause }),
    };
    match search.limit_by_bristles(start) {
        Some(top) if top.factor > 1.0 => {
            let reached = limit.top.factor;
            let sharper = search.climb_sharper(*limit, 1.0);
            sharper.ok_or(too_abrupt(reached))
        }
        Some(top) => Err(overloaded(search.drive, &top)),
        // It may be less than the limit is known to, or than the largest load.
        None if limit.top.factor * (1.0 + limit.top.error) > 1.0 || !limit.is_largest() => {
            Err(too_abrupt(limit.top.factor))
        }
        None => Err(overloaded(search.drive, &limit.top)),
    }
}

/// The load may be below the largest, but is not reached.
fn too_abrupt(reached: f64) -> SolveError {
    SolveError::Unreached {
        reached,
        cause: "friction changes too abruptly so near to the largest load",
    }
}

/// The load is above the largest.
pub(super) fn overloaded(drive: &Drive, top: &Top) -> SolveError {
    SolveError::Overloaded {
        pulley: drive.pulleys[top.pulley].name.clone(),
        load_factor: top.factor,
        overhangs: top.overhangs,
    }
}

impl Search<'_> {
    /// Whether it is the state of a drive to which a rising load leads from rest, as far as a glance at it tells.
    fn is_led_to(&mut self, solved: &Solved<LoopProblem>) -> bool {
        is_safe(solved) && self.slip_begins_at_rest(solved)
    }

    /// Whether the slip of every pulley begins at rest, as that under a little less load tells of those that slip all along.
    fn slip_begins_at_rest(&mut self, solved: &Solved<LoopProblem>) -> bool {
        let pulleys = 0..solved.problem.pulleys();
        let slipping: Vec<_> = pulleys
            .filter(|&pulley| slip(solved, pulley) > CREEP)
            .collect();
        if slipping.is_empty() {
            return true;
        }
        let loads = [LESS, 1.0].map(|share| share * solved.factor());
        let problem = solved.problem.clone().with_factor(loads[0]);
        let Ok(lighter) = self.attempt(problem, &Carried(solved), Effort::Rough) else {
            return false;
        };
        slipping.into_iter().all(|pulley| {
            let slips = [&lighter, solved].map(|state| slip(state, pulley));
            begins_at_rest(slips, loads, 0.0)
        })
    }
}

/// Whether the state may lie beyond the largest load.
fn may_be_beyond(solved: &Solved<LoopProblem>) -> bool {
    let p = solved.solution.parameters();
    let ends = solved.round(|round| round.end_angles());
    let mut pulleys = 0..solved.problem.pulleys();
    ends.iter().any(|ends| ends.exit > STEEP)
        || pulleys.any(|pulley| solved.problem.omega(pulley, p) < SLOW)
}

/// Whether it is the state of a drive that cannot lie beyond the largest load.
pub(super) fn is_safe(solved: &Solved<LoopProblem>) -> bool {
    is_drive(solved) && !may_be_beyond(solved)
}

/// Whether the belt pulls in all spans, turns every pulley forwards and touches it.
pub(super) fn is_drive(solved: &Solved<LoopProblem>) -> bool {
    let p = solved.solution.parameters();
    let Solved { problem, solution } = solved;
    problem.flow(p) > 0.0
        && (0..problem.pulleys()).all(|pulley| problem.omega(pulley, p) > 0.0)
        && (0..problem.zoning().count())
            .all(|segment| problem.length(segment, p) > 0.0 && solution.end(segment)[TENSION] > 0.0)
}
