//! A flat belt on one pulley: what is given, and the zones of the solution.

use super::super::creep_rate::Creep;
use super::quadrature::integral;
use super::traction::Traction;
use crate::ZoneKind;

/// Below this growth a y of the logarithm of the traction the integral of its growth is taken by
/// quadrature: the closed form loses digits there.
const SHORT: f64 = 0.05;

/// The arc of contact of a pulley, and the traction of the belt at its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arc {
    /// The moving belt.
    pub(crate) belt: Traction,
    /// Sense of the friction force on the belt: +1 on the driven pulley, where it holds the belt back
    /// and the traction grows; −1 on the driver.
    pub(crate) sense: f64,
    /// Slip rate a, 1/m.
    pub(crate) slip_rate: f64,
    /// Length L of the arc, m.
    pub(crate) length: f64,
    /// The smaller of the tractions P where the belt enters and leaves, N; positive.
    pub(crate) low: f64,
    /// The difference of the two, N; not negative.
    pub(crate) change: f64,
}

impl Arc {
    /// The traction where the belt enters, N.
    pub(crate) fn entry(&self) -> f64 {
        match self.sense > 0.0 {
            true => self.low,
            false => self.low + self.change,
        }
    }

    /// The traction where the belt leaves, N.
    pub(crate) fn exit(&self) -> f64 {
        match self.sense > 0.0 {
            true => self.low + self.change,
            false => self.low,
        }
    }

    /// The load |ln(P(L)/P(0))|. The arc carries less than a L.
    pub(crate) fn load(&self) -> f64 {
        (self.change / self.low).ln_1p()
    }

    /// The largest load, a L: the belt then slips on the whole arc.
    pub(crate) fn capacity(&self) -> f64 {
        self.slip_rate * self.length
    }

    /// Friction per coordinate σ at its limit, a P ds/dσ, N/m.
    pub(crate) fn friction_limit(&self, traction: f64) -> f64 {
        self.slip_rate * traction * self.belt.stretch(traction)
    }
}

/// The belt at a place on a pulley. Tensions grow along the driven pulley and fall along the driver; the
/// displacement and the friction force are magnitudes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// Arc length from the entry, m.
    pub(crate) arc_length: f64,
    /// Traction P, N.
    pub(crate) traction: f64,
    /// Displacement |u| against the rim, m.
    pub(crate) displacement: f64,
    /// Friction force per arc length by the friction law, N/m; that of the balance of forces is
    /// |dP/ds|.
    pub(crate) friction: f64,
}

/// A flat belt on one pulley: the solution.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Contact {
    /// What was given.
    pub(crate) arc: Arc,
    /// Strain |u′(0)| of the belt against the rim where it enters.
    pub(crate) strain: f64,
    /// The zones, in the order in which the belt passes them.
    pub(crate) zones: Vec<ContactZone>,
    /// Evaluations of scalar equations that it took.
    pub(crate) evaluations: usize,
}

/// A part of the arc with friction of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ContactZone {
    /// The belt where the zone begins.
    pub(crate) start: Place,
    /// Where it ends, as arc length, m.
    pub(crate) end: f64,
    /// What happens in between.
    pub(crate) friction: Friction,
}

/// Friction in a zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Friction {
    /// No displacement, no friction.
    Adhesion,
    /// Elastic friction `k_f` |u| per coordinate: |u|″ = w² |u| with w² = `k_f`/D.
    Elastic {
        /// Friction stiffness `k_f`, N/m².
        stiffness: f64,
        /// Its rate w, 1/m.
        rate: f64,
        /// Length of the zone in the coordinate σ, m.
        length: f64,
        /// Displacement |u| at its end, m.
        end: f64,
    },
    /// Friction at its limit: P = P₀ exp(± a (s − s₀)).
    Slip,
    /// Friction a P y/`v_s` with the slip velocity y below `v_s`.
    Creep {
        /// Logarithm of the slip velocity at the entry in m/s.
        logarithm: f64,
        /// Speed c of the unstretched belt, m/s.
        speed: f64,
        /// Slip velocity `v_s` of full friction, m/s.
        saturation: f64,
    },
}

impl Friction {
    /// The kind of zone.
    pub(crate) fn kind(&self) -> ZoneKind {
        match self {
            Self::Adhesion => ZoneKind::Adhesion,
            Self::Elastic { .. } => ZoneKind::Elastic,
            Self::Slip => ZoneKind::Slip,
            Self::Creep { .. } => ZoneKind::Creep,
        }
    }
}

impl Contact {
    /// Traction `P_o` at which the belt would run as fast as the rim, N.
    pub(crate) fn reference(&self) -> f64 {
        self.arc.entry() - self.arc.sense * self.arc.belt.stiffness * self.strain
    }

    /// The belt at a share of a zone, from 0 where it begins to 1 where it ends. Shares are those of
    /// the coordinate σ in an elastic zone, of arc length elsewhere.
    pub(crate) fn at(&self, zone: &ContactZone, share: f64) -> Place {
        let Arc {
            belt,
            sense,
            slip_rate,
            ..
        } = self.arc;
        let start = zone.start;
        let arc_length = start.arc_length + share * (zone.end - start.arc_length);
        match zone.friction {
            Friction::Adhesion => Place {
                arc_length,
                ..start
            },
            Friction::Elastic {
                stiffness,
                rate,
                length,
                end,
            } => {
                let x = share * length;
                let (ends, begin) = ([start.displacement, end], start.displacement);
                let [displacement, _] = elastic(rate, length, ends, x);
                let stiff = sense * belt.stiffness;
                let traction = start.traction + stiff * elastic_gain(rate, length, ends, x);
                let stretched = belt.stretch(self.reference()) * x
                    + belt.stretch_slope() * stiff * (displacement - begin);
                Place {
                    arc_length: start.arc_length + stretched,
                    traction,
                    displacement,
                    friction: stiffness * displacement / belt.stretch(traction),
                }
            }
            Friction::Slip => self.slipped(&start, arc_length - start.arc_length),
            Friction::Creep {
                logarithm,
                speed,
                saturation,
            } => {
                let creep = Creep::with_logarithm(&self.arc, speed, saturation, logarithm);
                let distance = (1.0 - share) * (zone.end - start.arc_length);
                let velocity = creep.velocity(distance);
                let load = creep.load_before(distance);
                let traction = self.arc.entry() * (sense * load).exp();
                let displacement = saturation / (slip_rate * speed) * load;
                Place {
                    arc_length,
                    traction,
                    displacement,
                    friction: slip_rate * traction * velocity / saturation,
                }
            }
        }
    }

    /// The belt after it has slipped over an arc length `y` from a place:
    ///
    /// ```text
    /// P = P₀ exp(± a y)     |u| = |u₀| + ∫ |P − P_o|/D dσ     dσ = dP/(± a P (α + β P))
    /// ```
    pub(crate) fn slipped(&self, from: &Place, y: f64) -> Place {
        let Arc {
            belt,
            sense,
            slip_rate,
            ..
        } = self.arc;
        let traction = from.traction * (sense * slip_rate * y).exp();
        // |P − P_o| = |P − P₀| + |P₀ − P_o|, of which the first is small with the square of y.
        let excess = match slip_rate * y < SHORT {
            true => integral([0.0, y], |t| {
                let grown = from.traction * (sense * slip_rate * t).exp_m1();
                sense * grown / belt.stretch(from.traction + grown)
            }),
            false => {
                let [first, last] =
                    [from.traction, traction].map(|traction| belt.stretch(traction));
                let relative = belt.stretch_slope() * (traction - from.traction) / first;
                let logarithm = if relative == 0.0 {
                    1.0
                } else {
                    relative.ln_1p() / relative
                };
                let grown = (traction - from.traction) / (slip_rate * first) * logarithm;
                grown - sense * from.traction * self.slipped_coordinate(y, last / first)
            }
        };
        let ratio = belt.stretch(traction) / belt.stretch(from.traction);
        let constant = sense * (from.traction - self.reference());
        let slid = (excess + constant * self.slipped_coordinate(y, ratio)) / belt.stiffness;
        Place {
            arc_length: from.arc_length + y,
            traction,
            displacement: from.displacement + slid,
            friction: slip_rate * traction,
        }
    }

    /// The coordinate σ over which the belt slips by an arc length `y`, with the ratio of the stretches
    /// at both ends.
    fn slipped_coordinate(&self, y: f64, ratio: f64) -> f64 {
        let Arc { belt, sense, .. } = self.arc;
        (y - sense / self.arc.slip_rate * ratio.ln()) / belt.stretch_offset()
    }

    /// The end of a zone.
    pub(crate) fn end(&self, zone: &ContactZone) -> Place {
        self.at(zone, 1.0)
    }
}

/// Value and slope at x of the function with b″ = w² b and given values at 0 and `length`, without
/// overflow:
///
/// ```text
/// b = [b₀ sinh w(l − x) + b₁ sinh w x]/sinh w l
/// ```
pub(crate) fn elastic(rate: f64, length: f64, [first, last]: [f64; 2], x: f64) -> [f64; 2] {
    // sinh(p)/sinh(q) and cosh(p)/sinh(q) for 0 ≤ p ≤ q.
    let ratios = |p: f64, q: f64| {
        let factor = (p - q).exp() / -(-2.0 * q).exp_m1();
        let decayed = (-2.0 * p).exp_m1();
        [-factor * decayed, factor * (2.0 + decayed)]
    };
    let whole = rate * length;
    let [rise, rise_slope] = ratios(rate * x, whole);
    let [fall, fall_slope] = ratios(rate * (length - x), whole);
    [
        first * fall + last * rise,
        rate * (last * rise_slope - first * fall_slope),
    ]
}

/// The gain of the slope from 0 to x of the same function, without cancellation where w l is small:
///
/// ```text
/// b′(x) − b′(0) = 2 w sinh(w x/2) [b₁ sinh(w x/2) + b₀ sinh(w l − w x/2)]/sinh w l
/// ```
fn elastic_gain(rate: f64, length: f64, [first, last]: [f64; 2], x: f64) -> f64 {
    // sinh(p) exp(−p)
    let scaled = |p: f64| -0.5 * (-2.0 * p).exp_m1();
    let (whole, half) = (rate * length, 0.5 * rate * x);
    let near = last * scaled(half) * (2.0 * half - whole).exp();
    let far = first * scaled(whole - half);
    2.0 * rate * scaled(half) * (near + far) / scaled(whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elastic_displacements_take_their_end_values_and_do_not_overflow() {
        for rate in [1e-6, 3.0, 1e5] {
            let ends = [0.2, 0.7];
            let [start, _] = elastic(rate, 2.0, ends, 0.0);
            let [end, _] = elastic(rate, 2.0, ends, 2.0);
            assert!((start - 0.2).abs() < 1e-9 && (end - 0.7).abs() < 1e-9);
        }
        for ends in [[0.0, 0.7], [0.3, 0.7]] {
            let [_, first] = elastic(3.0, 2.0, ends, 0.0);
            let [_, slope] = elastic(3.0, 2.0, ends, 1.3);
            assert!((elastic_gain(3.0, 2.0, ends, 1.3) - (slope - first)).abs() < 1e-14);
        }
        // Of a straight line that bends by w² x |u|/2, nothing is lost.
        let gain = elastic_gain(1e-6, 1.0, [0.0, 1.0], 1.0);
        assert!((gain / 0.5e-12 - 1.0).abs() < 1e-10, "{gain:e}");
        let [value, slope] = elastic(3.0, 2.0, [0.0, 1.0], 1.0);
        assert!((value - 3_f64.sinh() / 6_f64.sinh()).abs() < 1e-15);
        assert!((slope - 3.0 * 3_f64.cosh() / 6_f64.sinh()).abs() < 1e-14);
    }
}
