//! What the boundary value problem answers, as the closed form does.

use super::super::index;
use super::super::solve::refused;
use super::place::Place;
use super::{BoundaryValue, Failure};
use crate::{
    BeltKind, Check, Drive, FrictionLaw, Profile, Pulley, SolveError, SolveOptions, Zone, solve,
};
use bvp::Scheme;
use std::f64::consts::FRAC_PI_2;

/// Gauss collocation of order ten: for drives as stiff as real ones it takes less time than that of order
/// eight.
const SCHEME: Scheme = Scheme::Gauss { stages: 5 };
/// Points of a profile between two nodes of the mesh, the second of these included.
const POINTS: usize = 4;

impl BoundaryValue {
    /// The steady state of a flat-belt drive by collocation.
    ///
    /// # Errors
    /// As [`crate::solve`], of a flat-belt drive; [`SolveError::NotModelled`] for V-belts, too;
    /// [`SolveError::NotConverged`] if the mesh grows too large, which it does for creep-rate friction
    /// with very small velocities; [`SolveError::Violated`] if the zones are not those of the closed
    /// form.
    pub fn new(drive: &Drive, options: &SolveOptions) -> Result<Self, SolveError> {
        solve::check(drive, options)?;
        if let BeltKind::V(_) = drive.belt.kind {
            return Err(SolveError::NotModelled(
                "this boundary value problem is that of flat belts".into(),
            ));
        }
        let is_stated = matches!(
            drive.law,
            FrictionLaw::Coulomb | FrictionLaw::Epp { .. } | FrictionLaw::CreepRate { .. }
        );
        if !is_stated {
            return Err(SolveError::NotModelled(
                "this boundary value problem is that of coulomb, epp and creep-rate friction"
                    .into(),
            ));
        }
        Self::solve(drive, options.tolerance, SCHEME).map_err(|failure| match failure {
            Failure::Refused(refusal) => refused(drive, refusal),
            Failure::Solver(cause) => SolveError::NotConverged {
                tight: None,
                cause: Box::new(cause),
            },
            Failure::OtherZones => violated("friction zones are those of the closed form", 1.0),
            Failure::NegativeLength { length, .. } => {
                violated("friction zones have positive lengths", -length)
            }
        })
    }

    /// Angular speed of a pulley, rad/s.
    pub fn angular_speed(&self, pulley: Pulley) -> f64 {
        self.turning(index(pulley))
    }

    /// Tension `T_o` at which the belt would run as fast as the rim of a pulley, N.
    pub fn reference_tension(&self, pulley: Pulley) -> f64 {
        self.reference(index(pulley))
    }

    /// The zones of a pulley, in the order in which the belt passes them.
    pub fn zones(&self, pulley: Pulley) -> Vec<Zone> {
        let index = index(pulley);
        let radius = self.radius(index);
        let zones = self.bordered(index).into_iter();
        zones
            .map(|zone| Zone {
                kind: zone.kind,
                from: zone.from / radius,
                to: zone.to / radius,
            })
            .collect()
    }

    /// The belt along a pulley, at the nodes of the mesh and in between.
    pub fn profile(&self, pulley: Pulley) -> Profile {
        let index = index(pulley);
        let mut profile = Profile::default();
        for zone in 0..self.bordered(index).len() {
            let nodes = self.nodes(index, zone);
            self.push(&mut profile, pulley, &self.at(index, zone, 0.0));
            for ends in nodes.windows(2) {
                for point in 1..=POINTS {
                    let share = point as f64 / POINTS as f64;
                    let share = ends[0] + share * (ends[1] - ends[0]);
                    self.push(&mut profile, pulley, &self.at(index, zone, share));
                }
            }
        }
        profile
    }

    /// Adds a place to a profile.
    fn push(&self, profile: &mut Profile, pulley: Pulley, place: &Place) {
        let sense = match pulley {
            Pulley::Driven => 1.0,
            Pulley::Driver => -1.0,
        };
        profile
            .angle
            .push(place.arc_length / self.radius(index(pulley)));
        profile.arc_length.push(place.arc_length);
        profile.tension.push(place.tension);
        profile.tractive_tension.push(place.tractive_tension);
        profile.inclination.push(0.0);
        profile.penetration.push(0.0);
        profile.displacement.push(place.displacement);
        profile.sliding_angle.push(sense * FRAC_PI_2);
        profile.normal_force.push(place.normal);
        profile.friction_force.push(place.friction.abs());
    }
}

/// An invariant of the zones that does not hold.
fn violated(name: &'static str, deviation: f64) -> SolveError {
    SolveError::Violated(Check {
        name,
        deviation,
        limit: 0.0,
    })
}
