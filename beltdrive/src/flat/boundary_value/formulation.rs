//! The steady state of a flat-belt drive as a boundary value problem.
//!
//! Segments are the friction zones of the driven pulley, then those of the driver, on 0 ≤ ξ ≤ 1. With
//! the coordinate σ along the belt, which is arc length, or length of the unstretched belt where the
//! convention is `exact`, and the length ℓ of the zone in it, σ = σ₀ + ℓ ξ. The states are the
//! excess of the belt tension T over `T_o`, at which the belt runs as fast as the rim, the displacement u
//! of the belt against the rim (positive on the driven pulley, negative on the driver) and the arc length
//! s from the entry:
//!
//! ```text
//! (1 − m v²/EA) d(T − T_o)/dσ = f   balance of momentum, d(T − G V) with G = m c, V = c (1 + T/EA)
//! du/dσ = (T − T_o)/EA              slip velocity V − R ω = c u′
//! ds/dσ = 1, or 1 + T/EA            `exact`
//! ```
//!
//! with v = c, or the speed c (1 + `T_slack`/EA) of the slack span (`thesis`). The friction f per
//! coordinate is, with the normal force n = (T − G V)/R, or T/R (`thesis`), and the upper sign on the
//! driven pulley,
//!
//! ```text
//! adhesion   0
//! elastic    k_f u
//! slip       ± μ n ds/dσ
//! creep      μ n (V − R ω)/v_s ds/dσ
//! ```
//!
//! Unknown parameters are c, the tension `T_o` of each pulley, which is its speed R ω = c (1 + `T_o`/EA),
//! the tensions of the spans and the length ℓ of every zone:
//!
//! ```text
//! conditions with z zones in all                                        number
//!   T that of the span, u = 0, s = 0      at entry                       6
//!   T that of the span, s = R × wrap      at exit                        4
//!   T, u, s and f continuous              between zones                  4 (z − 2)
//!   the speed of the driver               R₂ ω₂ = c (1 + T_o/EA)         1
//!   the load                              of each span                   2
//! ```
//!
//! Together 4 z + 5: three states and the length of each zone, and five parameters. Between adhesion,
//! where friction is whatever holds the belt, and slip `T = T_o` takes the place of continuous friction.

use super::super::{DRIVEN, DRIVER};
use super::units::Units;
use crate::{FrictionLaw, Load, NormalForce, SpanTension, TwoPulleys, ZoneKind};
use bvp::{Ends, Problem, Real, Segment};
use std::ops::Range;

/// Index of the excess T − `T_o` of the tension among the states.
pub(super) const EXCESS: usize = 0;
/// Index of the displacement u.
pub(super) const DISPLACEMENT: usize = 1;
/// Index of the arc length s.
pub(super) const ARC_LENGTH: usize = 2;
/// Number of states.
const STATES: usize = 3;

/// Index of the speed c among the parameters.
pub(super) const SPEED: usize = 0;
/// Index of the tension `T_o` of the driven pulley; that of the driver is next.
pub(super) const REFERENCE: usize = 1;
/// Index of the tension of the slack span; that of the tight span is next.
pub(super) const SPANS: usize = 3;
/// Index of the length of segment 0.
pub(super) const LENGTHS: usize = 5;

/// The span that the belt comes from, of the driven pulley and of the driver: slack, tight.
pub(super) const ENTRY: [usize; 2] = [0, 1];
/// The span that it goes to.
pub(super) const EXIT: [usize; 2] = [1, 0];
/// Sense of the friction force on the belt: against its motion on the driver.
pub(super) const SENSE: [f64; 2] = [1.0, -1.0];

/// A flat-belt drive in steady motion with given kinds of zones, scaled.
#[derive(Clone, Debug)]
pub(super) struct Formulation {
    /// The units of all states and parameters.
    pub(super) units: Units,
    /// How the normal force follows from the tension.
    convention: NormalForce,
    /// Coefficient of friction μ.
    pub(super) friction_coefficient: f64,
    /// Strain F₀/EA of the unit of tension.
    pub(super) compliance: f64,
    /// The number m (ω₂ R₂)²/EA.
    pub(super) kinetic: f64,
    /// Slip velocity `v_s` of full friction.
    pub(super) saturation: f64,
    /// Friction stiffness as `k_f` R²/EA.
    pub(super) stiffness: [f64; 2],
    /// Wrap angles, rad.
    pub(super) wrap: [f64; 2],
    /// What is prescribed for the spans.
    pub(super) load: Load,
    /// Whether zones are segments. If not, elastic friction ends at its limit, with a kink.
    zoned: bool,
    /// Kinds of the zones of the driven pulley, then of those of the driver.
    kinds: Vec<ZoneKind>,
    /// The zones as segments.
    segments: Vec<Segment>,
    /// Number of zones of the driven pulley.
    driven_zones: usize,
}

impl Formulation {
    /// The problem of `drive` with these wrap angles, convention and zones.
    pub(super) fn new(
        drive: &TwoPulleys,
        wrap: [f64; 2],
        convention: NormalForce,
        zones: &[Vec<ZoneKind>; 2],
    ) -> Self {
        let (stiffness, saturation) = match drive.law {
            FrictionLaw::Epp { stiffness } => (Some(stiffness), f64::NAN),
            FrictionLaw::CreepRate { velocity } => (None, velocity),
            _ => (None, f64::NAN),
        };
        let units = Units::new(drive);
        let axial = drive.belt.axial_stiffness;
        let scaled = |span: SpanTension| {
            let unit = match span {
                SpanTension::DrivenTorque(_) => units.force * drive.driven_radius,
                SpanTension::Belt(_) | SpanTension::Tractive(_) => units.force,
            };
            span.with_value(span.value() / unit)
        };
        let kinds = zones.concat();
        Self {
            units,
            convention,
            friction_coefficient: drive.friction_coefficient,
            compliance: units.force / axial,
            kinetic: drive.belt.mass_per_length * units.speed * units.speed / axial,
            saturation: saturation / units.speed,
            stiffness: units
                .radius
                .map(|radius| stiffness.unwrap_or(f64::NAN) * radius * radius / axial),
            wrap,
            load: Load {
                slack: scaled(drive.load.slack),
                tight: scaled(drive.load.tight),
            },
            zoned: true,
            segments: vec![Segment::new(STATES); kinds.len()],
            kinds,
            driven_zones: zones[DRIVEN].len(),
        }
    }

    /// The same drive with one segment on each pulley: friction is elastic up to its limit, wherever it
    /// reaches that. Solutions are not smooth and meshes have to be fine, but nothing need be known of
    /// zones.
    pub(super) fn unzoned(&self) -> Self {
        let kinds = vec![ZoneKind::Elastic; 2];
        Self {
            zoned: false,
            segments: vec![Segment::new(STATES); kinds.len()],
            kinds,
            driven_zones: 1,
            ..self.clone()
        }
    }

    /// The pulley of a segment.
    pub(super) fn pulley(&self, segment: usize) -> usize {
        match segment < self.driven_zones {
            true => DRIVEN,
            false => DRIVER,
        }
    }

    /// The segments of a pulley.
    pub(super) fn zones(&self, pulley: usize) -> Range<usize> {
        match pulley {
            DRIVEN => 0..self.driven_zones,
            _ => self.driven_zones..self.kinds.len(),
        }
    }

    /// The kind of the zone of a segment.
    pub(super) fn kind(&self, segment: usize) -> ZoneKind {
        self.kinds[segment]
    }

    /// The share m v²/EA of the tension that accelerates the belt.
    pub(super) fn inertia<T: Real>(&self, p: &[T]) -> T {
        let speed = match self.convention {
            NormalForce::Thesis => p[SPEED] * (p[SPANS] * self.compliance + 1.0),
            NormalForce::Inertia | NormalForce::Exact => p[SPEED],
        };
        speed * speed * self.kinetic
    }

    /// Tractive tension T − G V.
    pub(super) fn tractive<T: Real>(&self, tension: T, speed: T) -> T {
        let flow = speed * speed * (self.kinetic / self.compliance);
        tension - flow * (tension * self.compliance + 1.0)
    }

    /// The tension T with a given tractive tension.
    pub(super) fn tension_of_tractive(&self, tractive: f64, speed: f64) -> f64 {
        let kinetic = self.kinetic * speed * speed;
        (tractive + kinetic / self.compliance) / (1.0 - kinetic)
    }

    /// The tension T with a given normal force.
    pub(super) fn tension_of_normal(&self, normal: f64, speed: f64) -> f64 {
        match self.convention {
            NormalForce::Thesis => normal,
            NormalForce::Inertia | NormalForce::Exact => self.tension_of_tractive(normal, speed),
        }
    }

    /// Normal force n per arc length.
    pub(super) fn normal<T: Real>(&self, tension: T, speed: T) -> T {
        match self.convention {
            NormalForce::Thesis => tension,
            NormalForce::Inertia | NormalForce::Exact => self.tractive(tension, speed),
        }
    }

    /// The stretch ds/dσ.
    pub(super) fn stretch<T: Real>(&self, tension: T) -> T {
        match self.convention {
            NormalForce::Thesis | NormalForce::Inertia => T::from_f64(1.0),
            NormalForce::Exact => tension * self.compliance + 1.0,
        }
    }

    /// The tension T with given states of a segment.
    pub(super) fn tension<T: Real>(&self, segment: usize, y: &[T], p: &[T]) -> T {
        let pulley = self.pulley(segment);
        let unit = self.units.excess(pulley, self.kinds[segment]);
        p[REFERENCE + pulley] + y[EXCESS] * unit
    }

    /// Friction force f per coordinate σ with given states of a segment, if it is of this kind.
    pub(super) fn friction<T: Real>(&self, segment: usize, kind: ZoneKind, y: &[T], p: &[T]) -> T {
        let pulley = self.pulley(segment);
        let limit = || {
            let tension = self.tension(segment, y, p);
            self.normal(tension, p[SPEED]) * self.stretch(tension) * self.friction_coefficient
        };
        match kind {
            ZoneKind::Adhesion => T::from_f64(0.0),
            ZoneKind::Elastic => {
                let elastic = y[DISPLACEMENT] * self.friction_coefficient;
                match (self.zoned, pulley) {
                    (true, _) => elastic,
                    (false, DRIVEN) => elastic.min(limit()),
                    (false, _) => elastic.max(-limit()),
                }
            }
            ZoneKind::Slip => limit() * SENSE[pulley],
            ZoneKind::Creep => {
                let excess = self.units.excess(pulley, kind);
                limit() * p[SPEED] * y[EXCESS] * (excess * self.compliance / self.saturation)
            }
        }
    }

    /// The differential equations of a segment with the friction force f.
    pub(super) fn rates<T: Real>(
        &self,
        segment: usize,
        friction: T,
        y: &[T],
        p: &[T],
        dy: &mut [T],
    ) {
        let (pulley, length) = (self.pulley(segment), p[LENGTHS + segment]);
        let kind = self.kinds[segment];
        let excess = self.units.excess(pulley, kind);
        let displacement = self.units.displacement(pulley, kind) / self.units.radius[pulley];
        dy[EXCESS] = length * friction / (-self.inertia(p) + 1.0) / excess;
        dy[DISPLACEMENT] = length * y[EXCESS] * (self.compliance * excess / displacement);
        dy[ARC_LENGTH] = length * self.stretch(self.tension(segment, y, p));
    }

    /// The excess of the load of a span over what is prescribed.
    fn excess<T: Real>(&self, span: SpanTension, tension: T, p: &[T]) -> T {
        match span {
            SpanTension::Belt(value) => tension - value,
            SpanTension::Tractive(value) => self.tractive(tension, p[SPEED]) - value,
            SpanTension::DrivenTorque(value) => {
                (p[SPANS + 1] - p[SPANS]) * (-self.inertia(p) + 1.0) - value
            }
        }
    }

    /// The condition that says where a zone ends and the next one begins.
    fn border<T: Real>(&self, segment: usize, at: &Ends<'_, T>, p: &[T]) -> T {
        let (before, after) = (at.end(segment), at.start(segment + 1));
        match [self.kinds[segment], self.kinds[segment + 1]] {
            [ZoneKind::Adhesion, _] => before[EXCESS],
            [kind, next] => {
                self.friction(segment + 1, next, after, p) - self.friction(segment, kind, before, p)
            }
        }
    }

    /// The step of a state between a segment and the next one, in the greater of its units.
    fn step<T: Real>(units: [f64; 2], before: T, after: T) -> T {
        let unit = units[0].max(units[1]);
        after * (units[1] / unit) - before * (units[0] / unit)
    }
}

impl Problem for Formulation {
    fn segments(&self) -> Vec<Segment> {
        self.segments.clone()
    }

    fn parameters(&self) -> usize {
        LENGTHS + self.segments.len()
    }

    fn rhs<T: Real>(&self, segment: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
        let friction = self.friction(segment, self.kinds[segment], y, p);
        self.rates(segment, friction, y, p, dy);
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
            let last = zones.end - 1;
            let (entry, exit) = (at.start(zones.start), at.end(last));
            zero(self.tension(zones.start, entry, p) - p[SPANS + ENTRY[pulley]]);
            zero(entry[DISPLACEMENT]);
            zero(entry[ARC_LENGTH]);
            zero(match self.kinds[last] {
                // The tension cannot change: both spans have it by the load.
                ZoneKind::Adhesion => exit[EXCESS],
                _ => self.tension(last, exit, p) - p[SPANS + EXIT[pulley]],
            });
            zero(exit[ARC_LENGTH] - self.wrap[pulley]);
            for segment in zones.start..last {
                let (before, after) = (at.end(segment), at.start(segment + 1));
                let kinds = [self.kinds[segment], self.kinds[segment + 1]];
                let excess = kinds.map(|kind| self.units.excess(pulley, kind));
                let unit = kinds.map(|kind| self.units.displacement(pulley, kind));
                zero(Self::step(excess, before[EXCESS], after[EXCESS]));
                zero(Self::step(unit, before[DISPLACEMENT], after[DISPLACEMENT]));
                zero(after[ARC_LENGTH] - before[ARC_LENGTH]);
                zero(self.border(segment, &at, p));
            }
        }
        zero(p[SPEED] * (p[REFERENCE + DRIVER] * self.compliance + 1.0) - 1.0);
        zero(self.excess(self.load.slack, p[SPANS], p));
        zero(self.excess(self.load.tight, p[SPANS + 1], p));
    }
}
