//! What is looked at at one place.

use std::slice::ChunksExact;

/// A state at one place, its right-hand side and its slope.
pub(super) struct At<'a> {
    pub(super) y: &'a mut [f64],
    pub(super) f: &'a mut [f64],
    pub(super) slope: &'a mut [f64],
    /// The right-hand sides at the places that are looked at next, where they have been evaluated in one call.
    pub(super) given: Option<ChunksExact<'a, f64>>,
}

impl<'a> At<'a> {
    /// Room for n states in 3n numbers.
    #[inline(always)]
    pub(super) fn new(n: usize, values: &'a mut [f64]) -> Self {
        let (y, rest) = values.split_at_mut(n);
        let (f, slope) = rest.split_at_mut(n);
        Self {
            y: &mut y[..n],
            f: &mut f[..n],
            slope: &mut slope[..n],
            given: None,
        }
    }

    /// The largest |f| relative to 1 + |y|.
    #[inline(always)]
    pub(super) fn rate(&self) -> f64 {
        let rates = self.f.iter().zip(&*self.y);
        rates.fold(0.0, |m, (f, y)| m.max(f.abs() / (1.0 + y.abs())))
    }
}

/// The size, or zero in the place of what is not finite: a segment may end at a singular place.
pub(super) fn finite(size: f64) -> f64 {
    if size.is_finite() { size } else { 0.0 }
}
