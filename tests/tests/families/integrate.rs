//! Initial value problems by extrapolation, for exact periods and for guesses.

/// Numbers of substeps 2, 4, … of one step: order 16.
const LEVELS: usize = 8;

/// One step of length `h` of the modified midpoint rule, extrapolated in h² (Bulirsch and Stoer,
/// Numer. Math. 8 (1966) 1-13).
pub(crate) fn step<const N: usize>(
    f: &impl Fn([f64; N]) -> [f64; N],
    y: [f64; N],
    h: f64,
) -> [f64; N] {
    let along = |y: [f64; N], slope: [f64; N], h: f64| std::array::from_fn(|i| y[i] + h * slope[i]);
    let mut row: Vec<[f64; N]> = vec![];
    for level in 1..=LEVELS {
        let part = h / (2 * level) as f64;
        let (mut before, mut now) = (y, along(y, f(y), part));
        for _ in 1..2 * level {
            (before, now) = (now, along(before, f(now), 2.0 * part));
        }
        let last = f(now);
        let rule = std::array::from_fn(|i| 0.5 * (now[i] + before[i] + part * last[i]));
        let mut next = vec![rule];
        for (k, coarser) in row.iter().enumerate() {
            let ratio = (level as f64 / (level - 1 - k) as f64).powi(2);
            let finer: [f64; N] = next[k];
            next.push(std::array::from_fn(|i| {
                finer[i] + (finer[i] - coarser[i]) / (ratio - 1.0)
            }));
        }
        row = next;
    }
    row[LEVELS - 1]
}

/// States at the ends of equal steps.
#[derive(Clone, Debug)]
pub(crate) struct Orbit<const N: usize> {
    pub(crate) step: f64,
    pub(crate) states: Vec<[f64; N]>,
}

impl<const N: usize> Orbit<N> {
    /// From `y` over a time in so many steps.
    pub(crate) fn new(
        f: &impl Fn([f64; N]) -> [f64; N],
        y: [f64; N],
        time: f64,
        steps: usize,
    ) -> Self {
        let h = time / steps as f64;
        let mut states = vec![y];
        for i in 0..steps {
            states.push(step(f, states[i], h));
        }
        Self { step: h, states }
    }

    /// The states at a time, between two steps linearly.
    pub(crate) fn at(&self, time: f64) -> [f64; N] {
        let place = (time / self.step).clamp(0.0, (self.states.len() - 1) as f64);
        let i = (0..self.states.len() - 2)
            .rfind(|&i| i as f64 <= place)
            .unwrap_or(0);
        let theta = place - i as f64;
        std::array::from_fn(|k| {
            self.states[i][k] + theta * (self.states[i + 1][k] - self.states[i][k])
        })
    }

    pub(crate) fn last(&self) -> [f64; N] {
        self.states[self.states.len() - 1]
    }
}

/// Time until state 1 falls below `zero`, and the states there.
pub(crate) fn to_falling_zero(
    f: &impl Fn([f64; 2]) -> [f64; 2],
    mut y: [f64; 2],
    zero: f64,
    h: f64,
) -> (f64, [f64; 2]) {
    let mut time = 0.0;
    loop {
        let next = step(f, y, h);
        // The first step may leave the place itself, to within rounding.
        if time > 0.0 && y[1] > zero && next[1] <= zero {
            break;
        }
        (time, y) = (time + h, next);
    }
    // Newton's method for the fraction of the step.
    let mut part = 0.5 * h;
    let mut there = y;
    for _ in 0..40 {
        there = step(f, y, part);
        let correction = (there[1] - zero) / f(there)[1];
        part -= correction;
        if correction.abs() < 1e-16 {
            break;
        }
    }
    (time + part, there)
}
