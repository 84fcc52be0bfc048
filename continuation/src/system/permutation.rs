//! Permutations.

/// +1 for an even permutation, −1 for an odd one.
pub(crate) fn parity(permutation: &[usize]) -> f64 {
    let mut seen = vec![false; permutation.len()];
    let mut sign = 1.0;
    for start in 0..permutation.len() {
        let (mut next, mut length) = (start, 0);
        while !seen[next] {
            seen[next] = true;
            next = permutation[next];
            length += 1;
        }
        if length > 0 && length % 2 == 0 {
            sign = -sign;
        }
    }
    sign
}
