//! From a solution to the steady state in SI units, with its checks.

use super::carried::Carried;
use super::laws::{ALLOWED, GAINED, power_gained, wrong_friction};
use super::on_pulley::{Integrals, OnPulley, extend};
use super::path::{Effort, Path, Solved};
use super::{BeltProblem, DRIVEN, DRIVER, EndAngles};
use crate::results::possible;
use crate::results::steady_state::{Check, Convergence, PulleyState, SteadyState, Zone};
use crate::results::v_warnings;
use std::sync::Arc;
use web_time::Instant;

/// The steady state of a solved drive.
pub(super) fn steady_state(path: &Path<'_>, solved: Solved, start: Instant) -> SteadyState {
    let mut state = describe(path, &solved);
    state.convergence.seconds = start.elapsed().as_secs_f64();
    state.restart = Some(Arc::new(solved));
    state
}

/// A sharper state with bristles aims at this share of the estimated error.
const OF_ERROR: f64 = 0.1;
/// Where friction is smoothed, that has more effect than the mesh: a sharper state has this share of ℓ or ε, and is
/// corrected to first order only.
const OF_SMOOTHING: f64 = 0.25;
/// Rounding hides what a smaller tolerance would tell.
const SMALLEST_TOLERANCE: f64 = 1e-12;

/// A steady state once more, from the solution behind it.
pub(crate) fn sharper(state: &SteadyState, solved: &Solved) -> Option<SteadyState> {
    let Convergence {
        tolerance,
        error_estimate,
        ..
    } = state.convergence;
    let smoothing = OF_SMOOTHING * solved.problem.smoothing();
    let problem = solved.problem.clone().with_smoothing(smoothing);
    if smoothing > 0.0 {
        let mut path = Path::new(&state.drive, tolerance);
        let solution = path.corrected(solved, &problem).ok()?;
        let mut sharper = describe(&path, &Solved { problem, solution });
        // That of a correction has the change of the direction by ℓ in it, which is large where the belt hardly slips.
        sharper.convergence.error_estimate = error_estimate;
        return Some(sharper);
    }
    let tolerance = (OF_ERROR * error_estimate.min(tolerance)).max(SMALLEST_TOLERANCE);
    let mut path = Path::new(&state.drive, tolerance);
    let sharper = path
        .attempt(problem, &Carried(solved), Effort::Final)
        .ok()?;
    Some(describe(&path, &sharper))
}

/// The numbers of a steady state.
pub(super) fn describe(path: &Path<'_>, solved: &Solved) -> SteadyState {
    let problem = &solved.problem;
    let scales = problem.scales();
    let p = solved.solution.parameters();
    let flow = problem.flow(p);
    let strand = problem.groove(DRIVER).strand;
    let on = [DRIVEN, DRIVER].map(|pulley| solved.on_pulley(pulley));
    let integrals = on.each_ref().map(OnPulley::integrate);
    let ends = on.each_ref().map(OnPulley::ends);
    let spans = [DRIVEN, DRIVER].map(|from| problem.layout().span(from, ends));

    let [tight, slack] = [solved.entry(DRIVER), solved.exit(DRIVER)].map(|y| y[super::TENSION]);
    let unstretched_span =
        |length: f64, tractive: f64| length / (1.0 + strand.strain(strand.tension(tractive, flow)));
    let contact_length = |pulley: usize| integrals[pulley].unstretched * scales.radius[pulley];

    // The moment of the tensions is as accurate as the nodes, the integral of friction as the mesh between them.
    let torques = on.each_ref().map(OnPulley::change_of_moment);
    let powers = [DRIVEN, DRIVER].map(|pulley| torques[pulley] * problem.omega(pulley, p));
    let [taken, given] = [powers[DRIVEN], -powers[DRIVER]];
    let friction = integrals[DRIVEN].friction + integrals[DRIVER].friction;

    let state = |pulley: usize| pulley_state(solved, pulley, torques[pulley]);
    let (driven, driver) = (state(DRIVEN), state(DRIVER));
    let force = |scaled: f64| scaled * scales.units.force;
    let stored = integrals[DRIVEN].stored + integrals[DRIVER].stored;
    let mut state = SteadyState {
        drive: path.drive.clone(),
        mass_flow: flow * scales.units.mass_flow(),
        belt_length: contact_length(DRIVEN)
            + contact_length(DRIVER)
            + unstretched_span(spans[DRIVEN], tight)
            + unstretched_span(spans[DRIVER], slack),
        slack_span: spans[DRIVER],
        tight_span: spans[DRIVEN],
        slack_tension: force(strand.tension(slack, flow)),
        tight_tension: force(strand.tension(tight, flow)),
        slack_tractive_tension: force(slack),
        tight_tractive_tension: force(tight),
        efficiency: if given > 0.0 {
            (taken / given).max(0.0)
        } else {
            0.0
        },
        friction_loss: friction * scales.units.power(),
        compression_power: stored * scales.units.power(),
        driver,
        driven,
        warnings: Vec::new(),
        checks: checks(path, solved, integrals),
        convergence: Convergence {
            tolerance: path.tolerance,
            defect: solved.solution.defect(),
            error_estimate: solved.solution.error_estimate().unwrap_or(f64::INFINITY),
            mesh_intervals: [DRIVER, DRIVEN].map(|pulley| {
                let segments = problem.zones(pulley);
                segments.map(|i| solved.solution.mesh(i).len() - 1).sum()
            }),
            newton_iterations: path.stats.newton_steps,
            rhs_evaluations: path.stats.rhs_evaluations,
            factorisations: path.stats.factorisations,
            continuation_steps: path.problems,
            slip_normalisation: problem.smoothing(),
            slip_normalisation_effect: path.smoothing_effect,
            seconds: 0.0,
        },
        restart: None,
    };
    state.checks.extend(possible::checks(&state));
    state.warnings = v_warnings::warnings(&state);
    state
}

/// The invariants of a steady state that its equations imply, recomputed from the solution.
///
/// ```text
/// moment    ∫ t r ds = [F r cos θ] on each pulley
/// closure   the belt laid out in the plane returns to its beginning
/// zones     elastic friction below its limit, slipping friction at it (EPP)
/// ```
fn checks(path: &Path<'_>, solved: &Solved, integrals: [Integrals; 2]) -> Vec<Check> {
    let problem = &solved.problem;
    let limit = ALLOWED * path.tolerance;
    let tight = solved.tight_tension().abs();
    let moment = |pulley: usize| {
        let change = solved.on_pulley(pulley).change_of_moment();
        (integrals[pulley].torque - change).abs() / tight
    };

    let on = [DRIVEN, DRIVER].map(|pulley| solved.on_pulley(pulley));
    let ends = on.each_ref().map(OnPulley::ends);
    let swept = [DRIVEN, DRIVER].map(|pulley| solved.exit(pulley)[super::ANGLE]);
    let misfit = problem.layout().plan(ends, swept).misfit(problem.layout());
    let [gap, kink, distance] = misfit.map(f64::abs);
    let centre_distance = problem.layout().centre_distance;
    let check = |name, deviation, limit| Check {
        name,
        deviation,
        limit,
    };
    let mut checks = vec![
        check(
            "effect of the smoothed direction of friction",
            path.smoothing_effect,
            path.tolerance,
        ),
        check("moment balance on the driven pulley", moment(DRIVEN), limit),
        check("moment balance on the driver", moment(DRIVER), limit),
        check(
            "closure of the belt",
            kink.max(gap / centre_distance)
                .max(distance / centre_distance),
            limit,
        ),
    ];
    if problem.has_direction() {
        let gained = power_gained(solved);
        let limit = GAINED * path.tolerance;
        checks.push(check("friction against the slip", gained, limit));
    }
    if problem.has_zones() {
        let wrong = wrong_friction(solved);
        checks.push(check("friction zones of their kind", wrong, limit));
    }
    checks
}

/// One pulley in SI units, from the scaled torque of the belt on it.
fn pulley_state(solved: &Solved, pulley: usize, torque: f64) -> PulleyState {
    let problem = &solved.problem;
    let (scales, p) = (problem.scales(), solved.solution.parameters());
    let radius = scales.radius[pulley];
    let on = solved.on_pulley(pulley);
    let EndAngles { entry, exit } = on.ends();
    let profile = on.profile();
    PulleyState {
        angular_speed: problem.omega(pulley, p) * scales.units.angular_speed(radius),
        torque: problem.sense(pulley) * torque * scales.units.torque(radius),
        wrap_angle: solved.exit(pulley)[super::ANGLE],
        geometric_wrap_angle: problem.layout().wraps([EndAngles::default(); 2])[pulley],
        max_penetration: on.max_penetration(),
        inclination: [entry, exit],
        zones: friction_zones(solved, pulley),
        entry: None,
        least_slip: Some(on.least_slip()),
        profile,
    }
}

/// The zones of friction on one pulley, by swept angle.
fn friction_zones(solved: &Solved, pulley: usize) -> Vec<Zone> {
    let problem = &solved.problem;
    if !problem.has_zones() || problem.is_split() {
        return solved.on_pulley(pulley).friction_zones();
    }
    let mut zones = Vec::new();
    for (regime, [from, to]) in super::zones::angles(solved, pulley) {
        extend(&mut zones, regime.kind(), from, to);
    }
    zones
}
