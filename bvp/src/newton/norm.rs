//! The size of a correction beside an iterate.

use crate::discretisation::iterate::Iterate;
use crate::kernels::dense::max_or_nan;

/// Size of a correction relative to 1 + |x|, over nodes, states and parameters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Norm {
    /// Root mean square: what the damping compares.
    pub(super) mean: f64,
    /// Largest entry: what the stopping test uses.
    pub(crate) largest: f64,
}

/// Measures a correction of `x`.
pub(crate) fn norm(x: &Iterate, correction: &Iterate) -> Norm {
    let mut sizes = Sizes::default();
    for (x, correction) in x.segments.iter().zip(&correction.segments) {
        sizes.add(&x.nodes, correction.nodes.iter().copied());
    }
    sizes.add(&x.p, correction.p.iter().copied());
    sizes.norm()
}

/// Measures the sum of a correction of `x` and a multiple of another one.
pub(super) fn norm_of_sum(x: &Iterate, one: &Iterate, factor: f64, other: &Iterate) -> Norm {
    let mut sizes = Sizes::default();
    let mut add = |x: &[f64], one: &[f64], other: &[f64]| {
        let both = one.iter().zip(other);
        sizes.add(x, both.map(|(one, other)| one + factor * other));
    };
    let others = one.segments.iter().zip(&other.segments);
    for (x, (one, other)) in x.segments.iter().zip(others) {
        add(&x.nodes, &one.nodes, &other.nodes);
    }
    add(&x.p, &one.p, &other.p);
    sizes.norm()
}

/// What is summed up for a [`Norm`].
#[derive(Default)]
struct Sizes {
    square: f64,
    largest: f64,
    count: usize,
}

impl Sizes {
    #[inline(always)]
    fn add(&mut self, x: &[f64], corrections: impl Iterator<Item = f64>) {
        self.count += x.len();
        for (x, correction) in x.iter().zip(corrections) {
            let relative = correction / (1.0 + x.abs());
            self.square += relative * relative;
            self.largest = max_or_nan(self.largest, relative.abs());
        }
    }

    fn norm(&self) -> Norm {
        Norm {
            mean: (self.square / self.count as f64).sqrt(),
            largest: self.largest,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discretisation::iterate::SegmentIterate;

    fn iterate(nodes: &[f64], p: &[f64]) -> Iterate {
        Iterate {
            segments: vec![SegmentIterate {
                nodes: nodes.to_vec(),
                stages: vec![],
            }],
            p: p.to_vec(),
        }
    }

    #[test]
    fn a_norm_is_relative_and_counts_parameters() {
        let x = iterate(&[0.0, 3.0], &[-1.0]);
        let correction = iterate(&[1.0, 4.0], &[6.0]);
        let size = norm(&x, &correction);
        assert_eq!(size.largest, 3.0);
        assert_eq!(size.mean, (11.0f64 / 3.0).sqrt());
        let none = norm_of_sum(&x, &correction, -2.0, &iterate(&[0.5, 2.0], &[3.0]));
        assert_eq!((none.mean, none.largest), (0.0, 0.0));
    }

    #[test]
    fn a_norm_keeps_nan_wherever_it_stands() {
        let x = iterate(&[0.0, 0.0], &[0.0]);
        for place in 0..3 {
            let mut values = [1.0; 3];
            values[place] = f64::NAN;
            let correction = iterate(&values[..2], &values[2..]);
            for size in [norm(&x, &correction), norm_of_sum(&x, &x, 1.0, &correction)] {
                assert!(size.mean.is_nan() && size.largest.is_nan());
            }
        }
    }
}
