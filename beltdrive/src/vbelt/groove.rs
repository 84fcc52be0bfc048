//! The constants of the belt on one pulley, and the laws of friction.
//!
//! The belt slips by e = (`e_t`, `e_w`) along the pulley and up the groove face, per unit of its own
//! speed (see `contact`). The traction q of a face against that slip is
//!
//! ```text
//! Coulomb   q = μ p e/|e|   (0/0 where the belt locks)
//! EPP       q = f e/|e|,    f = min(k_f |u|, μ p),         du/ds = (T − T_o)/EA
//! bristle   q = p B,        dB/ds = κ (e − |e| B/μ),       after Dahl (1968), a vector here
//! vector    q = p B,        |B| ≤ μ,                       EPP friction as a vector, see `vector`
//! ```
//!
//! A slipping contact is a bristle contact with B = μ e/|e|. The direction e/|e| is had in three ways: with
//! |e| = sqrt(`e_t`² + `e_w`² + ε²), as a state that follows it, or as that of bristles.
//!
//! Coulomb friction never holds the belt along an arc. EPP friction can: where f grows along the contact, the
//! belt that sinks comes to rest at a place at which friction straight up the groove just holds it, and behind
//! that place f is more than is needed. The belt sticks, F, θ = 0 and x constant, under
//!
//! ```text
//! q_t = 0    q_w = (k x tan β − F/r) cos β/2    |q_w| ≤ f
//! ```
//!
//! until it breaks loose in a direction of its own, at a place that the other end of the contact decides: every
//! solution behind a place at rest leaves it, and none comes to it but where `q_w` = −f.

use super::{Over, Strand, Units};
use crate::FrictionLaw;
use crate::results::steady_state::ZoneKind;
use bvp::Real;

/// Index of the tractive tension F among the states.
pub(super) const TENSION: usize = 0;
/// Index of the inclination θ.
pub(super) const INCLINATION: usize = 1;
/// Index of the penetration as ξ = m x (see `contact`).
pub(super) const PENETRATION: usize = 2;
/// Index of the swept angle φ.
pub(super) const ANGLE: usize = 3;
/// Index of the first state of the friction law: γ, u, or `B_t` followed by `B_w`.
pub(super) const LAW: usize = 4;

/// The largest number of states: those of bristles with the displacement, and in a loop the elongation of the belt.
pub(super) const MAX_STATES: usize = LAW + 4;

/// Length τ/R over which the traction is led towards the direction of the slip.
pub(super) const LEAD: f64 = 0.02;

/// How the direction of friction follows from the slip, scaled. EPP friction has an [`Elastic`] part and its
/// displacement u as the last state; without it friction is Coulomb's, or that of bristles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Law<S = f64> {
    /// Along the slip, which is normalised by ε: states F, θ, ξ, φ (and u).
    Normalised {
        /// Normalisation ε of the slip, per unit of belt speed.
        epsilon: f64,
        /// What EPP friction has more than Coulomb friction.
        elastic: Option<Elastic<S>>,
    },
    /// Along a direction γ that follows the slip: F, θ, ξ, φ, γ (and u).
    Sliding {
        /// Length ℓ/R over which the direction of the traction follows that of the slip.
        lag: f64,
        /// Length τ/R over which it is made to, by the rate of the slip.
        lead: f64,
        /// What EPP friction has more than Coulomb friction.
        elastic: Option<Elastic<S>>,
    },
    /// Along the deflection of bristles: F, θ, ξ, φ, `B_t`, `B_w` (and u).
    Bristle {
        /// Stiffness κ R.
        stiffness: S,
        /// The limit of EPP friction in place of μ p.
        elastic: Option<Elastic<S>>,
    },
    /// EPP friction as a vector: F, θ, ξ, φ, `B_t`, `B_w`.
    Vector {
        /// Stiffness `k_f` R²/`F_ref`.
        stiffness: S,
        /// How the plastic rate sets in where the regime is [`Either`](Regime::Either).
        onset: Onset,
        /// Length over which the traction of a slipping belt is led towards its slip where it follows that faster.
        lead: f64,
    },
}

/// How the plastic rate of vector EPP friction sets in where there are no zones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Onset {
    /// Half of the exponent of |B|/μ in proportion to which it does.
    pub(super) sharpness: i32,
    /// δ over p/`k_f`, by which it is rounded; zero on the way to a state.
    pub(super) rounding: f64,
}

impl<S: Real> Law<S> {
    /// A friction law with a value of its parameter, SI, on a pulley of a radius in m, with the direction of Coulomb and
    /// EPP friction as a state that follows the slip over the length ℓ/R `lag`. EPP friction is not blended;
    /// `unstretched` is the scaled tension at which its displacement does not grow.
    pub(super) fn new(
        (law, parameter): (FrictionLaw, S),
        units: &Units<S>,
        radius: S,
        unstretched: S,
        lag: f64,
    ) -> Self {
        let elastic = match law {
            FrictionLaw::Coulomb => None,
            FrictionLaw::Epp { .. } => Some(Elastic {
                stiffness: units.friction_stiffness(parameter, radius),
                unstretched,
                weight: 1.0,
            }),
            FrictionLaw::VectorEpp { .. } => {
                return Self::Vector {
                    stiffness: units.radial_stiffness(parameter, radius),
                    onset: Onset {
                        sharpness: 1,
                        rounding: 0.0,
                    },
                    lead: lag,
                };
            }
            FrictionLaw::Bristle { .. } => {
                return Self::Bristle {
                    stiffness: parameter * radius,
                    elastic: None,
                };
            }
            _ => panic!("a law for V-belts was expected"),
        };
        Self::Sliding {
            lag,
            lead: LEAD,
            elastic,
        }
    }

    /// What EPP friction has more.
    pub(super) fn elastic(&self) -> Option<Elastic<S>> {
        match self {
            Self::Normalised { elastic, .. }
            | Self::Sliding { elastic, .. }
            | Self::Bristle { elastic, .. } => *elastic,
            Self::Vector { .. } => None,
        }
    }

    /// What EPP friction has more.
    pub(super) fn elastic_mut(&mut self) -> Option<&mut Elastic<S>> {
        match self {
            Self::Normalised { elastic, .. }
            | Self::Sliding { elastic, .. }
            | Self::Bristle { elastic, .. } => elastic.as_mut(),
            Self::Vector { .. } => None,
        }
    }

    /// The length ℓ/R over which the direction follows the slip, or the normalisation ε of the slip; zero for
    /// bristles and the vector law.
    pub(super) fn smoothing(self) -> f64 {
        match self {
            Self::Normalised { epsilon, .. } => epsilon,
            Self::Sliding { lag, .. } => lag,
            Self::Vector { lead, .. } => lead,
            Self::Bristle { .. } => 0.0,
        }
    }

    /// The same law with another ℓ/R or ε. Laws without it stay as they are.
    pub(super) fn with_smoothing(mut self, smoothing: f64) -> Self {
        match &mut self {
            Self::Normalised { epsilon, .. } => *epsilon = smoothing,
            Self::Sliding { lag, .. } => *lag = smoothing,
            Self::Vector { lead, .. } => *lead = smoothing,
            Self::Bristle { .. } => {}
        }
        self
    }

    /// Vector EPP friction whose plastic rate sets in as in another law. Other laws stay as they are.
    pub(super) fn with_onset_of(mut self, like: Law) -> Self {
        if let (Self::Vector { onset, .. }, Law::Vector { onset: asked, .. }) = (&mut self, like) {
            *onset = asked;
        }
        self
    }

    /// The same law with its ℓ/R, ε or τ divided by a number, and vector EPP friction without zones as much sharper.
    pub(super) fn finer(self, times: i32) -> Self {
        let share = 1.0 / f64::from(times);
        let mut finer = self.with_smoothing(share * self.smoothing());
        if let Self::Vector { onset, .. } = &mut finer {
            onset.sharpness *= times;
            onset.rounding *= share;
        }
        finer
    }

    /// Vector EPP friction with another δ. Other laws stay as they are.
    pub(super) fn with_rounding(mut self, asked: f64) -> Self {
        if let Self::Vector { onset, .. } = &mut self {
            onset.rounding = asked;
        }
        self
    }

    /// The same law with friction whose direction is a state, or that of the slip normalised by ε. Other laws stay as
    /// they are.
    pub(super) fn with_direction(self, is_state: bool) -> Self {
        match self {
            Self::Sliding { lag, elastic, .. } if !is_state => Self::Normalised {
                epsilon: lag,
                elastic,
            },
            law => law,
        }
    }
}

/// Elastic friction below the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Elastic<S = f64> {
    /// Stiffness `k_f` R²/EA.
    pub(super) stiffness: S,
    /// Tension `T_o` at which the displacement does not grow.
    pub(super) unstretched: S,
    /// Share of EPP friction in a blend with Coulomb's, 0 to 1, where the regime is
    /// [`Either`](Regime::Either).
    pub(super) weight: f64,
}

/// The rounding η of friction between elastic friction and its limit. With 0.1 and with 1 another one of ten random drives is not
/// found along the share of elastic friction.
const ROUNDED: f64 = 0.3;

/// What is known about the friction on a segment of the contact. Only EPP friction, scalar or vector, distinguishes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Regime {
    /// Below its limit: f = `k_f` |u|, or as the slip changes it.
    Elastic,
    /// The same with a negative displacement u. Where u changes its sign friction has a kink.
    Reversed,
    /// At its limit, f = μ p.
    Slip,
    /// The belt does not slip, and friction below `k_f` |u| and μ p holds it where it is.
    Stick,
    /// The smaller of the two; not smooth where they cross.
    Either,
}

impl Regime {
    /// What is known of a law on a whole contact.
    pub(super) fn of_contact(law: FrictionLaw) -> Self {
        match law {
            FrictionLaw::Epp { .. } | FrictionLaw::VectorEpp { .. } => Self::Either,
            _ => Self::Slip,
        }
    }

    /// Whether friction is below its limit and the belt is not held.
    pub(super) fn is_elastic(self) -> bool {
        matches!(self, Self::Elastic | Self::Reversed)
    }

    /// What an engineer calls the zone.
    pub(super) fn kind(self) -> ZoneKind {
        match self {
            Self::Elastic | Self::Reversed => ZoneKind::Elastic,
            Self::Slip | Self::Either => ZoneKind::Slip,
            Self::Stick => ZoneKind::Adhesion,
        }
    }
}

/// The belt on one pulley: constants of the local mechanics, scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Groove<S = f64> {
    /// The belt as a moving string.
    pub(crate) strand: Strand<S>,
    /// Sine of the half groove angle β.
    pub(crate) sin_beta: S,
    /// Cosine of the half groove angle β.
    pub(crate) cos_beta: S,
    /// Coefficient of friction μ.
    pub(crate) friction_coefficient: S,
    /// Radial stiffness k R²/`F_ref`.
    pub(crate) radial_stiffness: S,
    /// Friction law.
    pub(crate) law: Law<S>,
}

impl<S: Real> Groove<S> {
    /// Number of states of the contact.
    pub(crate) fn states(&self) -> usize {
        self.displacement() + usize::from(self.elastic().is_some())
    }

    /// What EPP friction has more than Coulomb friction.
    pub(super) fn elastic(&self) -> Option<Elastic<S>> {
        self.law.elastic()
    }

    /// Index of the displacement u of EPP friction among the states.
    pub(super) fn displacement(&self) -> usize {
        match self.law {
            Law::Normalised { .. } => LAW,
            Law::Sliding { .. } => LAW + 1,
            Law::Bristle { .. } | Law::Vector { .. } => LAW + 2,
        }
    }

    /// Elastic friction `k_f` |u|.
    pub(super) fn elastic_friction<T: Over<S>>(&self, elastic: Elastic<S>, state: &[T]) -> T {
        state[self.displacement()].abs() * elastic.stiffness
    }

    /// Normalisation of the slip. Bristles have no 0/0 to be regularised; theirs only keeps the
    /// derivative of |e| finite where e = 0.
    pub(super) fn normalisation(&self) -> f64 {
        match self.law {
            Law::Bristle { .. } | Law::Vector { .. } | Law::Sliding { .. } => 1e-20,
            Law::Normalised { epsilon, .. } => epsilon,
        }
    }

    /// Normal load of a face when its traction is p B.
    pub(super) fn pressure<T: Over<S>>(&self, half_load: T, bristle_w: T) -> T {
        half_load / (bristle_w * self.sin_beta + self.cos_beta)
    }

    /// The friction force f per length of Coulomb's law and of EPP, whose `limit` is μ p in slip.
    pub(super) fn friction<T: Over<S>>(&self, regime: Regime, state: &[T], limit: T) -> T {
        let Some(elastic) = self.elastic() else {
            return limit;
        };
        let friction = self.elastic_friction(elastic, state);
        match regime {
            Regime::Elastic | Regime::Reversed => friction,
            Regime::Slip | Regime::Stick => limit,
            Regime::Either => elastic.blended(friction, limit),
        }
    }
}

impl<S> Elastic<S> {
    /// The smaller of elastic friction and its limit, or what is between that and the limit, with a share w less than 1, as friction
    /// without kinks: where the displacement changes its sign and where it comes to the limit,
    ///
    /// ```text
    /// e² = (k_f u)² + ((1 − w)/w μ p)²          f = (μ p + e − √((μ p − e)² + (2 η (1 − w) μ p)²))/2
    /// ```
    fn blended<T: Real>(&self, friction: T, limit: T) -> T {
        if self.weight == 1.0 {
            // By its excess, since with the rounding of `limit.min(friction)` one branch of the drive of
            // Kim (2009) with 8.1e6 N/m² takes 210 factorisations in place of 200 at most.
            return limit.min(limit + (friction - limit));
        }
        if self.weight == 0.0 {
            return limit;
        }
        let left = 1.0 - self.weight;
        let size = |one: T, other: T| {
            // Both vanish where the belt enters.
            (one * one + other * other + T::from_f64(f64::MIN_POSITIVE)).sqrt()
        };
        let rounded = size(friction, limit * (left / self.weight));
        let apart = size(limit - rounded, limit * (2.0 * ROUNDED * left));
        (limit + rounded - apart) * 0.5
    }
}

impl Groove {
    /// Penetration that carries the tension F on the pitch circle without friction, to first order
    /// in x/R: there 2 p cos β = k x and F = 2 p sin β r, so k r x tan β = F.
    pub(crate) fn frictionless_penetration(&self, tractive: f64) -> f64 {
        tractive * self.cos_beta / (self.radial_stiffness * self.sin_beta)
    }

    /// The largest scaled tension with which a belt settles in the groove without friction. In units of R and of the tension
    /// F − K x²/2 where it enters, the depth x at which it runs along a circle satisfies K x (1 − x) = 1 + K x²/2 with K = k tan β R²/T,
    /// which has a solution from K = 6 on.
    pub(crate) fn largest_tension(&self) -> f64 {
        self.radial_stiffness * self.sin_beta / self.cos_beta / 6.0
    }
}
