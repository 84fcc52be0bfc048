//! From a solution to the steady state in SI units, with its checks.

use super::path::{Path, Solved};
use super::{DRIVEN, DRIVER, DriveProblem, EndAngles, INCLINATION, LAW, Law, MAX_STATES, Regime};
use crate::steady_state::{
    Check, Convergence, Profile, Pulley, PulleyState, SteadyState, Warning, Zone, ZoneKind,
};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;
use web_time::Instant;

/// Gauss rule with four points on \[0, 1\] for integrals over a mesh interval (abscissae ±x₁, ±x₂
/// and weights of the rule on \[−1, 1\], Abramowitz & Stegun table 25.4).
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_2, 0.173_927_422_568_726_93),
];
/// Profiles have at least so many points per pulley.
const PROFILE_POINTS: usize = 240;
/// Bristles deflected to this share of their limit count as slipping.
const SLIPPING_BRISTLES: f64 = 0.99;

/// Integrals over the contact with one pulley, scaled.
#[derive(Clone, Copy, Debug, Default)]
struct Integrals {
    torque: f64,
    friction: f64,
    stored: f64,
    unstretched: f64,
}

/// The steady state of a solved drive.
pub(super) fn steady_state(path: &Path<'_>, solved: Solved, start: Instant) -> SteadyState {
    let mut state = describe(path, &solved);
    state.convergence.seconds = start.elapsed().as_secs_f64();
    state.restart = Some(Arc::new(solved));
    state
}

/// The numbers of a steady state.
pub(super) fn describe(path: &Path<'_>, solved: &Solved) -> SteadyState {
    let problem = &solved.problem;
    let scales = problem.scales();
    let p = solved.solution.parameters();
    let flow = DriveProblem::flow(p);
    let strand = problem.groove(DRIVER).strand;
    let integrals = [DRIVEN, DRIVER].map(|pulley| integrate(solved, pulley));
    let ends = [DRIVEN, DRIVER].map(|pulley| end_angles(solved, pulley));
    let spans = [DRIVEN, DRIVER].map(|from| problem.layout().span(from, ends));

    let [tight, slack] = [solved.entry(DRIVER), solved.exit(DRIVER)].map(|y| y[super::TENSION]);
    let unstretched_span =
        |length: f64, tractive: f64| length / (1.0 + strand.strain(strand.tension(tractive, flow)));
    let contact_length = |pulley: usize| integrals[pulley].unstretched * scales.radius[pulley];

    let powers =
        [DRIVEN, DRIVER].map(|pulley| integrals[pulley].torque * DriveProblem::speed(pulley, p));
    let [taken, given] = [powers[DRIVEN], -powers[DRIVER]];
    let friction = integrals[DRIVEN].friction + integrals[DRIVER].friction;

    let state = |pulley: usize| pulley_state(solved, pulley, integrals[pulley]);
    let (driven, driver) = (state(DRIVEN), state(DRIVER));
    let warnings = [(Pulley::Driven, &driven), (Pulley::Driver, &driver)]
        .into_iter()
        .filter_map(|(pulley, state)| {
            let steepest = state.profile.inclination.iter().copied();
            let inclination = steepest.fold(0.0, |m: f64, theta| m.max(theta.abs()));
            (inclination > FRAC_PI_2).then_some(Warning::Overhang {
                pulley,
                inclination,
            })
        })
        .collect();
    let force = |scaled: f64| scaled * scales.force;
    SteadyState {
        drive: path.drive.clone(),
        mass_flow: flow * scales.mass_flow(),
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
        friction_loss: friction * scales.power(),
        driver,
        driven,
        warnings,
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
            slip_normalisation: match problem.groove(DRIVER).law {
                Law::Bristle { .. } => 0.0,
                Law::Coulomb | Law::Epp { .. } => problem.epsilon(),
            },
            slip_normalisation_effect: path.epsilon_effect,
            seconds: 0.0,
        },
        restart: None,
    }
}

/// The inclination at entry and exit of a pulley.
fn end_angles(solved: &Solved, pulley: usize) -> EndAngles<f64> {
    EndAngles {
        entry: solved.entry(pulley)[INCLINATION],
        exit: solved.exit(pulley)[INCLINATION],
    }
}

/// Calls `visit(segment, s, weight, y)` at the points of a rule that integrates over the scaled
/// arc length of a pulley.
fn for_each_point(solved: &Solved, pulley: usize, mut visit: impl FnMut(usize, f64, f64, &[f64])) {
    let p = solved.solution.parameters();
    for segment in solved.problem.zones(pulley) {
        let length = p[DriveProblem::length_index(segment)];
        let mut y = [0.0; MAX_STATES];
        let y = &mut y[..solved.solution.segments()[segment].states];
        for pair in solved.solution.mesh(segment).windows(2) {
            let h = pair[1] - pair[0];
            for (point, weight) in GAUSS {
                let s = pair[0] + point * h;
                solved.solution.state(segment, s, y);
                visit(segment, s, weight * h * length, y);
            }
        }
    }
}

fn integrate(solved: &Solved, pulley: usize) -> Integrals {
    let p = solved.solution.parameters();
    let groove = solved.problem.groove(pulley);
    let mut sum = Integrals::default();
    for_each_point(solved, pulley, |segment, _, weight, y| {
        let contact = solved.problem.contact(segment, y, p);
        sum.torque += weight * contact.torque_density();
        sum.friction += weight * contact.friction_power_density();
        sum.stored += weight * contact.transverse_power_density(groove);
        sum.unstretched += weight * contact.unstretched_rate(&groove.strand);
    });
    sum
}

/// The invariants of a steady state, recomputed from the profiles.
///
/// ```text
/// moment    ∫ t r ds = [F r cos θ] on each pulley
/// power     M₂ ω₂ = M₁ ω₁ + friction + transverse work,  friction ≥ 0
/// closure   the belt laid out in the plane returns to its beginning
/// pressure  p ≥ 0
/// zones     elastic friction below its limit, slipping friction at it (EPP)
/// ```
fn checks(path: &Path<'_>, solved: &Solved, integrals: [Integrals; 2]) -> Vec<Check> {
    let problem = &solved.problem;
    let p = solved.solution.parameters();
    // Integrals of the continuous solution are as accurate as its defect.
    let limit = 10.0 * path.tolerance;
    let tight = solved.tight_tension().abs();
    let moment = |pulley: usize| {
        let arm =
            |y: &[f64]| y[super::TENSION] * (1.0 - y[super::PENETRATION]) * y[INCLINATION].cos();
        let change = arm(solved.exit(pulley)) - arm(solved.entry(pulley));
        (integrals[pulley].torque - change).abs() / tight
    };
    let friction = integrals[DRIVEN].friction + integrals[DRIVER].friction;
    let given = -integrals[DRIVER].torque;
    let taken = integrals[DRIVEN].torque * DriveProblem::speed(DRIVEN, p);
    let stored = integrals[DRIVEN].stored + integrals[DRIVER].stored;

    let ends = [DRIVEN, DRIVER].map(|pulley| end_angles(solved, pulley));
    let swept = [DRIVEN, DRIVER].map(|pulley| solved.exit(pulley)[super::ANGLE]);
    let misfit = problem.layout().plan(ends, swept).misfit(problem.layout());
    let [gap, kink, distance] = misfit.map(f64::abs);
    let centre_distance = problem.layout().centre_distance;

    let (mut lowest, mut highest, mut wrong) = (0.0f64, 0.0f64, 0.0f64);
    for pulley in [DRIVEN, DRIVER] {
        for_each_point(solved, pulley, |segment, _, _, y| {
            let pressure = problem.contact(segment, y, p).pressure;
            lowest = lowest.min(pressure);
            highest = highest.max(pressure);
            let excess = super::limit_excess(
                problem.groove(pulley),
                y,
                DriveProblem::speed(pulley, p),
                DriveProblem::flow(p),
            );
            wrong = wrong.max(match problem.regime(segment) {
                Regime::Elastic => excess,
                Regime::Slip => -excess,
                Regime::Either => 0.0,
            });
        });
    }
    let check = |name, deviation, limit| Check {
        name,
        deviation,
        limit,
    };
    let mut checks = vec![
        check(
            "effect of the slip normalisation",
            path.epsilon_effect,
            path.tolerance,
        ),
        check("moment balance on the driven pulley", moment(DRIVEN), limit),
        check("moment balance on the driver", moment(DRIVER), limit),
        check(
            "power balance",
            (given - taken - friction - stored).abs() / tight,
            limit,
        ),
        check(
            "friction loss not negative",
            (-friction).max(0.0) / tight,
            limit,
        ),
        check(
            "closure of the belt",
            kink.max(gap / centre_distance)
                .max(distance / centre_distance),
            limit,
        ),
        check(
            "normal pressure not negative",
            (-lowest).max(0.0) / highest,
            limit,
        ),
    ];
    if problem.has_zones() {
        checks.push(check("friction within its limit", wrong / highest, limit));
    }
    checks
}

/// One pulley in SI units.
fn pulley_state(solved: &Solved, pulley: usize, integrals: Integrals) -> PulleyState {
    let problem = &solved.problem;
    let (scales, p) = (problem.scales(), solved.solution.parameters());
    let EndAngles { entry, exit } = end_angles(solved, pulley);
    let profile = profile(solved, pulley);
    let sense = if pulley == DRIVEN { 1.0 } else { -1.0 };
    let deepest = profile.penetration.iter().copied().fold(0.0, f64::max);
    PulleyState {
        angular_speed: DriveProblem::speed(pulley, p) * scales.angular_speed(pulley),
        torque: sense * integrals.torque * scales.torque(pulley),
        wrap_angle: solved.exit(pulley)[super::ANGLE],
        max_penetration: deepest,
        inclination: [entry, exit],
        zones: friction_zones(solved, pulley),
        entry: None,
        profile,
    }
}

/// The belt along one pulley in SI units.
fn profile(solved: &Solved, pulley: usize) -> Profile {
    let problem = &solved.problem;
    let (scales, p) = (problem.scales(), solved.solution.parameters());
    let radius = scales.radius[pulley];
    let intervals: usize = problem
        .zones(pulley)
        .map(|i| solved.solution.mesh(i).len() - 1)
        .sum();
    let parts = PROFILE_POINTS.div_ceil(intervals);
    let mut profile = Profile::default();
    let (mut before, mut stretched) = (0.0, 0.0);
    // Entry tension, at which the belt of a law without elastic displacement has none.
    let mut reference = None;
    let mut last: Option<(f64, f64)> = None;
    for segment in problem.zones(pulley) {
        let length = p[DriveProblem::length_index(segment)];
        let mesh = solved.solution.mesh(segment);
        let mut y = [0.0; MAX_STATES];
        let y = &mut y[..solved.solution.segments()[segment].states];
        let mut add = |s: f64, y: &mut [f64]| {
            solved.solution.state(segment, s, y);
            let contact = problem.contact(segment, y, p);
            let place = before + s * length;
            let reference = *reference.get_or_insert(contact.tension);
            let rate = contact.displacement_rate(reference);
            if let Some((at, rate_before)) = last {
                stretched += 0.5 * (place - at) * (rate + rate_before);
            }
            last = Some((place, rate));
            let displacement = match problem.groove(pulley).law {
                Law::Epp { .. } => y[LAW],
                Law::Coulomb | Law::Bristle { .. } => stretched,
            };
            profile.angle.push(y[super::ANGLE]);
            profile.arc_length.push(place * radius);
            profile.tension.push(contact.tension * scales.force);
            profile
                .tractive_tension
                .push(contact.tractive * scales.force);
            profile.inclination.push(y[INCLINATION]);
            profile.penetration.push(y[super::PENETRATION] * radius);
            profile
                .displacement
                .push(displacement * scales.displacement(pulley));
            profile.sliding_angle.push(contact.sliding_angle());
            profile
                .normal_force
                .push(contact.pressure * scales.line_load(pulley));
            profile
                .friction_force
                .push(contact.friction() * scales.line_load(pulley));
        };
        for pair in mesh.windows(2) {
            for part in 0..parts {
                add(
                    pair[0] + (pair[1] - pair[0]) * part as f64 / parts as f64,
                    y,
                );
            }
        }
        add(1.0, y);
        before += length;
    }
    profile
}

/// The zones of friction on one pulley, by swept angle.
fn friction_zones(solved: &Solved, pulley: usize) -> Vec<Zone> {
    let problem = &solved.problem;
    let mut zones: Vec<Zone> = Vec::new();
    let mut extend = |kind: ZoneKind, from: f64, to: f64| match zones.last_mut() {
        Some(zone) if zone.kind == kind => zone.to = to,
        _ => zones.push(Zone { kind, from, to }),
    };
    if problem.has_zones() && !problem.is_split() {
        for (regime, [from, to]) in super::zones::angles(solved, pulley) {
            let kind = match regime {
                Regime::Elastic => ZoneKind::Elastic,
                Regime::Slip | Regime::Either => ZoneKind::Slip,
            };
            extend(kind, from, to);
        }
        return zones;
    }
    for segment in problem.zones(pulley) {
        let angle = |y: &[f64]| y[super::ANGLE];
        let ends = [solved.solution.start(segment), solved.solution.end(segment)].map(angle);
        match (problem.groove(pulley).law, problem.regime(segment)) {
            (Law::Epp { .. }, Regime::Elastic) => extend(ZoneKind::Elastic, ends[0], ends[1]),
            (Law::Coulomb | Law::Epp { .. }, _) => extend(ZoneKind::Slip, ends[0], ends[1]),
            (Law::Bristle { .. }, _) => {
                let limit = SLIPPING_BRISTLES * problem.groove(pulley).friction_coefficient;
                let mut y = [0.0; MAX_STATES];
                let y = &mut y[..solved.solution.segments()[segment].states];
                let mut from = ends[0];
                for pair in solved.solution.mesh(segment).windows(2) {
                    for part in 1..=4 {
                        let s = pair[0] + (pair[1] - pair[0]) * f64::from(part) / 4.0;
                        solved.solution.state(segment, s, y);
                        let deflection = y[LAW].hypot(y[LAW + 1]);
                        let kind = if deflection < limit {
                            ZoneKind::Elastic
                        } else {
                            ZoneKind::Slip
                        };
                        extend(kind, from, angle(y));
                        from = angle(y);
                    }
                }
            }
        }
    }
    // The entry is where the angle begins; its solved value is rounding.
    if let Some(first) = zones.first_mut() {
        first.from = 0.0;
    }
    zones
}
