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
use crate::mechanics::root::{bracketed, near_with_slope};
use crate::quantity::Measure;
use crate::{FrictionLaw, NormalForce, ZoneKind};

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
        solve,
        convention: Some(NormalForce::Inertia),
    }),
};

/// The contact of an arc on which friction is fully developed from the slip velocity `saturation`
/// `v_s` on, m/s, for a belt whose unstretched parts move at `speed` c, m/s; `None` if the load is not
/// below the capacity of the arc.
pub(crate) fn solve(arc: Arc, speed: f64, saturation: f64) -> Option<Contact> {
    let load = arc.load();
    if load >= arc.capacity() {
        return None;
    }
    let mut evaluations = 0;
    // The unknown is the logarithm of the slip velocity at the entry, which may be less than 1e-308.
    let entry = match load > 0.0 {
        true => {
            let mut residual = |logarithm: f64| {
                evaluations += 1;
                Creep::with_logarithm(&arc, speed, saturation, logarithm).load(&arc) - load
            };
            let [guess, slope] = guess(&arc, speed, saturation, load);
            let range = [f64::MIN, saturation.ln()];
            let near = near_with_slope(|place| Some(residual(place)), guess, slope, range, NEAR);
            let most = saturation.ln();
            let unit = speed * arc.entry() / arc.belt.stiffness;
            // The slip velocity grows at most by exp(a L (B ± v_s)/v_s) over the arc.
            let growth = arc.capacity() * (unit + 2.0 * saturation) / saturation;
            let least = (unit * load.min(1.0)).ln() - growth - LEAST;
            let ends = [least.min(most - 1.0), most];
            let found = || {
                let values = [residual(ends[0]), arc.capacity() - load];
                bracketed(&mut residual, ends, values)
            };
            near.or_else(found)?
        }
        false => f64::NEG_INFINITY,
    };
    let creep = Creep::with_logarithm(&arc, speed, saturation, entry);
    let start = Place {
        arc_length: 0.0,
        traction: arc.entry(),
        displacement: 0.0,
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
fn guess(arc: &Arc, speed: f64, saturation: f64, load: f64) -> [f64; 2] {
    let sense = arc.sense;
    let unit = speed * arc.entry() / arc.belt.stiffness;
    let gained = sense * (sense * load).exp_m1() * unit;
    let (mut logarithm, mut slope) = (f64::NEG_INFINITY, f64::NAN);
    for _ in 0..TURNS {
        let entry = logarithm.exp();
        let b = unit - sense * entry;
        let mut length = arc.length;
        let mut last = gained + entry;
        slope = last / unit * (-sense * load).exp();
        if last >= saturation {
            last = saturation;
            let creeping = sense * (sense * (last - entry) / unit).ln_1p();
            length -= (load - creeping) / arc.slip_rate;
            slope = last / unit;
        }
        let decayed = arc.slip_rate * b * length / saturation;
        logarithm = (unit * last / (b + sense * last)).ln() - decayed;
    }
    [logarithm, slope]
}

/// Friction a P y/`v_s` with the slip velocity y below `v_s`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Creeping {
    creep: Creep,
    /// Speed c of the unstretched belt, m/s.
    speed: f64,
    /// Slip velocity `v_s` of full friction, m/s.
    saturation: f64,
}

impl Developing for Creeping {
    fn kind(&self) -> ZoneKind {
        ZoneKind::Creep
    }

    fn at(&self, contact: &Contact, zone: &ContactZone, share: f64) -> Place {
        let Self {
            creep,
            speed,
            saturation,
        } = *self;
        let arc = &contact.arc;
        let extent = zone.end - zone.start.arc_length;
        let distance = (1.0 - share) * extent;
        let velocity = creep.velocity(distance);
        let load = creep.load_before(distance);
        let traction = arc.entry() * (arc.sense * load).exp();
        Place {
            arc_length: zone.start.arc_length + share * extent,
            traction,
            displacement: saturation / (arc.slip_rate * speed) * load,
            friction: arc.slip_rate * traction * velocity / saturation,
        }
    }

    fn decay_lengths(&self, contact: &Contact, zone: &ContactZone) -> f64 {
        let (arc, saturation) = (&contact.arc, self.saturation);
        let unit = self.speed * arc.entry() / arc.belt.stiffness;
        let extent = zone.end - zone.start.arc_length;
        arc.slip_rate * extent * (unit + 2.0 * saturation) / saturation
    }

    /// With ds = `v_s` D/(a c) dP/(P (P − `P_o`)) that of `P_o` times the length and, with S of
    /// [`Traction::offset`](super::rim::traction::Traction::offset),
    ///
    /// ```text
    /// v_s D²/(a c S (S + P_o)) ln( P₁ (S + P₀)/(P₀ (S + P₁)) )
    /// ```
    fn elongation(&self, contact: &Contact, zone: &ContactZone) -> f64 {
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
struct Creep {
    /// Sense of the friction force, as [`Arc::sense`].
    sense: f64,
    /// Rate a/`v_s`, s/m².
    rate: f64,
    /// Slip velocity at the entry, m/s.
    entry: f64,
    /// Velocities q and B, m/s.
    unit: f64,
    b: f64,
    /// Where friction is fully developed or the arc ends, m.
    end: f64,
    /// Slip velocity and x there.
    last: [f64; 2],
}

impl Creep {
    /// The slip velocity that begins with a given logarithm.
    fn with_logarithm(arc: &Arc, speed: f64, saturation: f64, logarithm: f64) -> Self {
        let (sense, rate) = (arc.sense, arc.slip_rate / saturation);
        let entry = logarithm.exp();
        let unit = speed * arc.entry() / arc.belt.stiffness;
        let mut creep = Self {
            sense,
            rate,
            entry,
            unit,
            b: unit - sense * entry,
            end: f64::INFINITY,
            last: [saturation, f64::NAN],
        };
        let first = unit.ln() - logarithm;
        // B/v_s ± 1, which is negative if the driver never slips so fast.
        let rest = creep.b / saturation + sense;
        if creep.is_degenerate() {
            creep.end = (entry.recip() - saturation.recip()) / rate;
        } else if rest > 0.0 {
            creep.last[1] = rest.ln();
            creep.end = (first - creep.last[1]) / (creep.b * rate);
        }
        if creep.end >= arc.length {
            creep.end = arc.length;
            creep.last[1] = first - creep.b * rate * arc.length;
            creep.last[0] = match creep.is_degenerate() {
                true => (entry.recip() - rate * arc.length).recip(),
                false => creep.velocity(0.0),
            };
        }
        creep
    }

    /// Whether B is zero to rounding.
    fn is_degenerate(&self) -> bool {
        self.b.abs() < 1e-8 * self.unit
    }

    /// The slip velocity y at a distance before the end, m/s.
    fn velocity(&self, distance: f64) -> f64 {
        let [velocity, exponent] = self.last;
        if self.is_degenerate() {
            return (velocity.recip() + self.rate * distance).recip();
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
    fn load_before(&self, distance: f64) -> f64 {
        let Self { sense, unit, .. } = *self;
        if self.is_degenerate() {
            return ((self.velocity(distance) - self.entry) / unit).ln_1p();
        }
        let [_, last] = self.last;
        let exponent = last + self.b * self.rate * distance;
        let logarithm = |value: f64| sense * (-sense * value).ln_1p();
        match exponent > 0.0 {
            true => logarithm(self.entry / unit) - logarithm((-exponent).exp()),
            false => {
                let travelled = self.b.abs() * self.rate * (self.end - distance);
                travelled + logarithm(unit / self.entry) - logarithm(exponent.exp())
            }
        }
    }

    /// The load |ln(P(L)/P(0))| of an arc.
    fn load(&self, arc: &Arc) -> f64 {
        self.load_before(0.0) + arc.slip_rate * (arc.length - self.end)
    }
}
