//! The statement of a boundary value problem.

use crate::problem::real::{LeftOf, Real};

/// A smooth piece of the solution: its number of states and the interval of its variable s.
///
/// A problem is a list of segments that meet only through its conditions, so two-point, periodic,
/// multipoint, interface and free-length problems are stated the same way. An unknown length is
/// an unknown parameter: keep s in \[0, 1\] and multiply the right-hand side by the length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Number of states n ≥ 1 of this segment.
    pub states: usize,
    /// Left end of the interval of s.
    pub from: f64,
    /// Right end of the interval of s; greater than `from`.
    pub to: f64,
}

impl Segment {
    /// A segment with `states` states on 0 ≤ s ≤ 1.
    pub const fn new(states: usize) -> Self {
        Self::on(states, 0.0, 1.0)
    }

    /// A segment with `states` states on `from` ≤ s ≤ `to`.
    pub const fn on(states: usize, from: f64, to: f64) -> Self {
        Self { states, from, to }
    }
}

/// The states at both ends of every segment, as the conditions see them.
///
/// The values lie in one slice: start of segment 0, end of segment 0, start of segment 1, …
#[derive(Clone, Copy, Debug)]
pub struct Ends<'a, T> {
    segments: &'a [Segment],
    values: &'a [T],
}

impl<'a, T> Ends<'a, T> {
    /// Views `values` (Σ 2 nᵢ numbers: start and end of each segment in turn).
    ///
    /// # Panics
    /// If the number of values is not Σ 2 nᵢ.
    pub fn new(segments: &'a [Segment], values: &'a [T]) -> Self {
        let count: usize = segments.iter().map(|segment| 2 * segment.states).sum();
        assert_eq!(values.len(), count, "one value per state and end");
        Self { segments, values }
    }

    /// The states at the left end of a segment.
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn start(&self, segment: usize) -> &'a [T] {
        let first = self.offset(segment);
        &self.values[first..first + self.segments[segment].states]
    }

    /// The states at the right end of a segment.
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn end(&self, segment: usize) -> &'a [T] {
        let states = self.segments[segment].states;
        let first = self.offset(segment) + states;
        &self.values[first..first + states]
    }

    /// All values: start of segment 0, end of segment 0, start of segment 1, …
    pub fn values(&self) -> &'a [T] {
        self.values
    }

    /// Other values at the same ends.
    pub(crate) fn with<'b, U>(&self, values: &'b [U]) -> Ends<'b, U>
    where
        'a: 'b,
    {
        Ends::new(self.segments, values)
    }

    fn offset(&self, segment: usize) -> usize {
        self.segments[..segment].iter().map(|s| 2 * s.states).sum()
    }
}

/// A boundary value problem, generic in the scalar so that its Jacobians are exact.
///
/// ```text
/// dy/ds = f(s, y, p)        on each segment, nᵢ states
/// g(all ends, p) = 0        Σ nᵢ + k conditions, k unknown parameters
/// ```
///
/// Every `Problem` is an [`Equations`](crate::Equations) by forward-mode automatic
/// differentiation; this is all a user has to write. Its functions are pure, and several threads may
/// evaluate them at once.
pub trait Problem: Sync {
    /// The smooth segments, in the order in which they are numbered.
    fn segments(&self) -> Vec<Segment>;

    /// Number k of unknown scalar parameters.
    fn parameters(&self) -> usize {
        0
    }

    /// Number of conditions that [`conditions`](Self::conditions) writes. The default is the
    /// number that a well-posed problem needs, Σ nᵢ + k; state your own count to have it checked. A
    /// problem with fewer conditions is a [`Family`](crate::Family), and [`solve`](crate::solve)
    /// refuses it.
    fn condition_count(&self) -> usize {
        self.segments().iter().map(|s| s.states).sum::<usize>() + self.parameters()
    }

    /// The right-hand side: `dy` = f(s, y, p) on `segment`. `dy` has as many entries as `y`, and
    /// every one must be written.
    ///
    /// The bound lets numbers stand on the left, as in `2.0 * y[0]`; an implementation that does
    /// without them may leave it out. See [`LeftOf`].
    fn rhs<T: Real>(&self, segment: usize, s: T, y: &[T], p: &[T], dy: &mut [T])
    where
        f64: LeftOf<T>;

    /// The conditions: `r` = g(ends, p), zero at the solution. Every entry must be written.
    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T])
    where
        f64: LeftOf<T>;
}
