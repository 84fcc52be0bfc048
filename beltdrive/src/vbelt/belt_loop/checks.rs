//! The invariants of a loop, recomputed from the profiles of its contacts.
//!
//! ```text
//! moment    ∫ t r ds = [F r cos θ] on every pulley, and M = that
//! power     Σ M ω + friction + transverse work = 0,  friction ≥ 0
//! hubs      the load on every hub is that of the forces along its contact
//! closure   the belt laid out in the plane meets every pulley and returns to its beginning
//! pressure  p ≥ 0,  |q| ≤ μ p
//! waves     the belt is slower than its longitudinal waves
//! ```

use super::super::BeltProblem;
use super::super::EndAngles;
use super::super::laws::{ALLOWED, GAINED, power_gained, wrong_friction};
use super::super::on_pulley::{Integrals, OnPulley};
use super::super::path::Solved;
use super::contacts::Touching;
use super::plane::{Laid, Plane};
use super::problem::LoopProblem;
use crate::{Check, Mount};
use std::f64::consts::FRAC_PI_2;

/// What the checks look at.
pub(super) struct Checked<'a> {
    pub(super) solved: &'a Solved<LoopProblem>,
    pub(super) laid: &'a Laid<f64>,
    pub(super) ends: &'a [EndAngles<f64>],
    pub(super) touching: &'a [Touching<'a>],
    pub(super) integrals: &'a [Integrals],
    /// Tractive tension of each span, scaled.
    pub(super) tractive: &'a [f64],
    /// Scaled angular speeds.
    pub(super) omegas: &'a [f64],
    /// Wraps, rad.
    pub(super) wraps: &'a [f64],
    pub(super) tolerance: f64,
}

impl Checked<'_> {
    /// All of them.
    pub(super) fn all(&self) -> Vec<Check> {
        // Integrals of the continuous solution are as accurate as its defect.
        let limit = ALLOWED * self.tolerance;
        let largest = self.tractive.iter().copied().fold(0.0, f64::max);
        let friction: f64 = self.integrals.iter().map(|sum| sum.friction).sum();
        let power = self.integrals.iter().zip(self.omegas);
        let power: f64 = power
            .map(|(sum, omega)| sum.torque * omega + sum.friction + sum.stored)
            .sum();
        let [lowest, highest, excess] = self.contact_forces();
        let units = self.solved.problem.units;
        let flow = self.solved.problem.flow(self.solved.solution.parameters());
        let strand = units.strand();
        let waves = flow * flow * strand.inertia * strand.compliance;
        let check = |name, deviation: f64, limit| Check {
            name,
            deviation,
            limit,
        };
        let mut checks = vec![
            check(
                "moment balance on every pulley",
                self.moments() / largest,
                limit,
            ),
            check("power balance", power.abs() / largest, limit),
            check(
                "friction loss not negative",
                (-friction).max(0.0) / largest,
                limit,
            ),
            check(
                "hub loads of the contact forces",
                self.hubs() / largest,
                limit,
            ),
            check("closure of the belt", self.closure(), limit),
            check(
                "normal pressure not negative",
                (-lowest).max(0.0) / highest,
                limit,
            ),
            check(
                "friction within its limit",
                excess.max(0.0) / highest,
                limit,
            ),
            check("belt slower than its waves", waves, 1.0 - self.tolerance),
            check(
                "belt in traction",
                self.tractive
                    .iter()
                    .fold(0.0, |most: f64, &force| most.max(-force))
                    / largest,
                0.0,
            ),
        ];
        let solved = self.solved;
        if solved.problem.has_direction() {
            checks.push(check(
                "friction against the slip",
                power_gained(solved),
                GAINED * self.tolerance,
            ));
        }
        if solved.problem.has_zones() {
            let wrong = wrong_friction(solved);
            checks.push(check("friction zones of their kind", wrong, limit));
        }
        checks
    }

    /// Largest difference of a torque and the moment of the forces along the contact, scaled.
    fn moments(&self) -> f64 {
        let plane = &self.solved.problem.plane;
        let moments = self.integrals.iter().enumerate().map(|(pulley, sum)| {
            let [behind, before] = [plane.arriving(pulley), pulley].map(|span| self.tractive[span]);
            let EndAngles { entry, exit } = self.ends[pulley];
            (sum.torque - (before * exit.cos() - behind * entry.cos())).abs()
        });
        moments.fold(0.0, f64::max)
    }

    /// Lowest and highest pressure, and the largest excess of friction over its limit, scaled.
    fn contact_forces(&self) -> [f64; 3] {
        let [mut lowest, mut highest, mut excess] = [0.0f64, 0.0f64, f64::NEG_INFINITY];
        for touching in self.touching {
            match touching {
                Touching::Groove(on) => on.for_each_point(|stretch, _, _, y| {
                    let contact = on.contact(stretch.regime, y);
                    lowest = lowest.min(contact.pressure);
                    highest = highest.max(contact.pressure);
                    let limit = on.groove.friction_coefficient * contact.pressure;
                    excess = excess.max(contact.friction() - limit);
                }),
                Touching::Back(on) => excess = excess.max(on.excess()),
                Touching::Idle(_) => {}
            }
        }
        [lowest, highest, excess]
    }

    /// Largest difference of the load on a hub and the forces along the contact, scaled; in grooves.
    fn hubs(&self) -> f64 {
        let plane = &self.solved.problem.plane;
        let hubs = self.touching.iter().enumerate().map(|(pulley, touching)| {
            let Touching::Groove(on) = touching else {
                return 0.0;
            };
            let tractive = [plane.arriving(pulley), pulley].map(|span| self.tractive[span]);
            let hub = self.laid.hub_load(plane, pulley, tractive);
            let turns = plane.spots[pulley].turns;
            let entry = polar(
                self.laid.directions[plane.arriving(pulley)],
                turns,
                self.ends[pulley].entry,
            );
            let along = contact_load(on, entry, turns);
            (hub[0] - along[0]).hypot(hub[1] - along[1])
        });
        hubs.fold(0.0, f64::max)
    }

    /// How far the belt is from closing: the largest distance of a pulley from where the belt meets it, and
    /// of the end of the belt from its beginning, as a share of its length. The belt is followed by its
    /// inclinations and wraps, one span after the other.
    fn closure(&self) -> f64 {
        let problem = &self.solved.problem;
        let plane: &Plane = &problem.plane;
        let coordinate = problem.coordinate(self.solved.solution.parameters());
        let centre = |pulley: usize| match &plane.spots[pulley].mount {
            Mount::Fixed(centre) => *centre,
            Mount::Tensioner(tensioner) => tensioner.guide.centre(coordinate)[0],
        };
        let count = plane.spots.len();
        let mut heading = self.laid.directions[0];
        let first = heading;
        let mut place = rim(
            centre(0),
            plane.spots[0].radius,
            polar(heading, plane.spots[0].turns, self.ends[0].exit),
        );
        let begin = place;
        let mut worst: f64 = 0.0;
        let mut turned = 0.0;
        for step in 1..=count {
            let (span, pulley) = (step - 1, step % count);
            let length = self.laid.lengths[span];
            place = [
                place[0] + length * heading.cos(),
                place[1] + length * heading.sin(),
            ];
            let spot = plane.spots[pulley];
            let entry = polar(heading, spot.turns, self.ends[pulley].entry);
            let found = rim(place, -spot.radius, entry);
            let stated = centre(pulley);
            worst = worst.max((found[0] - stated[0]).hypot(found[1] - stated[1]));
            let exit = entry + spot.turns * self.wraps[pulley];
            place = rim(found, spot.radius, exit);
            heading = exit + spot.turns * (FRAC_PI_2 - self.ends[pulley].exit);
            turned = heading - first;
        }
        let gap = (place[0] - begin[0]).hypot(place[1] - begin[1]);
        let length: f64 = self.laid.lengths.iter().sum();
        let whole = (turned / std::f64::consts::TAU).round() * std::f64::consts::TAU;
        worst.max(gap) / length + (turned - whole).abs()
    }
}

/// Polar angle on a pulley where a belt in a direction has an inclination θ: it runs in the direction
/// α + σ (π/2 − θ).
pub(super) fn polar(direction: f64, turns: f64, theta: f64) -> f64 {
    direction - turns * (FRAC_PI_2 - theta)
}

/// The point at a distance from a centre, at a polar angle.
pub(super) fn rim(centre: [f64; 2], radius: f64, polar: f64) -> [f64; 2] {
    [
        centre[0] + radius * polar.cos(),
        centre[1] + radius * polar.sin(),
    ]
}

/// Load of the belt on the hub by the forces along its contact, scaled. The belt enters at the polar angle
/// `entry`.
fn contact_load(on: &OnPulley<'_>, entry: f64, turns: f64) -> [f64; 2] {
    let mut load = [0.0; 2];
    on.for_each_point(|stretch, _, weight, y| {
        let contact = on.contact(stretch.regime, y);
        let (sine, cosine) = (entry + turns * y[super::super::ANGLE]).sin_cos();
        let inward = -contact.outward * weight;
        let along = contact.retarding * weight * turns;
        load[0] += inward * cosine - along * sine;
        load[1] += inward * sine + along * cosine;
    });
    load
}
