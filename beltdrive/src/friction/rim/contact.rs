//! A flat belt on one pulley: what is given, and the zones of the solution.

use super::quadrature::integral;
use super::traction::Traction;
use super::zone::{ContactZone, Friction};
use bvp::Real;

/// Below this growth a y of the logarithm of the traction the integral of its growth is taken by
/// quadrature: the closed form loses digits there.
const SHORT: f64 = 0.05;

/// The arc of contact of a pulley, and the traction of the belt at its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arc<S = f64> {
    /// The moving belt.
    pub(crate) belt: Traction<S>,
    /// Sense of the friction force on the belt: +1 on the driven pulley, where it holds the belt back
    /// and the traction grows; −1 on the driver.
    pub(crate) sense: f64,
    /// Slip rate a, 1/m.
    pub(crate) slip_rate: S,
    /// Length L of the arc, m.
    pub(crate) length: S,
    /// The smaller of the tractions P where the belt enters and leaves, N; positive.
    pub(crate) low: S,
    /// The difference of the two, N; not negative.
    pub(crate) change: S,
}

impl<S: Real> Arc<S> {
    /// The traction where the belt enters, N.
    pub(crate) fn entry(&self) -> S {
        match self.sense > 0.0 {
            true => self.low,
            false => self.low + self.change,
        }
    }

    /// The traction where the belt leaves, N.
    pub(crate) fn exit(&self) -> S {
        match self.sense > 0.0 {
            true => self.low + self.change,
            false => self.low,
        }
    }

    /// The load |ln(P(L)/P(0))|. The arc carries less than a L.
    pub(crate) fn load(&self) -> S {
        (self.change / self.low).ln_1p()
    }

    /// The largest load, a L: the belt then slips on the whole arc.
    pub(crate) fn capacity(&self) -> S {
        self.slip_rate * self.length
    }

    /// Friction per coordinate σ at its limit, a P ds/dσ, N/m.
    pub(crate) fn friction_limit(&self, traction: S) -> S {
        self.slip_rate * traction * self.belt.stretch(traction)
    }
}

/// The belt at a place on a pulley. Tensions grow along the driven pulley and fall along the driver; the
/// displacement and the friction force are magnitudes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place<S = f64> {
    /// Arc length from the entry, m.
    pub(crate) arc_length: S,
    /// Traction P, N.
    pub(crate) traction: S,
    /// Displacement |u| against the rim, m.
    pub(crate) displacement: S,
    /// Friction force per arc length by the friction law, N/m; that of the balance of forces is
    /// |dP/ds|.
    pub(crate) friction: S,
}

/// A flat belt on one pulley: the solution.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Contact<S = f64> {
    /// What was given.
    pub(crate) arc: Arc<S>,
    /// Strain |u′(0)| of the belt against the rim where it enters.
    pub(crate) strain: S,
    /// The zones, in the order in which the belt passes them.
    pub(crate) zones: Vec<ContactZone<S>>,
    /// Evaluations of scalar equations that it took.
    pub(crate) evaluations: usize,
}

impl<S: Real> Contact<S> {
    /// Traction `P_o` at which the belt would run as fast as the rim, N.
    pub(crate) fn reference(&self) -> S {
        self.arc.entry() - self.arc.belt.stiffness * self.arc.sense * self.strain
    }

    /// The belt at a share of a zone, from 0 where it begins to 1 where it ends. Shares are those of
    /// arc length, unless the law of the zone has another coordinate.
    pub(crate) fn at(&self, zone: &ContactZone<S>, share: S) -> Place<S> {
        let start = zone.start;
        let passed = share * (zone.end - start.arc_length);
        match &zone.friction {
            Friction::Adhesion => Place {
                arc_length: start.arc_length + passed,
                ..start
            },
            Friction::Slip => self.slipped(&start, passed),
            Friction::Developing(law) => law.own().at(self, zone, share),
        }
    }

    /// The belt after it has slipped over an arc length `y` from a place:
    ///
    /// ```text
    /// P = P₀ exp(± a y)     |u| = |u₀| + ∫ |P − P_o|/D dσ     dσ = dP/(± a P (α + β P))
    /// ```
    pub(crate) fn slipped(&self, from: &Place<S>, y: S) -> Place<S> {
        let Arc {
            belt,
            sense,
            slip_rate,
            ..
        } = self.arc;
        let traction = from.traction * (slip_rate * sense * y).exp();
        // |P − P_o| = |P − P₀| + |P₀ − P_o|, of which the first is small with the square of y.
        let excess = match slip_rate * y < SHORT {
            true => integral([S::ZERO, y], |t| {
                let grown = from.traction * (slip_rate * sense * t).exp_m1();
                grown * sense / belt.stretch(from.traction + grown)
            }),
            false => {
                let [first, last] =
                    [from.traction, traction].map(|traction| belt.stretch(traction));
                let relative = belt.stretch_slope() * (traction - from.traction) / first;
                let logarithm = if relative == 0.0 {
                    S::ONE
                } else {
                    relative.ln_1p() / relative
                };
                let grown = (traction - from.traction) / (slip_rate * first) * logarithm;
                grown - from.traction * sense * self.slipped_coordinate(y, last / first)
            }
        };
        let ratio = belt.stretch(traction) / belt.stretch(from.traction);
        let constant = (from.traction - self.reference()) * sense;
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
    fn slipped_coordinate(&self, y: S, ratio: S) -> S {
        let Arc { belt, sense, .. } = self.arc;
        (y - S::from_f64(sense) / self.arc.slip_rate * ratio.ln()) / belt.stretch_offset()
    }

    /// The end of a zone.
    pub(crate) fn end(&self, zone: &ContactZone<S>) -> Place<S> {
        self.at(zone, S::ONE)
    }
}
