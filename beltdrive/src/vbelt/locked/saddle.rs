//! The place at which a belt that slides with full friction may come to rest.
//!
//! The belt does not move against the pulley there, V = ω r and θ = 0, and the friction that resists its sinking just
//! balances it:
//!
//! ```text
//! F = h x r        h = k (tan β + μ/(cos β (cos β − μ sin β)))
//! ```
//!
//! Beside that place friction holds the belt along the pulley but for a slip of second order. The tension follows the
//! depth, dF/dx = −ω/(dV/dF), the share of friction along the pulley is S, and the rest of x and θ goes as exp(±λ s):
//!
//! ```text
//! λ² = (h/F)(1 − (x/F) dF/dx) − 1/r²        S = θ (F/r − dF/dx)/(2 μ p)
//! ```

use crate::vbelt::{Groove, Law};

/// The belt on a pulley of a certain speed, with a certain mass flow, scaled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    /// The groove, with friction along the slip.
    pub(super) groove: Groove,
    pub(super) omega: f64,
    pub(super) flow: f64,
}

/// The place of rest, scaled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Saddle {
    pub(super) rim: Rim,
    /// Tractive tension F; positive.
    pub(super) tractive: f64,
    /// Penetration x; positive.
    pub(super) depth: f64,
    /// λ; positive.
    pub(super) rate: f64,
    /// S/θ; positive.
    pub(super) turning: f64,
}

impl Saddle {
    /// On a driver of the speed `omega`, which determines the mass flow, with a tractive tension; `None` if friction jams
    /// the belt, or no depth carries the tension.
    pub(super) fn on_driver(groove: &Groove, omega: f64, tractive: f64) -> Option<Self> {
        let depth = depth(groove, tractive)?;
        let speed = omega * (1.0 - depth);
        let (inertia, compliance) = (groove.strand.inertia, groove.strand.compliance);
        // V = G (1 + e T) with T = F + c G V, for G.
        let stretch = 1.0 + compliance * tractive;
        let root = (stretch * stretch + 4.0 * compliance * inertia * speed * speed).sqrt();
        let flow = 2.0 * speed / (stretch + root);
        Self::new(groove, [omega, flow], tractive, depth)
    }

    /// On a driven pulley, whose speed it determines, with a mass flow and a tractive tension; `None` as on the driver.
    pub(super) fn on_driven(groove: &Groove, flow: f64, tractive: f64) -> Option<Self> {
        let depth = depth(groove, tractive)?;
        let speed = groove
            .strand
            .speed(groove.strand.tension(tractive, flow), flow);
        Self::new(groove, [speed / (1.0 - depth), flow], tractive, depth)
    }

    fn new(groove: &Groove, [omega, flow]: [f64; 2], tractive: f64, depth: f64) -> Option<Self> {
        let strand = groove.strand;
        let tension = strand.tension(tractive, flow);
        let speed = strand.speed(tension, flow);
        let follows = -omega / (speed * strand.stretching(tension, speed));
        let radius = 1.0 - depth;
        let friction =
            groove.friction_coefficient * groove.radial_stiffness * depth / free(groove)?;
        let square =
            stiffness(groove)? / tractive * (1.0 - depth * follows / tractive) - radius.powi(-2);
        let law = Law::Normalised {
            epsilon: 0.0,
            elastic: None,
        };
        let rim = Rim {
            groove: Groove { law, ..*groove },
            omega,
            flow,
        };
        (square > 0.0).then(|| Self {
            rim,
            tractive,
            depth,
            rate: square.sqrt(),
            turning: (tractive / radius - follows) / friction,
        })
    }
}

/// cos β − μ sin β, unless friction jams the belt in the groove.
fn free(groove: &Groove) -> Option<f64> {
    let free = groove.cos_beta - groove.friction_coefficient * groove.sin_beta;
    (free > 0.0).then_some(free)
}

/// h.
fn stiffness(groove: &Groove) -> Option<f64> {
    let (sin, cos) = (groove.sin_beta, groove.cos_beta);
    let friction = groove.friction_coefficient / (cos * free(groove)?);
    Some(groove.radial_stiffness * (sin / cos + friction))
}

/// The smaller one of both depths x with F = h x (1 − x).
fn depth(groove: &Groove, tractive: f64) -> Option<f64> {
    let share = 4.0 * tractive / stiffness(groove)?;
    (0.0 < share && share < 1.0).then(|| 0.5 * share / (1.0 + (1.0 - share).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FrictionLaw;
    use crate::vbelt::scaling::tests::kim;
    use crate::vbelt::{Contact, DRIVER, DriveProblem, INCLINATION, Regime, Scales};

    fn groove() -> Groove {
        let drive = kim(FrictionLaw::Coulomb, 0.25);
        *DriveProblem::new(&drive, Scales::new(&drive), 0.0).groove(DRIVER)
    }

    #[test]
    fn the_belt_rests_and_is_balanced_there() {
        let on_driver = Saddle::on_driver(&groove(), 1.0, 0.15).unwrap();
        let on_driven = Saddle::on_driven(&groove(), on_driver.rim.flow, 0.14).unwrap();
        for saddle in [on_driver, on_driven] {
            let Rim {
                groove,
                omega,
                flow,
            } = saddle.rim;
            // Sinking slowly, the belt slides straight down.
            let state = [saddle.tractive, -1e-9, saddle.depth, 0.0];
            let contact = Contact::new(&groove, Regime::Slip, &state, omega, flow);
            assert!(contact.slip[0].abs() < 1e-15, "{contact:?}");
            let mut rates = [0.0; 4];
            contact.rates(&groove, &state, &mut rates);
            assert!(rates[INCLINATION].abs() < 1e-8, "{rates:?}");
        }
    }

    #[test]
    fn a_belt_that_friction_jams_rests_nowhere() {
        let mut groove = groove();
        groove.friction_coefficient = 1.0 / groove.sin_beta;
        assert!(Saddle::on_driver(&groove, 1.0, 0.15).is_none());
    }

    #[test]
    fn a_tension_beyond_the_deepest_place_is_not_carried() {
        let groove = groove();
        let largest = 0.25 * stiffness(&groove).unwrap();
        assert!(Saddle::on_driver(&groove, 1.0, 0.99 * largest).is_some());
        assert!(Saddle::on_driver(&groove, 1.0, 1.01 * largest).is_none());
    }
}
