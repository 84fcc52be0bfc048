//! Friction that grows with the slip velocity, f = μ n min(y/`v_s`, 1), in closed form (Leamy and
//! Wasfy, 2002).
//!
//! The slip velocity y = |V − R ω| and the traction change together, dy = (c/D) |dP|, so that below
//! saturation
//!
//! ```text
//! dy/ds = (a/v_s) y (y + b)     b =   c P(0)/D − y(0)     on the driven pulley
//! dy/ds = (a/v_s) y (b − y)     b =   c P(0)/D + y(0)     on the driver
//! ```
//!
//! and both are dy/ds = (a/`v_s`) y (B ± y) with the upper sign on the driven pulley. The belt slips
//! from its entry on, however slowly: there is no arc of adhesion.

use super::rim::contact::{Arc, Contact, Place};
use super::rim::zone::{ContactZone, Developing, Friction, Law};
use super::row::OnRims;
use super::{Parameter, Row};
use crate::mechanics::implicit::{Implicit, bracketed, near_with_slope};
use crate::quantity::Measure;
use crate::{FrictionLaw, NormalForce, ZoneKind};
use bvp::Real;

/// The last step of the secant method for the logarithm of the slip velocity at the entry. Its error is about this
/// times the step before.
const NEAR: f64 = 1e-11;

/// Turns of the guess: each divides its error by the ratio of q and Y to y(0).
const TURNS: usize = 3;

/// Loads below this many logarithms are not told apart from none by the first guess.
const LEAST: f64 = 40.0;

pub(super) const ROW: Row = Row {
    name: "creep-rate",
    title: "creep-rate",
    other: None,
    parameter: Some(Parameter {
        path: "friction.velocity",
        name: "creep velocity",
        symbol: "v_s",
        measure: Measure::Velocity,
        example: "\"0.05 m/s\"",
    }),
    with: |velocity| FrictionLaw::CreepRate { velocity },
    in_grooves: false,
    on_rims: Some(OnRims {
        convention: Some(NormalForce::Inertia),
    }),
};

/// The contact of an arc on which friction is fully developed from the slip velocity `saturation`
/// `v_s` on, m/s, for a belt whose unstretched parts move at `speed` c, m/s; `None` if the load is not
/// below the capacity of the arc.
pub(crate) fn solve<S: Implicit>(arc: Arc<S>, speed: S, saturation: S) -> Option<Contact<S>> {
    let load = arc.load();
    if load >= arc.capacity() {
        return None;
    }
    let mut evaluations = 0;
    // The unknown is the logarithm of the slip velocity at the entry, which may be less than 1e-308.
    let entry = match load > 0.0 {
        true => {
            let mut residual = |logarithm: S| {
                evaluations += 1;
                Creep::with_logarithm(&arc, speed, saturation, logarithm).load(&arc) - load
            };
            let [guess, slope] = guess(&arc, speed, saturation, load);
            let range = [f64::MIN, saturation.value().ln()];
            let near = near_with_slope(|place| Some(residual(place)), guess, slope, range, NEAR);
            let most = saturation.ln();
            let unit = speed * arc.entry() / arc.belt.stiffness;
            // The slip velocity grows at most by exp(a L (B ± v_s)/v_s) over the arc.
            let growth = arc.capacity() * (unit + saturation * 2.0) / saturation;
            let least = (unit * load.min(S::ONE)).ln() - growth - LEAST;
            let ends = [least.min(most - 1.0), most];
            let found = || {
                let values = [residual(ends[0]), arc.capacity() - load];
                bracketed(&mut residual, ends, values)
            };
            near.or_else(found)?
        }
        false => S::from_f64(f64::NEG_INFINITY),
    };
    let creep = Creep::with_logarithm(&arc, speed, saturation, entry);
    let start = Place {
        arc_length: S::ZERO,
        traction: arc.entry(),
        displacement: S::ZERO,
        friction: arc.slip_rate * arc.entry() * creep.entry / saturation,
    };
    let saturated = creep.end;
    let mut contact = Contact {
        arc,
        strain: creep.entry / speed,
        zones: vec![ContactZone {
            start,
            end: saturated,
            friction: Friction::Developing(Law::Creep(Creeping {
                creep,
                speed,
                saturation,
            })),
        }],
        evaluations,
    };
    if saturated < arc.length {
        let start = contact.end(&contact.zones[0]);
        contact.zones.push(ContactZone {
            start,
            end: arc.length,
            friction: Friction::Slip,
        });
    }
    Some(contact)
}

/// About the logarithm of the slip velocity y(0) at the entry with which an arc carries a load, and the slope of
/// the load with it.
///
/// With x of [`Creep`] at both ends of the zone of creep, whose last slip velocity Y follows from the load or is
/// `v_s`, it is y(0) = q Y/(B ± Y) exp(−a B s/`v_s`), of which the right side hardly depends on y(0).
fn guess<S: Real>(arc: &Arc<S>, speed: S, saturation: S, load: S) -> [S; 2] {
    let sense = arc.sense;
    let unit = speed * arc.entry() / arc.belt.stiffness;
    let gained = (load * sense).exp_m1() * sense * unit;
    let [mut logarithm, mut slope] = [f64::NEG_INFINITY, f64::NAN].map(S::from_f64);
    for _ in 0..TURNS {
        let entry = logarithm.exp();
        let b = unit - entry * sense;
        let mut length = arc.length;
        let mut last = gained + entry;
        slope = last / unit * (load * -sense).exp();
        if last >= saturation {
            last = saturation;
            let creeping = ((last - entry) * sense / unit).ln_1p() * sense;
            length -= (load - creeping) / arc.slip_rate;
            slope = last / unit;
        }
        let decayed = arc.slip_rate * b * length / saturation;
        logarithm = (unit * last / (b + last * sense)).ln() - decayed;
    }
    [logarithm, slope]
}

/// Friction a P y/`v_s` with the slip velocity y below `v_s`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Creeping<S = f64> {
    creep: Creep<S>,
    /// Speed c of the unstretched belt, m/s.
    speed: S,
    /// Slip velocity `v_s` of full friction, m/s.
    saturation: S,
}

impl<S: Real> Developing<S> for Creeping<S> {
    fn kind(&self) -> ZoneKind {
        ZoneKind::Creep
    }

    fn at(&self, contact: &Contact<S>, zone: &ContactZone<S>, share: S) -> Place<S> {
        let Self {
            creep,
            speed,
            saturation,
        } = *self;
        let arc = &contact.arc;
        let extent = zone.end - zone.start.arc_length;
        let distance = (S::ONE - share) * extent;
        let velocity = creep.velocity(distance);
        let load = creep.load_before(distance);
        let traction = arc.entry() * (load * arc.sense).exp();
        Place {
            arc_length: zone.start.arc_length + share * extent,
            traction,
            displacement: saturation / (arc.slip_rate * speed) * load,
            friction: arc.slip_rate * traction * velocity / saturation,
        }
    }

    fn decay_lengths(&self, contact: &Contact<S>, zone: &ContactZone<S>) -> S {
        let (arc, saturation) = (&contact.arc, self.saturation);
        let unit = self.speed * arc.entry() / arc.belt.stiffness;
        let extent = zone.end - zone.start.arc_length;
        arc.slip_rate * extent * (unit + saturation * 2.0) / saturation
    }

    /// With ds = `v_s` D/(a c) dP/(P (P − `P_o`)) that of `P_o` times the length and, with S of
    /// [`Traction::offset`](super::rim::traction::Traction::offset),
    ///
    /// ```text
    /// v_s D²/(a c S (S + P_o)) ln( P₁ (S + P₀)/(P₀ (S + P₁)) )
    /// ```
    fn elongation(&self, contact: &Contact<S>, zone: &ContactZone<S>) -> S {
        let (arc, belt) = (&contact.arc, contact.arc.belt);
        let (reference, offset) = (contact.reference(), belt.offset());
        let (from, to) = (zone.start.traction, contact.end(zone).traction);
        let logarithm = (to / from * ((offset + from) / (offset + to))).ln();
        let stiffness = belt.stiffness * belt.stiffness;
        let unit = self.saturation * stiffness / (arc.slip_rate * self.speed * offset);
        let length = zone.end - zone.start.arc_length;
        length * belt.elongation(reference) + unit * logarithm / (offset + reference)
    }
}

/// The slip velocity along an arc, until friction is fully developed.
///
/// With q = c P(0)/D and the upper sign on the driven pulley it is
///
/// ```text
/// y = B/(exp(x) ∓ 1)     x = ln(q/y(0)) − a B s/v_s     B = q ∓ y(0)
/// ```
///
/// Where `v_s` is small, x is the small difference of large numbers, so that it is counted from the end,
/// where it is ln(B/`v_s` ± 1) if friction is fully developed there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Creep<S = f64> {
    /// Sense of the friction force, as [`Arc::sense`].
    sense: f64,
    /// Rate a/`v_s`, s/m².
    rate: S,
    /// Slip velocity at the entry, m/s.
    entry: S,
    /// Velocities q and B, m/s.
    unit: S,
    b: S,
    /// Where friction is fully developed or the arc ends, m.
    end: S,
    /// Slip velocity and x there.
    last: [S; 2],
}

impl<S: Real> Creep<S> {
    /// The slip velocity that begins with a given logarithm.
    fn with_logarithm(arc: &Arc<S>, speed: S, saturation: S, logarithm: S) -> Self {
        let (sense, rate) = (arc.sense, arc.slip_rate / saturation);
        let entry = logarithm.exp();
        let unit = speed * arc.entry() / arc.belt.stiffness;
        let mut creep = Self {
            sense,
            rate,
            entry,
            unit,
            b: unit - entry * sense,
            end: S::from_f64(f64::INFINITY),
            last: [saturation, S::from_f64(f64::NAN)],
        };
        let first = unit.ln() - logarithm;
        // B/v_s ± 1, which is negative if the driver never slips so fast.
        let rest = creep.b / saturation + sense;
        if creep.is_degenerate() {
            creep.end = (S::ONE / entry - S::ONE / saturation) / rate;
        } else if rest > 0.0 {
            creep.last[1] = rest.ln();
            creep.end = (first - creep.last[1]) / (creep.b * rate);
        }
        if creep.end >= arc.length {
            creep.end = arc.length;
            creep.last[1] = first - creep.b * rate * arc.length;
            creep.last[0] = match creep.is_degenerate() {
                true => S::ONE / (S::ONE / entry - rate * arc.length),
                false => creep.velocity(S::ZERO),
            };
        }
        creep
    }

    /// Whether B is zero to rounding.
    fn is_degenerate(&self) -> bool {
        self.b.abs() < self.unit * 1e-8
    }

    /// The slip velocity y at a distance before the end, m/s.
    fn velocity(&self, distance: S) -> S {
        let [velocity, exponent] = self.last;
        if self.is_degenerate() {
            return S::ONE / (S::ONE / velocity + self.rate * distance);
        }
        let exponent = exponent + self.b * self.rate * distance;
        match self.sense > 0.0 {
            true => self.b / exponent.exp_m1(),
            false => self.b / (exponent.exp() + 1.0),
        }
    }

    /// The load |ln(P(s)/P(0))| taken up to a distance before the end,
    ///
    /// ```text
    /// ± ln(1 ∓ y(0)/q) ∓ ln(1 ∓ exp(−x))  =  a |B| s/v_s ± ln(1 ∓ q/y(0)) ∓ ln(1 ∓ exp(x))
    /// ```
    ///
    /// of which the first form loses no digits for x > 0, the second for x < 0.
    fn load_before(&self, distance: S) -> S {
        let Self { sense, unit, .. } = *self;
        if self.is_degenerate() {
            return ((self.velocity(distance) - self.entry) / unit).ln_1p();
        }
        let [_, last] = self.last;
        let exponent = last + self.b * self.rate * distance;
        let logarithm = |value: S| (value * -sense).ln_1p() * sense;
        match exponent > 0.0 {
            true => logarithm(self.entry / unit) - logarithm((-exponent).exp()),
            false => {
                let travelled = self.b.abs() * self.rate * (self.end - distance);
                travelled + logarithm(unit / self.entry) - logarithm(exponent.exp())
            }
        }
    }

    /// The load |ln(P(L)/P(0))| of an arc.
    fn load(&self, arc: &Arc<S>) -> S {
        self.load_before(S::ZERO) + arc.slip_rate * (arc.length - self.end)
    }
}
