//! The contacts of a solved loop, one by one: integrals, profiles and friction zones.

use super::super::BeltProblem;
use super::super::on_pulley::{Integrals, OnPulley, points};
use super::super::path::Solved;
use super::back::Back;
use super::problem::LoopProblem;
use super::seat::Seat;
use crate::vbelt::SLIPPING_BRISTLES;
use crate::{Profile, Zone, ZoneKind};
use std::f64::consts::FRAC_PI_2;

/// Points of a profile on the back of the belt: at least so many.
const PROFILE_POINTS: usize = 240;

/// The belt on one pulley of a solved loop.
pub(super) enum Touching<'a> {
    Groove(OnPulley<'a>),
    Back(OnBack<'a>),
    /// An idler on the back, with its wrap in rad.
    Idle(f64),
}

/// The back of the belt on a flat pulley under a torque.
pub(super) struct OnBack<'a> {
    solved: &'a Solved<LoopProblem>,
    back: &'a Back,
    segment: usize,
    pulley: usize,
}

impl Solved<LoopProblem> {
    /// The belt on a pulley; `turned` is how far it turns there, rad.
    pub(super) fn touching(&self, pulley: usize, turned: f64) -> Touching<'_> {
        match (&self.problem.seats[pulley], self.in_groove(pulley)) {
            (_, Some(on)) => Touching::Groove(on),
            (Seat::Back(back), None) => Touching::Back(OnBack {
                solved: self,
                back,
                segment: self.problem.zones(pulley).start,
                pulley,
            }),
            _ => Touching::Idle(turned),
        }
    }
}

impl OnBack<'_> {
    fn problem(&self) -> &LoopProblem {
        &self.solved.problem
    }

    /// Scaled contact length, which is the wrap in rad.
    pub(super) fn wrap(&self) -> f64 {
        let p = self.solved.solution.parameters();
        self.problem().length(self.segment, p)
    }

    fn at(&self, y: &[f64]) -> super::back::Rubbing<f64> {
        let p = self.solved.solution.parameters();
        let rim_speed = self.problem().rim_speed(self.pulley, p);
        self.back.at(y, rim_speed, self.problem().flow(p))
    }

    /// Whether friction is at its limit, by less than the share that counts as slip.
    fn slips(&self, y: &[f64]) -> bool {
        let limit = self.back.friction_coefficient * y[super::back::TENSION];
        self.at(y).friction.abs() >= SLIPPING_BRISTLES * limit
    }

    /// The integrals over the contact.
    pub(super) fn integrate(&self) -> Integrals {
        let mut sum = Integrals::default();
        let length = self.wrap();
        points(&self.solved.solution, self.segment, |_, weight, y| {
            let at = self.at(y);
            sum.torque += weight * length * at.friction;
            let friction = weight * length * at.friction * at.slip * at.speed;
            sum.friction += friction;
            if self.back.is_elastic() && !self.slips(y) {
                sum.elastic += friction;
            }
        });
        sum
    }

    /// Largest excess of friction over its limit, in units of the tension.
    pub(super) fn excess(&self) -> f64 {
        let mut largest = f64::NEG_INFINITY;
        points(&self.solved.solution, self.segment, |_, _, y| {
            let limit = self.back.friction_coefficient * y[super::back::TENSION];
            largest = largest.max(self.at(y).friction.abs() - limit);
        });
        largest
    }

    /// Calls `visit(s, y)` along the contact.
    fn walk(&self, mut visit: impl FnMut(f64, &[f64])) {
        let solution = &self.solved.solution;
        let mesh = solution.mesh(self.segment);
        let parts = PROFILE_POINTS.div_ceil(mesh.len() - 1);
        let mut y = vec![0.0; solution.segments()[self.segment].states];
        for pair in mesh.windows(2) {
            for part in 0..parts {
                let s = pair[0] + (pair[1] - pair[0]) * part as f64 / parts as f64;
                solution.state(self.segment, s, &mut y);
                visit(s, &y);
            }
        }
        solution.state(self.segment, 1.0, &mut y);
        visit(1.0, &y);
    }

    /// The belt along the contact in SI units.
    pub(super) fn profile(&self) -> Profile {
        let units = self.problem().units;
        let radius = self.problem().plane.spots[self.pulley].radius;
        let mut profile = Profile::default();
        let (mut last, mut stretched) = (None::<(f64, f64)>, 0.0);
        let mut entering = None;
        self.walk(|s, y| {
            let at = self.at(y);
            let angle = s * self.wrap();
            let rate = at.tension - *entering.get_or_insert(at.tension);
            if let Some((before, rate_before)) = last {
                stretched += 0.5 * (angle - before) * (rate + rate_before);
            }
            last = Some((angle, rate));
            profile.angle.push(angle);
            profile.arc_length.push(angle * radius);
            profile.tension.push(at.tension * units.force);
            profile
                .tractive_tension
                .push(y[super::back::TENSION] * units.force);
            profile.inclination.push(0.0);
            profile.penetration.push(0.0);
            profile
                .displacement
                .push(stretched * units.displacement(radius));
            profile.sliding_angle.push(FRAC_PI_2.copysign(at.slip));
            profile
                .normal_force
                .push(y[super::back::TENSION] * units.line_load(radius));
            profile
                .friction_force
                .push(at.friction.abs() * units.line_load(radius));
        });
        profile
    }

    /// The zones of friction by angle.
    pub(super) fn zones(&self) -> Vec<Zone> {
        let mut zones = Vec::new();
        let mut from = 0.0;
        self.walk(|s, y| {
            if s > 0.0 {
                let kind = match self.slips(y) {
                    true => ZoneKind::Slip,
                    false => ZoneKind::Elastic,
                };
                super::super::on_pulley::extend(&mut zones, kind, from, s * self.wrap());
                from = s * self.wrap();
            }
        });
        zones
    }
}

/// The belt along an idler on its back: nothing changes. Tensions in N, radius in m, wrap in rad.
pub(super) fn idle_profile(wrap: f64, radius: f64, tension: f64, tractive: f64) -> Profile {
    let pair = |value: f64| vec![value; 2];
    Profile {
        angle: vec![0.0, wrap],
        arc_length: vec![0.0, wrap * radius],
        tension: pair(tension),
        tractive_tension: pair(tractive),
        inclination: pair(0.0),
        penetration: pair(0.0),
        displacement: pair(0.0),
        sliding_angle: pair(FRAC_PI_2),
        normal_force: pair(tractive / radius),
        friction_force: pair(0.0),
    }
}
