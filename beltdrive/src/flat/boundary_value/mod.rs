//! The flat-belt drive as a boundary value problem: an independent check of the closed form.
//!
//! The problem is stated in tension, displacement and arc length from the balance of momentum and the
//! laws of friction ([`formulation`]) and solved by collocation. Of the closed form it takes which kinds
//! of zones there are on each pulley, and nothing else: lengths of zones, tensions and speeds are
//! unknowns that start from a rough guess ([`start`]). The wrap angles are those of the open belt.

mod coarse;
mod formulation;
mod place;
mod start;
mod units;

mod tests;

use place::{BorderedZone, Place};

use super::closed_form::{ClosedForm, Refusal};
use super::{DRIVEN, DRIVER};
use crate::{BeltKind, FrictionLaw, NormalForce, TwoPulleys};
use bvp::{Options, Scheme, Solution, Stats};
use coarse::first_guess;
use formulation::{Formulation, LENGTHS, REFERENCE, SPANS, SPEED};

/// Intervals of a zone of the first mesh.
const INTERVALS: usize = 4;

/// The steady state of a flat-belt drive by collocation.
#[derive(Clone, Debug)]
pub(super) struct BoundaryValue {
    formulation: Formulation,
    solution: Solution,
}

/// Why there is no such solution.
#[derive(Debug, thiserror::Error)]
enum Failure {
    /// The closed form knows that there is no steady state.
    #[error("no steady state: {0:?}")]
    Refused(Refusal),
    /// The solver failed.
    #[error(transparent)]
    Solver(#[from] bvp::Error),
    /// A coarse solution has other zones than the closed form.
    #[error("a coarse solution has other zones than the closed form")]
    OtherZones,
    /// Zones of these kinds do not make a steady state: one has a negative length.
    #[error("zone {zone} of pulley {pulley} has the length {length} m")]
    NegativeLength {
        /// Index of the pulley.
        pulley: usize,
        /// Index of the zone on the pulley.
        zone: usize,
        /// Its length, m.
        length: f64,
    },
}

impl BoundaryValue {
    /// The steady state of a flat-belt drive, with estimated errors within this tolerance relative to
    /// the units of the problem.
    ///
    /// # Errors
    /// [`Failure`].
    ///
    /// # Panics
    /// If the drive is none of those that [`crate::solve`] passes on.
    fn solve(drive: &TwoPulleys, tolerance: f64, scheme: Scheme) -> Result<Self, Failure> {
        Self::of(
            formulation_of(drive).map_err(Failure::Refused)?,
            tolerance,
            scheme,
        )
    }

    /// The solution of a problem.
    fn of(formulation: Formulation, tolerance: f64, scheme: Scheme) -> Result<Self, Failure> {
        let start = first_guess(&formulation)?.on_mesh(INTERVALS, tolerance);
        let options = Options {
            tolerance,
            scheme: Some(scheme),
            ..Options::default()
        };
        let solution = bvp::solve(&formulation, &start, &options)?;
        let lengths = solution.parameters()[LENGTHS..].iter().enumerate();
        if let Some((segment, &length)) = lengths.into_iter().find(|(_, length)| **length < 0.0) {
            let pulley = formulation.pulley(segment);
            return Err(Failure::NegativeLength {
                pulley,
                zone: segment - formulation.zones(pulley).start,
                length: length * formulation.units.radius[pulley],
            });
        }
        Ok(Self {
            formulation,
            solution,
        })
    }

    /// Speed c of the unstretched belt, m/s.
    fn speed(&self) -> f64 {
        self.solution.parameters()[SPEED] * self.formulation.units.speed
    }

    /// Angular speed c (1 + `T_o`/EA)/R of a pulley, rad/s.
    fn turning(&self, pulley: usize) -> f64 {
        let p = self.solution.parameters();
        let strain = p[REFERENCE + pulley] * self.formulation.compliance;
        self.speed() * (1.0 + strain) / self.formulation.units.radius[pulley]
    }

    /// Tension `T_o` at which the belt would run as fast as the rim of a pulley, N.
    fn reference(&self, pulley: usize) -> f64 {
        self.solution.parameters()[REFERENCE + pulley] * self.formulation.units.force
    }

    /// Belt tension of the slack and of the tight span, N.
    fn tension(&self) -> [f64; 2] {
        let p = self.solution.parameters();
        [p[SPANS], p[SPANS + 1]].map(|tension| tension * self.formulation.units.force)
    }

    /// The zones of a pulley, in the order in which the belt passes them.
    fn bordered(&self, pulley: usize) -> Vec<BorderedZone> {
        let segments = self.formulation.zones(pulley);
        segments
            .map(|segment| BorderedZone {
                kind: self.formulation.kind(segment),
                from: self.place(segment, self.solution.start(segment)).arc_length,
                to: self.place(segment, self.solution.end(segment)).arc_length,
            })
            .collect()
    }

    /// The belt in a zone of a pulley at a share of the coordinate of the zone, from 0 to 1.
    ///
    /// # Panics
    /// If there is no such zone.
    fn at(&self, pulley: usize, zone: usize, share: f64) -> Place {
        let segment = self.formulation.zones(pulley).start + zone;
        let mut y = [0.0; 3];
        self.solution.state(segment, share, &mut y);
        self.place(segment, &y)
    }

    /// The shares at the nodes of the mesh of a zone, where the solution is most accurate.
    ///
    /// # Panics
    /// If there is no such zone.
    fn nodes(&self, pulley: usize, zone: usize) -> &[f64] {
        self.solution
            .mesh(self.formulation.zones(pulley).start + zone)
    }

    /// The largest estimated error of all states and parameters, relative to one plus their value in
    /// the units of the problem.
    fn error_estimate(&self) -> Option<f64> {
        self.solution.error_estimate()
    }

    /// What the solution has cost.
    fn stats(&self) -> &Stats {
        self.solution.stats()
    }
}

/// The problem with the kinds of zones that the closed form finds, and like it without regard to the
/// convention where friction grows with the slip velocity.
fn formulation_of(drive: &TwoPulleys) -> Result<Formulation, Refusal> {
    let closed_form = ClosedForm::find(drive)?;
    let zones = [DRIVEN, DRIVER].map(|pulley| {
        let zones = closed_form.contact[pulley].zones.iter();
        zones.map(|zone| zone.friction.kind()).collect()
    });
    let convention = match (drive.law, drive.belt.kind) {
        (FrictionLaw::CreepRate { .. }, _) => NormalForce::Inertia,
        (_, BeltKind::Flat { normal_force }) => normal_force,
        (_, BeltKind::V(_)) => panic!("a flat belt was expected"),
    };
    let wrap = closed_form.geometry.wrap;
    Ok(Formulation::new(drive, wrap, convention, &zones))
}
