//! Vector EPP friction at a point of the contact: bristles of constant stiffness that yield.
//!
//! The traction q = p B of a face grows with the slip e that is not plastic (ideal elastoplasticity, Simo and Hughes
//! 1998, chapter 1, with a limit that depends on the pressure):
//!
//! ```text
//! d(p B)/ds = k_f (e − σ Λ B/μ)         |B| ≤ μ
//! Λ = e·B/μ − μ p'/k_f                  the plastic rate, up to a positive factor, with
//! p' = (k x'/2 − k_f e_w sin β)/cos β   as long as friction is elastic
//!
//! elastic   σ = 0                       ends where |B| = μ
//! slip      σ = 1, so |B| stays μ       ends where Λ = 0
//! either    σ = (|B|/μ)^2m, with        tends to the law as m grows and δ falls, without zones
//!           (Λ + sqrt(Λ² + δ²))/2       in place of Λ
//! ```
//!
//! Without δ there would be a kink where Λ changes its sign, and along a branch of states a kink wherever it passes a
//! collocation point: on a drive with stiff friction the steps became a millionth of the load there, and branch points were
//! seen that are none. Its effect is of the order δ², and δ is a share of p/`k_f`, the order of Λ where friction is elastic.
//!
//! In slip p dB/ds = `k_f` (e − (e·B) B/μ²): the direction follows the slip over the length μ p/`k_f`, which is zero
//! where the belt enters and leaves. Gauss collocation does not damp what decays that fast. There the traction is led
//! towards the slip, over a length τ, by the rate of the slip: with ⊥ for what is across B,
//!
//! ```text
//! (p/k_f + τ (e·B/μ + |e|)/2μ) dB/ds = e⊥ + τ e'⊥         τ = τ₀ a²/(a² + p²),  a = k_f τ₀ |e|/μ
//! ```
//!
//! What leads the traction is the derivative of what makes it lag, which is of the order of τ there, so that the error is
//! of the order τ₀². Where the plastic rate sets in gradually, both terms with τ have the factor (|B|/μ)^2m.

use super::groove::{LAW, Law, Onset};
use super::{Contact, Groove, Over, Regime};
use bvp::Real;

/// Vector EPP friction of a contact.
pub(super) struct Yielding<'c, T, S = f64> {
    contact: &'c Contact<T>,
    /// Scaled stiffness `k_f`.
    stiffness: S,
    /// How the plastic rate sets in without zones.
    onset: Onset,
    /// The length τ₀.
    lead: f64,
    friction_coefficient: S,
    /// B.
    deflection: [T; 2],
    /// The derivative p' as long as friction is elastic.
    pressure_rate: T,
}

impl<'c, S: Real, T: Over<S>> Yielding<'c, T, S> {
    /// That of a contact in a state; `None` with another law.
    pub(super) fn new(contact: &'c Contact<T>, groove: &Groove<S>, state: &[T]) -> Option<Self> {
        let Law::Vector {
            stiffness,
            onset,
            lead,
        } = groove.law
        else {
            return None;
        };
        let [_, up] = contact.slip;
        let deeper = contact.sin_theta * (groove.radial_stiffness * -0.5);
        Some(Self {
            contact,
            stiffness,
            onset,
            lead,
            friction_coefficient: groove.friction_coefficient,
            deflection: [state[LAW], state[LAW + 1]],
            pressure_rate: (deeper - up * (stiffness * groove.sin_beta)) / groove.cos_beta,
        })
    }

    /// Component along B of a vector in the groove face, times μ.
    fn along(&self, [t, w]: [T; 2]) -> T {
        t * self.deflection[0] + w * self.deflection[1]
    }

    /// A vector in the groove face less its component along B, whose length is μ.
    fn across(&self, vector: [T; 2]) -> [T; 2] {
        let share = self.along(vector) / self.friction_coefficient.powi(2);
        [0, 1].map(|axis| vector[axis] - share * self.deflection[axis])
    }

    /// The plastic rate Λ.
    pub(super) fn plastic_rate(&self) -> T {
        let mu = self.friction_coefficient;
        self.along(self.contact.slip) / mu - self.pressure_rate * (mu / self.stiffness)
    }

    /// δ.
    fn least_plastic_rate(&self) -> T {
        self.contact.pressure * (S::from_f64(self.onset.rounding) / self.stiffness)
    }

    /// (|B|/μ)^2m, the share of the plastic rate that a gradual onset lets act.
    fn acting_share(&self) -> T {
        let share = self.along(self.deflection) / self.friction_coefficient.powi(2);
        share.powi(self.onset.sharpness)
    }

    /// p dB/ds over `k_f` where the belt is not taken to slip.
    fn growth(&self) -> [T; 2] {
        let mu = self.friction_coefficient;
        let plastic = match self.contact.regime {
            Regime::Either => {
                let (rate, least) = (self.plastic_rate(), self.least_plastic_rate());
                let rounded = match self.onset.rounding {
                    0.0 => rate.max(T::from_f64(0.0)),
                    _ => ((rate * rate + least * least).sqrt() + rate) * 0.5,
                };
                rounded * self.acting_share()
            }
            _ => T::from_f64(0.0),
        };
        let decay = plastic / mu + self.pressure_rate / self.stiffness;
        [0, 1].map(|axis| self.contact.slip[axis] - decay * self.deflection[axis])
    }

    /// dB/ds, with the derivative e' of the slip where it is needed.
    pub(super) fn rates(&self, turning: impl FnOnce() -> [T; 2]) -> [T; 2] {
        let (contact, mu) = (self.contact, self.friction_coefficient);
        let length = contact.pressure / self.stiffness;
        if contact.regime.is_elastic() || contact.regime == Regime::Stick {
            return self.growth().map(|growth| growth / length);
        }
        let least = (contact.slip_norm * (self.stiffness * self.lead / mu)).powi(2);
        let lead = least / (least + contact.pressure * contact.pressure) * self.lead;
        let weight = (self.along(contact.slip) / mu + contact.slip_norm) * (S::from_f64(0.5) / mu);
        let turning = self.across(turning());
        let (growth, lead) = match contact.regime {
            Regime::Either => (self.growth(), lead * self.acting_share()),
            _ => (self.across(contact.slip), lead),
        };
        [0, 1].map(|axis| (growth[axis] + lead * turning[axis]) / (length + lead * weight))
    }

    /// What is zero at the entry, where there is no pressure: the growth, and in slip the angle between traction
    /// and slip.
    pub(super) fn entering(&self) -> [T; 2] {
        let contact = self.contact;
        match contact.regime {
            Regime::Slip => [0, 1].map(|axis| {
                let along = contact.slip[axis] / contact.slip_norm;
                self.deflection[axis] - along * self.friction_coefficient
            }),
            _ => self.growth(),
        }
    }

    /// What is zero at the end of a zone, negative where friction is elastic and positive where it is plastic: |B| − μ
    /// in an elastic zone, and in slip the plastic rate over the strain of the reference force. In a gradual onset the
    /// smaller one, with a share of μ that a belt that slips reaches.
    pub(super) fn excess(&self, strain: S) -> T {
        let over = |share: f64| {
            self.deflection[0].hypot(self.deflection[1]) - self.friction_coefficient * share
        };
        match self.contact.regime {
            Regime::Elastic | Regime::Reversed | Regime::Stick => over(1.0),
            Regime::Slip => self.plastic_rate() / strain,
            Regime::Either => over(SLIPPING).min(self.plastic_rate() / strain),
        }
    }
}

/// Share of μ from which on a belt is seen to slip where the plastic rate sets in with the fourth power of |B|/μ: that
/// of the plastic rate is 0.8 then.
const SLIPPING: f64 = 0.95;

#[cfg(test)]
mod tests {
    use super::super::contact::tests::{FLOW, RIM_SPEED, groove};
    use super::*;

    const STIFFNESS: f64 = 700.0;

    /// A groove, and a state whose deflection is some share of its limit.
    fn yielding(share: f64, lead: f64) -> (Groove, [f64; 6]) {
        let law = Law::Vector {
            stiffness: STIFFNESS,
            onset: Onset {
                sharpness: 2,
                rounding: 0.0,
            },
            lead,
        };
        let groove = groove(law, 0.0);
        let limit = share * groove.friction_coefficient;
        (groove, [0.7, 0.12, 0.03, 1.1, 0.8 * limit, 0.6 * limit])
    }

    /// Derivatives of both tractions and of |B|.
    fn growing(groove: &Groove, regime: Regime, state: &[f64; 6]) -> ([f64; 2], f64) {
        let at = |state: &[f64]| Contact::new(groove, regime, state, RIM_SPEED, FLOW);
        let mut rates = [0.0; 6];
        at(state).rates(groove, state, &mut rates);
        let step = 1e-7;
        let [(before, less), (after, more)] = [-step, step].map(|step| {
            let each = state.iter().zip(rates);
            let moved: Vec<f64> = each.map(|(y, dy)| y + step * dy).collect();
            (at(&moved).traction, moved[LAW].hypot(moved[LAW + 1]))
        });
        let growth = [0, 1].map(|axis| (after[axis] - before[axis]) / (2.0 * step));
        (growth, (more - less) / (2.0 * step))
    }

    #[test]
    fn elastic_traction_grows_with_the_slip() {
        let (groove, state) = yielding(0.7, 0.0);
        let (growth, _) = growing(&groove, Regime::Elastic, &state);
        let contact = Contact::new(&groove, Regime::Elastic, &state, RIM_SPEED, FLOW);
        for (growth, slip) in growth.into_iter().zip(contact.slip) {
            assert!((growth / (STIFFNESS * slip) - 1.0).abs() < 1e-6);
        }
        let yielding = Yielding::new(&contact, &groove, &state).unwrap();
        assert!(yielding.excess(groove.strand.compliance) < 0.0);
    }

    #[test]
    fn a_belt_that_slips_stays_at_the_limit_and_elastic_friction_would_pass_it_at_the_plastic_rate()
    {
        for lead in [0.0, 1e-3] {
            let (groove, state) = yielding(1.0, lead);
            let (_, growth) = growing(&groove, Regime::Slip, &state);
            assert!(growth.abs() < 1e-5, "{growth}");
        }
        let (groove, state) = yielding(1.0, 0.0);
        let contact = Contact::new(&groove, Regime::Elastic, &state, RIM_SPEED, FLOW);
        let plastic = Yielding::new(&contact, &groove, &state)
            .unwrap()
            .plastic_rate();
        let (_, growth) = growing(&groove, Regime::Elastic, &state);
        assert!(plastic > 0.0);
        assert!((growth * contact.pressure / (STIFFNESS * plastic) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn a_gradual_onset_is_that_of_the_law_at_the_limit_and_elastic_where_nothing_is_plastic() {
        let (groove, state) = yielding(1.0, 0.0);
        let [gradual, slip] =
            [Regime::Either, Regime::Slip].map(|regime| growing(&groove, regime, &state).0);
        for (gradual, slip) in gradual.into_iter().zip(slip) {
            assert!((gradual / slip - 1.0).abs() < 1e-5, "{gradual} {slip}");
        }
        let (groove, mut state) = yielding(1.0, 0.0);
        (state[LAW], state[LAW + 1]) = (-state[LAW], -state[LAW + 1]);
        let [gradual, elastic] =
            [Regime::Either, Regime::Elastic].map(|regime| growing(&groove, regime, &state).0);
        assert_eq!(gradual, elastic);
    }
}
