//! A zone of elastic friction: |u|″ = w² |u| in the coordinate σ.

use crate::ZoneKind;
use crate::friction::rim::contact::{Arc, Contact, Place};
use crate::friction::rim::zone::{ContactZone, Developing};
use bvp::Real;

/// Elastic friction `k_f` |u| per coordinate, with w² = `k_f`/D. Shares of its zone are those of σ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Elastic<S = f64> {
    /// Friction stiffness `k_f`, N/m².
    pub(super) stiffness: S,
    /// Its rate w, 1/m.
    pub(super) rate: S,
    /// Length of the zone in the coordinate σ, m.
    pub(super) length: S,
    /// Displacement |u| at its end, m.
    pub(super) end: S,
}

impl<S: Real> Developing<S> for Elastic<S> {
    fn kind(&self) -> ZoneKind {
        ZoneKind::Elastic
    }

    fn at(&self, contact: &Contact<S>, zone: &ContactZone<S>, share: S) -> Place<S> {
        let Arc { belt, sense, .. } = contact.arc;
        let (start, rate, length) = (zone.start, self.rate, self.length);
        let x = share * length;
        let (ends, begin) = ([start.displacement, self.end], start.displacement);
        let [displacement, _] = elastic(rate, length, ends, x);
        let stiff = belt.stiffness * sense;
        let traction = start.traction + stiff * elastic_gain(rate, length, ends, x);
        let stretched = belt.stretch(contact.reference()) * x
            + belt.stretch_slope() * stiff * (displacement - begin);
        Place {
            arc_length: start.arc_length + stretched,
            traction,
            displacement,
            friction: self.stiffness * displacement / belt.stretch(traction),
        }
    }

    fn decay_lengths(&self, _: &Contact<S>, _: &ContactZone<S>) -> S {
        self.rate * self.length
    }

    fn arc_per_share(&self, contact: &Contact<S>, _: &ContactZone<S>, place: &Place<S>) -> S {
        self.length * contact.arc.belt.stretch(place.traction)
    }

    /// With the strain `ε_o` ± |u|′ of the belt it is, where σ is the length of the unstretched belt,
    /// `ε_o` σ ± |u|, and else the integral of the series
    ///
    /// ```text
    /// ε/(1 + ε) = ε_o/(1 + ε_o) ± |u|′/(1 + ε_o)² − |u|′²/(1 + ε_o)³ ± …
    /// ```
    ///
    /// whose powers |u|′ = e cosh w σ are integrated by recurrence.
    fn elongation(&self, contact: &Contact<S>, zone: &ContactZone<S>) -> S {
        let (belt, reference) = (contact.arc.belt, contact.reference());
        let (sense, begin) = (contact.arc.sense, zone.start.displacement);
        if belt.stretch_slope() != 0.0 {
            return self.length * belt.strain(reference) + (self.end - begin) * sense;
        }
        let ends = [S::ZERO, self.end];
        let [_, largest] = elastic(self.rate, self.length, ends, self.length);
        let stretched = belt.strain(reference) + 1.0;
        if begin != 0.0 || largest > stretched * CONVERGING {
            return contact.elongation_by_quadrature(zone);
        }
        let [_, entry] = elastic(self.rate, self.length, ends, S::ZERO);
        // The integral of each power of |u|′, from the last but one.
        let [mut before, mut integral] = [self.length, self.end];
        let (mut power, mut factor) = (S::ONE, S::from_f64(sense) / (stretched * stretched));
        let mut sum = self.length * belt.elongation(reference);
        for degree in 2..TERMS {
            let term = factor * integral;
            sum += term;
            if term.abs() <= sum.abs() * f64::EPSILON {
                break;
            }
            power *= largest;
            let boundary = power * self.end;
            let degree = f64::from(degree);
            let next = (boundary + entry * (degree - 1.0) * entry * before) / degree;
            [before, integral] = [integral, next];
            factor *= S::from_f64(-sense) / stretched;
        }
        sum
    }
}

/// Largest |u|′ over 1 + `ε_o` with the series, and more terms than it takes there; the belt of a drive has a
/// hundredth.
const CONVERGING: f64 = 0.3;
const TERMS: i32 = 40;

/// Value and slope at x of the function with b″ = w² b and given values at 0 and `length`, without
/// overflow:
///
/// ```text
/// b = [b₀ sinh w(l − x) + b₁ sinh w x]/sinh w l
/// ```
pub(super) fn elastic<S: Real>(rate: S, length: S, [first, last]: [S; 2], x: S) -> [S; 2] {
    // sinh(p)/sinh(q) and cosh(p)/sinh(q) for 0 ≤ p ≤ q.
    let ratios = |p: S, q: S| {
        let factor = (p - q).exp() / -(q * -2.0).exp_m1();
        let decayed = (p * -2.0).exp_m1();
        [-factor * decayed, factor * (decayed + 2.0)]
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
fn elastic_gain<S: Real>(rate: S, length: S, [first, last]: [S; 2], x: S) -> S {
    // sinh(p) exp(−p)
    let scaled = |p: S| (p * -2.0).exp_m1() * -0.5;
    let (whole, half) = (rate * length, rate * 0.5 * x);
    let near = last * scaled(half) * (half * 2.0 - whole).exp();
    let far = first * scaled(whole - half);
    rate * 2.0 * scaled(half) * (near + far) / scaled(whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NormalForce;
    use crate::friction::epp;
    use crate::friction::epp::tests::sample;
    use crate::friction::rim::traction::Traction;
    use crate::friction::rim::zone::Friction;

    #[test]
    fn the_elongation_is_that_of_quadrature() {
        let mut compared = 0;
        for (normal_force, axial) in [
            (NormalForce::Thesis, 1e5),
            (NormalForce::Inertia, 1e5),
            (NormalForce::Inertia, 2e3),
            (NormalForce::Exact, 1e4),
        ] {
            let belt = Traction::new(normal_force, 0.1, axial, 20.0);
            for (sense, stiffness) in [(1.0, 1e5), (1.0, 1e8), (-1.0, 1e3), (-1.0, 1e7)] {
                let arc = sample(belt, sense);
                let contact = epp::solve(arc, stiffness).unwrap();
                let zone = &contact.zones[0];
                let known = contact.elongation_by_quadrature(zone);
                let found = zone_elongation(&contact, zone);
                assert!(
                    (found / known - 1.0).abs() < 1e-13,
                    "{normal_force:?} {stiffness:e}"
                );
                compared += 1;
            }
        }
        assert_eq!(compared, 16);
    }

    fn zone_elongation(contact: &Contact, zone: &ContactZone) -> f64 {
        match &zone.friction {
            Friction::Developing(law) => law.own().elongation(contact, zone),
            _ => panic!("an elastic zone"),
        }
    }

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
