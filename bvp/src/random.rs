//! Random signs, always the same.

/// The signs of Knuth's multiplicative congruential generator (D. E. Knuth, *The Art of Computer
/// Programming*, vol. 2, 3rd ed., section 3.3.4).
pub(crate) struct Signs {
    state: u64,
}

impl Default for Signs {
    fn default() -> Self {
        Self { state: 1 }
    }
}

impl Signs {
    /// x or −x.
    pub(crate) fn turn(&mut self, x: f64) -> f64 {
        self.state = self
            .state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        if self.state >> 63 == 1 { -x } else { x }
    }
}
