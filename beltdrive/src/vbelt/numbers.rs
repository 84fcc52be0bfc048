//! The numbers of a drive with two pulleys, and what its equations take from them.

use super::{DRIVEN, DRIVER, Groove, Law, Layout, Units};
use crate::drive::Number;
use crate::{FrictionLaw, TwoPulleys};
use bvp::Real;

/// The numbers of a drive, SI, as scalars that may vary. The pulleys are in the order of the belt.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbers<S = f64> {
    mass_per_length: S,
    axial_stiffness: S,
    radial_stiffness: S,
    /// Sine and cosine of the half groove angle.
    half_angle: [S; 2],
    friction_coefficient: S,
    /// The friction law, and the parameter in place of its own; zero where it has none.
    law: (FrictionLaw, S),
    /// Pitch radii.
    pub(super) radius: [S; 2],
    driver_speed: S,
    centre_distance: S,
    /// What the tension of the span that leaves each pulley is prescribed by.
    tensions: [S; 2],
}

/// What the equations of a drive take from its numbers, scaled but for the layout.
#[derive(Clone, Debug)]
pub(super) struct Scaled<S = f64> {
    /// Where the pulleys are, m.
    pub(super) layout: Layout<S>,
    /// The belt on each pulley.
    pub(super) grooves: [Groove<S>; 2],
    /// What the tension of the span that leaves each pulley is prescribed by.
    pub(super) tensions: [S; 2],
}

impl Numbers {
    /// Those of a drive with a V-belt.
    pub(super) fn new(drive: &TwoPulleys) -> Self {
        let belt = drive.belt.v();
        Self {
            mass_per_length: drive.belt.mass_per_length,
            axial_stiffness: drive.belt.axial_stiffness,
            radial_stiffness: belt.radial_stiffness,
            half_angle: belt.half_angle.sin_cos().into(),
            friction_coefficient: drive.friction_coefficient,
            law: (drive.law, drive.law.parameter().unwrap_or_default()),
            radius: [drive.driven_radius, drive.driver_radius],
            driver_speed: drive.driver_speed,
            centre_distance: drive.centre_distance,
            tensions: [drive.load.tight.value(), drive.load.slack.value()],
        }
    }

    /// The same numbers as constants of another scalar.
    pub(super) fn lifted<S: Real>(&self) -> Numbers<S> {
        let (law, parameter) = self.law;
        Numbers {
            mass_per_length: S::from_f64(self.mass_per_length),
            axial_stiffness: S::from_f64(self.axial_stiffness),
            radial_stiffness: S::from_f64(self.radial_stiffness),
            half_angle: self.half_angle.map(S::from_f64),
            friction_coefficient: S::from_f64(self.friction_coefficient),
            law: (law, S::from_f64(parameter)),
            radius: self.radius.map(S::from_f64),
            driver_speed: S::from_f64(self.driver_speed),
            centre_distance: S::from_f64(self.centre_distance),
            tensions: self.tensions.map(S::from_f64),
        }
    }
}

impl<S: Real> Numbers<S> {
    /// Gives one of them another value, SI.
    pub(super) fn set(&mut self, number: Number, value: S) {
        let place = match number {
            Number::MassPerLength => &mut self.mass_per_length,
            Number::AxialStiffness => &mut self.axial_stiffness,
            Number::RadialStiffness => &mut self.radial_stiffness,
            Number::HalfAngle => {
                self.half_angle = value.sin_cos().into();
                return;
            }
            Number::FrictionCoefficient => &mut self.friction_coefficient,
            Number::FrictionParameter => &mut self.law.1,
            Number::DriverRadius => &mut self.radius[DRIVER],
            Number::DriverSpeed => &mut self.driver_speed,
            Number::DrivenRadius => &mut self.radius[DRIVEN],
            Number::CentreDistance => &mut self.centre_distance,
            Number::Slack => &mut self.tensions[DRIVER],
            Number::Tight => &mut self.tensions[DRIVEN],
        };
        *place = value;
    }

    /// The units that both pulleys share, with a reference force in N.
    pub(super) fn units(&self, force: f64) -> Units<S> {
        Units {
            force,
            speed: self.driver_speed * self.radius[DRIVER],
            mass_per_length: self.mass_per_length,
            axial_stiffness: self.axial_stiffness,
        }
    }

    /// The belt on a pulley, scaled, with the direction of Coulomb and EPP friction smoothed over the length ℓ/R
    /// `lag`. EPP friction is not blended.
    pub(super) fn groove(&self, pulley: usize, units: &Units<S>, lag: f64) -> Groove<S> {
        let radius = self.radius[pulley];
        let [sin_beta, cos_beta] = self.half_angle;
        let unstretched = self.tensions[DRIVER] / units.force;
        Groove {
            strand: units.strand(),
            sin_beta,
            cos_beta,
            friction_coefficient: self.friction_coefficient,
            radial_stiffness: units.radial_stiffness(self.radial_stiffness, radius),
            law: Law::new(self.law, units, radius, unstretched, lag),
        }
    }

    /// All that the equations take from them.
    pub(super) fn scaled(&self, units: &Units<S>, lag: f64) -> Scaled<S> {
        Scaled {
            layout: Layout {
                radius: self.radius,
                centre_distance: self.centre_distance,
            },
            grooves: [DRIVEN, DRIVER].map(|pulley| self.groove(pulley, units, lag)),
            tensions: self.tensions.map(|tension| tension / units.force),
        }
    }
}
