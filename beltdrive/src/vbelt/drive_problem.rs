//! The steady state of a two-pulley drive as a boundary value problem.
//!
//! Segments are the friction zones of the driven pulley, then those of the driver, each with the
//! scaled arc length L s, 0 ≤ s ≤ 1. Unknown parameters are the rim speeds ν₁ and ν₂ (see `contact`) and the length L of
//! every segment. The speed ω₂ is 1, so that G = 1/ν₂ and ω₁ = ν₁/ν₂.
//!
//! ```text
//! conditions per pulley with z zones and n states                              number
//!   the span's tension at entry and exit                                        2
//!   those in its groove (see `in_groove`)                                       (z − 1)(n + 1) + n − 1
//! the two conditions that close the drive (see `closure`)                      2
//! ```
//!
//! Together Σ z n + Σ z + 2: the states and the parameters. Where another quantity is
//! prescribed instead of the tension of the tight span, that is one more parameter, the last.

use super::belt_problem::{BeltProblem, Zoning, end_angles, in_groove};
use super::groove::{ANGLE, TENSION};
use super::numbers::{Numbers, Scaled};
use super::{Contact, DRIVEN, DRIVER, Groove, Law, Layout, Over, Regime, Scales, Units};
use crate::{Load, SpanTension, TwoPulleys};
use bvp::{Ends, Problem, Real, Segment, Solution};

/// Index of the length of segment 0 among the parameters.
const LENGTHS: usize = 2;

/// A drive in steady motion, scaled.
#[derive(Clone, Debug)]
pub(crate) struct DriveProblem {
    scales: Scales,
    scaled: Scaled,
    /// What the tensions of the spans are prescribed by.
    load: Load,
    /// What is prescribed instead of the tight tension, if anything.
    instead: Option<Instead>,
    zoning: Zoning,
    segments: Vec<Segment>,
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
    /// Index of the rim speed ν₁ of the driven pulley among the parameters.
    pub(crate) const DRIVEN_RIM_SPEED: usize = DRIVEN;
    /// Index of the rim speed ν₂ of the driver among the parameters.
    pub(crate) const DRIVER_RIM_SPEED: usize = DRIVER;

    /// The problem of `drive` in the units `scales`, with one segment on each pulley and the direction of Coulomb
    /// and EPP friction smoothed over the length ℓ/R `lag`. EPP friction is not blended.
    pub(crate) fn new(drive: &TwoPulleys, scales: Scales, lag: f64) -> Self {
        let problem = Self {
            scales,
            scaled: Numbers::new(drive).scaled(&scales.units, lag),
            load: drive.load,
            instead: None,
            zoning: Zoning::default(),
            segments: Vec::new(),
        };
        let regime = Regime::of_contact(drive.law);
        problem.with_zones(&[vec![regime], vec![regime]])
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
        self.scaled.tensions[DRIVEN] = value;
        self
    }

    /// The units of all states and parameters.
    pub(crate) fn scales(&self) -> &Scales {
        &self.scales
    }

    /// Where the pulleys are, m.
    pub(crate) fn layout(&self) -> &Layout {
        &self.scaled.layout
    }

    /// The prescribed tensions of the slack and the tight span, scaled.
    pub(crate) fn load(&self) -> [SpanTension; 2] {
        let [tight, slack] = self.scaled.tensions;
        [
            self.load.slack.with_value(slack),
            self.load.tight.with_value(tight),
        ]
    }

    /// The constants of the belt on a pulley.
    pub(crate) fn groove(&self, pulley: usize) -> &Groove {
        &self.scaled.grooves[pulley]
    }

    /// Index of the length of a segment among the parameters.
    pub(crate) fn length_index(segment: usize) -> usize {
        LENGTHS + segment
    }

    /// Scaled tight tension (of the kind that the load prescribes): prescribed or unknown.
    pub(crate) fn tight_tension<T: Real>(&self, p: &[T]) -> T {
        self.span_tension(&self.scaled, DRIVEN, p)
    }

    /// The scaled number that the tension of the span that leaves a pulley is prescribed by, or unknown.
    fn span_tension<S: Copy, T: Over<S>>(&self, drive: &Scaled<S>, from: usize, p: &[T]) -> T {
        match self.instead {
            Some(_) if from == DRIVEN => p[LENGTHS + self.segments.len()],
            _ => T::from(drive.tensions[from]),
        }
    }

    /// Excess of the tension at an end of the contact with a pulley over that of the span that lies there, which
    /// leaves the pulley `from`.
    fn tension_excess<S: Real, T: Over<S>>(
        &self,
        drive: &Scaled<S>,
        (pulley, from): (usize, usize),
        y: &[T],
        p: &[T],
    ) -> T {
        let value = self.span_tension(drive, from, p);
        let prescribed = match from {
            DRIVEN => self.load.tight,
            _ => self.load.slack,
        };
        let strand = drive.grooves[pulley].strand;
        strand.prescribed(prescribed, y[TENSION], self.flow(p)) - value
    }

    /// The right-hand side on a segment for a belt with these constants on its pulley.
    pub(super) fn rates<S: Real, T: Over<S>>(
        &self,
        groove: &Groove<S>,
        segment: usize,
        y: &[T],
        p: &[T],
        dy: &mut [T],
    ) {
        let (rim_speed, flow) = (self.rim_speed(self.pulley(segment), p), self.flow(p));
        Contact::new(groove, self.regime(segment), y, rim_speed, flow).rates(groove, y, dy);
        let length = self.length(segment, p);
        for rate in dy {
            *rate *= length;
        }
    }

    /// The conditions for a drive with these numbers.
    pub(super) fn residuals<S: Real, T: Over<S>>(
        &self,
        drive: &Scaled<S>,
        at: Ends<'_, T>,
        p: &[T],
        r: &mut [T],
    ) {
        let mut residuals = r.iter_mut();
        let mut zero = |value: T| {
            if let Some(residual) = residuals.next() {
                *residual = value;
            }
        };
        let exits = [DRIVEN, DRIVER].map(|pulley| at.end(self.zones(pulley).end - 1));
        for pulley in [DRIVEN, DRIVER] {
            let entry = at.start(self.zones(pulley).start);
            zero(self.tension_excess(drive, (pulley, 1 - pulley), entry, p));
            zero(self.tension_excess(drive, (pulley, pulley), exits[pulley], p));
            in_groove(self, (pulley, &drive.grooves[pulley]), &at, p, &mut zero);
        }
        let ends = [DRIVEN, DRIVER].map(|pulley| end_angles(self, pulley, &at));
        let wraps = drive.layout.wraps(ends);
        for pulley in [DRIVEN, DRIVER] {
            zero(exits[pulley][ANGLE] - wraps[pulley]);
        }
        match self.instead {
            None => {}
            Some(Instead::DrivenSpeed(prescribed)) => zero(self.omega(DRIVEN, p) - prescribed),
            Some(Instead::DriverLength(prescribed)) => {
                zero(self.contact_length(DRIVER, p) - prescribed);
            }
        }
    }
}

impl BeltProblem for DriveProblem {
    fn zoning(&self) -> &Zoning {
        &self.zoning
    }

    fn in_groove(&self, pulley: usize) -> Option<&Groove> {
        Some(&self.scaled.grooves[pulley])
    }

    fn rim_speed<T: Real>(&self, pulley: usize, p: &[T]) -> T {
        p[pulley]
    }

    /// Exactly 1 of the driver.
    fn omega<T: Real>(&self, pulley: usize, p: &[T]) -> T {
        match pulley {
            DRIVEN => p[Self::DRIVEN_RIM_SPEED] / p[Self::DRIVER_RIM_SPEED],
            _ => T::ONE,
        }
    }

    fn sense(&self, pulley: usize) -> f64 {
        match pulley {
            DRIVEN => 1.0,
            _ => -1.0,
        }
    }

    fn flow<T: Real>(&self, p: &[T]) -> T {
        T::ONE / p[Self::DRIVER_RIM_SPEED]
    }

    fn first_length(&self) -> usize {
        LENGTHS
    }

    fn behind_lengths(&self, solution: &Solution) -> f64 {
        self.tight_tension(solution.parameters())
    }

    fn constants(&self, solution: &Solution) -> Vec<f64> {
        let p = solution.parameters();
        let wrap = |pulley| solution.end(self.zones(pulley).end - 1)[ANGLE];
        vec![
            self.omega(DRIVEN, p),
            self.flow(p),
            wrap(DRIVEN),
            wrap(DRIVER),
        ]
    }

    fn pitch_radius(&self, pulley: usize) -> f64 {
        self.scales.radius[pulley]
    }

    fn units(&self) -> Units {
        self.scales.units
    }

    fn with_zones(mut self, zones: &[Vec<Regime>]) -> Self {
        self.zoning = Zoning::new(zones);
        self.segments = vec![Segment::new(self.groove(DRIVEN).states()); self.zoning.count()];
        self
    }

    fn with_laws(mut self, change: impl Fn(Law, f64) -> Law) -> Self {
        let grooves = self.scaled.grooves.iter_mut();
        for (groove, radius) in grooves.zip(self.scales.radius) {
            groove.law = change(groove.law, radius);
        }
        self.segments
            .fill(Segment::new(self.scaled.grooves[DRIVEN].states()));
        self
    }
}

impl Problem for DriveProblem {
    fn segments(&self) -> Vec<Segment> {
        self.segments.clone()
    }

    fn parameters(&self) -> usize {
        LENGTHS + self.segments.len() + usize::from(self.instead.is_some())
    }

    fn rhs<T: Real>(&self, segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        self.rates(self.groove(self.pulley(segment)), segment, y, p, dy);
    }

    /// On the rim speed of its pulley, the mass flow and its own length.
    fn depends(&self, segment: usize, parameter: usize) -> bool {
        match parameter {
            Self::DRIVEN_RIM_SPEED => self.pulley(segment) == DRIVEN,
            Self::DRIVER_RIM_SPEED => true,
            length => length == Self::length_index(segment),
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        self.residuals(&self.scaled, at, p, r);
    }
}

#[cfg(test)]
mod tests;
