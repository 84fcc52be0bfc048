//! Sums and products of vectors and of small matrices, row-major in slices.

/// Columns of a product that are summed together, in registers.
const LANES: usize = 4;

/// C += A B, where A has `inner` columns and B has `columns`.
#[inline(always)]
pub(crate) fn add_product(c: &mut [f64], a: &[f64], b: &[f64], inner: usize, columns: usize) {
    for (a, c) in a.chunks_exact(inner).zip(c.chunks_exact_mut(columns)) {
        let whole = columns - columns % LANES;
        for first in (0..whole).step_by(LANES) {
            add_combination(c, a, b, columns, first, LANES);
        }
        add_combination(c, a, b, columns, whole, columns - whole);
    }
}

/// Adds to at most [`LANES`] entries of c, from `first` on, those of the sum of the rows of B times the
/// numbers in a.
#[inline(always)]
fn add_combination(
    c: &mut [f64],
    a: &[f64],
    b: &[f64],
    columns: usize,
    first: usize,
    width: usize,
) {
    let c = &mut c[first..][..width];
    let mut sums = [0.0; LANES];
    let sums = &mut sums[..width];
    sums.copy_from_slice(c);
    for (factor, b) in a.iter().zip(b.chunks_exact(columns)) {
        add_scaled(sums, *factor, &b[first..][..width]);
    }
    c.copy_from_slice(sums);
}

/// Sets every entry to what is made of its index and the sum of the rows times the factors. Two entries at a time
/// fill the vector registers of every machine and stay in them.
#[inline(always)]
pub(crate) fn combine(
    values: &mut [f64],
    factors: &[f64],
    rows: &[f64],
    value: impl Fn(usize, f64) -> f64,
) {
    let columns = values.len();
    let terms = || factors.iter().zip(rows.chunks_exact(columns));
    let mut first = 0;
    let mut pairs = values.chunks_exact_mut(2);
    for pair in &mut pairs {
        let [a, b] = terms().fold([0.0; 2], |[a, b], (factor, row)| {
            [a + factor * row[first], b + factor * row[first + 1]]
        });
        pair.copy_from_slice(&[value(first, a), value(first + 1, b)]);
        first += 2;
    }
    for last in pairs.into_remainder() {
        let sum = terms().fold(0.0, |sum, (factor, row)| sum + factor * row[first]);
        *last = value(first, sum);
    }
}

/// The inner product of two vectors of the same length.
#[inline]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Four independent sums: one would wait for each addition in turn.
    let (a_blocks, b_blocks) = (a.chunks_exact(4), b.chunks_exact(4));
    let (a_rest, b_rest) = (a_blocks.remainder(), b_blocks.remainder());
    let mut sums = [0.0; 4];
    for (a, b) in a_blocks.zip(b_blocks) {
        for (sum, (x, y)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += x * y;
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Whether all numbers are finite: zero times anything else is NaN, and a sum keeps it.
#[inline(always)]
pub(crate) fn all_finite(x: &[f64]) -> bool {
    let blocks = x.chunks_exact(4);
    let rest: f64 = blocks.remainder().iter().map(|x| 0.0 * x).sum();
    let mut sums = [rest; 4];
    for block in blocks {
        for (sum, x) in sums.iter_mut().zip(block) {
            *sum += 0.0 * x;
        }
    }
    sums.iter().all(|sum| *sum == 0.0)
}

/// y += factor x.
#[inline]
pub(crate) fn add_scaled(y: &mut [f64], factor: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// The larger of two numbers without a sign, NaN if either is: what [`f64::max`] would lose. Such numbers are in
/// the order of their bits, infinity and NaN above all others, and these are compared without a branch.
#[inline(always)]
pub(crate) fn max_or_nan(a: f64, b: f64) -> f64 {
    let has_sign = |x: f64| x.is_sign_negative() && !x.is_nan();
    debug_assert!(!has_sign(a) && !has_sign(b), "{a} and {b} have no sign");
    f64::from_bits(a.to_bits().max(b.to_bits()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_number_that_is_not_finite_is_found() {
        for length in [1, 3, 4, 11] {
            let mut x = vec![1e300; length];
            assert!(all_finite(&x));
            for place in 0..length {
                for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let kept = std::mem::replace(&mut x[place], value);
                    assert!(!all_finite(&x));
                    x[place] = kept;
                }
            }
        }
    }

    #[test]
    fn a_maximum_keeps_nan() {
        assert_eq!([1.0, 3.0, 2.0].into_iter().fold(0.0, max_or_nan), 3.0);
        for values in [
            [f64::NAN, 1.0, 2.0],
            [1.0, f64::NAN, 2.0],
            [1.0, 2.0, f64::NAN],
        ] {
            assert!(values.into_iter().fold(0.0, max_or_nan).is_nan());
        }
    }
}
