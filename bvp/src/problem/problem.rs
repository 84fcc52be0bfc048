//! The statement of a boundary value problem.

use crate::problem::real::{LeftOf, Real};

/// A smooth piece of the solution: its number of states and the interval of its variable s.
///
/// A problem is a list of segments that meet only through its conditions, so two-point, periodic,
/// multipoint, interface and free-length problems are stated the same way. An unknown length is
/// an unknown parameter: keep s in \[0, 1\] and multiply the right-hand side by the length.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Segment {
    /// Number of states n ≥ 1 of this segment.
    pub states: usize,
    /// Where s starts.
    pub from: f64,
    /// Where s ends; smaller than `from` if s descends along the segment.
    pub to: f64,
    /// The joined points, inside the segment and in the order from `from` to `to`.
    pub joined: Vec<f64>,
}

impl Segment {
    /// A segment with `states` states on 0 ≤ s ≤ 1.
    pub const fn new(states: usize) -> Self {
        Self::on(states, 0.0, 1.0)
    }

    /// A segment with `states` states, with s from `from` to `to`. Where `from` is the larger of the
    /// two, s descends: the start of the segment is at `from`, its mesh descends, and derivatives are
    /// those with respect to s all the same.
    pub const fn on(states: usize, from: f64, to: f64) -> Self {
        let joined = vec![];
        Self {
            states,
            from,
            to,
            joined,
        }
    }

    /// The same segment joined at points inside it, in the order from `from` to `to`. The states are
    /// continuous there and may enter the conditions, as [`Ends::joined`]; the right-hand side may
    /// jump there as a function of s.
    ///
    /// ```
    /// use bvp::{Constant, Ends, Options, Problem, Real, Segment, solve};
    ///
    /// /// y'' = 2 with y(0) = 0 and y(0.3) = 0, so that y = s (s − 0.3).
    /// struct Parabola;
    ///
    /// impl Problem for Parabola {
    ///     fn segments(&self) -> Vec<Segment> {
    ///         vec![Segment::new(2).joined(&[0.3])]
    ///     }
    ///
    ///     fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
    ///         dy[0] = y[1];
    ///         dy[1] = T::from(2.0);
    ///     }
    ///
    ///     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
    ///         r[0] = at.start(0)[0];
    ///         r[1] = at.joined(0, 0)[0];
    ///     }
    /// }
    ///
    /// let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![] };
    /// let solution = solve(&Parabola, &guess, &Options::default())?;
    /// assert!((solution.end(0)[0] - 0.7).abs() < 1e-12);
    /// # Ok::<(), bvp::Error>(())
    /// ```
    #[must_use]
    pub fn joined(mut self, points: &[f64]) -> Self {
        self.joined = points.to_vec();
        self
    }

    /// Whether s descends.
    pub(crate) fn is_reversed(&self) -> bool {
        self.from > self.to
    }

    /// Whether these nodes run from its start to its end without turning back.
    pub(crate) fn has_mesh(&self, nodes: &[f64]) -> bool {
        let is_onward = |pair: &[f64]| match self.is_reversed() {
            true => pair[0] > pair[1],
            false => pair[0] < pair[1],
        };
        nodes.len() >= 2
            && nodes.first() == Some(&self.from)
            && nodes.last() == Some(&self.to)
            && nodes.windows(2).all(is_onward)
    }

    /// Number of values at its ends and joined points: two of every piece.
    fn values(&self) -> usize {
        2 * self.states * (self.joined.len() + 1)
    }
}

/// The states at both ends of every segment and at its joined points, as the conditions see them.
///
/// The values lie in one slice: start of segment 0, end of segment 0, start of segment 1, … A joined
/// point stands between start and end of its segment, twice, as seen from before and from behind it.
#[derive(Clone, Copy, Debug)]
pub struct Ends<'a, T> {
    segments: &'a [Segment],
    values: &'a [T],
}

impl<'a, T> Ends<'a, T> {
    /// Views `values`: Σ 2 nᵢ (jᵢ + 1) numbers, for segments with nᵢ states and jᵢ joined points.
    ///
    /// # Panics
    /// If the number of values differs.
    pub fn new(segments: &'a [Segment], values: &'a [T]) -> Self {
        let count: usize = segments.iter().map(Segment::values).sum();
        assert_eq!(values.len(), count, "one value per state and end");
        Self { segments, values }
    }

    /// The states at the start of a segment, where s is [`Segment::from`].
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn start(&self, segment: usize) -> &'a [T] {
        let first = self.offset(segment);
        &self.values[first..first + self.segments[segment].states]
    }

    /// The states at the end of a segment, where s is [`Segment::to`].
    ///
    /// # Panics
    /// If there is no such segment.
    pub fn end(&self, segment: usize) -> &'a [T] {
        let behind = self.offset(segment + 1);
        &self.values[behind - self.segments[segment].states..behind]
    }

    /// The states at a joined point of a segment, numbered as in [`Segment::joined`].
    ///
    /// # Panics
    /// If there is no such segment or point.
    pub fn joined(&self, segment: usize, point: usize) -> &'a [T] {
        let Segment { states, joined, .. } = &self.segments[segment];
        assert!(point < joined.len(), "a joined point of the segment");
        let first = self.offset(segment) + 2 * states * (point + 1);
        &self.values[first..first + states]
    }

    /// All values, in their order.
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
        self.segments[..segment].iter().map(Segment::values).sum()
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
    /// number that a well-posed problem needs, Σ nᵢ + k: one that `conditions` leaves out is refused as not
    /// written, and one too many is beyond the end of its slice. State your own count to have it checked before.
    /// A problem with fewer conditions is a [`Family`](crate::Family), which must state their number, and
    /// [`solve`](crate::solve) refuses it.
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

    /// Whether the right-hand side on a segment depends on a parameter: true for all by default. With many parameters of
    /// which a segment has few, such as one length for every segment, Jacobians are found faster if the others are
    /// known. The derivatives by those are taken to be zero; compare with
    /// [`check_jacobians`](crate::check_jacobians).
    fn depends(&self, segment: usize, parameter: usize) -> bool {
        let _ = (segment, parameter);
        true
    }

    /// The conditions: `r` = g(ends, p), zero at the solution. Every entry must be written.
    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T])
    where
        f64: LeftOf<T>;
}
