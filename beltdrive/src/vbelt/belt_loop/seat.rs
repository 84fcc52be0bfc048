//! How the belt touches a pulley, scaled.

use super::super::groove::Elastic;
use super::super::{Groove, Law, Strand, Units};
use super::back::Back;
use crate::FrictionLaw;
use crate::drive::belt_loop::{BeltLoop, Duty, LoopPulley};
use crate::drive::layout::Side;

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
    /// That of a pulley, with a friction law and the slip direction normalised by `epsilon`.
    pub(super) fn new(
        belt_loop: &BeltLoop,
        pulley: &LoopPulley,
        units: Units,
        law: FrictionLaw,
        epsilon: f64,
    ) -> Self {
        let friction_coefficient = pulley.friction_coefficient;
        let law = scaled_law(law, units, pulley.radius, epsilon);
        match (pulley.side, pulley.duty) {
            (Side::Inside, _) => Self::Groove(Groove {
                strand: units.strand(),
                friction_coefficient,
                law,
                ..frictionless(belt_loop, pulley, units)
            }),
            (Side::Outside, Duty::Torque(0.0) | Duty::Power(0.0)) => Self::Idle,
            (Side::Outside, _) => Self::Back(Back {
                strand: units.strand(),
                friction_coefficient,
                law,
            }),
        }
    }

    /// Number of states of its segment, the elongation among them; `None` without one.
    pub(super) fn states(&self) -> Option<usize> {
        match self {
            Self::Groove(groove) => Some(groove.states() + 1),
            Self::Back(back) => Some(back.states() + 1),
            Self::Idle => None,
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
pub(super) fn frictionless(belt_loop: &BeltLoop, pulley: &LoopPulley, units: Units) -> Groove {
    let belt = belt_loop.belt.v();
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

/// A friction law on a pulley of a radius in m. The tension at which the displacement of EPP friction does
/// not grow is a parameter of the loop and left out here.
pub(super) fn scaled_law(law: FrictionLaw, units: Units, radius: f64, epsilon: f64) -> Law {
    match law {
        FrictionLaw::Bristle { stiffness } => Law::Bristle {
            stiffness: stiffness * radius,
            elastic: None,
        },
        FrictionLaw::Epp { stiffness } => Law::Normalised {
            epsilon,
            elastic: Some(Elastic {
                stiffness: units.friction_stiffness(stiffness, radius),
                unstretched: 0.0,
                weight: 1.0,
            }),
        },
        _ => Law::Normalised {
            epsilon,
            elastic: None,
        },
    }
}
