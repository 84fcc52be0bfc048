//! From a solved loop to its steady state in SI units.

use super::super::on_pulley::Integrals;
use super::super::path::Solved;
use super::super::{BeltProblem, EndAngles};
use super::checks::{Checked, polar, rim};
use super::contacts::{Touching, idle_profile};
use super::plane::Laid;
use super::problem::LoopProblem;
use super::rest::{Known, Rest, RestProblem};
use super::rest_guess::RestNear;
use super::solve::Search;
use super::tensioner::{held, length_derivatives};
use crate::mechanics::span::{DEFLECTION, first_frequency, rest_frequency};
use crate::results::loop_state::{
    Contacts, FrictionParts, GrooveState, LoopConvergence, LoopState, Profiles, PulleyState,
    SpanState, TensionerState,
};
use crate::{Duty, Mount, Profile, SolveError, Zone, ZoneKind};

/// How the belt of a solved loop lies.
struct Lying<'a> {
    laid: Laid<f64>,
    ends: Vec<EndAngles<f64>>,
    touching: Vec<Touching<'a>>,
    /// Tractive tension of each span, scaled.
    tractive: Vec<f64>,
}

impl<'a> Lying<'a> {
    fn of(solved: &'a Solved<LoopProblem>) -> Self {
        let problem = &solved.problem;
        let count = problem.seats.len();
        let (ends, tractive) = solved.round(|round| {
            let tractive: Vec<_> = (0..count).map(|span| round.leaving(span)).collect();
            (round.end_angles(), tractive)
        });
        let coordinate = problem.coordinate(solved.solution.parameters());
        let laid = problem.plane.lay(coordinate, &ends);
        let touching = (0..count).map(|pulley| solved.touching(pulley, laid.turned[pulley]));
        Self {
            touching: touching.collect(),
            laid,
            ends,
            tractive,
        }
    }

    /// The belt along a pulley.
    fn profile(&self, solved: &Solved<LoopProblem>, pulley: usize) -> Profile {
        let problem = &solved.problem;
        let force = problem.units.force;
        match &self.touching[pulley] {
            Touching::Groove(on) => on.profile(),
            Touching::Back(on) => on.profile(),
            Touching::Idle(wrap) => {
                let tractive = self.tractive[pulley];
                let flow = problem.flow(solved.solution.parameters());
                let tension = problem.units.strand().tension(tractive, flow);
                let radius = problem.plane.spots[pulley].radius;
                idle_profile(*wrap, radius, tension * force, tractive * force)
            }
        }
    }
}

/// A solved loop with what follows from its solution at once.
struct Seen<'a> {
    solved: &'a Solved<LoopProblem>,
    rest: &'a Rest,
    lying: Lying<'a>,
    integrals: Vec<Integrals>,
    /// Scaled angular speeds.
    omegas: Vec<f64>,
    /// Wraps, rad.
    wraps: Vec<f64>,
    coordinate: f64,
    flow: f64,
}

impl<'a> Seen<'a> {
    fn new(solved: &'a Solved<LoopProblem>, rest: &'a Rest) -> Self {
        let problem = &solved.problem;
        let p = solved.solution.parameters();
        let count = problem.seats.len();
        let coordinate = problem.coordinate(p);
        let lying = Lying::of(solved);
        let integrals = lying.touching.iter().map(|touching| match touching {
            Touching::Groove(on) => on.integrate(),
            Touching::Back(on) => on.integrate(),
            Touching::Idle(_) => Integrals::default(),
        });
        let (strand, flow) = (problem.units.strand(), problem.flow(p));
        let omegas = (0..count).map(|pulley| match problem.is_idle(pulley) {
            false => problem.omega(pulley, p),
            true => strand.speed(strand.tension(lying.tractive[pulley], flow), flow),
        });
        let wraps = lying.touching.iter().map(|touching| match touching {
            Touching::Groove(on) => on.exit()[super::super::ANGLE],
            Touching::Back(on) => on.wrap(),
            Touching::Idle(wrap) => *wrap,
        });
        Self {
            integrals: integrals.collect(),
            omegas: omegas.collect(),
            wraps: wraps.collect(),
            flow,
            solved,
            rest,
            lying,
            coordinate,
        }
    }

    /// Tractive tensions behind and before a pulley, scaled.
    fn around(&self, pulley: usize) -> [f64; 2] {
        let behind = self.solved.problem.plane.arriving(pulley);
        [behind, pulley].map(|span| self.lying.tractive[span])
    }

    /// Belt tension of a span, scaled.
    fn tension(&self, span: usize) -> f64 {
        let strand = self.solved.problem.units.strand();
        strand.tension(self.lying.tractive[span], self.flow)
    }

    fn pulley(&self, search: &Search<'_>, pulley: usize) -> PulleyState {
        let stated = &search.drive.pulleys[pulley];
        let problem = &self.solved.problem;
        let units = problem.units;
        let angular_speed = match stated.duty {
            Duty::Driver(speed) => speed,
            _ => self.omegas[pulley] * units.angular_speed(stated.radius),
        };
        let [behind, before] = self.around(pulley);
        let EndAngles { entry, exit } = self.lying.ends[pulley];
        let torque = match stated.duty {
            Duty::Torque(torque) => torque,
            _ => (before * exit.cos() - behind * entry.cos()) * units.torque(stated.radius),
        };
        let zones = self.zones(pulley);
        let arc_of = |slips: bool| {
            let zones = zones
                .iter()
                .filter(|zone| (zone.kind == ZoneKind::Slip) == slips);
            // An empty sum is −0.
            zones.map(|zone| zone.to - zone.from).sum::<f64>() + 0.0
        };
        let force = |load: [f64; 2], unit: f64| load.map(|part| part * unit);
        let plane = &problem.plane;
        PulleyState {
            name: stated.name.clone(),
            centre: self.centre(search, pulley, self.coordinate),
            angular_speed,
            torque,
            power: torque * angular_speed,
            wrap: self.wraps[pulley],
            rest_wrap: self.rest.wraps[pulley],
            no_slip_arc: arc_of(false),
            slip_arc: arc_of(true),
            zones,
            entry_strain: None,
            reference_tension: None,
            hub_load: force(
                self.lying.laid.hub_load(plane, pulley, [behind, before]),
                units.force,
            ),
            rest_hub_load: force(
                self.rest.laid.hub_load(plane, pulley, [1.0; 2]),
                self.rest.tension,
            ),
            speed_loss: 1.0 - self.omegas[pulley],
            friction_loss: self.integrals[pulley].friction * units.power(),
            friction_parts: self.friction_parts(pulley),
            friction_utilisation: None,
            torque_capacity: None,
            torque_margin: None,
            torque_margin_error: 0.0,
            groove: self.groove(pulley),
        }
    }

    fn centre(&self, search: &Search<'_>, pulley: usize, coordinate: f64) -> [f64; 2] {
        match &search.drive.pulleys[pulley].mount {
            Mount::Fixed(centre) => *centre,
            Mount::Tensioner(tensioner) => tensioner.guide.centre(coordinate)[0],
        }
    }

    fn friction_parts(&self, pulley: usize) -> FrictionParts {
        let Integrals {
            friction,
            wedging,
            elastic,
            ..
        } = self.integrals[pulley];
        let [sliding, wedging, elastic] = [friction - wedging - elastic, wedging, elastic]
            .map(|part| part * self.solved.problem.units.power());
        FrictionParts {
            sliding,
            wedging,
            elastic,
        }
    }

    fn groove(&self, pulley: usize) -> Option<GrooveState> {
        let Touching::Groove(on) = &self.lying.touching[pulley] else {
            return None;
        };
        let EndAngles { entry, exit } = self.lying.ends[pulley];
        Some(GrooveState {
            inclination: [entry, exit],
            max_penetration: on.max_penetration(),
            transverse_loss: self.integrals[pulley].stored * on.units.power(),
            least_slip: on.least_slip(),
        })
    }

    fn zones(&self, pulley: usize) -> Vec<Zone> {
        match &self.lying.touching[pulley] {
            Touching::Groove(on) => on.friction_zones(),
            Touching::Back(on) => on.zones(),
            Touching::Idle(wrap) => vec![Zone {
                kind: ZoneKind::Adhesion,
                from: 0.0,
                to: *wrap,
            }],
        }
    }

    fn span(
        &self,
        search: &mut Search<'_>,
        at_rest: &RestProblem,
        span: usize,
        deflection_force: Option<Option<f64>>,
    ) -> SpanState {
        let units = self.solved.problem.units;
        let belt = search.drive.belt;
        let tension = self.tension(span) * units.force;
        let tractive = self.lying.tractive[span] * units.force;
        let speed = units.strand().speed(self.tension(span), self.flow) * units.speed;
        let flow = self.flow * units.mass_flow();
        let length = self.lying.laid.lengths[span];
        let rest_length = self.rest.laid.lengths[span];
        let deflection = DEFLECTION * rest_length;
        SpanState {
            length,
            direction: self.lying.laid.directions[span].rem_euclid(std::f64::consts::TAU),
            tension,
            tractive_tension: tractive,
            speed,
            frequency: first_frequency(length, tractive, tension, speed, flow),
            rest_length,
            rest_frequency: rest_frequency(
                rest_length,
                self.rest.tension,
                belt.mass_per_length,
                belt.axial_stiffness,
            ),
            deflection,
            deflection_force: deflection_force
                .unwrap_or_else(|| self.deflection_force(search, at_rest, span, deflection)),
        }
    }

    /// Force across a span of the belt at rest that displaces its midpoint, N.
    fn deflection_force(
        &self,
        search: &mut Search<'_>,
        at_rest: &RestProblem,
        span: usize,
        deflection: f64,
    ) -> Option<f64> {
        let rest = self.rest;
        let plane = &self.solved.problem.plane;
        let (direction, spot) = (rest.laid.directions[span], plane.spots[span]);
        let centre = self.centre(search, span, rest.coordinate);
        let begin = rim(
            centre,
            spot.radius,
            polar(direction, spot.turns, rest.exits[span]),
        );
        let [along, inward] = [0.0, 0.5 * std::f64::consts::PI * search.drive.sense.sign()]
            .map(|turned| direction + turned);
        let middle = rim(begin, 0.5 * rest.laid.lengths[span], along);
        let point = rim(middle, deflection, inward);
        let problem = at_rest.clone().with(Known::Length(rest.unstretched));
        let problem = problem.deflected(span, point, rest.coordinate);
        let guess = RestNear {
            problem: &problem,
            rest,
            first_length: at_rest.first_length(),
        };
        let found = problem.solve(&guess, search).ok()?;
        if found.wraps.iter().any(|&wrap| wrap <= 0.0) {
            return None;
        }
        let pull = found
            .laid
            .hub_load(&problem.plane, span + 1, [found.tension; 2]);
        let (sine, cosine) = inward.sin_cos();
        Some(-(pull[0] * cosine + pull[1] * sine))
    }

    fn tensioner(
        &self,
        search: &mut Search<'_>,
        at_rest: &RestProblem,
    ) -> Result<Option<TensionerState>, SolveError> {
        let Some((pulley, tensioner)) = search.drive.tensioner() else {
            return Ok(None);
        };
        let plane = &self.solved.problem.plane;
        let lost = SolveError::NotFound {
            what: "stiffness of the belt at rest",
        };
        let belt = search.stiffness(at_rest, self.rest).ok_or(lost)?;
        let carried = (pulley, tensioner);
        let tractive = self.lying.tractive[pulley] * self.solved.problem.units.force;
        let running = held(
            plane,
            &self.lying.laid,
            carried,
            self.coordinate,
            tractive,
            belt,
        );
        let rest = self.rest;
        let at_rest = held(
            plane,
            &rest.laid,
            carried,
            rest.coordinate,
            rest.tension,
            belt,
        );
        for (held, which) in [(&running, "under load"), (&at_rest, "at rest")] {
            if held.stiffness.is_nan() || held.stiffness <= 0.0 {
                return Err(SolveError::NoEquilibrium {
                    pulley: search.drive.pulleys[pulley].name.clone(),
                    which,
                });
            }
        }
        Ok(Some(TensionerState {
            pulley,
            coordinate: self.coordinate,
            rest_coordinate: rest.coordinate,
            load: tensioner.load_at(self.coordinate)[0],
            length_derivatives: length_derivatives(
                plane,
                &self.lying.laid,
                carried,
                self.coordinate,
            ),
            stiffness: running.stiffness,
            rest_stiffness: at_rest.stiffness,
            constant: running.constant,
            rest_constant: at_rest.constant,
        }))
    }
}

/// The answer, if it passes its checks. The forces that deflect the spans at rest may be known.
pub(super) fn state(
    search: &mut Search<'_>,
    rest: &Rest,
    at_rest: &RestProblem,
    solved: &Solved<LoopProblem>,
    deflections: Option<&[Option<f64>]>,
) -> Result<LoopState, SolveError> {
    let seen = Seen::new(solved, rest);
    let drive = search.drive;
    let checks = Checked {
        solved,
        laid: &seen.lying.laid,
        ends: &seen.lying.ends,
        touching: &seen.lying.touching,
        integrals: &seen.integrals,
        tractive: &seen.lying.tractive,
        omegas: &seen.omegas,
        wraps: &seen.wraps,
        tolerance: search.tolerance,
    };
    let checks = checks.all();
    if let Some(violated) = checks.iter().find(|check| !check.holds()) {
        return Err(SolveError::Violated(violated.clone()));
    }
    let count = drive.pulleys.len();
    let pulleys: Vec<_> = (0..count)
        .map(|pulley| seen.pulley(search, pulley))
        .collect();
    let powers = pulleys.iter().map(|pulley| pulley.power);
    let [power_in, power_out] = powers.fold([0.0, 0.0], |[input, output], power| {
        [input + (-power).max(0.0), output + power.max(0.0)]
    });
    let spans = (0..count)
        .map(|span| seen.span(search, at_rest, span, deflections.map(|known| known[span])))
        .collect();
    let tensioner = seen.tensioner(search, at_rest)?;
    let length = solved.round(|round| round.lengths())[1];
    let units = solved.problem.units;
    let meshes = 0..solved.problem.zoning().count();
    Ok(LoopState {
        layout: drive.layout(seen.coordinate)?,
        rest_layout: drive.layout(rest.coordinate)?,
        unstretched_speed: seen.flow * units.speed,
        mass_flow: seen.flow * units.mass_flow(),
        length,
        unstretched_length: rest.unstretched,
        rest_tension: rest.tension,
        power_in,
        power_out,
        power_loss: pulleys.iter().map(|pulley| pulley.friction_loss).sum(),
        efficiency: (power_in > 0.0).then(|| power_out / power_in),
        spans,
        pulleys,
        tensioner,
        load_limit: None,
        convergence: Some(LoopConvergence {
            tolerance: search.tolerance,
            error_estimate: solved.solution.error_estimate().unwrap_or(f64::INFINITY),
            defect: solved.solution.defect(),
            mesh_intervals: meshes
                .map(|segment| solved.solution.mesh(segment).len() - 1)
                .sum(),
            newton_steps: search.stats.newton_steps,
            problems: search.problems,
            slip_normalisation: solved.problem.smoothing(),
            slip_normalisation_effect: search.smoothing_effect,
        }),
        checks,
        contacts: Contacts::V(profiles(solved.clone())),
    })
}

/// The belt along every pulley of a solved loop.
fn profiles(solved: Solved<LoopProblem>) -> Profiles {
    Profiles::new(move || {
        let lying = Lying::of(&solved);
        let pulleys = 0..lying.touching.len();
        pulleys
            .map(|pulley| lying.profile(&solved, pulley))
            .collect()
    })
}
