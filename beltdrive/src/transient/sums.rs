//! Sums of lists, in several lanes at a time.

/// Partial sums, so that a sum is computed in as many lanes.
pub(super) const LANES: usize = 4;

/// The sum of a list.
#[inline(always)]
pub(super) fn total(list: &[f64]) -> f64 {
    let mut parts = [0.0; LANES];
    let chunks = list.chunks_exact(LANES);
    let rest: f64 = chunks.remainder().iter().sum();
    for chunk in chunks {
        for (part, number) in parts.iter_mut().zip(chunk) {
            *part += number;
        }
    }
    parts.iter().sum::<f64>() + rest
}

/// The sum of the products of two lists.
#[inline(always)]
pub(super) fn dot(one: &[f64], other: &[f64]) -> f64 {
    let mut parts = [0.0; LANES];
    let (ones, others) = (one.chunks_exact(LANES), other.chunks_exact(LANES));
    let rest = ones.remainder().iter().zip(others.remainder());
    let rest: f64 = rest.map(|(one, other)| one * other).sum();
    for (ones, others) in ones.zip(others) {
        for ((part, one), other) in parts.iter_mut().zip(ones).zip(others) {
            *part += one * other;
        }
    }
    parts.iter().sum::<f64>() + rest
}
