//! Random numbers that are computed from what they are of: no state is kept, and none depends on another.

/// The mixing of `SplitMix64` (G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014), whose every output bit depends on every input
/// bit.
pub(super) fn mixed(state: u64) -> u64 {
    let state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let state = (state ^ state >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let state = (state ^ state >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    state ^ state >> 31
}

/// The key of a number of a sample, of which its random numbers are mixed.
pub(super) fn key(seed: u64, number: usize) -> u64 {
    mixed(seed ^ mixed(number as u64))
}

/// A number from 0 to below 1 from the upper bits of a random one: as many as a double has.
pub(super) fn fraction(random: u64) -> f64 {
    (random >> 11) as f64 / (1_u64 << 53) as f64
}
