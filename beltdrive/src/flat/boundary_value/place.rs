//! The solution as physical quantities.

use super::BoundaryValue;
use super::formulation::{ARC_LENGTH, DISPLACEMENT, SPEED};
use crate::ZoneKind;

/// The belt at a place on a pulley, with signs: the displacement and the friction force are positive on
/// the driven pulley and negative on the driver.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Arc length from the entry, m.
    pub(super) arc_length: f64,
    /// Belt tension T, N.
    pub(super) tension: f64,
    /// Displacement u against the rim, m.
    pub(super) displacement: f64,
    /// Normal force n per arc length, N/m.
    pub(super) normal: f64,
    /// Friction force f per arc length, N/m.
    pub(super) friction: f64,
}

/// A zone of a pulley and its borders.
#[derive(Clone, Copy, Debug)]
pub(super) struct BorderedZone {
    /// Kind of friction.
    pub(super) kind: ZoneKind,
    /// Arc length where it begins, m.
    pub(super) from: f64,
    /// Arc length where it ends, m.
    pub(super) to: f64,
}

impl BoundaryValue {
    /// The belt with these states of a segment.
    pub(super) fn place(&self, segment: usize, y: &[f64]) -> Place {
        let (problem, p) = (&self.formulation, self.solution.parameters());
        let (pulley, kind) = (problem.pulley(segment), problem.kind(segment));
        let (units, tension) = (&problem.units, problem.tension(segment, y, p));
        let line_load = units.force / units.radius[pulley];
        let friction = problem.friction(segment, kind, y, p) / problem.stretch(tension);
        Place {
            arc_length: y[ARC_LENGTH] * units.radius[pulley],
            tension: tension * units.force,
            displacement: y[DISPLACEMENT] * units.displacement(pulley, kind),
            normal: problem.normal(tension, p[SPEED]) * line_load,
            friction: friction * line_load,
        }
    }
}
