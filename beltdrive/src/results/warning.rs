//! What a user must know of a state that the model is not for.

use crate::{Belt, BeltKind, FrictionLaw, NormalForce, Profile, Role};
use std::f64::consts::FRAC_PI_2;

/// Strain from which the stiffness per length of a stretched V-belt and that of the unstretched one, which the
/// model does not tell apart, differ by as much as coefficients of friction are uncertain.
const LARGE_STRETCH: f64 = 0.05;

/// From this strain on the friction zones of flat belts with small and with finite strains differ visibly.
const LARGE_STRAIN: f64 = 0.02;

/// A remark on the validity of a state: of a drive with two pulleys, or of a loop whose pulleys have names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Warning<P = Role> {
    /// The inclination exceeds 90° on a pulley: the belt overhangs itself, which is a solution of
    /// the equations but not a design.
    Overhang {
        /// The pulley on which it happens.
        pulley: P,
        /// Largest inclination, rad.
        inclination: f64,
    },
    /// The belt is stretched by more than a model of small strains stands for (flat belts).
    LargeStrain {
        /// The largest of the strain T/EA of the tightest span and those of the belt against the rims.
        strain: f64,
    },
    /// The belt is stretched by more than the model of V-belts stands for.
    LargeStretch {
        /// Strain T/EA of the tightest span.
        strain: f64,
    },
    /// The belt sinks into the groove of a pulley by more than its height (V-belts of known height).
    Sunk {
        /// The pulley on which it happens.
        pulley: P,
        /// Largest penetration, m.
        penetration: f64,
        /// Height of the belt, m.
        height: f64,
    },
}

/// Pulleys of a V-belt on which it overhangs itself.
pub(super) fn overhangs<'a, P>(
    pulleys: impl Iterator<Item = (P, &'a Profile)>,
) -> impl Iterator<Item = Warning<P>> {
    pulleys.filter_map(|(pulley, profile)| {
        let steepest = profile.inclination.iter().copied();
        let inclination = steepest.fold(0.0, |m: f64, theta| m.max(theta.abs()));
        (inclination > FRAC_PI_2).then_some(Warning::Overhang {
            pulley,
            inclination,
        })
    })
}

/// Pulleys into whose grooves a V-belt sinks too far by its largest penetrations, and too large a stretch by
/// its largest tension.
pub(super) fn beyond_model<P>(
    belt: &Belt,
    largest_tension: f64,
    pulleys: impl Iterator<Item = (P, f64)>,
) -> impl Iterator<Item = Warning<P>> {
    let height = belt.v().height.unwrap_or(f64::INFINITY);
    let sunk = pulleys.filter_map(move |(pulley, penetration)| {
        (penetration > height).then_some(Warning::Sunk {
            pulley,
            penetration,
            height,
        })
    });
    let strain = largest_tension / belt.axial_stiffness;
    let stretch = (strain > LARGE_STRETCH).then_some(Warning::LargeStretch { strain });
    sunk.chain(stretch)
}

/// Too large a strain of a flat belt, by its largest tension and its strains against the rims: it only matters to
/// elastic friction, which acts per unstretched length.
pub(crate) fn large_strain<P>(
    belt: &Belt,
    law: FrictionLaw,
    largest_tension: f64,
    against_rims: impl Iterator<Item = f64>,
) -> Option<Warning<P>> {
    let strain = against_rims.fold(largest_tension / belt.axial_stiffness, f64::max);
    let exact = BeltKind::Flat {
        normal_force: NormalForce::Exact,
    };
    let is_elastic = matches!(law, FrictionLaw::Epp { .. });
    (is_elastic && belt.kind != exact && strain > LARGE_STRAIN)
        .then_some(Warning::LargeStrain { strain })
}
