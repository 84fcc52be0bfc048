//! The number of eigenvalues in a box, by the argument principle.
//!
//! χ is real for real σ and has no poles, so that twice its change of phase along the upper half of
//! the border, from +x to −x, is 2π times the number of its zeros in the whole box.

use super::characteristic::Characteristic;
use super::scaled::Scaled;
use faer::c64;
use std::f64::consts::{FRAC_PI_4, PI};

/// The phase changes by less than this over an accepted step and each half of it.
const LARGEST_TURN: f64 = FRAC_PI_4;
/// The logarithm of χ changes by less than this over half an accepted step, as its derivative at
/// the ends and the middle has it.
const LARGEST_CHANGE: f64 = 1.0;
/// A step is halved at most so often: a zero that lies closer to the border is on it.
const HALVINGS: usize = 40;
/// The number may differ so much from an integer.
const ROUNDING: f64 = 1e-6;

/// A point of the border with χ there.
#[derive(Clone, Copy)]
struct Place {
    sigma: c64,
    at: Characteristic,
}

impl Scaled {
    /// The number of zeros of χ with |Re σ| < `re` and |Im σ| < `im`, each as often as it is
    /// multiple; none where a zero lies on the border.
    pub(super) fn zeros_within(&self, re: f64, im: f64) -> Option<usize> {
        let corners = [(re, 0.0), (re, im), (-re, im), (-re, 0.0)].map(|(x, y)| c64::new(x, y));
        let mut turned = 0.0;
        for side in corners.windows(2) {
            let way = side[1] - side[0];
            // The phase of χ turns by about one over each of these steps.
            let steps = (way.norm() / self.delta).ceil().max(1.0);
            let (mut here, mut step) = (self.place(side[0]), 0.0);
            while step < steps {
                step += 1.0;
                let next = self.place(side[0] + way * (step / steps));
                turned += self.turn(here, next, HALVINGS)?;
                here = next;
            }
        }
        let number = turned / PI;
        let integer = number.round();
        if (number - integer).abs() > ROUNDING || integer < 0.0 {
            return None;
        }
        // Counted up, for lack of a checked conversion.
        Some((0..).take_while(|&n: &u32| f64::from(n) < integer).count())
    }

    fn place(&self, sigma: c64) -> Place {
        Place {
            sigma,
            at: self.characteristic(sigma),
        }
    }

    /// The change of phase between two places.
    fn turn(&self, from: Place, to: Place, halvings: usize) -> Option<f64> {
        let middle = self.place((from.sigma + to.sigma) * 0.5);
        let half = 0.5 * (to.sigma - from.sigma).norm();
        let smooth = [from, middle, to]
            .iter()
            .all(|place| half * place.at.slope.norm() < LARGEST_CHANGE * place.at.value.norm());
        let turns = [(from, middle), (middle, to)]
            .map(|(from, to)| (to.at.value * from.at.value.conj()).arg());
        let turn = turns[0] + turns[1];
        if smooth
            && [turns[0], turns[1], turn]
                .iter()
                .all(|turn| turn.abs() < LARGEST_TURN)
        {
            return Some(turn);
        }
        let halvings = halvings.checked_sub(1)?;
        Some(self.turn(from, middle, halvings)? + self.turn(middle, to, halvings)?)
    }
}

#[cfg(test)]
mod tests {
    use super::super::LinearisedForm;
    use super::super::examples::coulomb_at_rest;
    use super::*;

    #[test]
    fn the_modes_of_a_rod_are_counted() {
        let scaled = Scaled::new(&coulomb_at_rest(), LinearisedForm::Thesis);
        // Zeros at ±i (n − ½) π.
        assert_eq!(scaled.zeros_within(1.0, PI), Some(2));
        assert_eq!(scaled.zeros_within(1.0, 1.5), Some(0));
        assert_eq!(scaled.zeros_within(3.0, 12.0 * PI), Some(24));
        assert_eq!(scaled.zeros_within(1.0, 1.5 * PI), None);
    }
}
