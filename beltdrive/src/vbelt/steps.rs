//! Steps of a homotopy: they double where they are easy and shrink where they fail.

/// A homotopy ends when its steps have shrunk to this fraction of the first.
const SHORTEST_STEP: f64 = 0.02;

/// The values of a parameter on the way from one to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Steps {
    here: f64,
    to: f64,
    first: f64,
    step: f64,
}

impl Steps {
    /// From a value whose member is solved, with the length of the first step.
    pub(super) fn new([from, to]: [f64; 2], first: f64) -> Self {
        Self {
            here: from,
            to,
            first,
            step: first,
        }
    }

    /// The next value to be tried; `None` at the end of the way.
    pub(super) fn next(&self) -> Option<f64> {
        let left = self.to - self.here;
        (left != 0.0).then(|| {
            if left.abs() <= 1.2 * self.step {
                self.to
            } else {
                self.here + self.step.copysign(left)
            }
        })
    }

    /// The member at `next` was solved: the next step is twice as long if that was easy.
    pub(super) fn solved(&mut self, next: f64, easily: bool) {
        if easily {
            self.step *= 2.0;
        }
        self.here = next;
    }

    /// The member at `next` was not solved: a shorter step. Returns whether there is one.
    pub(super) fn failed(&mut self, next: f64) -> bool {
        self.step = 0.4 * (next - self.here).abs();
        self.step >= SHORTEST_STEP * self.first
    }
}
