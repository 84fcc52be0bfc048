//! What is watched for along a branch.

use super::curve::Curve;
use super::path::Solved;
use super::tracer::Tracer;
use super::{BeltProblem, DRIVEN, DRIVER, DriveProblem, INCLINATION, PENETRATION, deepening};
use crate::{EventKind, Role};
use continuation::{Branch, Kind, Point, System};
use std::f64::consts::FRAC_PI_2;

/// Event functions of every piece, by their number; those of the zones follow.
const OVERHANG: [usize; 2] = [0, 1];
const DRIVEN_STOPS: usize = 2;
const BELT_HEIGHT: [usize; 2] = [3, 4];
pub(super) const FIRST_ZONE: usize = 5;

impl Tracer<'_> {
    /// Adds the event functions to a piece of the branch.
    pub(super) fn with_events<'a>(
        &self,
        branch: Branch<'a, Curve<'a>>,
        solved: &Solved,
        constants: usize,
    ) -> Branch<'a, Curve<'a>> {
        let problem = &solved.problem;
        let exits = [DRIVEN, DRIVER].map(|pulley| problem.zones(pulley).end - 1);
        let parameter = move |curve: &Curve<'_>, point: &Point, index: usize| {
            point.z[curve.unknowns() - 1 - constants + index]
        };
        let overhang = |exit: usize| {
            move |curve: &Curve<'_>, point: &Point| {
                curve.family.end(&point.z, exit)[INCLINATION] - FRAC_PI_2
            }
        };
        let height = self.drive.belt.v().height;
        let radius = problem.scales().radius;
        let sunk = |pulley: usize| {
            let zones = problem.zones(pulley);
            move |curve: &Curve<'_>, point: &Point| {
                let Some(height) = height else {
                    return -1.0;
                };
                let solution = curve.family.solution(&point.z);
                let rim_speed = parameter(curve, point, pulley);
                let depths = zones.clone().flat_map(|segment| {
                    let nodes = 0..solution.mesh(segment).len();
                    let depth = |node| solution.node(segment, node)[PENETRATION];
                    nodes.map(depth).collect::<Vec<_>>()
                });
                let deepest = depths.fold(0.0, f64::max) / deepening(rim_speed);
                deepest * radius[pulley] / height - 1.0
            }
        };
        let mut branch = branch
            .event(overhang(exits[DRIVEN]))
            .event(overhang(exits[DRIVER]))
            .event(move |curve, point| parameter(curve, point, DriveProblem::DRIVEN_RIM_SPEED))
            .event(sunk(DRIVEN))
            .event(sunk(DRIVER));
        if problem.has_junctions() {
            for segment in 0..problem.zones(DRIVER).end {
                let index = DriveProblem::length_index(segment);
                let length = move |curve: &Curve<'_>, point: &Point| parameter(curve, point, index);
                branch = match is_part(problem, segment) {
                    true => branch.change(length),
                    false => branch.event(length),
                };
            }
        }
        branch
    }

    /// What happens at a point.
    pub(super) fn kind(&self, point: &Point, here: &Solved) -> Option<EventKind> {
        let pulleys = [Role::Driven, Role::Driver];
        match point.kind {
            Kind::Start if self.points.is_empty() => Some(EventKind::Start),
            Kind::LimitPoint => Some(EventKind::LimitPoint),
            Kind::BranchPoint => Some(EventKind::BranchPoint),
            Kind::Event(DRIVEN_STOPS) => Some(EventKind::GrossSlip(Role::Driven)),
            Kind::Event(index) if OVERHANG.contains(&index) => {
                Some(EventKind::Overhang(pulleys[index - OVERHANG[0]]))
            }
            Kind::Event(index) if BELT_HEIGHT.contains(&index) => {
                Some(EventKind::BeltHeight(pulleys[index - BELT_HEIGHT[0]]))
            }
            Kind::Event(index) if index >= FIRST_ZONE => {
                let segment = index - FIRST_ZONE;
                let pulley = here.problem.pulley(segment);
                (!is_part(&here.problem, segment)).then(|| EventKind::ZoneVanishes {
                    pulley: pulleys[pulley],
                    kind: here.problem.regime(segment).kind(),
                })
            }
            _ => None,
        }
    }
}

/// Whether a segment is a part of a zone of one kind: that it vanishes is no event.
fn is_part(problem: &DriveProblem, segment: usize) -> bool {
    let zones = problem.zones(problem.pulley(segment));
    let kind = |segment| problem.regime(segment).kind();
    (segment > zones.start && kind(segment - 1) == kind(segment))
        || (segment + 1 < zones.end && kind(segment + 1) == kind(segment))
}
