//! The boundary value problem against the closed form.

mod agreement;
mod order;

use crate::{Belt, BeltKind, FrictionLaw, Load, NormalForce, SpanTension, TwoPulleys};

/// The drive of Kim (2009) with a law of friction, a convention and a load.
fn drive(
    law: FrictionLaw,
    normal_force: NormalForce,
    slack: SpanTension,
    tight: SpanTension,
) -> TwoPulleys {
    TwoPulleys {
        belt: Belt {
            ribs: 1,
            mass_per_length: 0.1036,
            axial_stiffness: 80_068.0,
            kind: BeltKind::Flat { normal_force },
        },
        friction_coefficient: 1.2,
        law,
        driver_radius: 0.08125,
        driver_speed: 120.0,
        driven_radius: 0.08125,
        centre_distance: 0.3,
        load: Load { slack, tight },
    }
}
