//! Statements, guesses and options that no sane caller gives: one clear error each, never a panic.

mod calls;
mod guesses;
mod statements;

use bvp::{Constant, Ends, Error, Guess, Options, Problem, Real, Segment, Solution, solve};

/// y′ = −y + p on any segments; conditions that fix the first states, or none of them.
#[derive(Clone, Debug)]
struct Plain {
    segments: Vec<Segment>,
    parameters: usize,
    count: Option<usize>,
    /// Factor of the unknowns in the conditions: zero ignores them all.
    weight: f64,
    /// Factor of the right-hand side.
    size: f64,
    /// What the conditions ask for.
    value: f64,
}

impl Default for Plain {
    fn default() -> Self {
        Self {
            segments: vec![Segment::new(1)],
            parameters: 0,
            count: None,
            weight: 1.0,
            size: 1.0,
            value: 1.0,
        }
    }
}

impl Problem for Plain {
    fn segments(&self) -> Vec<Segment> {
        self.segments.clone()
    }

    fn parameters(&self) -> usize {
        self.parameters
    }

    fn condition_count(&self) -> usize {
        let states = || self.segments.iter().map(|s| s.states).sum::<usize>();
        self.count.unwrap_or_else(|| states() + self.parameters)
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let zero = T::from_f64(0.0);
        let p = p.first().copied().unwrap_or(zero);
        for (dy, y) in dy.iter_mut().zip(y) {
            *dy = (p - *y) * self.size;
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let mut starts = (0..self.segments.len()).flat_map(|i| at.start(i)).chain(p);
        for r in r {
            let y = starts.next().copied().unwrap_or_else(|| T::from_f64(0.0));
            *r = (y - self.value) * self.weight;
        }
    }
}

impl Plain {
    fn on(from: f64, to: f64) -> Self {
        Self {
            segments: vec![Segment::on(1, from, to)],
            ..Self::default()
        }
    }

    fn guess(&self, value: f64) -> Constant {
        Constant {
            states: self
                .segments
                .iter()
                .map(|s| vec![value; s.states])
                .collect(),
            parameters: vec![value; self.parameters],
        }
    }

    fn solved(&self) -> Result<Solution, Error> {
        solve(self, &self.guess(0.5), &Options::default())
    }
}

/// A guess with a mesh of its own.
struct Meshed(Vec<Vec<f64>>);

impl Guess for Meshed {
    fn state(&self, _segment: usize, _s: f64, y: &mut [f64]) {
        y.fill(0.5);
    }

    fn parameters(&self, p: &mut [f64]) {
        p.fill(0.5);
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        Some(self.0.clone())
    }
}
