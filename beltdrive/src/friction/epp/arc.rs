//! An arc whose friction is elastic up to its limit.

use super::zone::Elastic;
use crate::friction::rim::contact::{Arc, Contact, Place};
use crate::friction::rim::zone::{ContactZone, Friction, Law};
use crate::mechanics::implicit::{Implicit, bracketed, near_with_slope};
use std::cell::Cell;

/// The last step of the secant method for the place where slip begins, relative to the arc. Its error is about this
/// times the step before.
const NEAR: f64 = 1e-11;

/// An arc with elastic friction.
pub(super) struct ElasticArc<S = f64> {
    arc: Arc<S>,
    stiffness: S,
    /// Rate w, 1/m.
    rate: S,
    evaluations: Cell<usize>,
}

/// The belt where it begins to slip.
#[derive(Clone, Copy)]
struct Transition<S = f64> {
    /// Coordinate σ₁, m.
    coordinate: S,
    /// The belt there.
    place: Place<S>,
}

impl<S: Implicit> ElasticArc<S> {
    pub(super) fn new(arc: Arc<S>, stiffness: S) -> Self {
        let rate = (stiffness / arc.belt.stiffness).sqrt();
        Self {
            arc,
            stiffness,
            rate,
            evaluations: Cell::new(0),
        }
    }

    /// The belt that begins to slip at the coordinate σ₁; `None` if friction does not reach its limit
    /// there at any load.
    fn transition(&self, coordinate: S) -> Option<Transition<S>> {
        self.evaluations.set(self.evaluations.get() + 1);
        let Arc { belt, sense, .. } = self.arc;
        let decayed = (-self.rate * coordinate).exp_m1();
        // tanh(w σ/2)
        let share = -decayed / (decayed + 2.0);
        let reach = self.arc.slip_rate * sense / self.rate * share;
        let square = reach * belt.stretch_slope();
        let linear = S::ONE - reach * belt.stretch_offset();
        let root = (linear * linear - square * 4.0 * self.arc.entry()).sqrt();
        let traction = self.arc.entry() * 2.0 / (linear + root);
        // Not a number included.
        if !(traction > 0.0 && traction.value().is_finite()) {
            return None;
        }
        let displacement = self.arc.friction_limit(traction) / self.stiffness;
        Some(Transition {
            coordinate,
            place: Place {
                arc_length: self.arc_length(coordinate, displacement),
                traction,
                displacement,
                friction: self.arc.slip_rate * traction,
            },
        })
    }

    /// The strain e = w |u|/sinh(w σ) at the entry of an elastic zone that ends at σ with |u|.
    fn strain(&self, coordinate: S, displacement: S) -> S {
        let exponent = -self.rate * coordinate;
        let decay = exponent.exp();
        self.rate * -2.0 * displacement * decay / (exponent.exp_m1() * (decay + 1.0))
    }

    /// Arc length s at σ from the entry, where the displacement is |u|: with `P_o = P(0) ∓ D e`,
    /// s = (α + β `P_o`) σ ± β D |u|.
    fn arc_length(&self, coordinate: S, displacement: S) -> S {
        let Arc { belt, sense, .. } = self.arc;
        let slope = belt.stretch_slope() * sense * belt.stiffness;
        let entered = belt.stretch(self.arc.entry()) * coordinate;
        match slope == 0.0 || coordinate == 0.0 {
            true => entered,
            false => {
                let strain = self.strain(coordinate, displacement);
                entered - slope * (strain * coordinate - displacement)
            }
        }
    }

    /// Whether elastic friction reaches its limit from below wherever slip begins.
    fn never_touches(&self) -> bool {
        let Arc { belt, sense, .. } = self.arc;
        belt.stretch_slope() == 0.0 && (sense < 0.0 || self.rate >= self.arc.slip_rate)
    }

    /// Slope of elastic friction less that of its limit where slip begins, over `k_f` |u₁|.
    fn gap(&self, transition: &Transition<S>) -> S {
        let Arc { belt, sense, .. } = self.arc;
        let traction = transition.place.traction;
        let steepening = belt.stretch_slope() * traction;
        let limit = self.arc.slip_rate * (belt.stretch(traction) + steepening);
        self.rate / (self.rate * transition.coordinate).tanh() - limit * sense
    }

    /// The contact with a load, if it is found at once from a belt that slips where elastic friction would need no
    /// room to develop.
    pub(super) fn near(&self, load: S) -> Option<Contact<S>> {
        let Arc {
            belt,
            slip_rate,
            length,
            ..
        } = self.arc;
        let stretch = belt.stretch(self.arc.entry());
        let (guess, slope) = ((length - load / slip_rate) / stretch, -slip_rate * stretch);
        let residual = |coordinate| Some(self.load(coordinate)? - load);
        let range = [0.0, (length * 2.0 / stretch).value()];
        let within = NEAR * length.value();
        let coordinate = near_with_slope(residual, guess, slope, range, within)?;
        let transition = self.transition(coordinate)?;
        if !self.never_touches() && self.gap(&transition) < 0.0 {
            return None;
        }
        match transition.place.arc_length < length {
            true => self.slipping(coordinate),
            false => self.all_elastic(),
        }
    }

    /// The last coordinate at which slip can begin: where the arc ends, or where elastic friction only
    /// touches its limit.
    pub(super) fn last_transition(&self) -> Option<S> {
        let Arc { belt, sense, .. } = self.arc;
        let entered = self.arc.length / belt.stretch(self.arc.entry());
        // The belt contracts on the driver, at most to P = 0.
        let longest = match sense > 0.0 {
            true => entered,
            false => self.arc.length / belt.stretch_offset(),
        };
        if self.never_touches() {
            return Some(longest);
        }
        let gap = |coordinate: S| {
            self.transition(coordinate)
                .map_or(-S::ONE, |found| self.gap(&found))
        };
        let at_end = gap(longest);
        let last = match at_end < 0.0 {
            true => {
                let early = longest * f64::EPSILON;
                bracketed(gap, [early, longest], [gap(early), at_end])?
            }
            false => longest,
        };
        let nowhere = S::from_f64(f64::NAN);
        let beyond = |coordinate: S| {
            let transition = self.transition(coordinate);
            transition.map_or(nowhere, |found| found.place.arc_length - self.arc.length)
        };
        let excess = beyond(last);
        // Rounding of a belt that does not stretch is no excess.
        match excess > self.arc.length * (4.0 * f64::EPSILON) {
            true => bracketed(beyond, [S::ZERO, last], [-self.arc.length, excess]),
            false => Some(last),
        }
    }

    /// The load |ln(P(L)/P(0))| if slip begins at σ₁.
    pub(super) fn load(&self, coordinate: S) -> Option<S> {
        let transition = self.transition(coordinate)?;
        let Arc { sense, .. } = self.arc;
        let entry = self.arc.entry();
        let gained = |traction: S| (((traction - entry) / entry).ln_1p() * sense).max(S::ZERO);
        let first = gained(transition.place.traction);
        match self.stick(&transition) {
            Some((_, zone)) => {
                let contact = self.contact(&transition);
                Some(gained(contact.end(&zone).traction))
            }
            None => {
                let slipping = self.arc.length - transition.place.arc_length;
                Some(first + self.arc.slip_rate * slipping)
            }
        }
    }

    /// Where the slipping belt sticks again, and the elastic zone from there.
    fn stick(&self, transition: &Transition<S>) -> Option<(Place<S>, ContactZone<S>)> {
        let Arc {
            belt,
            sense,
            slip_rate,
            ..
        } = self.arc;
        // Stiffer bristles follow the limit of friction however fast it rises.
        let from = transition.place;
        let steepest = belt.stretch(self.arc.exit()) + belt.stretch_slope() * self.arc.exit();
        let follows = self.rate >= slip_rate * steepest;
        if sense < 0.0 || transition.coordinate == 0.0 || follows {
            return None;
        }
        let contact = self.contact(transition);
        let slipping = self.arc.length - from.arc_length;
        let reference = contact.reference();
        // Elastic friction over its limit, and the slope of that along the coordinate.
        let over = |place: &Place<S>| {
            self.stiffness * place.displacement - self.arc.friction_limit(place.traction)
        };
        let slope = |place: &Place<S>| {
            let steepening = belt.stretch_slope() * place.traction;
            let limit = slip_rate
                * self.arc.friction_limit(place.traction)
                * (belt.stretch(place.traction) + steepening);
            self.stiffness * (place.traction - reference) / belt.stiffness - limit
        };
        let end = contact.slipped(&from, slipping);
        if over(&end) >= 0.0 {
            return None;
        }
        let slope_after = |y: S| slope(&contact.slipped(&from, y));
        let at_start = slope_after(S::ZERO);
        let highest = match at_start > 0.0 {
            true => bracketed(slope_after, [S::ZERO, slipping], [at_start, slope(&end)])?,
            false => S::ZERO,
        };
        let over_after = |y: S| over(&contact.slipped(&from, y));
        let at_highest = over_after(highest);
        let stuck = match at_highest > 0.0 {
            true => bracketed(over_after, [highest, slipping], [at_highest, over(&end)])?,
            false => highest,
        };
        let place = contact.slipped(&from, stuck);
        Some((place, self.elastic_after(&contact, place)?))
    }

    /// The elastic zone from a place, where the belt sticks again, to the end of the arc.
    fn elastic_after(&self, contact: &Contact<S>, start: Place<S>) -> Option<ContactZone<S>> {
        let Arc { belt, sense, .. } = self.arc;
        let reference = contact.reference();
        let slope = (start.traction - reference).abs() / belt.stiffness;
        let displacement = |x: S| {
            let (sinh, cosh) = ((self.rate * x).sinh(), (self.rate * x).cosh());
            start.displacement * cosh + slope / self.rate * sinh
        };
        let stretch = belt.stretch(reference);
        let stretching = belt.stretch_slope() * sense * belt.stiffness;
        let rest = self.arc.length - start.arc_length;
        let beyond =
            |x: S| stretch * x + stretching * (displacement(x) - start.displacement) - rest;
        let longest = rest / belt.stretch(start.traction);
        let length = match belt.stretch_slope() == 0.0 {
            true => rest,
            false => bracketed(beyond, [S::ZERO, longest], [-rest, beyond(longest)])?,
        };
        Some(ContactZone {
            start,
            end: self.arc.length,
            friction: self.elastic(length, displacement(length)),
        })
    }

    /// An elastic zone.
    fn elastic(&self, length: S, end: S) -> Friction<S> {
        Friction::Developing(Law::Elastic(Elastic {
            stiffness: self.stiffness,
            rate: self.rate,
            length,
            end,
        }))
    }

    /// The contact with its first zone, elastic, up to where slip begins.
    fn contact(&self, transition: &Transition<S>) -> Contact<S> {
        Contact {
            arc: self.arc,
            strain: self.strain(transition.coordinate, transition.place.displacement),
            zones: vec![ContactZone {
                start: self.entrance(),
                end: transition.place.arc_length,
                friction: self.elastic(transition.coordinate, transition.place.displacement),
            }],
            evaluations: self.evaluations.get(),
        }
    }

    /// The contact in which slip begins at σ₁.
    pub(super) fn slipping(&self, coordinate: S) -> Option<Contact<S>> {
        let transition = self.transition(coordinate)?;
        let mut contact = self.contact(&transition);
        let stick = self.stick(&transition);
        contact.zones.push(ContactZone {
            start: transition.place,
            end: stick.map_or(self.arc.length, |(place, _)| place.arc_length),
            friction: Friction::Slip,
        });
        contact.zones.extend(stick.map(|(_, zone)| zone));
        Some(contact)
    }

    /// The contact without slip. With the load ΔP, |u(L)| = ΔP/(D w tanh(w σ(L)/2)).
    pub(super) fn all_elastic(&self) -> Option<Contact<S>> {
        let Arc { belt, change, .. } = self.arc;
        let end = |x: S| change / (belt.stiffness * self.rate * (self.rate * 0.5 * x).tanh());
        let beyond = |x: S| self.arc_length(x, end(x)) - self.arc.length;
        let length = match belt.stretch_slope() == 0.0 {
            true => self.arc.length,
            false => {
                let [one, other] = [self.arc.entry(), self.arc.exit()]
                    .map(|traction| self.arc.length / belt.stretch(traction));
                // A load of rounding errors leaves no room between the two.
                let ends = [
                    one.min(other) * (1.0 - 1e-12),
                    one.max(other) * (1.0 + 1e-12),
                ];
                bracketed(beyond, ends, ends.map(beyond))?
            }
        };
        Some(Contact {
            arc: self.arc,
            strain: self.strain(length, end(length)),
            zones: vec![ContactZone {
                start: self.entrance(),
                end: self.arc.length,
                friction: self.elastic(length, end(length)),
            }],
            evaluations: self.evaluations.get(),
        })
    }

    /// The belt where it enters the pulley.
    fn entrance(&self) -> Place<S> {
        Place {
            arc_length: S::ZERO,
            traction: self.arc.entry(),
            displacement: S::ZERO,
            friction: S::ZERO,
        }
    }
}
