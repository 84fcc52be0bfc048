//! Smooth problems of every kind, manufactured from a known solution.

#[path = "../../../bvp/tests/properties/manufactured/drawn.rs"]
mod drawn;
#[path = "../../../bvp/tests/properties/manufactured/modes.rs"]
mod modes;
#[path = "../../../bvp/tests/properties/manufactured/shapes.rs"]
mod shapes;

use crate::draw::Draw;
use crate::trial::{Trial, Truth};
use bvp::{Guess, Problem};
use drawn::Drawn;

/// The exact solution with an error of a size, in units of its own, or the exact one at the middle
/// of every segment, everywhere.
struct Perturbed {
    exact: Drawn,
    size: Option<f64>,
    phase: f64,
}

impl Guess for Perturbed {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let Some(size) = self.size else {
            let segment_of = &Problem::segments(&self.exact)[segment];
            let middle = 0.5 * (segment_of.from + segment_of.to);
            return self.exact.state(segment, middle, y);
        };
        self.exact.state(segment, s, y);
        for (i, y) in y.iter_mut().enumerate() {
            let wave = (3.0 * s + self.phase + i as f64).sin();
            *y += size * wave * self.exact.size(segment, i);
        }
    }

    fn parameters(&self, p: &mut [f64]) {
        Guess::parameters(&self.exact, p);
        let size = self.size.unwrap_or(0.1);
        p.iter_mut()
            .for_each(|p| *p *= 1.0 + size * self.phase.sin());
    }
}

pub(crate) fn draw(draw: &mut Draw) -> Trial {
    let exact = Drawn::draw(draw);
    let size = (!draw.chance(0.2)).then(|| draw.log_between(1e-3, 1.0));
    let phase = draw.between(0.0, 6.0);
    let guess = Perturbed {
        exact: exact.clone(),
        size,
        phase,
    };
    let segments = Problem::segments(&exact).len();
    let kind = ["one segment", "two segments", "three segments"][segments - 1];
    Trial {
        kind,
        numbers: format!("guess off by {size:?}"),
        equations: Box::new(exact.clone()),
        guess: Box::new(guess),
        truth: Truth::OneOf(Box::new(exact)),
        places: vec![],
    }
}
