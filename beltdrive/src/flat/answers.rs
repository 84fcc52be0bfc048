//! What the closed form answers, in a few microseconds and without profiles.

use super::closed_form::ClosedForm;
use super::index;
use super::solve::refused;
use crate::answers::drive::check;
use crate::friction::rim::profile::zones;
use crate::{Drive, Role, SolveError, SolveOptions, Zone};

impl ClosedForm {
    /// The steady state of a flat-belt drive.
    ///
    /// # Errors
    /// As [`crate::solve`], of a flat-belt drive; [`SolveError::NotModelled`] for V-belts, too.
    pub fn new(drive: &Drive) -> Result<Self, SolveError> {
        check(drive, &SolveOptions::default())?;
        if let crate::BeltKind::V(_) = drive.belt.kind {
            return Err(SolveError::NotModelled(
                "the closed form is that of flat belts".into(),
            ));
        }
        Self::find(&drive.pair()).map_err(|refusal| refused(drive, refusal))
    }

    /// Speed c = G/m of the unstretched belt, m/s.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Belt tension of the slack and of the tight span, N.
    pub fn tension(&self) -> [f64; 2] {
        self.tension
    }

    /// Angular speed of a pulley, rad/s.
    pub fn angular_speed(&self, pulley: Role) -> f64 {
        let index = index(pulley);
        self.rim_speed(index) / self.radius(index)
    }

    /// Tension `T_o` at which the belt would run as fast as the rim of a pulley, N.
    pub fn reference_tension(&self, pulley: Role) -> f64 {
        let contact = &self.contact[index(pulley)];
        contact.arc.belt.tension(contact.reference())
    }

    /// The zones of a pulley, in the order in which the belt passes them.
    pub fn zones(&self, pulley: Role) -> Vec<Zone> {
        self.zones_on(index(pulley))
    }

    /// As [`ClosedForm::zones`].
    pub(super) fn zones_on(&self, index: usize) -> Vec<Zone> {
        zones(&self.contact[index], self.radius(index))
    }

    /// Radius of a pulley, m.
    fn radius(&self, index: usize) -> f64 {
        self.contact[index].arc.length / self.geometry.wrap[index]
    }
}
