//! The place at which a belt that slides down the groove may come to rest.
//!
//! The belt does not move against the pulley there, V = ω r and θ = 0, and the friction that resists its sinking just
//! balances it. That is a share y of its limit μ p, all of it but with elastic friction:
//!
//! ```text
//! F = h x r        h = k (tan β + y μ/(cos β (cos β − y μ sin β)))
//! ```
//!
//! Beside that place friction holds the belt along the pulley but for a slip of second order. The tension follows the
//! depth, dF/dx = −ω/(dV/dF), and the share of friction along the pulley is S. With full friction the rest of x and θ goes as
//! exp(±λ s); elastic friction, which grows with u, brings the belt to rest in an arc of its own:
//!
//! ```text
//! λ² = (h/F)(1 − (x/F) dF/dx) − 1/r²        S = θ (F/r − dF/dx)/(2 y μ p)
//! θ = −a s²/2,  x − x_P = a s³/6            a = 2 k_f |T − T_o|/(F cos β)
//! ```

use crate::vbelt::{Groove, Law};

/// The belt on a pulley of a certain rim speed, with a certain mass flow, scaled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    /// The groove, with friction along the slip.
    pub(super) groove: Groove,
    /// ν.
    pub(super) speed: f64,
    pub(super) flow: f64,
}

/// The place of rest, scaled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest {
    pub(super) rim: Rim,
    /// Tractive tension F; positive.
    pub(super) tractive: f64,
    /// Penetration x; positive.
    pub(super) depth: f64,
    /// λ; positive.
    pub(super) rate: f64,
    /// S/θ; positive.
    pub(super) turning: f64,
    /// Displacement u of elastic friction; zero with Coulomb friction.
    pub(super) displacement: f64,
    /// Whether friction is below its limit there.
    pub(super) is_held: bool,
}

/// What is known of a place of rest beside its tension.
#[derive(Clone, Copy, Debug)]
pub(super) enum On {
    /// On a driver of this speed, which determines the mass flow.
    Driver(f64),
    /// On a driven pulley with this mass flow, whose speed it determines.
    Driven(f64),
}

impl Rest {
    /// The place of rest with a tractive tension and the displacement u over that with which elastic friction reaches its limit;
    /// any number with Coulomb friction. `None` if friction jams the belt, or no depth carries the tension.
    pub(super) fn new(groove: &Groove, on: On, tractive: f64, displaced: f64) -> Option<Self> {
        let is_held = groove.elastic().is_some() && displaced.abs() < 1.0;
        let share = if is_held { displaced.abs() } else { 1.0 };
        let held = Groove {
            friction_coefficient: share * groove.friction_coefficient,
            ..*groove
        };
        let depth = depth(&held, tractive)?;
        let (strand, radius) = (groove.strand, 1.0 - depth);
        let [speed, flow] = match on {
            On::Driver(omega) => {
                let speed = omega * radius;
                // V = G (1 + e T) with T = F + c G V, for G.
                let (inertia, compliance) = (strand.inertia, strand.compliance);
                let stretch = 1.0 + compliance * tractive;
                let root = (stretch * stretch + 4.0 * compliance * inertia * speed * speed).sqrt();
                let flow = 2.0 * speed / (stretch + root);
                [omega / flow, flow]
            }
            On::Driven(flow) => {
                let stretch = 1.0 + strand.strain(strand.tension(tractive, flow));
                [stretch / radius, flow]
            }
        };
        let stretching = strand.stretching(strand.tension(tractive, flow), speed * radius * flow);
        let follows = -1.0 / (radius * stretching);
        let friction = held.friction_coefficient * held.radial_stiffness * depth / free(&held)?;
        let square =
            stiffness(&held)? / tractive * (1.0 - depth * follows / tractive) - radius.powi(-2);
        let elastic = groove.elastic();
        let law = Law::Normalised {
            epsilon: 0.0,
            elastic,
        };
        let rim = Rim {
            groove: Groove { law, ..*groove },
            speed,
            flow,
        };
        (square > 0.0).then(|| Self {
            rim,
            tractive,
            depth,
            rate: square.sqrt(),
            turning: (tractive / radius - follows) / friction,
            displacement: elastic.map_or(0.0, |elastic| {
                let beyond = displaced / share;
                0.5 * beyond * friction / elastic.stiffness
            }),
            is_held,
        })
    }

    /// The rate of the displacement of elastic friction there.
    pub(super) fn growing(&self) -> f64 {
        self.rim.growing(self.tractive)
    }

    /// The same place with friction at its limit whatever the displacement.
    pub(super) fn sliding(&self) -> Self {
        let law = Law::Normalised {
            epsilon: 0.0,
            elastic: None,
        };
        Self {
            rim: Rim {
                groove: Groove {
                    law,
                    ..self.rim.groove
                },
                ..self.rim
            },
            displacement: 0.0,
            ..*self
        }
    }
}

impl Rim {
    /// T − `T_o` with a tractive tension, the rate of the displacement of elastic friction; zero with Coulomb friction.
    pub(super) fn growing(&self, tractive: f64) -> f64 {
        let tension = self.groove.strand.tension(tractive, self.flow);
        let elastic = self.groove.elastic();
        elastic.map_or(0.0, |elastic| tension - elastic.unstretched)
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
    use crate::vbelt::{Contact, DRIVER, DriveProblem, INCLINATION, Regime, Scales, deepening};

    fn groove() -> Groove {
        let drive = kim(FrictionLaw::Coulomb, 0.25);
        *DriveProblem::new(&drive, Scales::new(&drive), 0.0).groove(DRIVER)
    }

    #[test]
    fn the_belt_rests_and_is_balanced_there() {
        let on_driver = Rest::new(&groove(), On::Driver(1.0), 0.15, 1.0).unwrap();
        let on_driven = Rest::new(&groove(), On::Driven(on_driver.rim.flow), 0.14, 1.0).unwrap();
        for rest in [on_driver, on_driven] {
            let Rim {
                groove,
                speed,
                flow,
            } = rest.rim;
            // Sinking slowly, the belt slides straight down.
            let deep = deepening(speed) * rest.depth;
            let state = [rest.tractive, -1e-9, deep, 0.0];
            let contact = Contact::new(&groove, Regime::Slip, &state, speed, flow);
            assert!(contact.slip[0].abs() < 1e-15, "{contact:?}");
            let mut rates = [0.0; 4];
            contact.rates(&groove, &state, &mut rates);
            assert!(rates[INCLINATION].abs() < 1e-8, "{rates:?}");
        }
    }

    #[test]
    fn elastic_friction_below_its_limit_balances_it_deeper() {
        let drive = kim(FrictionLaw::Epp { stiffness: 8.1e6 }, 0.25);
        let groove = *DriveProblem::new(&drive, Scales::new(&drive), 0.0).groove(DRIVER);
        let [held, full] = [-0.4, 1.0]
            .map(|displaced| Rest::new(&groove, On::Driver(1.0), 0.15, displaced).unwrap());
        assert!(held.is_held && !full.is_held && held.depth > full.depth);
        let Rim {
            groove,
            speed,
            flow,
        } = held.rim;
        let deep = deepening(speed) * held.depth;
        let state = [held.tractive, -1e-9, deep, 0.0, held.displacement];
        let contact = Contact::new(&groove, Regime::Either, &state, speed, flow);
        let mut rates = [0.0; 5];
        contact.rates(&groove, &state, &mut rates);
        assert!(
            contact.slip[0].abs() < 1e-15 && rates[INCLINATION].abs() < 1e-8,
            "{rates:?}"
        );
        let limit = Contact::new(&groove, Regime::Slip, &state, speed, flow).friction();
        assert!(contact.friction() < 0.9 * limit && held.displacement < 0.0);
    }

    #[test]
    fn a_belt_that_friction_jams_rests_nowhere() {
        let mut groove = groove();
        groove.friction_coefficient = 1.0 / groove.sin_beta;
        assert!(Rest::new(&groove, On::Driver(1.0), 0.15, 1.0).is_none());
    }

    #[test]
    fn a_tension_beyond_the_deepest_place_is_not_carried() {
        let groove = groove();
        let largest = 0.25 * stiffness(&groove).unwrap();
        assert!(Rest::new(&groove, On::Driver(1.0), 0.99 * largest, 1.0).is_some());
        assert!(Rest::new(&groove, On::Driver(1.0), 1.01 * largest, 1.0).is_none());
    }
}
