//! A fixed sequence of random signs.

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
    /// x with the next sign: x or −x.
    pub(crate) fn turn(&mut self, x: f64) -> f64 {
        self.state = self
            .state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        if self.state >> 63 == 1 { -x } else { x }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_repeat_and_are_both_as_frequent() {
        let draw = || {
            let mut signs = Signs::default();
            (0..10_000).map(|_| signs.turn(2.0)).collect::<Vec<f64>>()
        };
        let drawn = draw();
        assert_eq!(drawn, draw());
        assert!(drawn.iter().all(|x| x.abs() == 2.0));
        // Four standard deviations of the sum of this many signs.
        assert!(drawn.iter().sum::<f64>().abs() < 2.0 * 4.0 * 100.0);
        let changes = drawn.windows(2).filter(|pair| pair[0] != pair[1]).count();
        assert!(changes.abs_diff(5_000) < 200, "{changes}");
    }
}
