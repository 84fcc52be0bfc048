//! The steady state of a two-pulley drive as a boundary value problem.
//!
//! Segments are the friction zones of the driven pulley, then those of the driver, each with the
//! scaled arc length L s, 0 ≤ s ≤ 1. Unknown parameters are ω₁, G and the length L of every
//! segment. The speed ω₂ is 1.
//!
//! ```text
//! conditions per pulley with z zones and n states                              number
//!   every state continuous, and the junction     at each junction of zones    (z − 1)(n + 1)
//!   the span's tension, x = 0                    at entry and exit             4
//!   φ = 0, γ along the slip, u = 0 or B = 0      at entry                      n − 3
//! the two conditions that close the drive (see `closure`)                      2
//! ```
//!
//! A junction is where `k_f` |u| = μ p if elastic and slipping friction meet there, else it lies in
//! the middle of the turn of the traction that lifts the belt (see `Contact::turn_excess`).
//! Together Σ z n + Σ z + 2: the states and the parameters. Where another quantity is
//! prescribed instead of the tension of the tight span, that is one more parameter, the last.

use super::groove::{ANGLE, Elastic, INCLINATION, LAW, PENETRATION, TENSION};
use super::{
    Contact, DRIVEN, DRIVER, EndAngles, Groove, Law, Layout, Regime, Scales, hold_excess,
    limit_excess,
};
use crate::{Drive, FrictionLaw, SpanTension};
use bvp::{Ends, Problem, Real, Segment};
use std::ops::Range;

/// Index of the length of segment 0 among the parameters.
const LENGTHS: usize = 2;

/// Length τ/R over which the traction is led towards the direction of the slip.
const LEAD: f64 = 0.02;

/// A drive in steady motion, scaled.
#[derive(Clone, Debug)]
pub(crate) struct DriveProblem {
    scales: Scales,
    layout: Layout,
    grooves: [Groove; 2],
    /// Prescribed tensions of the slack and the tight span, scaled.
    slack: SpanTension,
    tight: SpanTension,
    /// What is prescribed instead of the tight tension, if anything.
    instead: Option<Instead>,
    /// Friction regimes along the driven pulley, then along the driver.
    regimes: Vec<Regime>,
    segments: Vec<Segment>,
    /// Number of segments on the driven pulley.
    driven_zones: usize,
}

/// A scaled quantity that is prescribed where the tight tension is unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Instead {
    /// Contact length S₂/R₂ of the driver: regular at a limit point of the tension.
    DriverLength(f64),
    /// Speed ω₁ of the driven pulley: zero where it slips grossly.
    DrivenSpeed(f64),
}

impl DriveProblem {
    /// Index of ω₁ among the parameters.
    pub(crate) const DRIVEN_SPEED: usize = 0;
    /// Index of G among the parameters.
    pub(crate) const MASS_FLOW: usize = 1;

    /// The problem of `drive` in the units `scales`, with one segment on each pulley and the slip
    /// direction of the traction smoothed: ℓ/R of Coulomb friction, ε of EPP friction. Bristles do not use it.
    /// EPP friction is not blended.
    pub(crate) fn new(drive: &Drive, scales: Scales, smoothing: f64) -> Self {
        let (sin_beta, cos_beta) = drive.belt.v().half_angle.sin_cos();
        let units = scales.units;
        let grooves = scales.radius.map(|radius| {
            let law = match drive.law {
                FrictionLaw::Coulomb => Law::Sliding {
                    lag: smoothing,
                    lead: LEAD,
                    elastic: None,
                },
                FrictionLaw::Epp { stiffness } => Law::Sliding {
                    lag: smoothing,
                    lead: LEAD,
                    elastic: Some(Elastic {
                        stiffness: units.friction_stiffness(stiffness, radius),
                        unstretched: drive.load.slack.value() / units.force,
                        weight: 1.0,
                    }),
                },
                FrictionLaw::Bristle { stiffness } => Law::Bristle {
                    stiffness: stiffness * radius,
                    elastic: None,
                },
                _ => panic!("a law for V-belts was expected"),
            };
            Groove {
                strand: units.strand(),
                sin_beta,
                cos_beta,
                friction_coefficient: drive.friction_coefficient,
                radial_stiffness: units.radial_stiffness(drive.belt.v().radial_stiffness, radius),
                law,
                epsilon: smoothing,
            }
        });
        let problem = Self {
            scales,
            layout: Layout {
                radius: scales.radius,
                centre_distance: drive.centre_distance,
            },
            grooves,
            slack: scaled(drive.load.slack, units.force),
            tight: scaled(drive.load.tight, units.force),
            instead: None,
            regimes: Vec::new(),
            segments: Vec::new(),
            driven_zones: 0,
        };
        let regime = match drive.law {
            FrictionLaw::Epp { .. } => Regime::Either,
            _ => Regime::Slip,
        };
        problem.with_zones([&[regime], &[regime]])
    }

    /// The same drive with these friction zones on the driven pulley and on the driver.
    pub(crate) fn with_zones(mut self, [driven, driver]: [&[Regime]; 2]) -> Self {
        self.regimes = [driven, driver].concat();
        self.driven_zones = driven.len();
        self.segments = vec![Segment::new(self.grooves[DRIVEN].states()); self.regimes.len()];
        self
    }

    /// The same drive with the tension of the tight span unknown (its prescribed number is no
    /// longer used) and another quantity prescribed instead.
    pub(crate) fn with_unknown_tight_tension(mut self, instead: Instead) -> Self {
        self.instead = Some(instead);
        self
    }

    /// The same drive with another prescribed tight tension, scaled.
    pub(crate) fn with_tight_tension(mut self, value: f64) -> Self {
        self.instead = None;
        self.tight = self.tight.with_value(value);
        self
    }

    /// The same drive with another length ℓ/R of Coulomb friction or normalisation ε of EPP friction. Bristles
    /// stay as they are.
    pub(crate) fn with_smoothing(mut self, smoothing: f64) -> Self {
        for groove in &mut self.grooves {
            match &mut groove.law {
                Law::Sliding { lag, .. } => *lag = smoothing,
                _ => groove.epsilon = smoothing,
            }
        }
        self
    }

    /// The same drive with Coulomb friction whose direction is a state, or that of the slip normalised by ε.
    /// Other laws stay as they are.
    pub(crate) fn with_direction(mut self, is_state: bool) -> Self {
        for groove in &mut self.grooves {
            if let (Law::Sliding { elastic, .. }, false) = (groove.law, is_state) {
                groove.law = Law::Normalised { elastic };
            }
        }
        let regimes = self.regimes.clone();
        let [driven, driver] = [DRIVEN, DRIVER].map(|pulley| &regimes[self.zones(pulley)]);
        self.with_zones([driven, driver])
    }

    /// The same drive with EPP friction blended into Coulomb friction by `share` in \[0, 1\].
    /// Coulomb and bristle friction stay as they are.
    pub(crate) fn with_epp_weight(mut self, share: f64) -> Self {
        for groove in &mut self.grooves {
            if let Some(elastic) = groove.law.elastic_mut() {
                elastic.weight = share;
            }
        }
        self
    }

    /// The same drive with the traction following the slip without a lead.
    pub(crate) fn without_lead(self) -> Self {
        self.led_by(0.0)
    }

    /// The same drive with the traction led towards the slip.
    pub(crate) fn with_lead(self) -> Self {
        self.led_by(LEAD)
    }

    fn led_by(mut self, length: f64) -> Self {
        for groove in &mut self.grooves {
            if let Law::Sliding { lead, .. } = &mut groove.law {
                *lead = length;
            }
        }
        self
    }

    /// The same drive with bristles of the stiffness κ, 1/m.
    pub(crate) fn with_bristles(mut self, stiffness: f64) -> Self {
        for (groove, radius) in self.grooves.iter_mut().zip(self.scales.radius) {
            groove.law = Law::Bristle {
                stiffness: stiffness * radius,
                elastic: groove.elastic(),
            };
        }
        let [driven, driver] = self.regimes().map(<[Regime]>::to_vec);
        self.with_zones([&driven, &driver])
    }

    /// The length ℓ/R of Coulomb friction, or the normalisation ε of EPP friction; zero for bristles.
    pub(crate) fn smoothing(&self) -> f64 {
        match self.grooves[DRIVER].law {
            Law::Sliding { lag, .. } => lag,
            Law::Normalised { .. } => self.grooves[DRIVER].epsilon,
            Law::Bristle { .. } => 0.0,
        }
    }

    /// Whether the direction of the traction is a state.
    pub(crate) fn has_direction(&self) -> bool {
        matches!(self.grooves[DRIVER].law, Law::Sliding { .. })
    }

    /// Whether the law of friction has elastic and slip zones.
    pub(crate) fn has_zones(&self) -> bool {
        self.grooves[DRIVER].elastic().is_some()
    }

    /// Whether those zones are segments.
    pub(crate) fn is_split(&self) -> bool {
        self.has_zones() && !self.regimes.contains(&Regime::Either)
    }

    /// The units of all states and parameters.
    pub(crate) fn scales(&self) -> &Scales {
        &self.scales
    }

    /// Where the pulleys are, m.
    pub(crate) fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The prescribed tensions of the slack and the tight span, scaled.
    pub(crate) fn load(&self) -> [SpanTension; 2] {
        [self.slack, self.tight]
    }

    /// The constants of the belt on a pulley.
    pub(crate) fn groove(&self, pulley: usize) -> &Groove {
        &self.grooves[pulley]
    }

    /// The friction regime of a segment.
    pub(crate) fn regime(&self, segment: usize) -> Regime {
        self.regimes[segment]
    }

    /// The friction regimes along the driven pulley and along the driver.
    pub(crate) fn regimes(&self) -> [&[Regime]; 2] {
        [DRIVEN, DRIVER].map(|pulley| &self.regimes[self.zones(pulley)])
    }

    /// The pulley of a segment.
    pub(crate) fn pulley(&self, segment: usize) -> usize {
        if segment < self.driven_zones {
            DRIVEN
        } else {
            DRIVER
        }
    }

    /// The segments of a pulley.
    pub(crate) fn zones(&self, pulley: usize) -> Range<usize> {
        match pulley {
            DRIVEN => 0..self.driven_zones,
            _ => self.driven_zones..self.regimes.len(),
        }
    }

    /// Index of the length of a segment among the parameters.
    pub(crate) fn length_index(segment: usize) -> usize {
        LENGTHS + segment
    }

    /// Scaled angular speed of a pulley.
    pub(crate) fn speed<T: Real>(pulley: usize, p: &[T]) -> T {
        match pulley {
            DRIVEN => p[Self::DRIVEN_SPEED],
            _ => T::from_f64(1.0),
        }
    }

    /// Scaled mass flow.
    pub(crate) fn flow<T: Real>(p: &[T]) -> T {
        p[Self::MASS_FLOW]
    }

    /// Scaled tight tension (of the kind that the load prescribes): prescribed or unknown.
    pub(crate) fn tight_tension<T: Real>(&self, p: &[T]) -> T {
        match self.instead {
            Some(_) => p[LENGTHS + self.segments.len()],
            None => T::from_f64(self.tight.value()),
        }
    }

    /// Scaled length of the contact with a pulley.
    pub(crate) fn contact_length<T: Real>(&self, pulley: usize, p: &[T]) -> T {
        let mut length = T::from_f64(0.0);
        for segment in self.zones(pulley) {
            length += p[Self::length_index(segment)];
        }
        length
    }

    /// All local quantities at a point of a segment.
    pub(crate) fn contact<T: Real>(&self, segment: usize, y: &[T], p: &[T]) -> Contact<T> {
        let pulley = self.pulley(segment);
        let regime = self.regimes[segment];
        Contact::new(
            &self.grooves[pulley],
            regime,
            y,
            Self::speed(pulley, p),
            Self::flow(p),
        )
    }

    /// The residual of the place of the junction before a segment, in the state there.
    fn junction<T: Real>(&self, next: usize, y: &[T], p: &[T]) -> T {
        let pulley = self.pulley(next);
        let groove = &self.grooves[pulley];
        if self.regimes[next] == Regime::Stick {
            let (speed, flow) = (Self::speed(pulley, p), Self::flow(p));
            return hold_excess(groove, self.regimes[next - 1], y, speed, flow);
        }
        if self.regimes[next - 1] == self.regimes[next] {
            return self.contact(next, y, p).turn_excess(groove);
        }
        limit_excess(groove, y, Self::speed(pulley, p), Self::flow(p))
    }

    /// Excess of the tension at an end of a contact over that of the span next to it.
    fn tension_excess<T: Real>(&self, pulley: usize, tight: bool, y: &[T], p: &[T]) -> T {
        let (kind, value) = if tight {
            (self.tight, self.tight_tension(p))
        } else {
            (self.slack, T::from_f64(self.slack.value()))
        };
        if let SpanTension::Tractive(_) = kind {
            return y[TENSION] - value;
        }
        let strand = self.grooves[pulley].strand;
        strand.tension(y[TENSION], Self::flow(p)) - value
    }
}

/// A prescribed tension in units of `force`.
fn scaled(tension: SpanTension, force: f64) -> SpanTension {
    tension.with_value(tension.value() / force)
}

impl Problem for DriveProblem {
    fn segments(&self) -> Vec<Segment> {
        self.segments.clone()
    }

    fn parameters(&self) -> usize {
        LENGTHS + self.segments.len() + usize::from(self.instead.is_some())
    }

    fn rhs<T: Real>(&self, segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        self.contact(segment, y, p)
            .rates(&self.grooves[self.pulley(segment)], y, dy);
        let length = p[Self::length_index(segment)];
        for rate in dy {
            *rate *= length;
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let mut residuals = r.iter_mut();
        let mut zero = |value: T| {
            if let Some(residual) = residuals.next() {
                *residual = value;
            }
        };
        for pulley in [DRIVEN, DRIVER] {
            let zones = self.zones(pulley);
            let (entry, exit) = (at.start(zones.start), at.end(zones.end - 1));
            zero(self.tension_excess(pulley, pulley == DRIVER, entry, p));
            zero(self.tension_excess(pulley, pulley == DRIVEN, exit, p));
            zero(entry[PENETRATION]);
            zero(exit[PENETRATION]);
            zero(entry[ANGLE]);
            let law = match self.grooves[pulley].law {
                Law::Sliding { .. } => {
                    zero(self.contact(zones.start, entry, p).misalignment(entry));
                    &entry[LAW + 1..]
                }
                _ => &entry[LAW..],
            };
            for &state in law {
                zero(state);
            }
            for next in zones.start + 1..zones.end {
                let (before, after) = (at.end(next - 1), at.start(next));
                for (index, (&before, &after)) in before.iter().zip(after).enumerate() {
                    // The belt breaks loose in a direction of its own.
                    if self.regimes[next - 1] != Regime::Stick || index != LAW {
                        zero(after - before);
                    }
                }
                if self.regimes[next] == Regime::Stick {
                    let contact = self.contact(next, after, p);
                    zero(contact.slip[0]);
                    zero(contact.slip[1]);
                }
                if self.regimes[next - 1] != Regime::Stick {
                    zero(self.junction(next, before, p));
                }
            }
        }
        let exits = [DRIVEN, DRIVER].map(|pulley| at.end(self.zones(pulley).end - 1));
        let ends = [DRIVEN, DRIVER].map(|pulley| EndAngles {
            entry: at.start(self.zones(pulley).start)[INCLINATION],
            exit: exits[pulley][INCLINATION],
        });
        let wraps = self.layout.wraps(ends);
        for pulley in [DRIVEN, DRIVER] {
            zero(exits[pulley][ANGLE] - wraps[pulley]);
        }
        match self.instead {
            None => {}
            Some(Instead::DrivenSpeed(prescribed)) => zero(p[Self::DRIVEN_SPEED] - prescribed),
            Some(Instead::DriverLength(prescribed)) => {
                zero(self.contact_length(DRIVER, p) - prescribed);
            }
        }
    }
}

#[cfg(test)]
mod tests;
