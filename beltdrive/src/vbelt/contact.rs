//! The belt in the groove of one pulley: local mechanics at a point of the contact.
//!
//! Everything is written in the plane of a groove face, with axes t along the motion of the pulley
//! and w along the face outward. The slip of the belt per unit of its own speed is
//!
//! ```text
//! e_t = v_t = cos θ − ω r/V          e_w = v_r/cos β = sin θ/cos β
//! ```
//!
//! Where the belt locks `e_t` is 1e-9 and less, a difference of numbers near 1, and its direction turns as soon as Newton's
//! method is off by more. That is off by what is not linear in its unknowns, which are therefore chosen so that the difference is
//! linear: the speed of the pitch circle over that of the unstretched belt, ν = ω R/G, and ξ = ν x in place of the penetration x,
//!
//! ```text
//! V e_t/G = 1 − ν + T/EA + ξ − (1 + T/EA) (1 − cos θ)          x = ξ/m(ν)
//! ```
//!
//! with m = ν. The penetration does not vanish with the speed of a pulley that stands, so that m = (ν² + a²)/(2a) where ν is less
//! than a, which goes on from ν with the same slope. With ω, G and x as unknowns the largest loads of 57 random drives with Coulomb
//! friction take 151 factorisations (median, 376 at nine of ten, 755 at most) in place of 97 (158, 325).
//!
//! Each face carries the normal load p and the traction q against the slip, both per length.
//! Balance across the belt, outward load n and retarding load t of both faces together:
//!
//! ```text
//! p cos β + q_w sin β = k x/2        n = 2 (p sin β − q_w cos β)        t = 2 q_t
//! dF/ds = t cos θ − n sin θ          dθ/ds = cos θ/r − (n cos θ + t sin θ)/F
//! dx/ds = −sin θ                     dφ/ds = cos θ/r
//! ```
//!
//! With the sliding angle γ these are the equations of Kong and Parker (2006) and Kim (2009,
//! chapter 3), who write them in the polar angle. That form is singular where the belt overhangs
//! (θ = 90°); the arc length is not.
//!
//! ```text
//! tan γ = v_t/v_r            tan β_s = tan β cos γ        so sin β_s = sin β e_w/|e|, and
//! q_t = f cos β_s sin γ      q_w = f cos β_s cos γ/cos β   is the friction f along e
//! ```
//!
//! How q depends on slip and deflection is in `groove`.

use super::groove::{ANGLE, INCLINATION, LAW, MAX_STATES, PENETRATION, TENSION};
use super::vector::Yielding;
use super::{Groove, Law, Over, Regime, Strand};
use bvp::Real;
use std::f64::consts::PI;

/// The rim speed a below which m is not ν: no belt locks on so slow a pulley. With 0.5 the drive of Kim (2009) at 7000 N, whose
/// driven pulley has 0.39, took 10 of 88 Newton steps in that place.
const SLOW: f64 = 0.2;

/// All local quantities at one point of the contact, scaled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact<T> {
    /// What is known about the friction.
    pub(crate) regime: Regime,
    /// Tractive tension F.
    pub(crate) tractive: T,
    /// Belt tension T.
    pub(crate) tension: T,
    /// Belt speed V.
    pub(crate) speed: T,
    /// Penetration x.
    pub(crate) penetration: T,
    /// Local radius r = R − x.
    pub(crate) radius: T,
    /// m(ν), by which the rate of the penetration is that of its state.
    deepening: T,
    /// Sine of the inclination θ; also the outward slip velocity `v_r`.
    pub(crate) sin_theta: T,
    /// Cosine of the inclination θ.
    pub(crate) cos_theta: T,
    /// Slip `e_t` = `v_t` along the pulley and `e_w` up the groove face, per unit of belt speed.
    pub(crate) slip: [T; 2],
    /// Normalised slip |e|.
    pub(crate) slip_norm: T,
    /// Direction of friction along the pulley and up the groove face: sine and cosine of the angle of sliding friction,
    /// normalised slip, or the state of bristles and of vector EPP friction.
    direction: [T; 2],
    /// Transverse load k x of both faces.
    pub(crate) transverse: T,
    /// Normal load p of each face per length.
    pub(crate) pressure: T,
    /// Traction `q_t`, `q_w` of each face on the belt per length, positive against positive slip.
    pub(crate) traction: [T; 2],
    /// Outward load n of both faces on the belt per length.
    pub(crate) outward: T,
    /// Load t of both faces per length that retards the belt and drives the pulley.
    pub(crate) retarding: T,
}

impl<T: Real> Contact<T> {
    /// The contact in `state`, on a pulley of rim speed ν `rim_speed`, with the mass flow `flow`.
    pub(crate) fn new<S: Real>(
        groove: &Groove<S>,
        regime: Regime,
        state: &[T],
        rim_speed: T,
        flow: T,
    ) -> Self
    where
        T: Over<S>,
    {
        let one = T::from_f64(1.0);
        let [tractive, theta] = [state[TENSION], state[INCLINATION]];
        let deepening = deepening(rim_speed);
        let penetration = state[PENETRATION] / deepening;
        let (sin_half, cos_half) = (theta * 0.5).sin_cos();
        let versine = sin_half * sin_half * 2.0;
        let (sin_theta, cos_theta) = (sin_half * cos_half * 2.0, one - versine);
        let tension = groove.strand.tension(tractive, flow);
        let speed = groove.strand.speed(tension, flow);

        // The units cancel exactly in 1 − ν; what remains is the rounding of the small terms (1e-18) and that of the
        // unknown ν itself (1e-16), which shifts v_t by one constant along the whole pulley.
        let strain = groove.strand.strain(tension);
        let creep = (one - rim_speed) + strain + rim_speed * penetration;
        let slip_t = creep / (strain + 1.0) - versine;
        let slip_w = sin_theta / groove.cos_beta;
        let norm = slip_t * slip_t + slip_w * slip_w + groove.normalisation().powi(2);
        let slip_norm = norm.sqrt();

        let transverse = penetration * groove.radial_stiffness;
        let half_load = transverse * 0.5;
        let direction = match groove.law {
            Law::Normalised { .. } => [slip_t / slip_norm, slip_w / slip_norm],
            Law::Sliding { .. } => state[LAW].sin_cos().into(),
            Law::Bristle { .. } | Law::Vector { .. } => [state[LAW], state[LAW + 1]],
        };
        let mu = groove.friction_coefficient;
        let traction = match groove.law {
            Law::Bristle { .. } | Law::Vector { .. } => {
                let slipping = groove.pressure(half_load, direction[1]);
                let carrying = match groove.elastic() {
                    Some(_) => groove.friction(regime, state, slipping * mu) / mu,
                    None => slipping,
                };
                direction.map(|d| d * carrying)
            }
            _ if regime == Regime::Stick => {
                // The outward load n is F/r, which keeps the inclination.
                let tan_beta = groove.sin_beta / groove.cos_beta;
                let held = tractive / (one - penetration);
                let up = (transverse * tan_beta - held) * (groove.cos_beta * 0.5);
                [T::from_f64(0.0), up]
            }
            Law::Normalised { .. } | Law::Sliding { .. } => {
                let limit = groove.pressure(half_load, direction[1] * mu) * mu;
                let friction = groove.friction(regime, state, limit);
                direction.map(|d| d * friction)
            }
        };
        let pressure = (half_load - traction[1] * groove.sin_beta) / groove.cos_beta;
        Self {
            regime,
            tractive,
            tension,
            speed,
            penetration,
            radius: one - penetration,
            deepening,
            sin_theta,
            cos_theta,
            slip: [slip_t, slip_w],
            slip_norm,
            direction,
            transverse,
            pressure,
            traction,
            outward: (pressure * groove.sin_beta - traction[1] * groove.cos_beta) * 2.0,
            retarding: traction[0] * 2.0,
        }
    }

    /// Derivatives of the states with respect to the arc length.
    pub(crate) fn rates<S: Real>(&self, groove: &Groove<S>, state: &[T], rates: &mut [T])
    where
        T: Over<S>,
    {
        let turning =
            (self.outward * self.cos_theta + self.retarding * self.sin_theta) / self.tractive;
        let sweep = self.cos_theta / self.radius;
        rates[TENSION] = self.retarding * self.cos_theta - self.outward * self.sin_theta;
        rates[INCLINATION] = sweep - turning;
        rates[PENETRATION] = -(self.sin_theta * self.deepening);
        rates[ANGLE] = sweep;
        if let Some(elastic) = groove.elastic() {
            rates[groove.displacement()] = self.displacement_rate(elastic.unstretched);
        }
        match groove.law {
            Law::Normalised { .. } => {}
            Law::Sliding { .. } if self.regime == Regime::Stick => rates[LAW] = T::from_f64(0.0),
            Law::Sliding { lag, lead, .. } => {
                let direction = self.direction;
                let turning = across(self.slip_rates(groove, rates), direction);
                // |e| cos² of half the angle between slip and traction: |e| but where they are opposed.
                let aligned = self.slip[0] * direction[0] + self.slip[1] * direction[1];
                let weight = (self.slip_norm + aligned) * 0.5;
                rates[LAW] = (self.misalignment() + turning * lead) / (weight * lead + lag);
            }
            Law::Bristle { stiffness, .. } => {
                let saturation = self.slip_norm / groove.friction_coefficient;
                for (axis, &slip) in self.slip.iter().enumerate() {
                    rates[LAW + axis] = (slip - saturation * state[LAW + axis]) * stiffness;
                }
            }
            Law::Vector { .. } => {
                if let Some(yielding) = Yielding::new(self, groove, state) {
                    let growing = yielding.rates(|| self.slip_rates(groove, rates));
                    rates[LAW..LAW + 2].copy_from_slice(&growing);
                }
            }
        }
    }

    /// Derivatives of the slip with respect to the arc length, from those of F and θ.
    pub(super) fn slip_rates<S: Real>(&self, groove: &Groove<S>, rates: &[T]) -> [T; 2]
    where
        T: Over<S>,
    {
        let [slip_t, _] = self.slip;
        let strand = &groove.strand;
        // V'/V, and (ω r/V)'/(ω r/V) with r' = sin θ.
        let stretching = strand.stretching(self.tension, self.speed) * rates[TENSION];
        let rim = self.sin_theta / self.radius - stretching;
        [
            -(self.sin_theta * rates[INCLINATION]) - (self.cos_theta - slip_t) * rim,
            self.cos_theta * rates[INCLINATION] / groove.cos_beta,
        ]
    }

    /// Slip across the direction of the traction.
    pub(super) fn misalignment(&self) -> T {
        across(self.slip, self.direction)
    }

    /// Excess of the traction up the groove face over half of what lies between that which lets the
    /// inclination stay zero and the whole friction: it rises through zero where the belt turns to be lifted.
    pub(super) fn turn_excess<S: Real>(&self, groove: &Groove<S>) -> T
    where
        T: Over<S>,
    {
        let unbalanced = self.tractive / self.radius - self.outward;
        self.traction[1] - self.friction() + unbalanced * (groove.cos_beta * 0.5)
    }

    /// du/ds = (T − `T_o`)/EA, the displacement of the belt against the pulley; for laws that do
    /// not have it as a state, to be integrated over a solution.
    pub(crate) fn displacement_rate<S>(&self, unstretched: S) -> T
    where
        T: Over<S>,
    {
        self.tension - unstretched
    }

    /// Unstretched belt per arc length, 1/(1 + T/EA).
    pub(crate) fn unstretched_rate(&self, strand: &Strand) -> T {
        T::from_f64(1.0) / (strand.strain(self.tension) + 1.0)
    }

    /// Torque of the belt on the pulley per arc length, t r. Its integral between two points is
    /// the difference of F r cos θ.
    pub(crate) fn torque_density(&self) -> T {
        self.retarding * self.radius
    }

    /// Power against friction per arc length along the rim and across it, `2 q_t e_t V` and `2 q_w e_w V`.
    pub(crate) fn friction_power_densities(&self) -> [T; 2] {
        [0, 1].map(|axis| self.traction[axis] * self.slip[axis] * self.speed * 2.0)
    }

    /// Power stored in the transverse compression of the belt per arc length, k x tan β V dx/ds.
    /// With it the power balance V dF/ds = t ω r + friction + stored holds at every point.
    pub(crate) fn transverse_power_density(&self, groove: &Groove) -> T {
        let tan_beta = groove.sin_beta / groove.cos_beta;
        -(self.transverse * self.sin_theta * self.speed * tan_beta)
    }

    /// Friction force |q| of each face per length.
    pub(crate) fn friction(&self) -> T {
        self.traction[0].hypot(self.traction[1])
    }

    /// Sliding angle γ, from the outward radius towards the motion of the pulley: that of the traction where its
    /// direction is a state, also where the slip is no more than rounding. Where the belt sticks it is that in which
    /// it came to rest.
    pub(crate) fn sliding_angle(&self, groove: &Groove, state: &[T]) -> T {
        let [along, up] = match groove.law {
            Law::Sliding { .. } => state[LAW].sin_cos().into(),
            Law::Vector { .. } => [state[LAW], state[LAW + 1]],
            _ => self.slip,
        };
        along.atan2(up * groove.cos_beta)
    }
}

/// m(ν), by which the penetration x is multiplied to be a state.
pub(crate) fn deepening<T: Real>(rim_speed: T) -> T {
    if rim_speed > SLOW {
        rim_speed
    } else {
        (rim_speed * rim_speed + SLOW * SLOW) / (2.0 * SLOW)
    }
}

/// Component of a vector in the groove face across the direction γ of the traction, given by its sine and cosine, positive
/// where γ has to grow to follow it.
fn across<T: Real>([t, w]: [T; 2], [sin, cos]: [T; 2]) -> T {
    t * cos - w * sin
}

/// Share of friction along the pulley at which the belt breaks away. Smaller than the directions of zones in which
/// the belt slips, larger than what is left of seating where the belt hardly slips.
pub(crate) const BREAKAWAY: f64 = 0.02;

/// Excess of the share of friction that acts along the pulley, in either sense, over that with which the belt breaks
/// away. In front of that place the belt slides straight down the groove, or hardly at all.
pub(crate) fn beyond_breakaway(direction: f64) -> f64 {
    direction.sin().abs() - BREAKAWAY
}

/// As [`beyond_breakaway`] to first order, without a kink.
pub(crate) fn breakaway_excess<T: Real>(direction: T) -> T {
    (direction.sin().powi(2) - BREAKAWAY * BREAKAWAY) / (2.0 * BREAKAWAY)
}

/// Excess of the traction that would hold the belt over that of friction straight up the groove, at a place
/// where it stops to sink: zero where it begins to stick.
pub(crate) fn hold_excess<S: Real, T: Over<S>>(
    groove: &Groove<S>,
    before: Regime,
    state: &[T],
    rim_speed: T,
    flow: T,
) -> T {
    let mut sinking = [T::from_f64(0.0); MAX_STATES];
    let sinking = &mut sinking[..state.len()];
    sinking.copy_from_slice(state);
    sinking[LAW] = T::from_f64(PI);
    let sliding = Contact::new(groove, before, sinking, rim_speed, flow);
    let held = Contact::new(groove, Regime::Stick, state, rim_speed, flow);
    held.traction[1] - sliding.traction[1]
}

/// Excess of the elastic friction over its limit: zero at the end of a zone of EPP friction, negative where
/// friction is elastic and positive where the belt slips. It is `k_f` |u| − μ p, and with vector EPP friction that of
/// [`Yielding::excess`]. Other laws have no limit to exceed; they give zero.
pub(crate) fn limit_excess<S: Real, T: Over<S>>(
    groove: &Groove<S>,
    regime: Regime,
    state: &[T],
    rim_speed: T,
    flow: T,
) -> T {
    if let Some(elastic) = groove.elastic() {
        let slip = Contact::new(groove, Regime::Slip, state, rim_speed, flow);
        return groove.elastic_friction(elastic, state)
            - slip.pressure * groove.friction_coefficient;
    }
    let Law::Vector { .. } = groove.law else {
        return T::from_f64(0.0);
    };
    let contact = Contact::new(groove, regime, state, rim_speed, flow);
    let yielding = Yielding::new(&contact, groove, state);
    yielding.map_or(T::from_f64(0.0), |yielding| {
        yielding.excess(groove.strand.compliance)
    })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::vbelt::groove::Elastic;

    /// A groove with a law, of which ε is given apart.
    pub(in crate::vbelt) fn groove(law: Law, normalisation: f64) -> Groove {
        let law = match law {
            Law::Normalised { elastic, .. } => Law::Normalised {
                epsilon: normalisation,
                elastic,
            },
            law => law,
        };
        let (sin_beta, cos_beta) = 18_f64.to_radians().sin_cos();
        Groove {
            strand: Strand {
                inertia: 0.1,
                compliance: 6e-3,
            },
            sin_beta,
            cos_beta,
            friction_coefficient: 0.4,
            radial_stiffness: 80.0,
            law,
        }
    }

    fn epp(weight: f64) -> Law {
        let elastic = Some(Elastic {
            stiffness: 4.0,
            unstretched: 0.15,
            weight,
        });
        Law::Normalised {
            epsilon: 0.0,
            elastic,
        }
    }

    const COULOMB: Law = Law::Normalised {
        epsilon: 0.0,
        elastic: None,
    };

    /// F, θ, ξ, φ, then the state of EPP, with ν and G.
    const STATE: [f64; 5] = [0.7, 0.12, 0.03, 1.1, 0.3];
    pub(in crate::vbelt) const RIM_SPEED: f64 = 1.01;
    pub(in crate::vbelt) const FLOW: f64 = 0.95;

    fn contact(law: Law, epsilon: f64, regime: Regime, state: &[f64]) -> Contact<f64> {
        Contact::new(&groove(law, epsilon), regime, state, RIM_SPEED, FLOW)
    }

    #[test]
    fn the_face_plane_form_is_the_published_one() {
        let groove = groove(COULOMB, 0.05);
        let c = Contact::new(&groove, Regime::Slip, &STATE[..4], RIM_SPEED, FLOW);
        let [tractive, theta, deep, _, _] = STATE;
        let x = deep / RIM_SPEED;
        let tension = groove.strand.tension(tractive, FLOW);
        let v_t = theta.cos() - RIM_SPEED * (1.0 - x) / (1.0 + 6e-3 * tension);
        let v_r = theta.sin();
        let v = (v_t * v_t + v_r * v_r + 0.05 * 0.05).sqrt();
        let (sin_gamma, cos_gamma) = (v_t / v, v_r / v);
        let beta = 18_f64.to_radians();
        let beta_s = (beta.tan() * cos_gamma).atan();
        let p = 80.0 * x / (2.0 * (beta.cos() + 0.4 * beta_s.sin()));
        let f = 0.4 * p;
        // cos(θ + γ) and sin(θ + γ) with the normalised sine and cosine of γ.
        let cosine = theta.cos() * cos_gamma - theta.sin() * sin_gamma;
        let sine = theta.sin() * cos_gamma + theta.cos() * sin_gamma;
        let tension_rate = -2.0 * p * beta.sin() * theta.sin() + 2.0 * f * beta_s.cos() * sine;
        let bending = p * beta.sin() * theta.cos() - f * beta_s.cos() * cosine;
        let inclination_rate = theta.cos() / (1.0 - x) - 2.0 / tractive * bending;
        let mut rates = [0.0; 4];
        c.rates(&groove, &STATE[..4], &mut rates);
        assert!((c.pressure - p).abs() < 1e-14);
        assert!((rates[TENSION] - tension_rate).abs() < 1e-14);
        assert!((rates[INCLINATION] - inclination_rate).abs() < 1e-14);
        let torque = 2.0 * f * beta_s.cos() * sin_gamma * (1.0 - x);
        assert!((c.torque_density() - torque).abs() < 1e-14);
    }

    #[test]
    fn bristles_bent_to_their_limit_along_the_slip_are_coulomb_friction() {
        let coulomb = contact(COULOMB, 0.0, Regime::Slip, &STATE[..4]);
        let bend = coulomb.slip.map(|e| 0.4 * e / coulomb.slip_norm);
        let state = [&STATE[..4], &bend[..]].concat();
        let law = Law::Bristle {
            stiffness: 400.0,
            elastic: None,
        };
        let bristle = contact(law, 0.0, Regime::Slip, &state);
        assert!((bristle.outward - coulomb.outward).abs() < 1e-14);
        assert!((bristle.retarding - coulomb.retarding).abs() < 1e-14);
        assert!((bristle.friction() - 0.4 * bristle.pressure).abs() < 1e-14);
        let mut rates = [0.0; 6];
        bristle.rates(&groove(law, 0.0), &state, &mut rates);
        assert!(rates[LAW].abs() < 1e-13 && rates[LAW + 1].abs() < 1e-13);
    }

    #[test]
    fn epp_slips_as_coulomb_and_blends_into_it() {
        let coulomb = contact(COULOMB, 0.01, Regime::Slip, &STATE[..4]);
        let slip = contact(epp(1.0), 0.01, Regime::Slip, &STATE);
        let unblended = contact(epp(0.0), 0.01, Regime::Either, &STATE);
        assert_eq!(slip.traction, coulomb.traction);
        assert_eq!(unblended.traction, coulomb.traction);
        let mut state = STATE;
        state[LAW] = 1e-3;
        let elastic = contact(epp(1.0), 0.0, Regime::Either, &state);
        assert!((elastic.friction() - 4e-3).abs() < 1e-15);
    }

    #[test]
    fn epp_blends_without_kinks() {
        // At equal steps of the displacement, through zero and over the limit: second differences are those of a smooth function.
        let step = 1e-4;
        let friction = |share: f64, index: i32| {
            let mut state = STATE;
            state[LAW] = f64::from(index) * step;
            contact(epp(share), 0.0, Regime::Either, &state).friction()
        };
        let bent = |share: f64| {
            let second = |index| {
                let at = |index| friction(share, index);
                (at(index - 1) - 2.0 * at(index) + at(index + 1)).abs() / (step * step)
            };
            (-2000..2000).map(second).fold(0.0, f64::max)
        };
        let [half, most] = [0.5, 0.9].map(bent);
        assert!(half < 100.0 && most < 2000.0, "{half} {most}");
        assert!(bent(1.0) > 0.9 * 4.0 * 2.0 / step);
        for (share, index) in [0.1, 0.5, 0.9, 0.999]
            .into_iter()
            .flat_map(|share| [-500, 0, 3, 700, 1500].map(|index| (share, index)))
        {
            let [blended, sharp, limit] = [share, 1.0, 0.0].map(|share| friction(share, index));
            let off = (1.0 - share) * (1.0 / share + 0.3) * limit;
            assert!((blended - sharp).abs() <= off, "{share} {index}");
        }
    }

    #[test]
    fn epp_is_continuous_where_it_begins_to_slip() {
        let groove = groove(epp(1.0), 0.0);
        let slip = Contact::new(&groove, Regime::Slip, &STATE, RIM_SPEED, FLOW);
        let mut state = STATE;
        state[LAW] = 0.4 * slip.pressure / 4.0;
        assert!(limit_excess(&groove, Regime::Either, &state, RIM_SPEED, FLOW).abs() < 1e-15);
        for regime in [Regime::Elastic, Regime::Slip, Regime::Either] {
            let c = Contact::new(&groove, regime, &state, RIM_SPEED, FLOW);
            assert!((c.pressure - slip.pressure).abs() < 1e-14);
            assert!((c.retarding - slip.retarding).abs() < 1e-14);
        }
        state[LAW] *= 1.1;
        assert!(limit_excess(&groove, Regime::Either, &state, RIM_SPEED, FLOW) > 0.0);
    }

    /// States of sliding friction, the traction turned from the slip by some angle.
    fn sliding(turned: f64) -> (Law, [f64; 5]) {
        let law = Law::Sliding {
            lag: 1e-3,
            lead: 0.02,
            elastic: None,
        };
        let mut state = STATE;
        let slip = contact(law, 0.0, Regime::Slip, &state).slip;
        state[LAW] = slip[0].atan2(slip[1]) + turned;
        (law, state)
    }

    #[test]
    fn traction_along_the_slip_is_coulomb_friction() {
        let coulomb = contact(COULOMB, 0.0, Regime::Slip, &STATE[..4]);
        let (law, state) = sliding(0.0);
        let sliding = contact(law, 0.0, Regime::Slip, &state);
        assert!((sliding.outward - coulomb.outward).abs() < 1e-14);
        assert!((sliding.retarding - coulomb.retarding).abs() < 1e-14);
        assert!(sliding.misalignment().abs() < 1e-15);
    }

    #[test]
    fn the_slip_changes_as_the_states_do() {
        let (law, state) = sliding(0.3);
        let groove = groove(law, 0.0);
        let here = Contact::new(&groove, Regime::Slip, &state, RIM_SPEED, FLOW);
        let mut rates = [0.0; 5];
        here.rates(&groove, &state, &mut rates);
        let step = 1e-6;
        let [before, after] = [-step, step].map(|step| {
            let moved: Vec<f64> = state
                .iter()
                .zip(rates)
                .map(|(y, dy)| y + step * dy)
                .collect();
            Contact::new(&groove, Regime::Slip, &moved, RIM_SPEED, FLOW).slip
        });
        for (axis, rate) in here.slip_rates(&groove, &rates).iter().enumerate() {
            let difference = (after[axis] - before[axis]) / (2.0 * step);
            assert!((difference - rate).abs() < 1e-8, "{difference} {rate}");
        }
    }

    #[test]
    fn the_direction_follows_the_slip_at_the_rate_of_its_lag_and_lead() {
        let rate = |turned: f64| {
            let (law, state) = sliding(turned);
            let groove = groove(law, 0.0);
            let mut rates = [0.0; 5];
            let here = Contact::new(&groove, Regime::Slip, &state, RIM_SPEED, FLOW);
            here.rates(&groove, &state, &mut rates);
            let turning = across(here.slip_rates(&groove, &rates), here.direction);
            (here, rates[LAW], turning)
        };
        // Along the slip it turns as the slip does, but for ℓ against τ |e|.
        let (here, along, turning) = rate(0.0);
        assert!((along * (here.slip_norm * 0.02 + 1e-3) - 0.02 * turning).abs() < 1e-14);
        // Against it only ℓ resists.
        let (_, against, turning) = rate(PI);
        assert!((against * 1e-3 - 0.02 * turning).abs() < 1e-13);
    }

    #[test]
    fn a_belt_that_sticks_keeps_its_place() {
        let elastic = Some(Elastic {
            stiffness: 4.0,
            unstretched: 0.15,
            weight: 1.0,
        });
        let law = Law::Sliding {
            lag: 1e-3,
            lead: 0.02,
            elastic,
        };
        let groove = groove(law, 0.0);
        let mut state = [0.7, 0.0, 0.025 * RIM_SPEED, 1.1, 0.3, 0.02];
        let c = Contact::new(&groove, Regime::Stick, &state, RIM_SPEED, FLOW);
        let mut rates = [0.0; 6];
        c.rates(&groove, &state, &mut rates);
        let held = [TENSION, INCLINATION, PENETRATION, LAW].map(|index| rates[index]);
        assert!(held.iter().all(|rate| rate.abs() < 1e-15), "{held:?}");
        assert_eq!(rates[ANGLE], 1.0 / 0.975);
        assert!((rates[LAW + 1] - (c.tension - 0.15)).abs() < 1e-15);
        // The faces carry the transverse load, whatever friction does.
        let [sin, cos] = [groove.sin_beta, groove.cos_beta];
        let carried = 2.0 * (c.pressure * cos + c.traction[1] * sin);
        assert!((carried - c.transverse).abs() < 1e-14);
        // It begins to stick where elastic friction is as large as that.
        state[LAW + 1] = c.friction() / 4.0;
        assert!(c.traction[1] < 0.0);
        assert!(hold_excess(&groove, Regime::Elastic, &state, RIM_SPEED, FLOW).abs() < 1e-14);
        state[LAW + 1] *= 1.1;
        assert!(hold_excess(&groove, Regime::Elastic, &state, RIM_SPEED, FLOW) > 0.0);
    }

    #[test]
    fn no_friction_holds_a_belt_at_the_frictionless_penetration() {
        let mut groove = groove(COULOMB, 1e-3);
        groove.friction_coefficient = 0.0;
        // Exact for a belt along a circle of radius 1 − x: k x tan β = F/(1 − x).
        let x = 0.03;
        let tractive = x * (1.0 - x) / groove.frictionless_penetration(1.0);
        let state = [tractive, 0.0, x * RIM_SPEED, 0.0];
        let mut rates = [0.0; 4];
        let c = Contact::new(&groove, Regime::Slip, &state, RIM_SPEED, FLOW);
        c.rates(&groove, &state, &mut rates);
        assert!(rates[..3].iter().all(|rate: &f64| rate.abs() < 1e-14));
        assert_eq!(c.torque_density(), 0.0);
    }

    #[test]
    fn power_is_balanced_at_every_point() {
        for (law, extra) in [
            (COULOMB, &[][..]),
            (epp(0.7), &[0.02]),
            (
                Law::Bristle {
                    stiffness: 400.0,
                    elastic: None,
                },
                &[-0.3, 0.1],
            ),
        ] {
            let groove = groove(law, 0.02);
            let state = [&STATE[..4], extra].concat();
            let c = Contact::new(&groove, Regime::Either, &state, RIM_SPEED, FLOW);
            let mut rates = vec![0.0; state.len()];
            c.rates(&groove, &state, &mut rates);
            let [along, across] = c.friction_power_densities();
            let spent = c.torque_density() * RIM_SPEED * FLOW
                + (along + across)
                + c.transverse_power_density(&groove);
            assert!((c.speed * rates[TENSION] - spent).abs() < 1e-14);
        }
    }

    #[test]
    fn the_slip_is_linear_in_the_unknowns() {
        // V e_t/G in the middle between two states is the mean of both, however far apart they are.
        let groove = groove(COULOMB, 0.0);
        let slip = |[tractive, deep, rim_speed]: [f64; 3]| {
            let state = [tractive, 0.0, deep, 0.0];
            let c = Contact::new(&groove, Regime::Slip, &state, rim_speed, FLOW);
            c.slip[0] * c.speed / FLOW
        };
        let [one, other] = [[0.2, 0.01, 1.02], [0.9, 0.06, 0.8]];
        let middle = std::array::from_fn(|i| f64::midpoint(one[i], other[i]));
        let bent = slip(middle) - f64::midpoint(slip(one), slip(other));
        assert!(bent.abs() < 1e-15, "{bent}");
    }

    #[test]
    fn locked_slip_keeps_its_digits() {
        // ν such that V = ω r (1 + 1e-9): the slip is 1e-9 to the rounding of ν.
        let groove = groove(COULOMB, 0.0);
        let (tractive, x) = (0.7, 0.03);
        let strain = groove.strand.strain(groove.strand.tension(tractive, FLOW));
        let rim_speed = (1.0 + strain) / (1.0 - x) / (1.0 + 1e-9);
        let state = [tractive, 0.0, x * rim_speed, 0.0];
        let c = Contact::new(&groove, Regime::Slip, &state, rim_speed, FLOW);
        assert!((c.slip[0] / 1e-9 - 1.0).abs() < 5e-7);
    }
}
