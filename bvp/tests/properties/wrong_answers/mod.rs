//! Families of problems in which solutions were once accepted that were wrong.

mod growth;
mod not_isolated;
mod not_smooth;
mod scales;
mod shocks;
mod singular_ends;
mod unseen;

use bvp::{Error, Solution};

/// From this many tolerances on an accepted solution is wrong.
const WRONG: f64 = 10.0;

/// What came of attempts at a family.
#[derive(Debug, Default)]
struct Score {
    solved: usize,
    refused: usize,
}

impl Score {
    /// Counts an attempt; the error of a solution is that in its first state, relative to 1 + |y|, at a
    /// thousand places.
    fn count(
        &mut self,
        name: &str,
        tolerance: f64,
        outcome: Result<Solution, Error>,
        exact: impl Fn(f64) -> f64,
    ) {
        let Ok(solution) = outcome else {
            self.refused += 1;
            return;
        };
        let (from, to) = (solution.segments()[0].from, solution.segments()[0].to);
        let mut y = vec![0.0; solution.segments()[0].states];
        let error = (0..=1000).fold(0.0, |m: f64, i| {
            let s = from + (to - from) * f64::from(i) / 1000.0;
            solution.state(0, s, &mut y);
            m.max((y[0] - exact(s)).abs() / (1.0 + exact(s).abs()))
        });
        assert!(
            error <= WRONG * tolerance,
            "{name} at {tolerance:e}: {error:e}"
        );
        self.solved += 1;
    }
}

/// Places in \[0, 1) without a pattern.
fn place(i: u32) -> f64 {
    (0.5 + f64::from(i) * 0.754_877_666_246_692_7).fract()
}
