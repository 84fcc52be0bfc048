//! A zone of elastic friction: |u|″ = w² |u| in the coordinate σ.

use crate::ZoneKind;
use crate::friction::rim::contact::{Arc, Contact, Place};
use crate::friction::rim::zone::{ContactZone, Developing};

/// Elastic friction `k_f` |u| per coordinate, with w² = `k_f`/D. Shares of its zone are those of σ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Elastic {
    /// Friction stiffness `k_f`, N/m².
    pub(super) stiffness: f64,
    /// Its rate w, 1/m.
    pub(super) rate: f64,
    /// Length of the zone in the coordinate σ, m.
    pub(super) length: f64,
    /// Displacement |u| at its end, m.
    pub(super) end: f64,
}

impl Developing for Elastic {
    fn kind(&self) -> ZoneKind {
        ZoneKind::Elastic
    }

    fn at(&self, contact: &Contact, zone: &ContactZone, share: f64) -> Place {
        let Arc { belt, sense, .. } = contact.arc;
        let (start, rate, length) = (zone.start, self.rate, self.length);
        let x = share * length;
        let (ends, begin) = ([start.displacement, self.end], start.displacement);
        let [displacement, _] = elastic(rate, length, ends, x);
        let stiff = sense * belt.stiffness;
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

    fn decay_lengths(&self, _: &Contact, _: &ContactZone) -> f64 {
        self.rate * self.length
    }

    fn arc_per_share(&self, contact: &Contact, _: &ContactZone, place: &Place) -> f64 {
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
    fn elongation(&self, contact: &Contact, zone: &ContactZone) -> f64 {
        let (belt, reference) = (contact.arc.belt, contact.reference());
        let (sense, begin) = (contact.arc.sense, zone.start.displacement);
        if belt.stretch_slope() != 0.0 {
            return self.length * belt.strain(reference) + sense * (self.end - begin);
        }
        let [_, largest] = elastic(self.rate, self.length, [0.0, self.end], self.length);
        let stretched = 1.0 + belt.strain(reference);
        if begin != 0.0 || largest > CONVERGING * stretched {
            return contact.elongation_by_quadrature(zone);
        }
        let [_, entry] = elastic(self.rate, self.length, [0.0, self.end], 0.0);
        // The integral of each power of |u|′, from the last but one.
        let [mut before, mut integral] = [self.length, self.end];
        let (mut power, mut factor) = (1.0, sense / (stretched * stretched));
        let mut sum = self.length * belt.elongation(reference);
        for degree in 2..TERMS {
            let term = factor * integral;
            sum += term;
            if term.abs() <= f64::EPSILON * sum.abs() {
                break;
            }
            power *= largest;
            let boundary = power * self.end;
            let degree = f64::from(degree);
            let next = (boundary + (degree - 1.0) * entry * entry * before) / degree;
            [before, integral] = [integral, next];
            factor *= -sense / stretched;
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
pub(super) fn elastic(rate: f64, length: f64, [first, last]: [f64; 2], x: f64) -> [f64; 2] {
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
            Friction::Developing(law) => law.elongation(contact, zone),
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
