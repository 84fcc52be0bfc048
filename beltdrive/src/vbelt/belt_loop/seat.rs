//! How the belt touches a pulley, scaled.

use super::super::{Groove, Law, Strand, Units};
use super::back::Back;
use crate::drive::layout::Side;
use crate::{Drive, Duty, FrictionLaw, Pulley};

/// How the belt touches a pulley.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Seat {
    /// In a groove.
    Groove(Groove),
    /// With its back, under a torque.
    Back(Back),
    /// With its back, on an idler.
    Idle,
}

impl Seat {
    /// That of a pulley, with a friction law whose direction is smoothed over the length ℓ/R `lag`. The tension at
    /// which the displacement of EPP friction does not grow is a parameter of the loop and left out here.
    pub(super) fn new(
        drive: &Drive,
        pulley: &Pulley,
        units: Units,
        law: FrictionLaw,
        lag: f64,
    ) -> Self {
        let friction_coefficient = pulley.friction_coefficient;
        let law = Law::new(
            (law, law.parameter().unwrap_or_default()),
            &units,
            pulley.radius,
            0.0,
            lag,
        );
        match (pulley.side, pulley.duty) {
            (Side::Inside, _) => Self::Groove(Groove {
                strand: units.strand(),
                friction_coefficient,
                law,
                ..frictionless(drive, pulley, units)
            }),
            (Side::Outside, Duty::Torque(0.0) | Duty::Power(0.0)) => Self::Idle,
            (Side::Outside, _) => Self::Back(Back {
                strand: units.strand(),
                friction_coefficient,
                law,
            }),
        }
    }

    /// Number of states of its segments, the elongation among them.
    pub(super) fn states(&self) -> usize {
        1 + match self {
            Self::Groove(groove) => groove.states(),
            Self::Back(back) => back.states(),
            Self::Idle => 1,
        }
    }

    /// Scales it by other units, whose force is a factor times the one before.
    pub(super) fn set_units(&mut self, units: Units, factor: f64) {
        match self {
            Self::Groove(groove) => {
                groove.strand = units.strand();
                groove.radial_stiffness /= factor;
            }
            Self::Back(back) => back.strand = units.strand(),
            Self::Idle => {}
        }
        if let Some(Law::Vector { stiffness, .. }) = self.law_mut() {
            *stiffness /= factor;
        }
    }

    /// The friction law, where there is friction.
    pub(super) fn law_mut(&mut self) -> Option<&mut Law> {
        match self {
            Self::Groove(groove) => Some(&mut groove.law),
            Self::Back(back) => Some(&mut back.law),
            Self::Idle => None,
        }
    }
}

/// The groove of a pulley without friction, in a belt without inertia.
pub(super) fn frictionless(drive: &Drive, pulley: &Pulley, units: Units) -> Groove {
    let belt = drive.belt.v();
    let (sin_beta, cos_beta) = pulley.half_angle.unwrap_or(belt.half_angle).sin_cos();
    Groove {
        strand: Strand {
            inertia: 0.0,
            ..units.strand()
        },
        sin_beta,
        cos_beta,
        friction_coefficient: 0.0,
        radial_stiffness: units.radial_stiffness(belt.radial_stiffness, pulley.radius),
        law: Law::Normalised {
            epsilon: 1.0,
            elastic: None,
        },
    }
}
