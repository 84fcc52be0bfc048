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

use super::contact::{Arc, Contact, ContactZone, Friction, Place};
use super::root::bracketed;

/// Loads below this many logarithms are not told apart from none by the first guess.
const LEAST: f64 = 40.0;

/// The contact of an arc on which friction is fully developed from the slip velocity `saturation`
/// `v_s` on, m/s, for a belt whose unstretched parts move at `speed` c, m/s; `None` if the load is not
/// below the capacity of the arc.
pub(super) fn solve(arc: Arc, speed: f64, saturation: f64) -> Option<Contact> {
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
                Creep::with_logarithm(&arc, speed, saturation, logarithm).load() - load
            };
            let most = saturation.ln();
            let unit = speed * arc.entry / arc.belt.stiffness;
            // The slip velocity grows at most by exp(a L (B ± v_s)/v_s) over the arc.
            let growth = arc.capacity() * (unit + 2.0 * saturation) / saturation;
            let least = (unit * load.min(1.0)).ln() - growth - LEAST;
            let ends = [least.min(most - 1.0), most];
            let [low, high] = [residual(ends[0]), arc.capacity() - load];
            bracketed(residual, ends, [low, high])?
        }
        false => f64::NEG_INFINITY,
    };
    let creep = Creep::with_logarithm(&arc, speed, saturation, entry);
    let start = Place {
        arc_length: 0.0,
        traction: arc.entry,
        displacement: 0.0,
        friction: arc.slip_rate * arc.entry * creep.entry / saturation,
    };
    let saturated = creep.saturated().min(arc.length);
    let mut contact = Contact {
        arc,
        strain: creep.entry / speed,
        zones: vec![ContactZone {
            start,
            end: saturated,
            friction: Friction::Creep {
                logarithm: creep.logarithm,
                speed,
                saturation,
            },
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

/// The slip velocity along an arc, until friction is fully developed.
pub(super) struct Creep {
    /// Sense of the friction force, as [`Arc::sense`].
    sense: f64,
    /// Slip rate a, 1/m, and length of the arc, m.
    slip_rate: f64,
    length: f64,
    /// Slip velocity `v_s` of full friction, m/s.
    saturation: f64,
    /// Logarithm of the slip velocity at the entry, in m/s, and the velocity.
    logarithm: f64,
    pub(super) entry: f64,
    /// Velocity c P(0)/D, m/s, and B = c P(0)/D ∓ y(0).
    unit: f64,
    b: f64,
}

impl Creep {
    /// The slip velocity that begins with a given logarithm.
    pub(super) fn with_logarithm(arc: &Arc, speed: f64, saturation: f64, logarithm: f64) -> Self {
        let entry = logarithm.exp();
        let unit = speed * arc.entry / arc.belt.stiffness;
        Self {
            sense: arc.sense,
            slip_rate: arc.slip_rate,
            length: arc.length,
            saturation,
            logarithm,
            entry,
            unit,
            b: unit - arc.sense * entry,
        }
    }

    /// Whether B is zero to rounding.
    fn is_degenerate(&self) -> bool {
        self.b.abs() < 1e-8 * self.unit
    }

    /// The slip velocity y at an arc length s before saturation, m/s:
    ///
    /// ```text
    /// B/y = c P(0)/(D y(0)) exp(−a B s/v_s) ∓ 1
    /// ```
    pub(super) fn velocity(&self, arc_length: f64) -> f64 {
        let travelled = self.slip_rate * arc_length / self.saturation;
        if self.is_degenerate() {
            return (self.entry.recip() - travelled).recip();
        }
        let exponent = self.unit.ln() - self.logarithm - self.b * travelled;
        match self.sense > 0.0 {
            true => self.b / exponent.exp_m1(),
            false => self.b / (exponent.exp() + 1.0),
        }
    }

    /// Arc length at which friction is fully developed, m; infinite if it never is.
    pub(super) fn saturated(&self) -> f64 {
        let scale = self.saturation / self.slip_rate;
        if self.is_degenerate() {
            return scale * (self.entry.recip() - self.saturation.recip());
        }
        let rest = self.b / self.saturation + self.sense;
        match rest > 0.0 || self.b < 0.0 {
            true => scale / self.b * (self.unit.ln() - self.logarithm - rest.abs().ln()),
            false => f64::INFINITY,
        }
    }

    /// The load |ln(P(s)/P(0))| taken up to an arc length before saturation. With the exponent x of
    /// [`Creep::velocity`], q = c P(0)/D and the upper sign on the driven pulley, it is
    ///
    /// ```text
    /// ± ln(1 ∓ y(0)/q) ∓ ln(1 ∓ exp(−x))  =  a |B| s/v_s ± ln(1 ∓ q/y(0)) ∓ ln(1 ∓ exp(x))
    /// ```
    ///
    /// of which the first loses no digits for x > 0, the second for x < 0.
    pub(super) fn load_to(&self, arc_length: f64) -> f64 {
        let Self { sense, unit, .. } = *self;
        if self.is_degenerate() {
            let velocity = self.velocity(arc_length);
            return ((velocity - self.entry) / unit).ln_1p();
        }
        let travelled = self.b * self.slip_rate * arc_length / self.saturation;
        let exponent = unit.ln() - self.logarithm - travelled;
        let logarithm = |value: f64| sense * (-sense * value).ln_1p();
        match exponent > 0.0 {
            true => logarithm(self.entry / unit) - logarithm((-exponent).exp()),
            false => travelled.abs() + logarithm(unit / self.entry) - logarithm(exponent.exp()),
        }
    }

    /// The load |ln(P(L)/P(0))| of the arc.
    fn load(&self) -> f64 {
        let saturated = self.saturated();
        match saturated < self.length {
            true => self.load_to(saturated) + self.slip_rate * (self.length - saturated),
            false => self.load_to(self.length),
        }
    }
}
